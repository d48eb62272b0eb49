// SPDX-License-Identifier: GPL-3.0-or-later
// `droplet-shape morph`: kinds of output, footprints from pictures, drawings and text, errors.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "cli/in_process.h"
#include "droplet/mask/mask.h"
#include "support/command.h"
#include "support/paths.h"

namespace droplet {
namespace {

namespace fs = std::filesystem;
using testing::CommandResult;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::readFile;
using testing::runDroplet;
using ::testing::StartsWith;
using testing::writeFile;

class MorphCommand : public ::testing::Test {
protected:
    MorphCommand()
    {
        writeFile(path("square.pgm"), squareOf(20, 60, 40));
        writeFile(path("disc.svg"),
                  "<svg xmlns='http://www.w3.org/2000/svg' width='50' height='50'>"
                  "<circle cx='25' cy='25' r='20'/></svg>");
    }

    /// Bright square in the middle of a dark picture of 60 × `height` pixels.
    static std::string squareOf(int side, int width, int height)
    {
        std::string text = "P5\n" + std::to_string(width) + " " + std::to_string(height) + "\n255\n";
        for (int k = 0; k < width * height; ++k) {
            const int x = k % width - (width - side) / 2;
            const int y = k / width - (height - side) / 2;
            text += x >= 0 && y >= 0 && x < side && y < side ? '\xff' : '\0';
        }
        return text;
    }

    [[nodiscard]] std::string path(const std::string& name) const { return (scratch_.path() / name).string(); }

    [[nodiscard]] static CommandResult flow(const std::vector<std::string>& arguments)
    {
        return runDroplet(shortFlow(arguments));
    }

    static std::vector<std::string> shortFlow(std::vector<std::string> arguments)
    {
        arguments.insert(arguments.begin(), "morph");
        arguments.insert(arguments.end(), {"--frames", "5", "--particle-count", "1k", "--quiet"});
        return arguments;
    }

    static void expectRefused(const std::vector<std::string>& arguments, int exit_code, const std::string& message)
    {
        testing::expectOneLine(testing::runInProcess(shortFlow(arguments)), exit_code, {message});
    }

