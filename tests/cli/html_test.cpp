// SPDX-License-Identifier: GPL-3.0-or-later
// --html: the page's content, and the other files of a run.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "droplet/io/page.h"
#include "support/base64.h"
#include "support/command.h"
#include "support/paths.h"

namespace droplet {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::CommandOptions;
using testing::CommandResult;
using testing::discPicture;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::readFile;
using testing::runDroplet;
using testing::ScratchDirectory;
using ::testing::StartsWith;
using testing::writeFile;

/// Content of a script element.
std::string script(const std::string& html, const std::string& id)
{
    const auto at = html.find("<script id=\"" + id + "\"");
    const auto begin = html.find('>', at) + 1;
    return at == std::string::npos ? "" : html.substr(begin, html.find("</script>", begin) - begin);
}

std::string modelOf(const std::string& html)
{
    return testing::decodedBase64(script(html, "model"));
}

json contentOf(const std::string& html)
{
    return json::parse(script(html, "content"));
}

/// JSON chunk of a GLB.
json gltfOf(const std::string& glb)
{
    std::array<std::uint32_t, 5> head{};
    EXPECT_GE(glb.size(), sizeof head);
    std::memcpy(head.data(), glb.data(), sizeof head);
    return json::parse(glb.substr(sizeof head, head[3]));
}

class HtmlTest : public ::testing::Test {
protected:
    HtmlTest()
    {
        if (!hasPage()) {
            throw std::logic_error("this test needs a program with --html built in");
        }
        writeFile(directory() / "disc.pgm", discPicture(64, 24.0));
    }

    [[nodiscard]] const fs::path& directory() const { return scratch_.path(); }
    [[nodiscard]] std::string bytesOf(const std::string& name) const { return readFile(directory() / name); }
    [[nodiscard]] std::vector<std::string> names() const { return scratch_.names(); }

    [[nodiscard]] CommandResult run(std::vector<std::string> arguments) const
    {
        arguments.insert(arguments.end(), {"--triangles", "500", "-q"});
        CommandOptions options;
        options.directory = directory();
        return runDroplet(arguments, options);
    }

