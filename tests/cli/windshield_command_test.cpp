// SPDX-License-Identifier: GPL-3.0-or-later
// `droplet-shape windshield`: outputs, errors, resuming an interrupted run.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "cli/in_process.h"
#include "droplet/drawing/picture.h"
#include "support/command.h"
#include "support/paths.h"

namespace droplet {
namespace {

using ::testing::AllOf;
using testing::CommandResult;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using testing::readFile;
using testing::runDroplet;
using ::testing::SizeIs;

Picture grey(int width, int height)
{
    const std::size_t levels = 3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    return {width, height, std::vector<std::uint8_t>(levels, 128)};
}

class WindshieldCommand : public ::testing::Test {
protected:
    [[nodiscard]] std::string path(const std::string& name) const { return (scratch_.path() / name).string(); }

    static CommandResult simulate(const std::string& output, const std::vector<std::string>& more = {})
    {
        return runDroplet(argumentsOf(output, more));
    }

    /// Arguments for a small glass, a small frame and a short time, unless `more` sets them.
    static std::vector<std::string> argumentsOf(const std::string& output, const std::vector<std::string>& more)
    {
        std::vector<std::string> arguments{"windshield", output, "--quiet"};
        const auto is_given = [&](const std::string& option) {
            return std::find(more.begin(), more.end(), option) != more.end();
        };
        const auto add = [&](const std::string& option, const std::string& value) {
            if (!is_given(option)) {
                arguments.push_back(option);
                arguments.push_back(value);
            }
        };
        add("--rain", "50mm/h");
        add("--eye-distance", "200mm");
        add("--warm-up", "0.3s");
        add("--time", "0.2s");
        if (!is_given("--surface")) {
            add("--glass-width", "300mm");
            add("--glass-height", "250mm");
        }
        if (!is_given("--background")) {
            add("--frame-size", "96x54");
        }
        arguments.insert(arguments.end(), more.begin(), more.end());
        return arguments;
    }

    void expectRefused(const std::vector<std::string>& arguments, int exit_code, const std::string& message) const
    {
        testing::expectOneLine(testing::runInProcess(argumentsOf(path("refused.png"), arguments)), exit_code,
                               {message});
        EXPECT_FALSE(std::filesystem::exists(path("refused.png")));
    }

    std::string stored(const std::string& name, const std::string& bytes) const
    {
        testing::writeFile(path(name), bytes);
        return path(name);
    }

    [[nodiscard]] std::vector<std::string> frames(const std::string& folder) const
    {
        std::vector<std::string> all;
        for (int k = 1; std::filesystem::exists(path(folder) + "/" + std::to_string(k) + ".png"); ++k) {
            all.push_back(readFile(path(folder) + "/" + std::to_string(k) + ".png"));
        }
        return all;
    }

