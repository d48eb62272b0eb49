// SPDX-License-Identifier: GPL-3.0-or-later
// `droplet-shape compare`: exit codes, keys of the report, errors.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "cli/in_process.h"
#include "droplet/drawing/picture.h"
#include "droplet/io/output.h"
#include "support/command.h"
#include "support/paths.h"
#include "support/surfaces.h"

namespace droplet {
namespace {

using testing::CommandResult;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::roundDroplet;
using testing::runDroplet;
using ::testing::SizeIs;
using ::testing::StartsWith;

class CompareCommand : public ::testing::Test {
protected:
    /// Writes a surface and returns its path.
    [[nodiscard]] std::string file(const std::string& name, const Surface& surface) const
    {
        const std::string path = (scratch_.path() / name).string();
        std::ofstream out(path, std::ios::binary);
        writeSurface(surface, out, formatNamed(std::filesystem::path(name).extension().string()));
        return path;
    }

    static CommandResult compare(const std::vector<std::string>& arguments)
    {
        return runDroplet(withCommand(arguments));
    }

    static std::vector<std::string> withCommand(std::vector<std::string> arguments)
    {
        arguments.insert(arguments.begin(), "compare");
        return arguments;
    }

    static void expectRefused(const std::vector<std::string>& arguments, int exit_code, const std::string& words)
    {
        testing::expectOneLine(testing::runInProcess(withCommand(arguments)), exit_code, {words});
    }

