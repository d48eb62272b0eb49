// SPDX-License-Identifier: GPL-3.0-or-later
// `droplet-shape animate`: inputs, animations and files, report, errors.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/in_process.h"
#include "support/command.h"
#include "support/paths.h"
#include "support/photographs.h"

namespace droplet {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::CommandOptions;
using testing::CommandResult;
using ::testing::ElementsAre;
using testing::greymap;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using testing::readFile;
using testing::runDroplet;
using testing::runProgram;
using testing::ScratchDirectory;
using ::testing::SizeIs;
using ::testing::StartsWith;
using testing::writeFile;

/// Two discs that approach and merge in the fourth of five frames; 64 × 48 pixels, smooth edges.
std::string picture(int frame)
{
    const double x = 14.0 + 4.0 * std::min(frame, 4);
    return greymap(64, 48, [=](int i, int j) {
        const double first = 9.0 - std::hypot(i + 0.5 - x, j + 0.5 - 24.0);
        const double second = 11.0 - std::hypot(i + 0.5 - 46.0, j + 0.5 - 24.0);
        return static_cast<int>(std::lround(255.0 * std::clamp(std::max(first, second) + 0.5, 0.0, 1.0)));
    });
}

class AnimateTest : public ::testing::Test {
protected:
    AnimateTest()
    {
        fs::create_directory(directory() / "frames");
        for (int frame = 0; frame < 5; ++frame) {
            writeFile(directory() / "frames" / name(frame), picture(frame));
        }
    }

    static std::string name(int frame)
    {
        std::string digits = std::to_string(frame + 8);
        return "f" + std::string(4 - digits.size(), '0') + digits + ".pgm";
    }

    [[nodiscard]] const fs::path& directory() const { return scratch_.path(); }
    [[nodiscard]] std::string bytesOf(const std::string& file) const { return readFile(directory() / file); }

    static std::vector<std::string> withCommand(std::vector<std::string> arguments)
    {
        arguments.insert(arguments.begin(), "animate");
        arguments.insert(arguments.end(), {"--triangles", "800"});
        return arguments;
    }

    [[nodiscard]] CommandResult run(const std::vector<std::string>& arguments, CommandOptions options = {}) const
    {
        options.directory = directory();
        return runDroplet(withCommand(arguments), options);
    }

    void make(std::vector<std::string> arguments) const
    {
        arguments.emplace_back("-q");
        const auto result = run(arguments);
        ASSERT_EQ(result.exit_code, 0) << result.error;
        EXPECT_THAT(result.error, IsEmpty());
        EXPECT_THAT(result.output, IsEmpty());
    }

    [[nodiscard]] json report(std::vector<std::string> arguments) const
    {
        arguments.insert(arguments.end(), {"--json", "report.json"});
        make(arguments);
        return json::parse(bytesOf("report.json"));
    }

    void expectFailure(const std::vector<std::string>& arguments, int exit_code, const std::vector<std::string>& words,
                       const std::optional<CommandOptions>& own_process = {}) const
    {
        writeFile(directory() / "old.glb", "an older file\n");
        testing::expectOneLine(
            own_process ? run(arguments, *own_process) : testing::runInProcess(withCommand(arguments), directory()),
            exit_code, words);
        EXPECT_EQ(bytesOf("old.glb"), "an older file\n");
    }

