// SPDX-License-Identifier: GPL-3.0-or-later
// Tests of the page in a real browser, from disk: display, controls, and no network requests.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "droplet/io/page.h"
#include "droplet/io/read_surface.h"
#include "support/command.h"
#include "support/paths.h"

namespace droplet {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::Each;
using ::testing::Gt;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::readFile;
using testing::runDroplet;
using testing::runProgram;
using testing::writeFile;

const std::string kHostile =
    "</script><script>window.executed=1</script></title><img src=x onerror=\"window.executed=1\"><!-- \"'&lt;";

/// Minimum share of pixels that a control changes; without an effect it stays below kNoise.
constexpr double kSeen = 0.02;
constexpr double kNoise = 0.002;

void makePages(const fs::path& folder)
{
    const auto make = [&](const std::string& html, const std::vector<std::string>& options,
                          const std::string& volume = "40uL") {
        std::vector<std::string> arguments{(folder / "disc.pgm").string(),
                                           fs::path(folder / html).replace_extension(".glb").string(),
                                           "--html",
                                           (folder / html).string(),
                                           "--triangles",
                                           "800",
                                           "--volume",
                                           volume,
                                           "-q"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        const auto run = runDroplet(arguments);
        ASSERT_EQ(run.exit_code, 0) << run.error;
    };
    writeFile(folder / "disc.pgm", testing::discPicture(64, 24.0));
    writeFile(folder / "picture.png", readFile(fs::path(testing::inSource("data/letter_g_1bit.png"))));
    make("water.html", {"--material", "ink", "--model", "linear"});
    make("full.html", {"--json", (folder / "full.json").string(), "--model", "linear"}, "80uL");
    make("exact.html", {"--model", "exact"});
    make("mercury.html", {"--liquid", "mercury"});
    // A droplet on a red can, and the droplet alone.
    writeFile(folder / "spot.pgm",
              testing::greymap(64, 64, [](int x, int y) { return std::hypot(x - 31.5, y - 16.5) < 6.0 ? 255 : 0; }));
    for (const std::string html : {"can.html", "off_can.html"}) {
        std::vector<std::string> arguments{(folder / "spot.pgm").string(),
                                           (folder / "can.glb").string(),
                                           "--onto",
                                           testing::inSource("data/can.glb"),
                                           "--html",
                                           (folder / html).string(),
                                           "--triangles",
                                           "800",
                                           "-q"};
        if (html == "off_can.html") {
            arguments.emplace_back("--droplets-only");
        }
        const auto laid = runDroplet(arguments);
        ASSERT_EQ(laid.exit_code, 0) << laid.error;
    }
    // A disc on black, red on the left and green on the right.
    std::string halves = "P6 64 64 255\n";
    for (int i = 0; i < 64 * 64; ++i) {
        const bool is_inside = std::hypot(i % 64 - 31.5, i / 64 - 31.5) < 24.0;
        halves += is_inside ? (i % 64 < 32 ? std::string("\xff\x20\x20") : std::string("\x20\xff\x20")) : "...";
    }
    writeFile(folder / "disc.ppm", halves);
    const auto pictured = runDroplet({(folder / "disc.ppm").string(), (folder / "out.obj").string(), "--html",
                                      (folder / "pictured.html").string(), "--triangles", "800", "--colour-map",
                                      "--channel", "luma", "--threshold", "0.25", "-q"});
    ASSERT_EQ(pictured.exit_code, 0) << pictured.error;
    fs::create_directory(folder / "frames");
    for (const auto& [name, radius] : {std::pair("1.pgm", 24.0), std::pair("2.pgm", 14.0), std::pair("3.pgm", 0.0)}) {
        writeFile(folder / "frames" / name, testing::discPicture(64, radius));
    }
    const auto film = runDroplet({"animate", (folder / "frames").string(), (folder / "film.glb").string(), "--html",
                                  (folder / "film.html").string(), "--triangles", "800", "--volume", "40uL", "--fps",
                                  "3", "--material", "ink", "-q"});
    ASSERT_EQ(film.exit_code, 0) << film.error;
    std::ofstream hostile(folder / "hostile.html", std::ios::binary);
    const nlohmann::json report{
        {"input", {{"path", kHostile}}}, {"liquid", {{"name", kHostile}}}, {"warnings", {kHostile}}};
    writePage(hostile, {kHostile, "glTF, but no more", report.dump()});
}

TEST(PageInBrowser, ControlsWorkWithoutNetworkRequests)
{
    const testing::ScratchDirectory scratch;
    makePages(scratch.path());
    const auto run = runProgram({"node", testing::kPageDriver, testing::kChromium, scratch.path().string(),
                                 testing::inSource("src/html/figures.js")});
    ASSERT_EQ(run.exit_code, 0) << run.error;
    const auto seen = nlohmann::json::parse(run.output);
    SCOPED_TRACE(seen.dump(1));

    EXPECT_THAT(seen["complaints"], IsEmpty());
    EXPECT_THAT(seen["outside"], IsEmpty());

    const auto& wide = seen["wide"];
    EXPECT_EQ(wide["state"], "resting");
    EXPECT_GT(wide["colours"], 100);
    EXPECT_EQ(wide["frames_at_rest"], 0);
    EXPECT_TRUE(wide["labelled"]);
    EXPECT_THAT(wide["scale"].get<std::string>(), HasSubstr("mm"));

    // The slider fills the droplet from nothing to twice the liquid, in the picture and in the table.
    EXPECT_EQ(wide["range"], (nlohmann::json{"0", "2", "1"}));
    EXPECT_GT(wide["full"], kSeen);
    EXPECT_GT(wide["empty"], kSeen);
    EXPECT_LT(wide["filled_again"], kNoise);
    const auto& amounts = wide["amounts"];
    EXPECT_THAT(amounts[0].get<std::string>(), AllOf(HasSubstr("100"), HasSubstr("40.0"), HasSubstr("µL")));
    EXPECT_THAT(amounts[1].get<std::string>(), AllOf(HasSubstr("200"), HasSubstr("80.0"), HasSubstr("µL")));
    EXPECT_THAT(amounts[2].get<std::string>(), AllOf(::testing::StartsWith("0\u2009%"), HasSubstr("mm high")));

    EXPECT_GT(wide["turned_by_key"], kSeen);
    EXPECT_LT(wide["turned_back"], kNoise);
    ASSERT_EQ(wide["grounds"].size(), 2U);
    EXPECT_GT(wide["grounds"][0], kSeen);
    EXPECT_GT(wide["grounds"][1], kSeen);
    EXPECT_GT(wide["own_picture"], kSeen);
    EXPECT_EQ(wide["figures"]["Volume"], "40.0 µL");
    EXPECT_EQ(wide["figures"]["Liquid"], "Water");
    EXPECT_EQ(wide["figures"]["Picture"], "20.0 × 20.0 mm");
    // At twice the liquid the table equals that of a droplet made with twice the liquid; then it returns.
    for (const char* row : {"Volume", "Greatest height", "Contact angle", "Liquid surface", "Pressure", "Footprint"}) {
        EXPECT_EQ(wide["figures_full"][row], seen["told_full"][row]) << row;
    }
    EXPECT_NE(wide["figures_full"]["Contact angle"], wide["figures"]["Contact angle"]);
    EXPECT_THAT(wide["subtitle_full"].get<std::string>(), HasSubstr("80.0"));
    EXPECT_EQ(wide["figures_again"], wide["figures"]);
    EXPECT_TRUE(wide["figures"].contains("Pressure"));
    EXPECT_TRUE(wide["figures"].contains("Bond number"));

    EXPECT_EQ(wide["download"]["name"], "disc.glb");
    EXPECT_EQ(wide["download"]["sha256"], wide["download"]["embedded"]);
    // At another fill, the download is the droplet that is shown, without a slider.
    const ReadSurface filled = readSurface(scratch.path() / "filled.glb");
    const Surface full = readSurface(scratch.path() / "full.glb").surface;
    EXPECT_THAT(filled.warnings, IsEmpty());
    ASSERT_EQ(filled.surface.vertices.size(), full.vertices.size());
    EXPECT_EQ(filled.surface.triangles, full.triangles);
    for (std::size_t v = 0; v < full.vertices.size(); ++v) {
        ASSERT_LT(length(filled.surface.vertices[v] - full.vertices[v]), 1e-8);
        ASSERT_LT(length(filled.surface.normals[v] - full.normals[v]), 1e-5);
    }

    const auto& phone = seen["phone"];
    EXPECT_GT(phone["colours"], 50);
    EXPECT_LE(phone["overflow"], 0);
    EXPECT_LE(phone["overflow_open"], 0);
    EXPECT_LT(phone["panel_height"], 0.65);
    for (const auto& [control, reachable] : phone["reachable"].items()) {
        EXPECT_TRUE(reachable) << control;
    }
    EXPECT_NEAR(phone["fill"], 1.6, 0.1);
    EXPECT_GT(phone["filled"], kSeen);
    EXPECT_GT(phone["dragged"], kSeen);
    EXPECT_GT(phone["pinched"], kSeen);
    EXPECT_EQ(phone["page_zoom"], 1) << "the fingers zoom the droplet, not the page";

    EXPECT_TRUE(seen["exact"]["slider"]);
    EXPECT_NE(seen["exact"]["state"], "failed");

    const auto& film = seen["film"];
    EXPECT_FALSE(film["refill"]);
    EXPECT_EQ(film["duration"], 1.0);
    EXPECT_GT(film["shown"][0], kSeen) << "another droplet";
    EXPECT_GT(film["shown"][1], kSeen) << "nothing";
    EXPECT_GT(film["shown"][2], kSeen) << "nothing at the end, before it begins again";
    EXPECT_LT(film["shown"][3], kNoise);
    EXPECT_THAT(film["moments"][1].get<std::string>(),
                AllOf(HasSubstr("2 of 3"), HasSubstr("40.0"), HasSubstr("high")));
    EXPECT_THAT(film["moments"][2].get<std::string>(), HasSubstr("3 of 3 · no liquid"));
    EXPECT_EQ(film["words"], (nlohmann::json{"Play", "Pause"}));
    EXPECT_EQ(film["moved_in_pause"], 0.0);

    // Metal mirrors dark walls; without them nothing in the picture is dark.
    const auto& shades = seen["mercury"];
    EXPECT_GT(shades[0].get<double>() + shades[1].get<double>() + shades[2].get<double>(), kSeen);

    EXPECT_GT(seen["laid"]["red"], kSeen) << "the can";
    EXPECT_LT(seen["laid"]["red_alone"], kNoise);
    EXPECT_FALSE(seen["laid"]["refill"]);
    EXPECT_EQ(seen["laid"]["figures"]["Laid on"], "can.glb");

    EXPECT_GT(seen["pictured"]["red"], 0.5 * kSeen);
    EXPECT_GT(seen["pictured"]["green"], 0.5 * kSeen);

    const auto& hostile = seen["hostile"];
    EXPECT_FALSE(hostile["executed"]);
    EXPECT_TRUE(hostile["forbidden"]);
    EXPECT_EQ(hostile["title"], kHostile);
    EXPECT_EQ(hostile["heading"], kHostile);
    EXPECT_EQ(hostile["scripts"], 3);
    EXPECT_EQ(hostile["images"], 0);
    // The page reports a damaged model and still offers it for download.
    EXPECT_EQ(hostile["state"], "failed");
    EXPECT_TRUE(hostile["trouble"]);
    EXPECT_TRUE(hostile["download"]);
    EXPECT_THAT(seen["hostile_complaints"], ::testing::SizeIs(2))
        << "of the model, and of the script that was kept out";
}

}  // namespace
}  // namespace droplet