    testing::ScratchDirectory scratch_;
};

TEST_F(WindshieldCommand, FramesAreTheSameWithAnyNumberOfThreads)
{
    // The folders of patterns are made.
    ASSERT_EQ(simulate(path("a/%d.png"), {"-j", "1"}).exit_code, 0);
    ASSERT_EQ(simulate(path("b/%d.png"), {"-j", "2"}).exit_code, 0);
    EXPECT_THAT(frames("a"), SizeIs(6));
    EXPECT_EQ(frames("a"), frames("b"));
    EXPECT_FALSE(std::filesystem::exists(path("a/checkpoint.state"))) << "the run is complete";
    // The picture of only the last frame is the same.
    ASSERT_EQ(simulate(path("last.png")).exit_code, 0);
    EXPECT_EQ(readPicture(path("last.png")), readPicture(path("a/6.png")));
}

TEST_F(WindshieldCommand, PresetsOfTheThesisDrawCapsules)
{
    const auto drawn = [&](const std::string& name, const std::vector<std::string>& more) {
        EXPECT_EQ(simulate(path(name), more).exit_code, 0);
        return readFile(path(name));
    };
    const std::string without = drawn("a.png", {"--speed", "54km/h", "--runoff", "0s"});
    const std::string with = drawn("b.png", {"--speed", "54km/h", "--preset", "figure-3.12"});
    EXPECT_NE(without, with);
    EXPECT_EQ(drawn("c.png", {"--speed", "54km/h", "--shape", "capsule", "--runoff", "0s"}), with);
    EXPECT_EQ(drawn("d.png", {"--speed", "54km/h", "--preset", "figure-3.12", "--shape", "capillary"}), without);
}

TEST_F(WindshieldCommand, WritesAllOutputs)
{
    std::filesystem::create_directory(path("f"));
    const CommandResult run = simulate(
        path("f/%d.png"), {"--layer", "--maps", path("f/m%d.png"), "--map-width", "64", "--droplets", path("d.csv"),
                           "--animation", path("d.glb"), "--animation-method", "texture", "--json", "-",
                           "--wiper-period", "1.5s", "--background-blur", "1deg", "--shutter", "180deg"});
    ASSERT_EQ(run.exit_code, 0) << run.error;
    const auto report = nlohmann::json::parse(run.output);
    EXPECT_EQ(report.at("schema"), "droplet-shape.windshield/1");
    EXPECT_EQ(report.at("output").at("frames"), 6);
    EXPECT_EQ(report.at("wipers").at("count"), 2);
    EXPECT_NEAR(report.at("view").at("shutter_open_s").get<double>(), 1.0 / 60.0, 1e-12);
    EXPECT_NEAR(report.at("view").at("background_blur_deg").get<double>(), 1.0, 1e-12);
    EXPECT_LT(report.at("largest_residual").get<double>(), 1e-9);
    EXPECT_GT(report.at("balance").back().at("rained_m3").get<double>(), 0.0);
    EXPECT_NEAR(report.at("balance").back().at("time_s").get<double>(), 0.3 + 5.0 / 30.0, 1e-9);
    std::istringstream rows(readFile(path("d.csv")));
    std::string last;
    for (std::string row; std::getline(rows, row);) {
        last = row;
    }
    EXPECT_THAT(last, ::testing::StartsWith("6,"));
    EXPECT_EQ(readFile(path("d.glb")).substr(0, 4), "glTF");
    for (const char* map : {"normal", "thickness", "velocity"}) {
        const std::string png = readFile(path(std::string("f/m6-") + map + ".png"));
        ASSERT_GT(png.size(), 30U);
        EXPECT_EQ(png[24], 16) << "bits per channel";
    }
    EXPECT_EQ(readFile(path("f/1.png"))[25], 6) << "with alpha";
    const CommandResult floats =
        simulate(path("x.png"), {"--maps", path("f/m%d.exr"), "--map-width", "64", "--time", "0.04s"});
    ASSERT_EQ(floats.exit_code, 0) << floats.error;
    for (const char* map : {"normal", "thickness", "velocity"}) {
        EXPECT_EQ(readFile(path(std::string("f/m1-") + map + ".exr")).substr(0, 4), "\x76\x2f\x31\x01");
    }
}

TEST_F(WindshieldCommand, PanoramaIsTheWholeBackground)
{
    std::ostringstream bytes;
    writePng(grey(64, 32), bytes);
    const std::string panorama = stored("panorama.png", bytes.str());
    const CommandResult run = simulate(path("x.png"), {"--environment", panorama, "--rain", "0mm/h", "--look-at",
                                                       "1m,1m,0m", "--json", path("r.json")});
    ASSERT_EQ(run.exit_code, 0) << run.error;
    const Picture seen = readPicture(path("x.png"));
    ASSERT_EQ(seen.width, 96);
    // Grey, except for the light that the pane absorbs.
    for (const std::uint8_t level : seen.rgb) {
        EXPECT_NEAR(level, 127, 1);
    }
    EXPECT_EQ(nlohmann::json::parse(readFile(path("r.json"))).at("view").at("environment"), panorama);
    EXPECT_EQ(simulate(panorama, {"--environment", panorama}).exit_code, 2) << "input and output are the same file";
}

TEST_F(WindshieldCommand, ResumedRunGivesTheSameBytes)
{
    const auto options = [&](const std::string& time) {
        return std::vector<std::string>{"--time", time, "--fps", "10", "--json", path("r.json")};
    };
    for (const char* folder : {"whole", "cut"}) {
        std::filesystem::create_directory(path(folder));
    }
    // A long run is killed when its thirteenth frame exists.
    const std::string script =
        R"("$@" & id=$!; while [ ! -e "$0" ]; do sleep 0.005; kill -0 $id || exit 1; done; kill -9 $id)";
    std::vector<std::string> command{"bash", "-c", script, path("cut/13.png"), testing::kCommand};
    for (const std::string& argument : argumentsOf(path("cut/%d.png"), options("600s"))) {
        command.push_back(argument);
    }
    testing::runProgram(command);
    ASSERT_TRUE(std::filesystem::exists(path("cut/checkpoint.state")));
    const auto before = frames("cut");
    ASSERT_GE(before.size(), 13U);
    // The number of frames depends on the moment of the kill.
    const std::size_t count = before.size() + 27;
    const std::string time = std::to_string(count) + "00ms";
    ASSERT_EQ(simulate(path("whole/%d.png"), options(time)).exit_code, 0);
    const auto whole = frames("whole");
    ASSERT_THAT(whole, SizeIs(count));
    const auto balance = nlohmann::json::parse(readFile(path("r.json"))).at("balance");
    EXPECT_TRUE(std::equal(before.begin(), before.end(), whole.begin())) << "existing frames are complete";
    // A run with other options must not resume.
    std::vector<std::string> more = options(time);
    more.emplace_back("--resume");
    std::vector<std::string> other = more;
    other.insert(other.end(), {"--speed", "3m/s"});
    const CommandResult refused = simulate(path("cut/%d.png"), other);
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_THAT(refused.errorLines(), ElementsAre(HasSubstr("with other options")));
    std::vector<std::string> shorter = options("0.5s");
    shorter.emplace_back("--resume");
    const CommandResult beyond = simulate(path("cut/%d.png"), shorter);
    EXPECT_EQ(beyond.exit_code, 2);
    EXPECT_THAT(beyond.errorLines(), ElementsAre(HasSubstr("frames exist already, but this run has 5")));
    // Missing frames are made again, existing ones are not.
    const auto fifth = std::filesystem::last_write_time(path("cut/5.png"));
    for (const bool is_missing : {false, true}) {
        if (is_missing) {
            std::filesystem::remove(path("cut/3.png"));
        }
        std::filesystem::copy_file(path("cut/checkpoint.state"), path("kept.state"),
                                   std::filesystem::copy_options::overwrite_existing);
        ASSERT_EQ(simulate(path("cut/%d.png"), more).exit_code, 0);
        EXPECT_TRUE(std::filesystem::exists(path("cut/3.png")));
        EXPECT_EQ(std::filesystem::last_write_time(path("cut/5.png")), fifth);
        EXPECT_FALSE(std::filesystem::exists(path("cut/checkpoint.state")));
        EXPECT_EQ(nlohmann::json::parse(readFile(path("r.json"))).at("balance"), balance);
        std::filesystem::rename(path("kept.state"), path("cut/checkpoint.state"));
    }
    EXPECT_EQ(frames("cut"), whole);
    // A new run removes the checkpoint of this one.
    EXPECT_EQ(simulate(path("cut/%d.png"), {"--time", "0.1s", "--fps", "10", "--no-clobber"}).exit_code, 4);
    EXPECT_TRUE(std::filesystem::exists(path("cut/checkpoint.state")));
    ASSERT_EQ(simulate(path("cut/%d.png"), {"--time", "0.1s", "--fps", "10", "--speed", "1m/s"}).exit_code, 0);
    EXPECT_FALSE(std::filesystem::exists(path("cut/checkpoint.state")));
}

TEST_F(WindshieldCommand, KeepsFilesOfOthers)
{
    std::filesystem::create_directory(path("f"));
    stored("f/checkpoint.state", "a letter");
    const CommandResult other = simulate(path("f/%d.png"));
    EXPECT_EQ(other.exit_code, 4);
    EXPECT_THAT(other.errorLines(), ElementsAre(HasSubstr("is not a checkpoint, and will not be replaced")));
    EXPECT_EQ(readFile(path("f/checkpoint.state")), "a letter");
    std::filesystem::remove(path("f/checkpoint.state"));
    std::ostringstream bytes;
    writePng(grey(96, 54), bytes);
    const std::string road = stored("f/4.png", bytes.str());
    const CommandResult behind = simulate(path("f/%d.png"), {"--background", road});
    EXPECT_EQ(behind.exit_code, 2);
    EXPECT_THAT(behind.errorLines(), ElementsAre(HasSubstr("OUTPUT and --background are the same")));
    const CommandResult kept = simulate(path("f/%d.png"), {"--no-clobber"});
    EXPECT_EQ(kept.exit_code, 4);
    EXPECT_THAT(kept.errorLines(), ElementsAre(HasSubstr("4.png")));
    EXPECT_FALSE(std::filesystem::exists(path("f/1.png"))) << "refused before any work is done";
    EXPECT_EQ(simulate(path("f/%d.png"), {"--droplets", path("f/2.csv"), "--json", path("f/2.png")}).exit_code, 2);
    EXPECT_EQ(readFile(road), bytes.str());
    EXPECT_EQ(simulate(path("f/%d.png"), {"--json", path("f/checkpoint.state")}).exit_code, 2);
}

TEST_F(WindshieldCommand, ReportsFilesBeyondTheSizeLimit)
{
    std::vector<std::string> command{"bash", "-c", "ulimit -f 4; exec \"$@\"", "bash", testing::kCommand};
    for (const std::string& argument : argumentsOf(path("x.png"), {"--frame-size", "320x180"})) {
        command.push_back(argument);
    }
    const CommandResult result = testing::runProgram(command);
    EXPECT_EQ(result.exit_code, 4) << result.error;
    EXPECT_THAT(result.errorLines(), ElementsAre(HasSubstr("x.png")));
    EXPECT_THAT(scratch_.names(), IsEmpty());
}

TEST_F(WindshieldCommand, ResumingWithATableIncludesAllFrames)
{
    std::filesystem::create_directory(path("f"));
    const std::vector<std::string> options{"--fps", "5", "--droplets", path("d.csv"), "--animation", path("d.glb")};
    const auto with_time = [&](const char* time, bool resumes) {
        std::vector<std::string> all = options;
        all.insert(all.end(), {"--time", time});
        if (resumes) {
            all.emplace_back("--resume");
        }
        return simulate(path("f/%d.png"), all).exit_code;
    };
    ASSERT_EQ(with_time("1.4s", false), 0);
    const std::string table = readFile(path("d.csv"));
    const std::string model = readFile(path("d.glb"));
    std::filesystem::remove(path("d.csv"));
    ASSERT_EQ(with_time("1.4s", true), 0) << "without a checkpoint, it starts from the first frame";
    EXPECT_EQ(readFile(path("d.csv")), table);
    EXPECT_EQ(readFile(path("d.glb")), model);
}

TEST_F(WindshieldCommand, DamagedCheckpointsAreRefused)
{
    std::filesystem::create_directory(path("f"));
    for (const std::string& bytes :
         {std::string(), std::string("something else"),
          std::string("droplet-shape windshield checkpoint 2\n\xff\xff\xff\xff\xff\xff\xff\xff")}) {
        stored("f/checkpoint.state", bytes);
        const CommandResult result = simulate(path("f/%d.png"), {"--resume"});
        EXPECT_EQ(result.exit_code, 3) << result.error;
        EXPECT_THAT(result.errorLines(), ElementsAre(HasSubstr("checkpoint")));
    }
}

TEST_F(WindshieldCommand, TheLivePageRefusesWhatItHasNoUseFor)
{
    const auto live = [&](const std::vector<std::string>& more) {
        std::vector<std::string> arguments{"windshield", "--live", path("rain.html")};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return testing::runInProcess(arguments);
    };
    testing::expectOneLine(live({path("out.mp4")}), 2, {"--live and OUTPUT exclude each other"});
    for (const std::vector<std::string>& more : std::initializer_list<std::vector<std::string>>{
             {"--time", "3s"}, {"--drive-cycle", "drive.csv"}, {"--shape", "capsule"}, {"--json", "-"}, {"--resume"}}) {
        testing::expectOneLine(live(more), 2, {"--live and " + more.front() + " exclude each other"});
    }
    testing::expectOneLine(live({"--speed", "500m/s"}), 2, {"--speed", "from 0m/s to 150m/s"});
    testing::expectOneLine(live({"--mist", "4mm/h"}), 2, {"--mist", "from 0mm/h to 3.6mm/h"});
    testing::expectOneLine(testing::runInProcess({"windshield", path("rain.png"), "--mist", "1mm/h"}), 2,
                           {"--mist needs --live"});
    testing::expectOneLine(testing::runInProcess({"windshield", "--live", path("rain.mp4")}), 2, {".html"});
    testing::expectOneLine(testing::runInProcess({"windshield"}), 2, {"OUTPUT is missing"});
    EXPECT_THAT(scratch_.names(), IsEmpty());
}

TEST_F(WindshieldCommand, BackgroundsFillTheFrame)
{
    std::ostringstream bytes;
    writePng(grey(80, 60), bytes);
    const std::string road = stored("road.png", bytes.str());
    const CommandResult own = simulate(path("own.png"), {"--background", road});
    ASSERT_EQ(own.exit_code, 0) << own.error;
    EXPECT_EQ(readPicture(path("own.png")).width, 80);
    EXPECT_EQ(readPicture(path("own.png")).height, 60);
    expectRefused({"--background", road, "--frame-size", "96x54"}, 3, "has 80x60 pixels, but the frame has 96x54");
    ASSERT_EQ(simulate(path("fit.png"), {"--background", road, "--frame-size", "96x54", "--fit"}).exit_code, 0);
    EXPECT_EQ(readPicture(path("fit.png")).width, 96);
}

TEST_F(WindshieldCommand, ReadsAndWritesVideos)
{
    const CommandResult run = simulate(path("rain.mp4"));
    ASSERT_EQ(run.exit_code, 0) << run.error;
    EXPECT_EQ(readFile(path("rain.mp4")).substr(4, 4), "ftyp");
    ASSERT_EQ(simulate(path("behind.png"), {"--background", path("rain.mp4"), "--time", "0.4s"}).exit_code, 0)
        << "a video of six frames repeats";
    EXPECT_EQ(readPicture(path("behind.png")).width, 96);
    const CommandResult odd = simulate(path("odd.mp4"), {"--frame-size", "97x54"});
    EXPECT_EQ(odd.exit_code, 2);
    EXPECT_THAT(odd.errorLines(), ElementsAre(HasSubstr("even")));
    const CommandResult codec = simulate(path("x.mp4"), {"--codec", "no-such-codec"});
    EXPECT_EQ(codec.exit_code, 2);
    EXPECT_THAT(codec.errorLines(), ElementsAre(HasSubstr("'no-such-codec' must be a video encoder")));
    // ffmpeg has the encoder, but not for this container; its message is passed on.
    const CommandResult misfit = simulate(path("x.webm"), {"--codec", "libx264"});
    EXPECT_EQ(misfit.exit_code, 2);
    EXPECT_THAT(misfit.errorLines(), ElementsAre(HasSubstr("--codec libx264: " + path("x.webm") + ": ffmpeg cannot")));
    EXPECT_THAT(misfit.error, ::testing::Not(HasSubstr("0x")));
    testing::CommandOptions without;
    without.environment = {{"PATH", scratch_.path().string()}};
    const CommandResult missing = runDroplet({"windshield", path("y.mp4")}, without);
    EXPECT_EQ(missing.exit_code, 4);
    EXPECT_THAT(missing.errorLines(), ElementsAre(HasSubstr("the program ffmpeg, which cannot be run")));
    EXPECT_FALSE(std::filesystem::exists(path("x.mp4")) || std::filesystem::exists(path("x.webm")));
}

TEST_F(WindshieldCommand, BackgroundVideosPlayAtTheirOwnSpeed)
{
    // Ten frames in one second, and the same frames with the second half at half the speed.
    const std::string grow = "color=black:s=64x36:r=10:d=1,format=gbrp,geq=r='24*N':g='24*N':b='24*N'";
    for (const auto& [name, times] : {std::pair("even.mkv", "PTS"), {"late.mkv", "PTS+gte(N\\,5)*(PTS-0.5/TB)"}}) {
        ASSERT_EQ(testing::runProgram({"ffmpeg", "-nostdin", "-v", "error", "-f", "lavfi", "-i", grow, "-vf",
                                       std::string("setpts=") + times, "-fps_mode", "passthrough", "-c:v", "ffv1",
                                       path(name)})
                      .exit_code,
                  0);
    }
    const auto shown = [&](const std::string& video, const char* rate) {
        const std::string folder = video + rate;
        std::filesystem::create_directory(path(folder));
        EXPECT_EQ(simulate(path(folder + "/%d.png"),
                           {"--background", path(video), "--fps", rate, "--rain", "0mm/h", "--time", "1.2s"})
                      .exit_code,
                  0);
        std::vector<int> numbers;
        for (int k = 1; std::filesystem::exists(path(folder) + "/" + std::to_string(k) + ".png"); ++k) {
            const Picture frame = readPicture(path(folder) + "/" + std::to_string(k) + ".png");
            numbers.push_back((frame.rgb[0] + 12) / 24);
        }
        return numbers;
    };
    EXPECT_THAT(shown("even.mkv", "10"), ElementsAre(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 0, 1));
    EXPECT_THAT(shown("even.mkv", "5"), ElementsAre(0, 2, 4, 6, 8, 0));
    EXPECT_THAT(shown("even.mkv", "20"),
                ElementsAre(0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5, 6, 6, 7, 7, 8, 8, 9, 9, 0, 0, 1, 1));
    EXPECT_THAT(shown("late.mkv", "10"), ElementsAre(0, 1, 2, 3, 4, 5, 5, 6, 6, 7, 7, 8));
}

TEST_F(WindshieldCommand, VideosKeepTheirColours)
{
    const std::vector<std::array<std::uint8_t, 3>> colours{{255, 0, 0},     {0, 255, 0},   {0, 0, 255},
                                                           {255, 255, 255}, {12, 200, 90}, {250, 160, 20},
                                                           {90, 30, 140},   {20, 22, 30}};
    Picture flat{256, 32, {}};
    for (int y = 0; y < 32; ++y) {
        for (int x = 0; x < 256; ++x) {
            const auto& colour = colours[static_cast<std::size_t>(x / 32)];
            flat.rgb.insert(flat.rgb.end(), colour.begin(), colour.end());
        }
    }
    std::ostringstream bytes;
    writePng(flat, bytes);
    const std::string behind = stored("flat.png", bytes.str());
    const auto dry = [&](const std::string& output, const std::string& quality) {
        std::vector<std::string> options{"--background", behind, "--rain", "0mm/h", "--warm-up", "0s"};
        if (!quality.empty()) {
            options.insert(options.end(), {"--quality", quality});
        }
        return simulate(path(output), options).exit_code;
    };
    ASSERT_EQ(dry("dry.png", ""), 0);
    ASSERT_EQ(dry("dry.mp4", ""), 0);
    const std::string tags = testing::runProgram({"ffprobe", "-v", "error", "-show_entries",
                                                  "stream=color_range,color_space,color_transfer,color_primaries",
                                                  "-of", "default=nw=1:nk=1", path("dry.mp4")})
                                 .output;
    EXPECT_EQ(tags, "tv\nbt709\nbt709\nbt709\n");
    ASSERT_EQ(testing::runProgram({"ffmpeg", "-nostdin", "-v", "error", "-i", path("dry.mp4"), "-frames:v", "1",
                                   "-sws_flags", "accurate_rnd+full_chroma_int", path("back.png")})
                  .exit_code,
              0);
    const Picture sent = readPicture(path("dry.png"));
    const Picture back = readPicture(path("back.png"));
    for (std::size_t x = 16; x < 256; x += 32) {
        for (std::size_t c = 0; c < 3; ++c) {
            const std::size_t at = 3 * (16 * 256 + x) + c;
            EXPECT_NEAR(back.rgb[at], sent.rgb[at], 2) << "colour " << x / 32 << ", channel " << c;
        }
    }
    // A lower quality gives a smaller file.
    ASSERT_EQ(dry("coarse.mp4", "5"), 0);
    EXPECT_LT(std::filesystem::file_size(path("coarse.mp4")), std::filesystem::file_size(path("dry.mp4")));
    EXPECT_EQ(dry("x.mp4", "101"), 2);
    EXPECT_EQ(dry("x.png", "50"), 2);
}

TEST_F(WindshieldCommand, DriveCyclesSetTheSpeed)
{
    const std::string cycle = stored("cycle.csv", "time_s,speed_km_per_h\n0,36\n0.5,72\n");
    const CommandResult run = simulate(path("x.png"), {"--drive-cycle", cycle, "--json", "-", "--time", "0.5s"});
    ASSERT_EQ(run.exit_code, 0) << run.error;
    const auto balance = nlohmann::json::parse(run.output).at("balance");
    EXPECT_NEAR(balance.back().at("speed_m_per_s").get<double>(), 10.0 + 10.0 * 14.0 / 15.0, 1e-6);
    // The cycle lasts from its first row to its last, whatever the first time is.
    const std::string late = stored("late.csv", "time_s,speed_m_per_s\n1700000000,1\n1700000000.4,5\n");
    std::vector<std::string> arguments =
        argumentsOf(path("y.png"), {"--drive-cycle", late, "--json", "-", "--time", "x"});
    arguments.erase(arguments.end() - 2, arguments.end());  // no --time
    const CommandResult own = runDroplet(arguments);
    ASSERT_EQ(own.exit_code, 0) << own.error;
    EXPECT_EQ(nlohmann::json::parse(own.output).at("output").at("frames"), 12);
    expectRefused({"--drive-cycle", stored("fast.csv", "time_s,speed_m_per_s\n0,1e300\n1,5\n")}, 3, "at most 150 m/s");
    std::vector<std::string> years = argumentsOf(
        path("y.png"), {"--drive-cycle", stored("long.csv", "time_s,speed_m_per_s\n0,1\n1e7,5\n"), "--time", "x"});
    years.erase(years.end() - 2, years.end());
    const CommandResult endless = runDroplet(years);
    EXPECT_EQ(endless.exit_code, 3);
    EXPECT_THAT(endless.errorLines(), ElementsAre(HasSubstr("lasts longer than 24h")));
}

TEST_F(WindshieldCommand, ReportsTheBalanceEverySecond)
{
    for (const char* rate : {"30", "29.97", "1.5"}) {
        const CommandResult run =
            simulate(path("x.png"), {"--fps", rate, "--warm-up", "2s", "--time", "2.2s", "--json", "-"});
        ASSERT_EQ(run.exit_code, 0) << run.error;
        const auto balance = nlohmann::json::parse(run.output).at("balance");
        ASSERT_GE(balance.size(), 4U) << rate;
        for (std::size_t k = 0; k + 1 < balance.size(); ++k) {
            EXPECT_NEAR(balance[k].at("time_s").get<double>(), static_cast<double>(k + 1), 1.0 / 59.0) << rate;
        }
    }
}

TEST_F(WindshieldCommand, PresetsBehaveLikeTheFiguresOfTheThesis)
{
    const auto moving = [&](const char* preset) {
        const CommandResult run = runDroplet({"windshield", path("x.png"), "--preset", preset, "--json", "-", "--quiet",
                                              "--noise", "0m/s2", "--warm-up", "2s", "--time", "0.1s", "--frame-size",
                                              "64x36", "--glass-width", "500mm", "--glass-height", "400mm"});
        EXPECT_EQ(run.exit_code, 0) << run.error;
        const auto row = nlohmann::json::parse(run.output).at("balance").back();
        EXPECT_GT(row.at("running_droplets").get<int>(), 100);
        return row.at("moving_droplets").get<int>();
    };
    EXPECT_EQ(moving("figure-3.10"), 0);
    EXPECT_GT(moving("figure-3.11"), 10);
}

/// Pane of 400 mm by 283 mm that leans back by 45°, as a GLB, with normals outward or inward.
std::string paneGlb(float outward)
{
    std::string buffer;
    const auto put = [&](std::initializer_list<float> numbers) {
        for (const float number : numbers) {
            buffer.append(reinterpret_cast<const char*>(&number), sizeof number);
        }
    };
    const float slant = outward * 0.70710678F;
    put({0.2F, 0.2F, 0.0F, -0.2F, 0.2F, 0.0F, 0.2F, 0.0F, 0.2F, -0.2F, 0.0F, 0.2F});
    put({0, slant, slant, 0, slant, slant, 0, slant, slant, 0, slant, slant});
    put({0, 0, 1.414214F, 0, 0, 1, 1.414214F, 1});
    const std::string order = outward > 0.0F ? "032013" : "023031";
    for (const char digit : order) {
        buffer += static_cast<char>(digit - '0');
        buffer += '\0';
    }
    std::string json =
        R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[)"
        R"({"attributes":{"POSITION":0,"NORMAL":1,"TEXCOORD_0":2},"indices":3}]}],"buffers":[{"byteLength":140}],)"
        R"("bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":48},)"
        R"({"buffer":0,"byteOffset":96,"byteLength":32},{"buffer":0,"byteOffset":128,"byteLength":12}],"accessors":[)"
        R"({"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[-0.2,0,0],"max":[0.2,0.2,0.2]},)"
        R"({"bufferView":1,"componentType":5126,"count":4,"type":"VEC3"},)"
        R"({"bufferView":2,"componentType":5126,"count":4,"type":"VEC2"},)"
        R"({"bufferView":3,"componentType":5123,"count":6,"type":"SCALAR"}]})";
    json.append((4 - json.size() % 4) % 4, ' ');
    std::string glb = "glTF";
    const auto word = [&](std::size_t number) {
        for (int k = 0; k < 4; ++k) {
            glb += static_cast<char>(number >> (8 * k));
        }
    };
    word(2);
    word(28 + json.size() + buffer.size());
    word(json.size());
    glb += "JSON" + json;
    word(buffer.size());
    glb += std::string("BIN\0", 4) + buffer;
    return glb;
}