    void make(const std::vector<std::string>& arguments) const
    {
        const auto result = run(arguments);
        ASSERT_EQ(result.exit_code, 0) << result.error;
        EXPECT_EQ(result.output + result.error, "");
    }

private:
    ScratchDirectory scratch_;
};

TEST_F(HtmlTest, DoesNotChangeTheOtherFiles)
{
    for (const std::string extension : {".glb", ".gltf", ".ply"}) {
        make({"disc.pgm", "plain" + extension, "--json", "plain.json"});
        make({"disc.pgm", "beside" + extension, "--html", "page.html", "--json", "beside.json"});
        EXPECT_EQ(bytesOf("plain" + extension), bytesOf("beside" + extension));
        json plain = json::parse(bytesOf("plain.json"));
        json beside = json::parse(bytesOf("beside.json"));
        for (json* report : {&plain, &beside}) {
            report->erase("time_s");
            report->erase("peak_memory_bytes");
            (*report)["output"].erase("path");
        }
        EXPECT_EQ(plain, beside);
        EXPECT_TRUE(beside["fill"]["range"].is_null()) << "only the page has a slider";
    }
}

TEST_F(HtmlTest, HasASliderIfPossible)
{
    make({"disc.pgm", "disc.obj", "--html", "page.html", "--model", "linear"});
    EXPECT_EQ(gltfOf(modelOf(bytesOf("page.html")))["meshes"][0]["extras"]["fill_range"], json({0.0, 2.0}));
    make({"disc.pgm", "disc.obj", "--html", "page.html", "--fill-range", "0.5..3", "--model", "linear"});
    EXPECT_EQ(gltfOf(modelOf(bytesOf("page.html")))["meshes"][0]["extras"]["fill_range"], json({0.5, 3.0}));
    make({"disc.pgm", "disc.obj", "--html", "page.html", "--model", "exact"});
    const json solved = gltfOf(modelOf(bytesOf("page.html")))["meshes"][0]["extras"];
    EXPECT_EQ(solved["fill_range"][0], 0.0);
    EXPECT_GT(solved["fill_range"][1], 1.2);
    EXPECT_EQ(solved["fills"].size(), solved["targetNames"].size());
    make({"disc.pgm", "disc.obj", "--html", "page.html", "--no-penetration"});
    EXPECT_FALSE(gltfOf(modelOf(bytesOf("page.html")))["meshes"][0].contains("weights"));
}

TEST_F(HtmlTest, ContainsTheWrittenGlb)
{
    make({"disc.pgm", "disc.glb", "--html", "page.html", "--fill-range", "0..2", "--material", "honey"});
    EXPECT_EQ(modelOf(bytesOf("page.html")), bytesOf("disc.glb"));
    make({"disc.pgm", "disc.glb", "--html", "page.html", "--no-penetration", "--open"});
    EXPECT_EQ(modelOf(bytesOf("page.html")), bytesOf("disc.glb"));
}

TEST_F(HtmlTest, HasTheObjectBelowTheDroplets)
{
    writeFile(directory() / "spot.pgm",
              testing::greymap(64, 64, [](int x, int y) { return std::hypot(x - 31.5, y - 16.5) < 8.0 ? 255 : 0; }));
    const std::vector<std::string> onto{"--onto", testing::inSource("data/can.glb"), "--html", "page.html"};
    const auto page_of = [&](std::vector<std::string> arguments) {
        arguments.insert(arguments.end(), onto.begin(), onto.end());
        make(arguments);
        return modelOf(bytesOf("page.html"));
    };
    const std::string model = page_of({"spot.pgm", "laid.glb"});
    EXPECT_EQ(gltfOf(model)["nodes"][0]["name"], "object");
    EXPECT_EQ(gltfOf(model)["materials"][0]["name"], "paint");
    EXPECT_EQ(model, bytesOf("laid.glb"));
    // Other formats hold the droplets alone, but the page shows the object all the same.
    EXPECT_EQ(page_of({"spot.pgm", "laid.stl"}), model);
    const std::string alone = page_of({"spot.pgm", "alone.glb", "--droplets-only"});
    EXPECT_EQ(alone, bytesOf("alone.glb"));
    EXPECT_EQ(gltfOf(alone)["nodes"].size(), 1U);
}

TEST_F(HtmlTest, MaterialAffectsThePage)
{
    make({"disc.pgm", "disc.stl", "--html", "page.html", "--material", "mercury"});  // no warning
    EXPECT_EQ(gltfOf(modelOf(bytesOf("page.html")))["materials"][0]["name"], "mercury");
}

TEST_F(HtmlTest, ContainsTheReportAndThePicturesName)
{
    make({"disc.pgm", "out.glb", "--html", "page.html", "--json", "report.json", "--volume", "20uL"});
    json report = json::parse(bytesOf("report.json"));
    report.erase("time_s");
    report.erase("peak_memory_bytes");
    const json content = contentOf(bytesOf("page.html"));
    EXPECT_EQ(content["title"], "disc");
    EXPECT_EQ(content["report"], report);
    EXPECT_NEAR(content["report"]["shape"]["volume_ul"].get<double>(), 20.0, 1e-6);
}

TEST_F(HtmlTest, EscapesNamesOfPictures)
{
    const std::string odd = "a \"b\" <script>alert(1)<!-- & \xff.pgm";
    writeFile(directory() / odd, discPicture(64, 24.0));
    make({odd, "out.glb", "--html", "page.html"});
    make({"disc.pgm", "out.glb", "--html", "plain.html"});
    const json content = contentOf(bytesOf("page.html"));
    EXPECT_EQ(content["title"], "a \"b\" <script>alert(1)<!-- & \xef\xbf\xbd");
    EXPECT_EQ(content["report"]["input"]["path"], "a \"b\" <script>alert(1)<!-- & \xef\xbf\xbd.pgm");
    const auto count = [](const std::string& text, const std::string& word) {
        std::size_t found = 0;
        for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
            ++found;
        }
        return found;
    };
    for (const char* word : {"<script", "<!--", "</title"}) {
        EXPECT_EQ(count(bytesOf("page.html"), word), count(bytesOf("plain.html"), word)) << word;
    }
}