    testing::ScratchDirectory scratch_;
};

TEST_F(CompareCommand, ToleranceDecidesTheExitCode)
{
    // Paraboloids of height 1 mm and 1.1 mm: their largest distance is 0.1 mm, at the top.
    const std::string a = file("a.glb", roundDroplet());
    const std::string b = file("b.obj", roundDroplet({.height = 1.1e-3}));
    EXPECT_EQ(compare({a, b}).exit_code, 0) << "no tolerance is given";
    EXPECT_EQ(compare({a, b, "--tolerance", "0.11mm"}).exit_code, 0);
    const CommandResult over = compare({a, b, "--tolerance", "90um"});
    EXPECT_EQ(over.exit_code, 1);
    ASSERT_THAT(over.errorLines(), SizeIs(1));
    EXPECT_THAT(over.error, StartsWith("droplet-shape: " + a + " and " + b + " differ: the largest distance of 0.1"));
    EXPECT_THAT(over.error, HasSubstr("is over 0.09 mm"));
    EXPECT_THAT(over.output, HasSubstr("distance"));

    EXPECT_EQ(compare({a, b, "--volume-tolerance", "10.1%"}).exit_code, 0);
    EXPECT_EQ(compare({b, a, "--volume-tolerance", "9.2%"}).exit_code, 0) << "share of the first volume";
    const CommandResult more = compare({a, b, "--volume-tolerance", "9%", "-q", "--tolerance", "1mm"});
    EXPECT_EQ(more.exit_code, 1);
    EXPECT_EQ(more.output, "");
    EXPECT_THAT(more.error, HasSubstr("the difference in volume of 10 % is over 9 %"));

    EXPECT_EQ(compare({a, b, "--normal-tolerance", "5deg"}).exit_code, 0);
    EXPECT_THAT(compare({a, b, "--normal-tolerance", "0.1deg"}).error, HasSubstr("the rms angle between normals"));
}

TEST_F(CompareCommand, AnyToleranceRequiresTheSameTopology)
{
    const std::string closed = file("closed.glb", roundDroplet());
    const std::string open = file("open.glb", roundDroplet({.open = true}));
    EXPECT_EQ(compare({closed, open}).exit_code, 0);
    for (const std::vector<std::string>& tolerance : {std::vector<std::string>{"--tolerance", "100m"},
                                                      {"--volume-tolerance", "100%"},
                                                      {"--normal-tolerance", "180deg"}}) {
        const CommandResult result = compare({closed, open, tolerance[0], tolerance[1]});
        EXPECT_EQ(result.exit_code, 1) << tolerance[0];
        EXPECT_THAT(result.error, HasSubstr("topology is not the same: 1 closed component of Euler number 2; 1 "
                                            "component of Euler number 1 with 1 boundary loops"));
    }
}

TEST_F(CompareCommand, AllFormatsHoldTheSameDroplet)
{
    const std::string first = file("droplet.glb", roundDroplet());
    for (const char* const name : {"droplet.glb", "droplet.gltf", "droplet.obj", "droplet.ply", "droplet.stl"}) {
        const CommandResult result = compare({first, file(name, roundDroplet()), "--tolerance", "1um"});
        EXPECT_EQ(result.exit_code, 0) << result.error;
    }
}

TEST_F(CompareCommand, RefusesFormatsThatAreOnlyWritten)
{
    const std::string glb = file("droplet.glb", roundDroplet());
    for (const char* const name : {"droplet.usda", "droplet.usdz"}) {
        const CommandResult result = compare({glb, file(name, roundDroplet())});
        EXPECT_EQ(result.exit_code, 2);
        EXPECT_THAT(result.error,
                    HasSubstr("USD and 3MF files are only written; glb, gltf, obj, ply and stl can be read"));
    }
}

// The facets of an STL are separate; the picture must have the colours of the connected surface.
TEST_F(CompareCommand, PictureOfSeparateFacetsIsColoured)
{
    const auto coloured = [&](const std::string& extension) {
        const std::string a = file("a" + extension, roundDroplet());
        const std::string b = file("b" + extension, roundDroplet({.height = 1.1e-3}));
        EXPECT_EQ(compare({a, b, "--picture", (scratch_.path() / "difference.png").string(), "-q"}).exit_code, 0);
        const Picture picture = readPicture(scratch_.path() / "difference.png");
        std::size_t count = 0;
        for (std::size_t i = 0; i < picture.rgb.size(); i += 3) {
            const auto [min, max] = std::minmax({picture.rgb[i], picture.rgb[i + 1], picture.rgb[i + 2]});
            count += max - min > 40 ? 1 : 0;
        }
        return count;
    };
    const std::size_t whole = coloured(".obj");
    EXPECT_GT(whole, 10'000U);
    EXPECT_NEAR(static_cast<double>(coloured(".stl")), static_cast<double>(whole), 0.2 * static_cast<double>(whole));
}

TEST_F(CompareCommand, ReportHasEveryKey)
{
    const std::string a = file("a.glb", testing::withContactAngles(roundDroplet()));
    const std::string b = file("b.glb", roundDroplet({.height = 1.1e-3}));
    const CommandResult result = compare({a, b, "--json", "-", "--tolerance", "10um", "--normal-tolerance", "90deg"});
    EXPECT_EQ(result.exit_code, 1);
    const auto json = nlohmann::ordered_json::parse(result.output);
    std::vector<std::string> keys;
    for (const auto& [key, value] : json.items()) {
        keys.push_back(key);
        if (value.is_object()) {
            for (const auto& [inner, unused] : value.items()) {
                keys.push_back(key + "." + inner);
            }
        }
    }
    EXPECT_EQ(json["schema"], "droplet-shape.compare/1");
    EXPECT_EQ(json["a"]["path"], a);
    EXPECT_EQ(json["a"]["triangles"], roundDroplet().triangles.size());
    EXPECT_NEAR(json["a"]["contact_angle_deg"]["min"].get<double>(), 17.76, 0.01);
    EXPECT_TRUE(json["b"]["contact_angle_deg"].is_null());
    EXPECT_TRUE(json["difference"]["contact_angle_mean_deg"].is_null());
    EXPECT_NEAR(json["difference"]["volume_share"].get<double>(), 0.1, 1e-6);
    EXPECT_NEAR(json["distance"]["upper_m"].get<double>(), 1e-4, 1e-6);
    EXPECT_LE(json["distance"]["lower_m"].get<double>(), json["distance"]["upper_m"].get<double>());
    EXPECT_EQ(json["tolerance"]["distance_m"], 1e-5);
    EXPECT_TRUE(json["tolerance"]["volume_share"].is_null());
    EXPECT_NEAR(json["tolerance"]["normals_deg"].get<double>(), 90.0, 1e-12);
    EXPECT_EQ(json["same_topology"], true);
    EXPECT_THAT(json["exceeded"], SizeIs(1));
    EXPECT_THAT(json["warnings"], IsEmpty());
    // docs/reports.md lists all keys.
    const std::string page = testing::readFile(testing::inSource("docs/reports.md"));
    const auto begin = page.find("```compare-report\n");
    ASSERT_NE(begin, std::string::npos);
    const std::string block = page.substr(begin + 18, page.find("\n```", begin) - begin - 18);
    std::vector<std::string> documented;
    std::istringstream lines(block);
    for (std::string line; std::getline(lines, line);) {
        const auto colon = line.find(':');
        std::istringstream heads(line.substr(0, colon));
        std::istringstream inner(colon == std::string::npos ? "" : line.substr(colon + 1));
        std::vector<std::string> inner_keys{std::istream_iterator<std::string>(inner), {}};
        for (std::string head; heads >> head;) {
            documented.push_back(head);
            for (const std::string& key : inner_keys) {
                documented.push_back(head + "." + key);
            }
        }
    }
    EXPECT_EQ(documented, keys);
}

TEST_F(CompareCommand, SameBytesWithAnyNumberOfThreads)
{
    const std::string a = file("a.glb", roundDroplet({.rings = 9, .segments = 31}));
    const std::string b = file("b.glb", roundDroplet({.rings = 7, .segments = 40}));
    const CommandResult one = compare({a, b, "--json", "-", "-j", "1"});
    const CommandResult more = compare({a, b, "--json", "-", "-j", "5"});
    EXPECT_EQ(one.exit_code, 0);
    EXPECT_EQ(one.output, more.output);
    EXPECT_EQ(compare({a, b, "-j", "1"}).output, compare({a, b, "-j", "5"}).output);
}

TEST_F(CompareCommand, RefusesWrongArguments)
{
    const std::string a = file("a.glb", roundDroplet());
    expectRefused({}, 2, "A is missing");
    expectRefused({a}, 2, "B is missing");
    expectRefused({a, a, a}, 2, "unexpected argument");
    expectRefused({a, "-"}, 2, "not from standard input");
    expectRefused({a, "b.xyz"}, 2, "xyz");
    expectRefused({a, "b"}, 2, "'b'");
    expectRefused({a, a, "--tolerance", "0.01"}, 2, "--tolerance");
    expectRefused({a, a, "--tolerance", "-1mm"}, 2, "--tolerance");
    expectRefused({a, a, "--volume-tolerance", "0.1"}, 2, "such as 0.1%");
    expectRefused({a, a, "--volume-tolerance", "101%"}, 2, "such as 0.1%");
    expectRefused({a, a, "--normal-tolerance", "1mm"}, 2, "--normal-tolerance");
    expectRefused({a, a, "--width", "1mm"}, 2, "unknown option");
    expectRefused({a, a, "--json", a}, 2, "--json");
    expectRefused({a, a, "--picture", "-", "--json", "-"}, 2, "--picture");
    expectRefused({a, a, "--picture", "a.jpg"}, 2, ".png");
}

TEST_F(CompareCommand, ReportsFilesThatCannotBeReadOrWritten)
{
    const std::string a = file("a.glb", roundDroplet());
    const std::string missing = (scratch_.path() / "missing.glb").string();
    expectRefused({a, missing}, 3, missing);
    const std::string text = (scratch_.path() / "text.ply").string();
    testing::writeFile(text, "no surface");
    expectRefused({text, a}, 3, text);
    expectRefused({a, a, "--json", (scratch_.path() / "no" / "report.json").string()}, 4, "report.json");
    expectRefused({a, a, "-q", "--json", "/dev/full"}, 4, "/dev/full");
    const std::string report = (scratch_.path() / "report.json").string();
    EXPECT_EQ(compare({a, a, "--json", report, "-q"}).exit_code, 0);
    expectRefused({a, a, "--json", report, "--no-clobber"}, 4, report);
}

}  // namespace
}  // namespace droplet