TEST_F(WindshieldCommand, UsesASurfaceAsGlass)
{
    const CommandResult run = simulate(path("x.png"), {"--surface", stored("pane.glb", paneGlb(1.0F)), "--json", "-"});
    ASSERT_EQ(run.exit_code, 0) << run.error;
    const auto report = nlohmann::json::parse(run.output);
    EXPECT_NEAR(report.at("glass").at("width_m").get<double>(), 0.4, 1e-5);
    EXPECT_NEAR(report.at("glass").at("height_m").get<double>(), 0.2 * std::sqrt(2.0), 1e-5);
    EXPECT_GT(report.at("balance").back().at("rained_m3").get<double>(), 0.0);
    expectRefused({"--surface", stored("inward.glb", paneGlb(-1.0F))}, 3, "rain cannot reach it");
    const std::string page = path("rain.html");
    for (const std::string& glass : {path("none.glb"), path("inward.glb")}) {
        testing::expectOneLine(testing::runInProcess({"windshield", "--live", page, "--surface", glass}), 3, {glass});
    }
    // A droplet is not a glass: it has a hole, and is too small.
    testing::writeFile(path("dot.pgm"), "P2\n5 5\n1\n1 1 1 1 1\n1 0 0 0 1\n1 0 0 0 1\n1 0 0 0 1\n1 1 1 1 1\n");
    ASSERT_EQ(runDroplet({path("dot.pgm"), path("drop.glb"), "--triangles", "200", "--quiet"}).exit_code, 0);
    const CommandResult drop = simulate(path("y.png"), {"--surface", path("drop.glb"), "--eye-distance", "100m"});
    EXPECT_EQ(drop.exit_code, 3) << drop.error;
    EXPECT_THAT(drop.errorLines(), ElementsAre(HasSubstr("drop.glb: ")));
    const CommandResult far = simulate(path("y.png"), {"--glass-width", "1mm"});
    EXPECT_EQ(far.exit_code, 2);
}