TEST_F(HtmlTest, IsTheSameWithAnyNumberOfThreads)
{
    make({"disc.pgm", "out.glb", "--html", "one.html", "-j", "1"});
    make({"disc.pgm", "out.glb", "--html", "two.html", "-j", "2"});
    EXPECT_EQ(bytesOf("one.html"), bytesOf("two.html"));
}

TEST_F(HtmlTest, PlaysDropletsThatRunWithTheirStreaks)
{
    writeFile(directory() / "slope.obj", "v 0 0 0\nv 100 0 0\nv 100 60 -100\nv 0 60 -100\nf 1 2 3\nf 1 3 4\n");
    const auto flow = [&](const std::string& output, std::vector<std::string> more) {
        std::vector<std::string> arguments{"flow", "slope.obj", output,  "--drops", "5",  "--hysteresis",
                                           "0.02", "--time",    "300ms", "--fps",   "10", "-q"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        CommandOptions options;
        options.directory = directory();
        const auto result = runDroplet(arguments, options);
        ASSERT_EQ(result.exit_code, 0) << result.error;
    };
    flow("plain.glb", {});
    flow("beside.glb", {"--html", "page.html"});
    EXPECT_EQ(bytesOf("plain.glb"), bytesOf("beside.glb"));
    const std::string page = bytesOf("page.html");
    EXPECT_EQ(contentOf(page)["title"], "beside");
    EXPECT_EQ(contentOf(page)["report"]["output"]["frames"], 3);
    EXPECT_FALSE(contentOf(page)["report"].contains("time_s"));
    flow("wet.glb", {"--streaks", "streaks.ply"});
    EXPECT_EQ(modelOf(page), bytesOf("wet.glb"));
    // The page has all frames, whatever the output is.
    flow("%02d.obj", {"--html", "meshes.html"});
    EXPECT_EQ(modelOf(bytesOf("meshes.html")), bytesOf("wet.glb"));
    flow("%02d.obj", {"--html", "meshes.html", "--resume"});
    EXPECT_EQ(modelOf(bytesOf("meshes.html")), bytesOf("wet.glb"));
}

TEST_F(HtmlTest, WritesToStandardOutput)
{
    const auto piped = run({"disc.pgm", "out.glb", "--html", "-"});
    ASSERT_EQ(piped.exit_code, 0) << piped.error;
    EXPECT_THAT(piped.output, StartsWith("<!doctype html>"));
    make({"disc.pgm", "out.glb", "--html", "page.html"});
    EXPECT_EQ(piped.output, bytesOf("page.html"));
}

TEST_F(HtmlTest, RefusesToReplaceOtherFiles)
{
    const auto refused = [&](const std::vector<std::string>& arguments, int exit_code, const std::string& words) {
        const auto result = run(arguments);
        EXPECT_EQ(result.exit_code, exit_code);
        EXPECT_THAT(result.error, HasSubstr(words));
    };
    refused({"disc.pgm", "out.glb", "--html", "disc.pgm"}, 2, "--html and INPUT are the same");
    refused({"disc.pgm", "out.glb", "--html", "./out.glb"}, 2, "--html and OUTPUT are the same");
    refused({"disc.pgm", "out.glb", "--html", "x", "--json", "x"}, 2, "are the same");
    refused({"disc.pgm", "out.glb", "--html", "nowhere/page.html"}, 4, "nowhere");
    refused({"disc.pgm", "out.glb", "--html", "/dev/full"}, 4, "/dev/full");
    writeFile(directory() / "page.html", "older");
    refused({"disc.pgm", "out.glb", "--html", "page.html", "--no-clobber"}, 4, "page.html");
    // If the report cannot be written, neither is the page.
    refused({"disc.pgm", "out.glb", "--html", "page.html", "--json", "/dev/full"}, 4, "/dev/full");
    EXPECT_EQ(bytesOf("page.html"), "older");
    EXPECT_THAT(names(), ElementsAre("disc.pgm", "page.html"));
}

}  // namespace
}  // namespace droplet