    /// Makes a lossless video of the frames.
    void makeVideo() const
    {
        CommandOptions options;
        options.directory = directory();
        const auto made =
            runProgram({"ffmpeg", "-v", "error", "-framerate", "10", "-start_number", "8", "-i", "frames/f%04d.pgm",
                        "-c:v", "ffv1", "-pix_fmt", "gray", "-fflags", "+bitexact", "film.mkv"},
                       options);
        ASSERT_EQ(made.exit_code, 0) << "ffmpeg is needed to make the video\n" << made.error;
    }

private:
    ScratchDirectory scratch_;
};

std::vector<double> volumes(const json& report)
{
    std::vector<double> all;
    for (const json& frame : report["frames"]) {
        all.push_back(frame["volume_m3"]);
    }
    return all;
}

TEST_F(AnimateTest, MakesAnAnimationThatKeepsTheTotalVolume)
{
    const json result = report({"frames/f%04d.pgm", "film.glb", "--volume", "20uL", "--fps", "12.5"});
    EXPECT_THAT(bytesOf("film.glb"), StartsWith("glTF"));
    EXPECT_EQ(result["schema"], "droplet-shape.sequence/1");
    EXPECT_EQ(result["volume_mode"], "total");
    EXPECT_EQ(result["output"]["frames_per_second"], 12.5);
    EXPECT_EQ(result["output"]["bytes"], bytesOf("film.glb").size());
    EXPECT_EQ(result["fill"]["sharing"], "total");
    ASSERT_THAT(result["frames"], SizeIs(5));
    for (const json& frame : result["frames"]) {
        EXPECT_NEAR(frame["volume_ul"].get<double>(), 20.0, 20e-9);
        EXPECT_TRUE(frame["closed"].get<bool>());
        EXPECT_EQ(frame["volume_gained_m3"], 0.0);
    }
    EXPECT_EQ(result["frames"][0]["input"], "frames/f0008.pgm");
    EXPECT_THAT(result["frames"][0]["droplets"], SizeIs(2));
    EXPECT_THAT(result["frames"][4]["droplets"], SizeIs(1));
    EXPECT_EQ(result["transitions"]["count"], 4);
    EXPECT_EQ(result["transitions"]["vertices_kept"], 3);
    EXPECT_GT(result["transitions"]["vertices_kept_share"].get<double>(), 0.5);
    EXPECT_TRUE(result["frames"][1]["continues"].get<bool>());
    EXPECT_EQ(result["input"]["width_px"], 64);
}

TEST_F(AnimateTest, NamesTheModeForAFilmThatBecomesFlat)
{
    const auto disc = [](double radius) {
        return greymap(64, 48, [=](int i, int j) { return std::hypot(i - 32, j - 24) < radius ? 255 : 0; });
    };
    writeFile(directory() / "small.pgm", disc(4.0));
    writeFile(directory() / "large.pgm", disc(22.0));
    const std::vector<std::string> growing{"small.pgm", "large.pgm", "film.glb"};
    EXPECT_THAT(run(growing).error, HasSubstr("large.pgm: the liquid is"));
    EXPECT_THAT(run(growing).error, HasSubstr("--volume-mode fill"));
    std::vector<std::string> filled = growing;
    filled.insert(filled.end(), {"--volume-mode", "fill"});
    EXPECT_THAT(run(filled).error, Not(HasSubstr("--volume-mode")));
    EXPECT_THAT(run({"frames", "film.glb"}).error, Not(HasSubstr("--volume-mode")));
}

TEST_F(AnimateTest, FillsEveryFrame)
{
    const json result = report({"frames/f%04d.pgm", "film.glb", "--volume-mode", "fill", "--height", "1mm"});
    EXPECT_EQ(result["volume_mode"], "fill");
    for (const json& frame : result["frames"]) {
        EXPECT_NEAR(frame["height_max_m"].get<double>(), 1e-3, 1e-9);
        EXPECT_TRUE(frame["closed"].get<bool>());
    }
}

/// JSON of a GLB: after a header of twelve bytes and the chunk's length and type.
json jsonOf(const std::string& glb)
{
    std::uint32_t length = 0;
    std::memcpy(&length, glb.data() + 12, sizeof length);
    return json::parse(glb.substr(20, length));
}

TEST_F(AnimateTest, BeadsThatGrowAreMorphTargetsOfOneMesh)
{
    fs::create_directory(directory() / "beads");
    for (int frame = 0; frame < 4; ++frame) {
        const double radius = 14.0 + 0.2 * frame;
        writeFile(directory() / "beads" / name(frame), greymap(64, 48, [=](int i, int j) {
                      const double inside = radius - std::hypot(i + 0.5 - 32.0, j + 0.5 - 24.0);
                      return static_cast<int>(std::lround(255.0 * std::clamp(inside + 0.5, 0.0, 1.0)));
                  }));
    }
    const std::vector<std::string> arguments{"beads",           "film.glb", "--volume-mode", "fill",
                                             "--contact-angle", "120deg",   "--threads"};
    std::vector<std::string> films;
    for (const char* threads : {"1", "2"}) {
        std::vector<std::string> all = arguments;
        all.emplace_back(threads);
        const json result = report(all);
        EXPECT_EQ(result["transitions"]["vertices_kept"], 3);
        EXPECT_EQ(result["transitions"]["vertices_kept_share"], 1.0);
        for (const json& frame : result["frames"]) {
            EXPECT_NEAR(frame["contact_angle_deg"]["mean"].get<double>(), 120.0, 1e-6);
            EXPECT_GT(frame["overhang_m"].get<double>(), 0.0);
        }
        films.push_back(bytesOf("film.glb"));
    }
    EXPECT_EQ(films[0], films[1]);
    const json film = jsonOf(films[0]);
    ASSERT_THAT(film["meshes"], SizeIs(1));
    EXPECT_THAT(film["meshes"][0]["primitives"][0]["targets"], SizeIs(3));
}

TEST_F(AnimateTest, TracksDropletsWhenTheyMerge)
{
    const json result = report({"frames/f%04d.pgm", "film.glb", "--volume-mode", "track"});
    const json& frames = result["frames"];
    const double all = frames[0]["volume_m3"];
    for (const double volume : volumes(result)) {
        EXPECT_NEAR(volume / all, 1.0, 1e-9);
    }
    EXPECT_NEAR(frames[0]["droplets"][0]["contact_angle_deg"]["mean"].get<double>(), 40.0, 1e-6);
    EXPECT_TRUE(frames[0]["pressure_pa"].is_null());
    const json& merged = frames[4]["droplets"];
    ASSERT_THAT(merged, SizeIs(1));
    EXPECT_FALSE(merged[0]["from"].empty());
    const auto merger =
        std::find_if(frames.begin(), frames.end(), [](const json& frame) { return frame["droplets"].size() == 1; });
    EXPECT_THAT((*merger)["droplets"][0]["from"], SizeIs(2));
    // The merged droplet keeps the identity of the larger one.
    const json& before = (*(merger - 1))["droplets"];
    const std::size_t larger = before[0]["volume_m3"] > before[1]["volume_m3"] ? 0 : 1;
    EXPECT_EQ((*merger)["droplets"][0]["id"], before[larger]["id"]);
}

TEST_F(AnimateTest, ReadsFramesFromAPatternAFolderAListOrAVideo)
{
    make({"frames/f%04d.pgm", "pattern.glb"});
    make({"frames", "folder.glb"});
    make({"frames/f0008.pgm", "frames/f0009.pgm", "frames/f0010.pgm", "frames/f0011.pgm", "frames/f0012.pgm",
          "list.glb"});
    EXPECT_EQ(bytesOf("folder.glb"), bytesOf("pattern.glb"));
    EXPECT_EQ(bytesOf("list.glb"), bytesOf("pattern.glb"));
    ASSERT_NO_FATAL_FAILURE(makeVideo());
    const json result = report({"film.mkv", "video.glb"});
    EXPECT_EQ(result["output"]["frames_per_second"], 10.0) << "frame rate of the video";
    EXPECT_EQ(result["frames"][2]["input"], "film.mkv, frame 3");
    make({"film.mkv", "video.glb", "--fps", "24"});
    EXPECT_EQ(bytesOf("video.glb"), bytesOf("pattern.glb"));
}

TEST_F(AnimateTest, ReadsAFolderInTheOrderOfItsNumbers)
{
    fs::create_directory(directory() / "loose");
    for (int frame = 0; frame < 5; ++frame) {
        writeFile(directory() / "loose" / (std::to_string(frame + 8) + ".pgm"), picture(frame));
    }
    writeFile(directory() / "loose" / "notes.txt", "no picture");
    make({"frames", "frames.glb"});
    make({"loose/", "loose.glb"});
    EXPECT_EQ(bytesOf("loose.glb"), bytesOf("frames.glb"));
}

// One footprint that is too narrow for the liquid does not end the film.
TEST_F(AnimateTest, HoldsTheLastDropletsWhereAFrameHasNone)
{
    fs::create_directory(directory() / "narrow");
    for (int frame = 1; frame <= 4; ++frame) {
        const double half = frame == 2 || frame == 3 ? 1.0 : 20.0;
        writeFile(directory() / "narrow" / (std::to_string(frame) + ".pgm"), greymap(96, 64, [=](int i, int j) {
                      return std::abs(i + 0.5 - 48.0) < 36.0 && std::abs(j + 0.5 - 32.0) < half ? 255 : 0;
                  }));
    }
    const auto result = run({"narrow", "film.glb", "--width", "9.6mm", "--volume", "60uL", "--json", "film.json"});
    EXPECT_EQ(result.exit_code, 6);
    EXPECT_THAT(result.error, HasSubstr("4 frames, 2 held at the frame before (2-3), 60 uL"));
    EXPECT_THAT(result.error, HasSubstr("warning: narrow/2.pgm: no stable droplet"));
    EXPECT_THAT(result.error, Not(HasSubstr("narrow/3.pgm")));
    EXPECT_THAT(bytesOf("film.glb"), StartsWith("glTF"));
    const json frames = json::parse(bytesOf("film.json"))["frames"];
    for (std::size_t k = 0; k < 4; ++k) {
        EXPECT_EQ(frames[k]["held"], k == 1 || k == 2);
        EXPECT_NEAR(frames[k]["volume_ul"].get<double>(), 60.0, 1e-6);
    }
    EXPECT_EQ(run({"narrow", "%d.stl", "--width", "9.6mm", "--volume", "60uL", "-q"}).exit_code, 6);
    EXPECT_EQ(bytesOf("2.stl"), bytesOf("1.stl"));
    EXPECT_EQ(bytesOf("3.stl"), bytesOf("1.stl"));
    // The first droplets set the amount.
    expectFailure({"narrow/2.pgm", "narrow/1.pgm", "old.glb", "--width", "9.6mm", "--volume", "60uL"}, 5,
                  {"narrow/2.pgm", "no stable"});
}

TEST_F(AnimateTest, LevelsOfDetailAreInTheFileOfEachFrameOrBesideIt)
{
    const auto lod = [&](std::vector<std::string> options) {
        options.insert(options.begin(), {"animate", "frames/f%04d.pgm"});
        options.insert(options.end(), {"--lod", "3k,600,200"});
        CommandOptions command;
        command.directory = directory();
        return runDroplet(options, command);
    };
    const auto objs = lod({"out/%04d.obj"});
    ASSERT_EQ(objs.exit_code, 0) << objs.error;
    for (const char* name : {"out/%04d.obj", "out/%04d-lod1.obj", "out/%04d-lod2.obj"}) {
        EXPECT_THAT(objs.error, HasSubstr(name));
    }
    for (int frame = 8; frame <= 12; ++frame) {
        const std::string stem = "out/" + name(frame - 8).substr(1, 4);
        EXPECT_LT(bytesOf(stem + "-lod1.obj").size(), bytesOf(stem + ".obj").size());
        EXPECT_LT(bytesOf(stem + "-lod2.obj").size(), bytesOf(stem + "-lod1.obj").size());
        EXPECT_THAT(bytesOf(stem + "-lod2.obj"), HasSubstr("mtllib " + stem.substr(4) + ".mtl"));
    }
    ASSERT_EQ(lod({"out/%d.gltf"}).exit_code, 0);
    const json file = json::parse(bytesOf("out/10.gltf"));
    EXPECT_THAT(file["extensionsUsed"].dump(), HasSubstr("MSFT_lod"));
    EXPECT_EQ(file["meshes"].size(), 3U);
    EXPECT_THAT(lod({"film.glb"}).error, HasSubstr("--lod needs a file for every frame"));
    // Levels are files of the run.
    EXPECT_EQ(lod({"out/%04d.obj", "--json", "out/0009-lod2.obj"}).exit_code, 2);
    EXPECT_EQ(lod({"out/%04d.obj", "--no-clobber"}).exit_code, 4);
}

TEST_F(AnimateTest, PutsFramesIntoAnArchive)
{
    // A leading frame without liquid is written with the first that has some.
    writeFile(directory() / "frames" / "f0007.pgm", greymap(64, 48, [](int, int) { return 0; }));
    const auto told_of = [&](const std::string& output, const std::vector<std::string>& options) {
        std::vector<std::string> arguments{"animate", "frames/f%04d.pgm", output, "--channel",
                                           "luma",    "--json",           "told"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        CommandOptions command;
        command.directory = directory();
        const auto run = runDroplet(arguments, command);
        EXPECT_EQ(run.exit_code, 0) << run.error;
        return json::parse(bytesOf("told"));
    };
    const auto expect_same = [&](const std::string& archive, const std::string& frames, std::size_t files,
                                 const std::vector<std::string>& options) {
        const json told = told_of(archive, options);
        const json same = told_of(frames, options);
        const fs::path zip =
            fs::path(archive).extension() == ".zip" ? fs::path(archive) : fs::path(archive).parent_path();
        EXPECT_EQ(told["output"]["bytes"], readFile(directory() / zip).size());
        EXPECT_EQ(told["frames"].size(), same["frames"].size());
        EXPECT_EQ(told["frames"][3]["output"],
                  (zip / fs::path(same["frames"][3]["output"].get<std::string>()).filename()).string());
        const auto run =
            runProgram({"python3", "-c",
                        "import zipfile, sys, os\n"
                        "z = zipfile.ZipFile(sys.argv[1])\n"
                        "assert z.testzip() is None\n"
                        "names = [n for n in os.listdir(sys.argv[2]) if n != 'checkpoint.state']\n"
                        "assert sorted(z.namelist()) == sorted(names), (z.namelist(), names)\n"
                        "assert all(z.read(n) == open(os.path.join(sys.argv[2], n), 'rb').read() for n in names)\n"
                        "print(len(names))",
                        (directory() / zip).string(), (directory() / fs::path(frames).parent_path()).string()});
        EXPECT_EQ(run.output, std::to_string(files) + "\n") << run.error;
    };
    expect_same("all.zip", "glb/%04d.glb", 6, {"--triangles", "800"});
    expect_same("obj.zip/f%d.obj", "obj/f%d.obj", 6 * 3, {"--lod", "800,200"});
    expect_same("usd.ZIP/%04d.usdz", "usd/%04d.usdz", 6, {"--triangles", "800", "--threads", "1"});
    const std::string before = bytesOf("usd.ZIP");
    told_of("usd.ZIP/%04d.usdz", {"--triangles", "800", "--threads", "2"});
    EXPECT_EQ(bytesOf("usd.ZIP"), before);
}

TEST_F(AnimateTest, RefusesArchivesOfWhatIsNoFrame)
{
    expectFailure({"frames", "frames.zip/film.glb"}, 2, {"'frames.zip/film.glb'", "placeholder"});
    expectFailure({"frames", "frames-%04d.zip"}, 2, {"frames-%04d.zip"});
    expectFailure({"frames", "old.zip/%04d.png"}, 2, {"format is 'png'"});
    expectFailure({"frames", "frames.zip", "--resume"}, 2, {"--resume needs a file for every frame"});
    expectFailure({"frames", "frames.zip", "--html", "frames.zip"}, 2, {"the same", "frames.zip"});
    // What fails leaves the older archive as it was.
    writeFile(directory() / "frames.zip", "an older file\n");
    expectFailure({"frames", "frames.zip", "--no-clobber"}, 4, {"frames.zip", "must not be replaced"});
    writeFile(directory() / "frames" / "f0012.pgm", "damaged");
    expectFailure({"frames", "frames.zip"}, 3, {"f0012.pgm"});
    EXPECT_EQ(bytesOf("frames.zip"), "an older file\n");
}

// A droplet under a ceiling sheds a drop, which falls out of the picture.
TEST_F(AnimateTest, DropsFallFromACeiling)
{
    writeFile(directory() / "disc.pgm", greymap(64, 64, [](int i, int j) {
                  return std::hypot(i + 0.5 - 32.0, j + 0.5 - 32.0) < 24.0 ? 255 : 0;
              }));
    const std::vector<std::string> feed{"disc.pgm", "drip.glb", "--tilt", "180deg", "--width", "5.333mm",  "--volume",
                                        "70uL",     "--feed",   "200uL",  "--slow", "10",      "--frames", "16"};
    const json told = report(feed);
    EXPECT_EQ(told["volume_mode"], "track");
    ASSERT_EQ(told["frames"].size(), 16U);
    double before = 70e-9;
    std::size_t seen = 0;
    for (const json& frame : told["frames"]) {
        double all = frame["volume_m3"];
        for (const json& drop : frame["falling"]) {
            all += drop["volume_m3"].get<double>();
            EXPECT_EQ(drop["from"], 0);
            EXPECT_NEAR(drop["volume_m3"].get<double>(), 60e-9, 7e-9) << "800 triangles find less than hangs";
        }
        seen += frame["falling"].size();
        EXPECT_NEAR(all, before + frame["volume_gained_m3"].get<double>() - frame["volume_lost_m3"].get<double>(),
                    1e-17);
        before = all;
    }
    EXPECT_GT(seen, 3U);
    EXPECT_TRUE(told["frames"].back()["falling"].empty());
    EXPECT_THAT(run(feed).error, HasSubstr("; 1 drop fell"));
    const auto refused = [&](std::vector<std::string> more, const std::vector<std::string>& words) {
        more.insert(more.begin(), {"disc.pgm", "old.glb"});
        expectFailure(more, 2, words);
    };
    refused({"--feed", "200uL"}, {"level ceiling"});
    refused({"--slow", "10"}, {"--slow needs --feed"});
    refused({"--feed", "200uL", "--drips", "2"}, {"--drips and --feed exclude each other"});
    refused({"--feed", "200uL", "--volume-mode", "fill"}, {"--volume-mode", "--feed"});
    refused({"--feed", "0uL"}, {"--feed"});
    expectFailure({"frames", "old.glb", "--feed", "1uL"}, 2, {"--feed", "one picture"});
}

/// An interrupted run goes on from its checkpoint, with the same files and the same report.
TEST_F(AnimateTest, ResumesAnInterruptedRun)
{
    const auto run_in = [&](const std::string& folder, std::vector<std::string> more) {
        more.insert(more.begin(),
                    {"frames", folder + "/%d.glb", "--fps", "2", "--volume-mode", "track", "--json", folder + ".json"});
        return run(more);
    };
    for (const char* folder : {"whole", "cut"}) {
        fs::create_directory(directory() / folder);
    }
    ASSERT_EQ(run_in("whole", {}).exit_code, 0);
    // A folder in the place of a frame interrupts the run.
    fs::create_directories(directory() / "cut/5.glb/x");
    ASSERT_EQ(run_in("cut", {}).exit_code, 4);
    EXPECT_TRUE(fs::exists(directory() / "cut/checkpoint.state"));
    fs::remove_all(directory() / "cut/5.glb");
    EXPECT_THAT(run_in("cut", {"--resume", "--contact-angle", "50deg"}).error, HasSubstr("other options or files"));
    writeFile(directory() / "cut/2.glb", std::string(bytesOf("whole/2.glb").size(), 'x'));
    ASSERT_EQ(run_in("cut", {"--resume"}).exit_code, 0);
    EXPECT_EQ(bytesOf("cut/2.glb").front(), 'x') << "frames that exist are not made again";
    EXPECT_FALSE(fs::exists(directory() / "cut/checkpoint.state"));
    for (const char* name : {"/1.glb", "/3.glb", "/4.glb", "/5.glb"}) {
        EXPECT_EQ(bytesOf(std::string("cut") + name), bytesOf(std::string("whole") + name)) << name;
    }
    json whole = json::parse(bytesOf("whole.json"));
    json cut = json::parse(bytesOf("cut.json"));
    for (std::size_t k = 0; k < 5; ++k) {
        whole["frames"][k].erase("output");
        cut["frames"][k].erase("output");
    }
    EXPECT_EQ(whole["frames"], cut["frames"]);
    EXPECT_EQ(whole["output"]["bytes"], cut["output"]["bytes"]);
    expectFailure({"frames", "old.glb", "--resume"}, 2, {"--resume needs a file for every frame"});
    expectFailure({"-", "f%d.glb", "--resume"}, 2, {"INPUT in files"});
}

TEST_F(AnimateTest, WritesOneFilePerFrame)
{
    // The folder is made.
    const json result = report({"frames/f%04d.pgm", "out/%03d.obj"});
    std::vector<std::string> names;
    std::uintmax_t bytes = 0;
    for (const auto& entry : fs::directory_iterator(directory() / "out")) {
        names.push_back(entry.path().filename().string());
        bytes += entry.path().extension() == ".obj" ? entry.file_size() : 0;
    }
    std::sort(names.begin(), names.end());
    EXPECT_THAT(names, ElementsAre("008.mtl", "008.obj", "009.mtl", "009.obj", "010.mtl", "010.obj", "011.mtl",
                                   "011.obj", "012.mtl", "012.obj"));
    EXPECT_EQ(result["output"]["bytes"], bytes);
    EXPECT_EQ(result["frames"][1]["output"], "out/009.obj");
    // The first frame is the droplet of its picture alone.
    CommandOptions options;
    options.directory = directory();
    ASSERT_EQ(
        runDroplet({"frames/f0008.pgm", "008.obj", "--fill", "total", "--triangles", "800", "-q"}, options).exit_code,
        0);
    EXPECT_EQ(bytesOf("out/008.obj"), bytesOf("008.obj"));
    EXPECT_EQ(bytesOf("out/008.mtl"), bytesOf("008.mtl"));
}

TEST_F(AnimateTest, ContactSheetHasATileForEveryFrame)
{
    make({"frames", "film.glb", "--contact-sheet", "sheet.png"});
    const auto size = [&](const std::string& file) {
        const std::string bytes = bytesOf(file);
        EXPECT_THAT(bytes, StartsWith("\x89PNG"));
        const auto word = [&](std::size_t at) {
            unsigned value = 0;
            for (std::size_t i = at; i < at + 4; ++i) {
                value = 256 * value + static_cast<unsigned char>(bytes.at(i));
            }
            return value;
        };
        return std::pair(word(16), word(20));
    };
    const auto [width, height] = size("sheet.png");
    EXPECT_GE(width, 2 * 320U);
    EXPECT_GE(height, 2 * 240U);
    make({"frames/f0008.pgm", "one.glb", "--contact-sheet", "one.png", "-j", "1"});
    EXPECT_LT(size("one.png").first, width);
    make({"frames", "film.glb", "--contact-sheet", "again.png", "-j", "1"});
    EXPECT_EQ(bytesOf("again.png"), bytesOf("sheet.png"));
}

TEST_F(AnimateTest, WritesPreviewsAsPicturesOrAVideo)
{
    writeFile(directory() / "frames/f0010.pgm", greymap(64, 48, [](int, int) { return 0; }));
    make({"frames/f%04d.pgm", "film.glb", "--preview", "seen/%02d.png", "--preview-size", "64x48", "--view", "top"});
    for (int frame = 8; frame <= 12; ++frame) {
        const std::string digits = frame < 10 ? "0" + std::to_string(frame) : std::to_string(frame);
        EXPECT_THAT(bytesOf("seen/" + digits + ".png"), StartsWith("\x89PNG"));
    }
    EXPECT_NE(bytesOf("seen/08.png"), bytesOf("seen/10.png"));
    const std::string from_above = bytesOf("seen/08.png");
    make({"frames/f%04d.pgm", "film.glb", "--preview", "seen/%02d.png", "--preview-size", "64x48", "--camera",
          "0deg,20deg"});
    EXPECT_NE(bytesOf("seen/08.png"), from_above);
    make({"frames", "out.glb", "--preview", "film.mp4", "--preview-size", "64x48", "--fps", "10"});
    CommandOptions options;
    options.directory = directory();
    const auto probed = runProgram({"ffprobe", "-v", "error", "-count_frames", "-select_streams", "v", "-show_entries",
                                    "stream=nb_read_frames,width,height,r_frame_rate", "-of", "csv=p=0", "film.mp4"},
                                   options);
    EXPECT_THAT(probed.output, StartsWith("64,48,10/1,5")) << probed.error;
    expectFailure({"frames", "old.glb", "--preview", "film.gif"}, 2, {"--preview", "'film.gif'", "out/%04d.png"});
    expectFailure({"frames", "old.glb", "--preview", "film.mp4", "--preview-size", "65x48"}, 2, {"even sides"});
    expectFailure({"frames/f%04d.pgm", "old.glb", "--preview", "old.glb"}, 2, {"--preview"});
}

TEST_F(AnimateTest, GivesTheSameBytesWithAnyNumberOfThreads)
{
    for (const char* mode : {"total", "track"}) {
        make({"frames", "one.glb", "--volume-mode", mode, "-j", "1"});
        make({"frames", "other.glb", "--volume-mode", mode, "-j", "2"});
        EXPECT_EQ(bytesOf("one.glb"), bytesOf("other.glb"));
    }
}

TEST_F(AnimateTest, PrintsASummary)
{
    const auto result = run({"frames", "film.glb", "--volume", "20uL"});
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_THAT(result.error, HasSubstr("5 frames, 20 uL; vertices kept in 3 of 4 steps"));
    EXPECT_THAT(result.error, HasSubstr("film.glb: "));
    const auto piped = run({"frames", "-", "-q"});
    EXPECT_EQ(piped.exit_code, 0);
    EXPECT_THAT(piped.output, StartsWith("glTF"));
}

TEST_F(AnimateTest, NamesTheFrameInErrors)
{
    expectFailure({"frames/g%04d.pgm", "old.glb"}, 3, {"frames/g%04d.pgm", "no such file"});
    expectFailure({"nowhere/%d.pgm", "old.glb"}, 3, {"nowhere", "No such file"});
    expectFailure({"frames/f0008.pgm", "frames/none.pgm", "old.glb"}, 3, {"frames/none.pgm"});
    writeFile(directory() / "frames/f0010.pgm", greymap(60, 48, [](int i, int) { return i > 30 ? 255 : 0; }));
    expectFailure({"frames", "old.glb"}, 3, {"frames/f0010.pgm", "60 x 48", "frames/f0008.pgm", "64 x 48"});
    fs::remove(directory() / "frames/f0010.pgm");
    expectFailure({"frames/f%04d.pgm", "old.glb"}, 3, {"frames/f0010.pgm is missing", "from 8 to 12"});
    fs::create_directory(directory() / "empty");
    expectFailure({"empty", "old.glb"}, 3, {"empty", "no picture"});
}

TEST_F(AnimateTest, OneFrameDecidesForAllFramesWhatIsLiquid)
{
    // An empty page, then a dark disc that grows over the border.
    for (int frame = 8; frame <= 12; ++frame) {
        const double radius = frame == 8 ? -5.0 : 6.0 * (frame - 8) + 4.0;
        writeFile(directory() / "frames" / name(frame - 8), greymap(64, 48, [=](int i, int j) {
                      const double in = radius - std::hypot(i + 0.5 - 32.0, j + 0.5 - 24.0);
                      return static_cast<int>(std::lround(255.0 * (1.0 - std::clamp(in + 0.5, 0.0, 1.0))));
                  }));
    }
    writeFile(directory() / "frames" / name(4), greymap(64, 48, [](int i, int) { return i < 2 ? 255 : 0; }));
    const auto result = report({"frames", "film.glb", "--width", "64mm"});
    std::vector<double> areas;
    for (const json& frame : result["frames"]) {
        areas.push_back(1e6 * frame["footprint_area_m2"].get<double>());
    }
    EXPECT_EQ(areas[0], 0.0);
    EXPECT_NEAR(areas[1], M_PI * 100.0, 3.0);
    EXPECT_NEAR(areas[3], M_PI * 22.0 * 22.0, 6.0);
    EXPECT_NEAR(areas[4], 62.0 * 48.0, 6.0);
    ASSERT_THAT(result["warnings"], ElementsAre(HasSubstr("triangles along the rim"), HasSubstr("frame 5 by itself"),
                                                HasSubstr("frames/f0012.pgm: the liquid is 0.15 mm high")));
    EXPECT_THAT(result["warnings"][1].get<std::string>(),
                HasSubstr("like frames/f0009.pgm, by luma with dark as liquid"));
}

// In this light, no single level separates liquid from ground. If the first clear frame is read as a photograph, so are
// all others, and paper without liquid is recognised as dry, first or last.
TEST_F(AnimateTest, PhotographMakesAllFramesPhotographs)
{
    fs::create_directory(directory() / "light");
    const auto shoot = [&](const char* name, double brightness, bool wet) {
        testing::Scene scene = testing::inkSpill(320.0);
        if (!wet) {
            scene.outside = [](Vec2) { return 1.0e3; };
        }
        const testing::Photograph photograph = testing::photograph(
            scene,
            [=](Vec2 p) {
                const auto [red, green, blue] = testing::gradientLight()(p);
                return std::array{brightness * red, brightness * green, brightness * blue};
            },
            0.01);
        writeFile(directory() / "light" / name, greymap(photograph.width, photograph.height, [&](int x, int y) {
                      const auto at = static_cast<std::size_t>(y) * static_cast<std::size_t>(photograph.width) +
                                      static_cast<std::size_t>(x);
                      return static_cast<int>(std::lround(255.0 * photograph.rgb[at][1]));
                  }));
    };
    shoot("1.pgm", 1.0, false);
    shoot("2.pgm", 1.0, true);
    shoot("3.pgm", 0.8, true);
    shoot("4.pgm", 0.8, false);
    make({"light", "film.glb", "--json", "report.json"});
    const json frames = json::parse(bytesOf("report.json"))["frames"];
    for (const std::size_t k : {0U, 3U}) {
        EXPECT_THAT(frames[k]["droplets"], IsEmpty());
    }
    for (const std::size_t k : {1U, 2U}) {
        EXPECT_THAT(frames[k]["droplets"], SizeIs(testing::inkSpill().droplets));
        EXPECT_EQ(frames[k]["holes"], testing::inkSpill().holes);
    }
}

TEST_F(AnimateTest, AllowsFramesWithoutLiquid)
{
    const auto dry = greymap(64, 48, [](int, int) { return 0; });
    writeFile(directory() / "frames/f0008.pgm", dry);
    writeFile(directory() / "frames/f0010.pgm", dry);
    const json result = report({"frames", "film.glb", "--volume", "20uL", "--contact-sheet", "sheet.png"});
    ASSERT_THAT(result["frames"], SizeIs(5));
    EXPECT_THAT(volumes(result), ElementsAre(0.0, ::testing::DoubleNear(20e-9, 1e-16), 0.0,
                                             ::testing::DoubleNear(20e-9, 1e-16), ::testing::DoubleNear(20e-9, 1e-16)));
    const json& pause = result["frames"][2];
    EXPECT_THAT(pause["droplets"], IsEmpty());
    EXPECT_TRUE(pause["pressure_pa"].is_null());
    EXPECT_TRUE(pause["contact_angle_deg"]["mean"].is_null());
    EXPECT_NEAR(pause["volume_lost_m3"].get<double>(), 20e-9, 1e-16);
    EXPECT_NEAR(result["frames"][3]["volume_gained_m3"].get<double>(), 20e-9, 1e-16);
    fs::create_directory(directory() / "out");
    for (const char* kind : {"obj", "ply", "stl", "glb", "gltf"}) {
        make({"frames/f%04d.pgm", std::string("out/%d.") + kind});
        EXPECT_TRUE(fs::exists(directory() / (std::string("out/8.") + kind))) << kind;
    }
    for (int frame = 0; frame < 5; ++frame) {
        writeFile(directory() / "frames" / name(frame), dry);
    }
    expectFailure({"frames", "old.glb"}, 3, {"frames", "no liquid in any of 5 frames"});
    fs::create_directory(directory() / "none");
    expectFailure({"frames", "none/%d.obj"}, 3, {"no liquid"});
    EXPECT_TRUE(fs::is_empty(directory() / "none"));
}

TEST_F(AnimateTest, ReportsUnreadableVideosAndMissingFfmpeg)
{
    writeFile(directory() / "film.mkv", "no video");
    expectFailure({"film.mkv", "old.glb"}, 3, {"film.mkv", "ffprobe cannot read it"});
    expectFailure({"none.mkv", "old.glb"}, 3, {"none.mkv", "no such file"});
    ASSERT_NO_FATAL_FAILURE([&] {
        fs::remove(directory() / "film.mkv");
        makeVideo();
    }());
    CommandOptions without;
    without.environment = {{"PATH", "/nowhere"}};
    expectFailure({"film.mkv", "old.glb"}, 3, {"film.mkv", "ffprobe, which cannot be run"}, without);
}

TEST_F(AnimateTest, ReportsVideosThatAreCutOff)
{
    // ffmpeg only warns about a cut Matroska file; AVI states the number of frames.
    CommandOptions options;
    options.directory = directory();
    for (const std::string name : {"film.mkv", "film.avi", "film.mp4"}) {
        const auto made =
            runProgram({"ffmpeg", "-v", "error", "-framerate", "10", "-start_number", "8", "-i", "frames/f%04d.pgm",
                        "-c:v", "mjpeg", "-q:v", "1", "-fflags", "+bitexact", "-movflags", "+faststart", name},
                       options);
        ASSERT_EQ(made.exit_code, 0) << made.error;
        EXPECT_EQ(run({name, "whole.glb"}).exit_code, 0) << name;
        fs::resize_file(directory() / name, fs::file_size(directory() / name) * 3 / 4);
        expectFailure({name, "old.glb"}, 3, {name, "is cut off or damaged after frame "});
    }
    // A video that was trimmed without new encoding contains frames that it does not show.
    const auto trimmed = runProgram({"ffmpeg", "-v", "error", "-framerate", "10", "-start_number", "8", "-i",
                                     "frames/f%04d.pgm", "-c:v", "mpeg4", "-q:v", "1", "long.mp4"},
                                    options);
    ASSERT_EQ(trimmed.exit_code, 0) << trimmed.error;
    ASSERT_EQ(
        runProgram({"ffmpeg", "-v", "error", "-ss", "0.2", "-i", "long.mp4", "-c", "copy", "trimmed.mp4"}, options)
            .exit_code,
        0);
    EXPECT_EQ(run({"trimmed.mp4", "trimmed.glb"}).exit_code, 0);
}

TEST_F(AnimateTest, DrawingsKeepTheirOwnSize)
{
    fs::create_directory(directory() / "drawn");
    for (int frame = 1; frame < 3; ++frame) {
        writeFile(directory() / "drawn" / (std::to_string(frame) + ".svg"),
                  R"(<svg xmlns="http://www.w3.org/2000/svg" width="8mm" height="4mm" viewBox="0 0 8 4"><circle cx=")" +
                      std::to_string(1 + frame) + R"(" cy="2" r="1"/></svg>)");
    }
    const json drawn = report({"drawn", "out.glb"});
    ASSERT_THAT(drawn["frames"], SizeIs(2));
    EXPECT_NEAR(drawn["input"]["pixel_size_m"].get<double>() * drawn["input"]["width_px"].get<double>(), 8e-3, 1e-12);
}

TEST_F(AnimateTest, ReportsProgressOfEveryFrame)
{
    const std::string log = run({"frames", "out.glb", "--progress", "json"}).error;
    std::size_t solved = 0;
    for (auto at = log.find("solve"); at != std::string::npos; at = log.find("solve", at + 1)) {
        ++solved;
    }
    EXPECT_GE(solved, 5U) << log;
}

TEST_F(AnimateTest, ReportsProgressOfEveryPicture)
{
    const std::string log = run({"frames/f0008.pgm", "frames/f0009.pgm", "out.glb", "--progress", "json", "--preview",
                                 "%d.png", "--preview-size", "32x24", "--contact-sheet", "sheet.png"})
                                .error;
    EXPECT_THAT(log, AllOf(HasSubstr(R"({"drawn":1,"of":4,)"), HasSubstr(R"({"drawn":4,"of":4,)")));
}

TEST_F(AnimateTest, RefusesTooShortEdgesBeforeMemoryIsFull)
{
    CommandOptions options;
    options.directory = directory();
    const CommandResult result = runDroplet({"animate", "frames", "out.glb", "--edge", "100nm"}, options);
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(result.error, HasSubstr("--edge"));
}

TEST_F(AnimateTest, RefusesWrongOptions)
{
    const auto refused = [&](std::vector<std::string> arguments, const std::vector<std::string>& words) {
        arguments.insert(arguments.begin(), {"frames", "old.glb"});
        expectFailure(arguments, 2, words);
    };
    refused({"--volume-mode", "some"}, {"--volume-mode", "'some'", "total, track, fill"});
    refused({"--fps", "0"}, {"--fps", "'0'", "0.001 to 1000"});
    refused({"--fps", "fast"}, {"--fps", "'fast'"});
    refused({"--fill", "each"}, {"--fill each and --volume-mode total exclude each other"});
    refused({"--contact-sheet", "sheet.jpg"}, {"--contact-sheet", "'sheet.jpg'", ".png"});
    refused({"--contact-sheet", "old.glb.png", "--json", "old.glb.png"}, {"--json and --contact-sheet are the same"});
    refused({"--onto", "can.glb"}, {"--onto cannot be used for a sequence"});
    expectFailure({}, 2, {"INPUT is missing"});
    expectFailure({"frames"}, 2, {"OUTPUT is missing", "INPUT... OUTPUT"});
    expectFailure({"frames", "-o", "old.glb"}, 2, {"-o: OUTPUT needs no option", "INPUT... OUTPUT"});
    expectFailure({"frames", "film.obj"}, 2, {"film.obj", "out/%04d.obj"});
    expectFailure({"frames", "film"}, 2, {"film", "no extension"});
    expectFailure({"frames", "out/%04x.glb"}, 2, {"OUTPUT", "%04d"});
    expectFailure({"frames", "%d/%d.glb"}, 2, {"OUTPUT", "file's name"});
    expectFailure({"frames", "/proc/nowhere/%d.glb"}, 4, {"/proc/nowhere cannot be created"});
    expectFailure({"frames/f%04d.pgm", "frames/f%04d.pgm"}, 2, {"f%04d.pgm"});
    expectFailure({"frames", "old.glb", "--no-clobber"}, 4, {"old.glb", "exists"});
    expectFailure({"-", "frames/f0008.pgm", "old.glb"}, 2, {"INPUT: - must stand alone"});
    expectFailure({"frames/f0008.pgm", "-", "old.glb"}, 2, {"INPUT: - must stand alone"});
}

// The last frame is the droplet of the picture itself; before it there is ever more liquid, at the same angle.
TEST_F(AnimateTest, RevealFillsTheFootprintOfOnePicture)
{
    for (const std::string source : {"left", "middle", "0.1,0.5"}) {
        const json told = report({"frames/" + name(4), "reveal.glb", "--reveal", source, "--frames", "6",
                                  "--contact-angle", "30deg", "--model", "linear"});
        ASSERT_EQ(told["frames"].size(), 6U);
        EXPECT_EQ(told["volume_mode"], "fill");
        double before = 0.0;
        for (const json& frame : told["frames"]) {
            const double volume = frame["volume_m3"];
            EXPECT_GT(volume, before);
            before = volume;
        }
        CommandOptions here;
        here.directory = directory();
        const CommandResult alone = runDroplet({"frames/" + name(4), "alone.glb", "--contact-angle", "30deg", "--model",
                                                "linear", "--triangles", "800", "-q", "--json", "alone.json"},
                                               here);
        ASSERT_EQ(alone.exit_code, 0) << alone.error;
        const double whole = json::parse(bytesOf("alone.json"))["shape"]["volume_m3"];
        EXPECT_NEAR(before / whole, 1.0, 0.01) << "other triangles, of 800";
    }
}

// Liquid drips from the picture's droplet: ever more of it, at the same angle, always as one droplet.
TEST_F(AnimateTest, DripsGrowFromTheFootprintOfOnePicture)
{
    const auto drips = [&](const std::string& seed) {
        return report({"frames/" + name(4), "drips.glb", "--drips", "2", "--seed", seed, "--frames", "5",
                       "--contact-angle", "30deg", "--model", "linear"});
    };
    const json told = drips("1");
    ASSERT_EQ(told["frames"].size(), 5U);
    EXPECT_EQ(told["volume_mode"], "fill");
    const auto volume = [](const json& frame) { return frame["volume_m3"].get<double>(); };
    for (const json& frame : told["frames"]) {
        EXPECT_GE(volume(frame), 0.999 * volume(told["frames"][0]));
    }
    EXPECT_GT(volume(told["frames"][4]), 1.02 * volume(told["frames"][0]));
    EXPECT_NE(drips("2")["frames"], told["frames"]);
    const std::string picture = "frames/" + name(4);
    expectFailure({picture, "old.glb", "--drips", "0"}, 2, {"--drips", "0"});
    expectFailure({picture, "old.glb", "--drips", "2", "--reveal", "left"}, 2, {"--drips", "--reveal"});
    expectFailure({picture, "old.glb", "--seed", "2"}, 2, {"--seed", "--drips"});
    expectFailure({"frames", "old.glb", "--drips", "2"}, 2, {"--drips", "one picture"});
}

TEST_F(AnimateTest, RevealRefusesWhatItCannotFill)
{
    const std::string picture = "frames/" + name(4);
    expectFailure({picture, "old.glb", "--reveal", "up"}, 2, {"--reveal", "'up'", "left, right, top, bottom, middle"});
    expectFailure({picture, "old.glb", "--reveal", "0.5"}, 2, {"--reveal", "left"});
    expectFailure({picture, "old.glb", "--reveal", "0.5,1.5"}, 2, {"--reveal", "from 0 to 1"});
    expectFailure({picture, "old.glb", "--reveal", "0.5,0.5,0.5"}, 2, {"--reveal", "from 0 to 1"});
    expectFailure({picture, "frames/" + name(3), "old.glb", "--reveal", "left"}, 2, {"--reveal", "one picture"});
    expectFailure({"frames", "old.glb", "--reveal", "left"}, 2, {"--reveal", "one picture"});
    expectFailure({picture, "old.glb", "--frames", "6"}, 2, {"--frames", "--reveal"});
    expectFailure({picture, "old.glb", "--reveal", "left", "--frames", "0"}, 2, {"--frames", "0"});
    writeFile(directory() / "dry.pgm", greymap(8, 8, [](int, int) { return 0; }));
    expectFailure({"dry.pgm", "old.glb", "--reveal", "left"}, 3, {"dry.pgm"});
}

}  // namespace
}  // namespace droplet