    testing::ScratchDirectory scratch_;
};

TEST_F(MorphCommand, MakesDropletsOfTheFlow)
{
    const CommandResult run = flow({path("square.pgm"), path("disc.svg"), path("out.glb"), "--triangles", "500",
                                    "--json", path("out.json"), "--width", "30mm"});
    ASSERT_EQ(run.exit_code, 0) << run.error;
    EXPECT_THAT(readFile(path("out.glb")), StartsWith("glTF"));
    const auto report = nlohmann::json::parse(readFile(path("out.json")));
    const auto& frames = report.at("frames");
    ASSERT_EQ(frames.size(), 5U);
    const auto volume = [&](std::size_t k) { return frames.at(k).at("volume_m3").get<double>(); };
    EXPECT_NEAR(volume(4) / volume(0), 1.0, 1e-9);
    // The square covers 20 of 60 pixels of 30 mm; the disc is as high as 0.8 of the window.
    EXPECT_NEAR(frames.at(0).at("footprint_area_m2").get<double>(), 1e-4, 1e-6);
    EXPECT_NEAR(frames.at(4).at("footprint_area_m2").get<double>(), 3.14159 * 8e-3 * 8e-3, 2e-6);
    const CommandResult packed = flow({path("square.pgm"), path("disc.svg"), path("out.zip"), "--triangles", "500"});
    ASSERT_EQ(packed.exit_code, 0) << packed.error;
    EXPECT_THAT(readFile(path("out.zip")), ::testing::AllOf(StartsWith("PK"), ::testing::HasSubstr("0005.glb")));
}

TEST_F(MorphCommand, WritesMasksDrawingsAndAStream)
{
    const std::vector<std::string> inputs{path("square.pgm"), path("disc.svg")};
    const auto to = [&](const std::string& output) { return flow({inputs[0], inputs[1], output}); };
    ASSERT_EQ(to(path("%02d.png")).exit_code, 0);
    const Mask mask = readMask(path("05.png"));
    EXPECT_EQ(mask.width, 60);
    EXPECT_EQ(mask.height, 40);
    EXPECT_EQ(mask.at(30, 20), 65535);
    ASSERT_EQ(to(path("%02d.svg")).exit_code, 0);
    EXPECT_THAT(readFile(path("03.svg")), HasSubstr("id=\"liquid\""));
    const CommandResult stream = to("-");
    ASSERT_EQ(stream.exit_code, 0) << stream.error;
    EXPECT_THAT(stream.output, StartsWith(readFile(path("01.png")) + readFile(path("02.png"))));
}

// Half transparent pixels have the liquid's own colour, also where the codec mixes neighbours. Without --alpha they are
// mixed with white.
TEST_F(MorphCommand, VideosKeepTransparency)
{
    const auto pixelsOf = [&](const std::string& name, const std::vector<std::string>& options) {
        std::vector<std::string> arguments{path("square.pgm"), path("square.pgm"), path(name), "--mask-width", "120"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        const CommandResult made = flow(arguments);
        EXPECT_EQ(made.exit_code, 0) << made.error;
        std::vector<std::string> command{"ffmpeg", "-v", "error"};
        if (name.ends_with("webm")) {
            command.insert(command.end(), {"-c:v", "libvpx-vp9"});  // ffmpeg's own decoder of VP9 drops alpha
        }
        command.insert(command.end(), {"-i", path(name), "-frames:v", "1", "-pix_fmt", "rgba", "-f", "rawvideo", "-"});
        const auto decoded = testing::runProgram(command);
        EXPECT_EQ(decoded.exit_code, 0) << decoded.error;
        EXPECT_EQ(decoded.output.size(), 4U * 120U * 80U);
        return decoded.output;
    };
    const std::array<int, 3> liquid{58, 134, 200};  // of the look `flat`
    for (const auto& [name, codec] : {std::pair("a.webm", ""), {"a.mov", ""}, {"p.mov", "png"}, {"q.mov", "qtrle"}}) {
        SCOPED_TRACE(name + std::string(" ") + codec);
        std::vector<std::string> options{"--alpha"};
        if (*codec != '\0') {
            options.insert(options.end(), {"--codec", codec});
        }
        const std::string pixels = pixelsOf(name, options);
        std::size_t opaque = 0;
        std::size_t clear = 0;
        std::size_t wrong = 0;
        for (std::size_t i = 0; i + 3 < pixels.size(); i += 4) {
            const int alpha = static_cast<unsigned char>(pixels[i + 3]);
            opaque += alpha > 250 ? 1 : 0;
            clear += alpha < 5 ? 1 : 0;
            for (std::size_t k = 0; alpha > 20 && k < 3; ++k) {
                wrong += std::abs(static_cast<unsigned char>(pixels[i + k]) - liquid.at(k)) > 8 ? 1 : 0;
            }
        }
        EXPECT_NEAR(static_cast<double>(opaque), 40.0 * 40.0, 200.0);
        EXPECT_NEAR(static_cast<double>(opaque + clear), 120.0 * 80.0, 400.0);
        EXPECT_EQ(wrong, 0U);
    }
    const std::string flat = pixelsOf("flat.mp4", {});
    EXPECT_GT(static_cast<unsigned char>(flat[0]), 250) << "white";
    expectRefused({path("square.pgm"), path("disc.svg"), path("a.mp4"), "--alpha"}, 2,
                  "has no alpha; .webm, .mkv and .mov");
    expectRefused({path("square.pgm"), path("disc.svg"), path("a.mov"), "--alpha", "--codec", "libx264"}, 2,
                  "--alpha: libx264 has no alpha");
    expectRefused({path("square.pgm"), path("disc.svg"), path("a.glb"), "--alpha"}, 2, "--alpha needs a video");
}

TEST_F(MorphCommand, BeginsWithAText)
{
    const CommandResult run = flow({"--text", "A & B", path("disc.svg"), path("%d.png"), "--mask-width", "200"});
    ASSERT_EQ(run.exit_code, 0) << run.error;
    const Mask first = readMask(path("1.png"));
    EXPECT_EQ(first.width, 200);
    EXPECT_EQ(first.height, 100);
    // The letters fill 0.8 of the width.
    int left = first.width;
    int right = 0;
    for (int y = 0; y < first.height; ++y) {
        for (int x = 0; x < first.width; ++x) {
            if (first.at(x, y) > 32767) {
                left = std::min(left, x);
                right = std::max(right, x);
            }
        }
    }
    EXPECT_NEAR(left, 20, 2);
    EXPECT_NEAR(right, 180, 2);
}

TEST_F(MorphCommand, RefusesWhatCannotFlow)
{
    const std::string square = path("square.pgm");
    const std::string out = path("out.glb");
    writeFile(path("other.pgm"), squareOf(10, 30, 30));
    writeFile(path("dry.pgm"), squareOf(0, 60, 40));
    expectRefused({square, path("other.pgm"), out}, 3, "all pictures must have one size");
    expectRefused({square, path("dry.pgm"), out}, 3, "dry.pgm");
    expectRefused({square, path("none.pgm"), out}, 3, "none.pgm");
    expectRefused({square, out}, 2, "fewer than two footprints");
    expectRefused({square, "-", out}, 2, "a picture in a file");
    expectRefused({square, square, path("x.png")}, 2, "a file for every frame, such as out/%04d.png");
    expectRefused({square, square, path("%d.png"), "--volume", "3uL"}, 2, "--volume needs droplets as OUTPUT");
    expectRefused({square, square, square, square, out}, 2, "3 transitions need at least 7 frames");
    expectRefused({square, square, out, "--look", "ink"}, 2, "--look needs drawings as OUTPUT");
    expectRefused({square, square, out, "--font-family", "serif"}, 2, "--font-family needs --text");
    expectRefused({square, square, out, "--rounding", "11"}, 2, "--rounding: '11' must be a number from 0 to 10");
    EXPECT_FALSE(fs::exists(out));
}

/// Masks and droplets of an interrupted run are not made again.
TEST_F(MorphCommand, ResumesAnInterruptedRun)
{
    for (const char* extension : {".png", ".obj"}) {
        SCOPED_TRACE(extension);
        const auto run_in = [&](const std::string& folder, std::vector<std::string> more) {
            fs::create_directory(path(folder));
            more.insert(more.begin(),
                        {path("square.pgm"), path("disc.svg"), path(folder + "/%d") + extension, "--fps", "2"});
            return flow(more);
        };
        ASSERT_EQ(run_in("whole", {}).exit_code, 0);
        fs::create_directories(path(std::string("cut/4") + extension) + "/x");
        ASSERT_EQ(run_in("cut", {}).exit_code, 4);
        ASSERT_TRUE(fs::exists(path("cut/checkpoint.state")));
        fs::remove_all(path(std::string("cut/4") + extension));
        writeFile(path(std::string("cut/1") + extension), "kept");
        const CommandResult resumed = run_in("cut", {"--resume"});
        ASSERT_EQ(resumed.exit_code, 0) << resumed.error;
        EXPECT_EQ(readFile(path(std::string("cut/1") + extension)), "kept");
        for (const char* name : {"2", "3", "4", "5"}) {
            EXPECT_EQ(readFile(path(std::string("cut/") + name + extension)),
                      readFile(path(std::string("whole/") + name + extension)))
                << name;
        }
        fs::remove_all(path("cut"));
        fs::remove_all(path("whole"));
    }
    expectRefused({path("square.pgm"), path("disc.svg"), path("a.glb"), "--resume"}, 2,
                  "--resume needs a file for every frame");
}

}  // namespace
}  // namespace droplet