TEST_F(WindshieldCommand, ReportsProgressOfEveryFrame)
{
    const CommandResult run =
        simulate(path("%d.png"), {"--progress", "json", "--time", "100ms", "--rain", "0mm/h", "--frame-size", "16x16"});
    EXPECT_EQ(run.exit_code, 0);
    EXPECT_THAT(run.errorLines(), ElementsAre(HasSubstr(R"({"frame":1,"of":3,)"), HasSubstr(R"({"frame":2,"of":3,)"),
                                              HasSubstr(R"({"frame":3,"of":3,)")));
}

TEST_F(WindshieldCommand, ReportsErrorsInOneLine)
{
    expectRefused({"--rain", "-1mm/h"}, 2, "--rain: '-1mm/h' must be from 0mm/h to 1000mm/h");
    expectRefused({"--speed", "50"}, 2, "--speed: '50' has no unit");
    expectRefused({"--drive-cycle", stored("gap.csv", "time_s,speed_m_per_s\n0,1\n\n2,3\n")}, 3, "gap");
    expectRefused({"--drive-cycle", path("none.csv")}, 3, "none.csv");
    const std::string both = "time_s,speed_m_per_s,speed_km_per_h\n0,0,0\n1,10,50\n";
    expectRefused({"--drive-cycle", stored("both.csv", both)}, 3, "both 'speed_m_per_s' and 'speed_km_per_h'");
    expectRefused({"--background", path("none.png")}, 3, "there is no such file");
    expectRefused({"--background", stored("bad.png", "no picture")}, 3, "bad.png");
    expectRefused({"--environment", path("none.hdr")}, 3, "none.hdr");
    expectRefused({"--surface", path("none.glb")}, 3, "none.glb");
    expectRefused({"--surface", "glass.obj"}, 2, ".glb or .gltf");
    expectRefused({"--preset", "figure-9"}, 2, "figure-3.10");
    expectRefused({"--codec", "libx264"}, 2, "--codec needs a video as OUTPUT");
    expectRefused({"--resume"}, 2, "--resume needs frames as OUTPUT");
    expectRefused({"--maps", "m.png"}, 2, "%d");
    expectRefused({"--droplets", "d.txt"}, 2, ".csv or .json");
    expectRefused({"--moving-only"}, 2, "--moving-only needs --droplets");
    expectRefused({"--animation-method", "texture"}, 2, "--animation-method needs --animation");
    expectRefused({"--animation", "m.glb", "--animation-method", "bones"}, 2, "--animation-method");
    expectRefused({"--highlight-boost", "5"}, 2, "from 0 to 4");
    expectRefused({"--exposure", "9"}, 2, "from -8 to 8");
    expectRefused({"--background-blur", "21deg"}, 2, "from 0deg to 20deg");
    expectRefused({"--shutter", "400deg"}, 2, "from 0deg to 360deg, or a number from 0 to 1");
    expectRefused({"--shutter", "1.5"}, 2, "from 0 to 1");
    expectRefused({"--look-at", "1m,2m"}, 2, "three lengths: to the right, ahead and up");
    expectRefused({"--look-at", "0m,-5m,0m"}, 2, "must be in front of the eye");
    expectRefused({"--fit"}, 2, "--background");
    expectRefused({"--samples", "5"}, 2, "from 1 to 4");
    expectRefused({"--frame-size", "10x10"}, 2, "WIDTHxHEIGHT");
    expectRefused({"--wiper-period", "1s"}, 2, "from 1.2s to 60s");
    expectRefused({"--seed", "-1"}, 2, "whole number");
    expectRefused({"--hysteresis", "3"}, 2, "from 0 to 2");
    expectRefused({"--maps", path("m%d.tif")}, 2, "ends in .png or .exr");
    const CommandResult format = simulate(path("x.gif"));
    EXPECT_EQ(format.exit_code, 2);
    EXPECT_THAT(format.errorLines(), ElementsAre(HasSubstr("out/%05d.png")));
    const CommandResult folder = simulate("/proc/nowhere/%d.png");
    EXPECT_EQ(folder.exit_code, 4);
    EXPECT_THAT(folder.errorLines(), SizeIs(1));
}

// In heavy rain most water is in the film, which tables and animations of droplets do not have.
TEST_F(WindshieldCommand, TellsWhereTheWaterIs)
{
    const auto told = [&](const std::vector<std::string>& more) {
        std::vector<std::string> arguments = argumentsOf(path("rain.png"), {"--rain", "150mm/h", "--warm-up", "6s"});
        std::erase(arguments, "--quiet");
        arguments.insert(arguments.end(), more.begin(), more.end());
        const CommandResult result = runDroplet(arguments);
        EXPECT_EQ(result.exit_code, 0) << result.error;
        return result.error;
    };
    EXPECT_THAT(told({}),
                AllOf(HasSubstr("\non the glass: "), HasSubstr(" mL in the film, "), Not(HasSubstr("warning"))));
    const std::string words =
        "% of the water on the glass is in the film of heavy rain, which is in pictures and --maps";
    EXPECT_THAT(told({"--droplets", path("d.csv")}), AllOf(HasSubstr("warning: --droplets: "), HasSubstr(words)));
    EXPECT_THAT(told({"--droplets", path("d.csv"), "--animation", path("d.glb")}),
                HasSubstr("warning: --droplets, --animation: "));
    EXPECT_THAT(told({"--droplets", path("d.csv"), "--runoff", "0s"}), Not(HasSubstr("warning")));
}

}  // namespace
}  // namespace droplet
