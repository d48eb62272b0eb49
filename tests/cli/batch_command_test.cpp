// SPDX-License-Identifier: GPL-3.0-or-later
// `droplet-shape batch`: the same bytes as single runs, with any threads and shares; separate failures; resuming.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "droplet/drawing/picture.h"
#include "droplet/version.h"
#include "support/command.h"
#include "support/hostile_drawings.h"
#include "support/paths.h"

namespace droplet {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::AllOf;
using testing::canRespectPermissions;
using testing::CommandOptions;
using testing::CommandResult;
using testing::discPicture;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using testing::readFile;
using testing::runDroplet;
using testing::runProgram;
using testing::writeFile;

const std::string kDrawing =
    R"(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 10 10"><path d="M1 1h8v3h-8z"/></svg>)";

class BatchTest : public ::testing::Test {
protected:
    BatchTest()
    {
        fs::create_directories(directory() / "masks/more");
        writeFile(directory() / "masks/a.pgm", discPicture(20, 7.0));
        writeFile(directory() / "masks/b.SVG", kDrawing);
        writeFile(directory() / "masks/c.pgm", discPicture(24, 9.0));
        writeFile(directory() / "masks/.hidden.pgm", "not looked at");
        writeFile(directory() / "masks/notes.txt", "not looked at");
        writeFile(directory() / "masks/more/d.pgm", discPicture(16, 5.0));
    }

    [[nodiscard]] fs::path directory() const { return scratch_.path(); }

    [[nodiscard]] CommandResult run(std::vector<std::string> arguments, CommandOptions options = {}) const
    {
        arguments.insert(arguments.end(), {"--triangles", "200"});
        options.directory = directory();
        return runDroplet(arguments, options);
    }

    [[nodiscard]] CommandResult batch(std::vector<std::string> arguments, const CommandOptions& options = {}) const
    {
        arguments.insert(arguments.begin(), {"batch", "masks", "-o", "out/{stem}.glb"});
        return run(arguments, options);
    }

    [[nodiscard]] json manifest(const std::string& name = "out/manifest.json") const
    {
        return json::parse(readFile(directory() / name));
    }

    /// Manifest without times.
    [[nodiscard]] json timeless(const std::string& name = "out/manifest.json") const
    {
        json all = manifest(name);
        all["totals"].erase("time_s");
        for (json& row : all["items"]) {
            row.erase("time_s");
        }
        return all;
    }

    [[nodiscard]] std::vector<std::string> statuses(const std::string& name = "out/manifest.json") const
    {
        std::vector<std::string> all;
        const json whole = manifest(name);
        for (const json& row : whole["items"]) {
            all.push_back(row["status"]);
        }
        return all;
    }

    /// Names and contents of all files in a folder except manifests.
    [[nodiscard]] std::map<std::string, std::string> files(const std::string& folder) const
    {
        std::map<std::string, std::string> all;
        for (const auto& entry : fs::recursive_directory_iterator(directory() / folder)) {
            const std::string name = entry.path().lexically_relative(directory() / folder).string();
            if (entry.is_regular_file() && name.find("manifest") == std::string::npos) {
                all[name] = readFile(entry.path());
            }
        }
        return all;
    }

private:
    testing::ScratchDirectory scratch_;
};

TEST_F(BatchTest, WritesTheSameBytesAsSingleRuns)
{
    const auto result = batch({"--contact-angle", "60deg"});
    EXPECT_EQ(result.exit_code, 0) << result.error;
    EXPECT_THAT(result.error, HasSubstr("3 of 3"));
    const auto made = files("out");
    ASSERT_EQ(made.size(), 3U);
    for (const char* name : {"a.pgm", "b.SVG", "c.pgm"}) {
        ASSERT_EQ(run({"masks/" + std::string(name), "one.glb", "--contact-angle", "60deg"}).exit_code, 0);
        EXPECT_EQ(made.at(fs::path(name).stem().string() + ".glb"), readFile(directory() / "one.glb")) << name;
    }
}

TEST_F(BatchTest, EveryPictureHasItsOwnStrokesAndMask)
{
    const auto strokes = [&](const std::string& name, int side, int light) {
        writeFile(directory() / name, testing::greymap(side, side, [&](int x, int y) {
                      return y != side / 2 ? 128 : x == 0 ? 0 : x == light ? 255 : 128;
                  }));
    };
    fs::create_directories(directory() / "strokes");
    fs::remove(directory() / "masks/b.SVG");
    strokes("strokes/a.pgm", 20, 10);
    strokes("strokes/c.pgm", 24, 12);
    const std::vector<std::string> more{"--seeds", "strokes/{stem}.pgm", "--mask-out", "out/{stem}.png"};
    EXPECT_EQ(batch(more).exit_code, 0);
    const auto made = files("out");
    EXPECT_EQ(made.size(), 4U);
    for (const std::string stem : {"a", "c"}) {
        const auto one =
            run({"masks/" + stem + ".pgm", "one.glb", "--seeds", "strokes/" + stem + ".pgm", "--mask-out", "one.png"});
        EXPECT_EQ(one.exit_code, 0) << one.error;
        EXPECT_EQ(made.at(stem + ".glb"), readFile(directory() / "one.glb"));
        EXPECT_EQ(made.at(stem + ".png"), readFile(directory() / "one.png"));
    }
    // Other strokes make a picture again, and it alone.
    strokes("strokes/c.pgm", 24, 13);
    EXPECT_EQ(batch(more).exit_code, 0);
    EXPECT_THAT(statuses(), ElementsAre("skipped", "made"));
    fs::remove(directory() / "strokes/a.pgm");
    const auto missing = batch({"--seeds", "strokes/{stem}.pgm", "--keep-going"});
    EXPECT_EQ(missing.exit_code, 6);
    EXPECT_THAT(missing.error, HasSubstr("strokes/a.pgm"));
    EXPECT_EQ(batch({"--mask-out", "-"}).exit_code, 2);
    EXPECT_THAT(batch({"--seeds", "strokes/{stem}.pgm", "--mask-out", "strokes/{stem}.pgm"}).error,
                HasSubstr("must be different files"));
}

// Sheets of files with the object and of those without it differ by the object, which is no liquid.
TEST_F(BatchTest, ContactSheetShowsTheObjectBelowItsDroplets)
{
    ASSERT_EQ(run({"masks/a.pgm", "cap.glb", "--open", "--width", "6cm"}).exit_code, 0);
    fs::remove(directory() / "masks/b.SVG");
    writeFile(directory() / "masks/a.pgm", discPicture(20, 3.0));
    writeFile(directory() / "masks/c.pgm", discPicture(24, 4.0));
    const auto sheet = [&](const std::string& name, std::vector<std::string> more) {
        more.insert(more.begin(), {"batch", "masks", "-o", name + "/{stem}.glb", "--onto", "cap.glb", "--contact-sheet",
                                   name + ".png"});
        const auto result = run(more);
        EXPECT_EQ(result.exit_code, 0) << result.error;
        return readFile(directory() / (name + ".png"));
    };
    const std::string both = sheet("both", {});
    EXPECT_NE(both, sheet("alone", {"--droplets-only"}));
    EXPECT_EQ(both, sheet("threads", {"-j", "1"}));
}

TEST_F(BatchTest, ManifestHasARowForEveryPicture)
{
    ASSERT_EQ(batch({"--recursive", "--liquid", "glycerol", "-q"}).exit_code, 0);
    const json all = manifest();
    EXPECT_EQ(all["schema"], "droplet-shape.manifest/1");
    EXPECT_EQ(all["version"], kVersion);
    EXPECT_EQ(all["options"], json({{"liquid", "glycerol"}, {"triangles", "200"}}));
    EXPECT_TRUE(all["shard"].is_null());
    ASSERT_EQ(all["items"].size(), 4U);
    const std::vector<std::string> inputs{"masks/a.pgm", "masks/b.SVG", "masks/c.pgm", "masks/more/d.pgm"};
    std::size_t bytes = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        const json& row = all["items"][i];
        EXPECT_EQ(row["index"], i + 1);
        EXPECT_EQ(row["name"], inputs[i]);
        EXPECT_EQ(row["input"], inputs[i]);
        EXPECT_EQ(row["output"], "out/" + fs::path(inputs[i]).stem().string() + ".glb");
        EXPECT_EQ(row["status"], "made");
        EXPECT_TRUE(row["error"].is_null());
        EXPECT_EQ(row["exit_code"], 0);
        EXPECT_EQ(row["closed"], true);
        EXPECT_GT(row["volume_m3"], 0.0);
        EXPECT_GT(row["height_max_m"], 0.0);
        EXPECT_TRUE(row["warnings"].is_array());
        const fs::path output = directory() / row["output"].get<std::string>();
        EXPECT_EQ(row["bytes"], fs::file_size(output));
        bytes += row["bytes"].get<std::size_t>();
        const auto sum = runProgram({"sha256sum", output.string()});
        EXPECT_EQ(row["sha256"], sum.output.substr(0, 64));
    }
    EXPECT_EQ(all["totals"]["items"], 4);
    EXPECT_EQ(all["totals"]["made"], 4);
    EXPECT_EQ(all["totals"]["bytes"], bytes);
}

TEST_F(BatchTest, NamesWhatItLeavesOutOfAFolder)
{
    writeFile(directory() / "masks/photo.heic", std::string("\0\0\0\x18"
                                                            "ftypheic\0\0\0\0mif1heic",
                                                            24));
    writeFile(directory() / "masks/old.glb", "an output of an earlier run");
    const CommandResult result = batch({});
    ASSERT_EQ(result.exit_code, 0) << result.error;
    EXPECT_THAT(result.error,
                HasSubstr("left out   masks/notes.txt, masks/photo.heic; the manifest lists the reasons"));
    const json left_out = manifest()["left_out"];
    ASSERT_EQ(left_out.size(), 2U);
    EXPECT_EQ(left_out[0]["name"], "masks/notes.txt");
    EXPECT_THAT(left_out[0]["reason"].get<std::string>(), HasSubstr("not an image this program reads"));
    EXPECT_THAT(left_out[1]["reason"].get<std::string>(), HasSubstr("heif-convert"));
}

TEST_F(BatchTest, ResultDoesNotDependOnThreads)
{
    writeFile(directory() / "masks/aa_broken.pgm", "P5");
    for (const char* way : {"--keep-going", "--no-resume"}) {  // --no-resume has no effect here
        ASSERT_EQ(batch({way, "-j", "1"}).exit_code, 6);
        const auto one = files("out");
        const json rows = timeless();
        for (const char* threads : {"2", "5"}) {
            fs::remove_all(directory() / "out");
            const auto result = batch({way, "-j", threads});
            EXPECT_EQ(result.exit_code, 6);
            EXPECT_EQ(result.errorLines().front(),
                      "droplet-shape: masks/aa_broken.pgm: not an image this program reads (PNG, "
                      "JPEG, SVG, BMP, GIF, ICO, TGA, TIFF, WebP, PBM/PGM/PPM, JPEG 2000, OpenEXR, Radiance HDR)");
            EXPECT_EQ(timeless(), rows) << threads;
            for (const auto& [name, content] : one) {
                EXPECT_EQ(files("out")[name], content) << name;
            }
        }
        fs::remove_all(directory() / "out");
    }
}

TEST_F(BatchTest, FailureEndsTheBatchUnlessKeepGoing)
{
    writeFile(directory() / "masks/b.pgm", "P5");
    writeFile(directory() / "masks/bb.pgm", discPicture(20, 0.0));
    fs::remove(directory() / "masks/b.SVG");
    auto result = batch({"-j", "2"});
    EXPECT_EQ(result.exit_code, 6);
    EXPECT_THAT(statuses(), ElementsAre("made", "failed", "not started", "not started"));
    EXPECT_THAT(result.error, AllOf(HasSubstr("masks/b.pgm: "), Not(HasSubstr("bb.pgm"))));
    EXPECT_EQ(manifest()["items"][1]["exit_code"], 3);
    EXPECT_THAT(manifest()["items"][1]["error"].get<std::string>(), HasSubstr("b.pgm"));
    EXPECT_TRUE(manifest()["items"][1]["bytes"].is_null());

    result = batch({"--keep-going"});
    EXPECT_EQ(result.exit_code, 6);
    EXPECT_THAT(statuses(), ElementsAre("skipped", "failed", "failed", ::testing::AnyOf("made", "skipped")));
    EXPECT_THAT(result.error, AllOf(HasSubstr("masks/b.pgm: "), HasSubstr("masks/bb.pgm: ")));
    EXPECT_EQ(files("out").size(), 2U);
    EXPECT_EQ(manifest()["totals"]["failed"], 2);
}

TEST_F(BatchTest, OutOfMemoryFailsOnlyOnePicture)
{
#if defined(__SANITIZE_ADDRESS__)
    GTEST_SKIP() << "the sanitizer itself takes terabytes of address space";
#endif
    // Its coverage would take two gigabytes.
    writeFile(directory() / "masks/b.pbm", "P4\n16000 16000\n" + std::string(std::size_t{2000} * 16000, '\x55'));
    fs::remove(directory() / "masks/b.SVG");
    CommandOptions options;
    options.directory = directory();
    const auto result = runProgram(
        {"sh", "-c", "ulimit -v 600000; exec \"$0\" batch masks -o 'out/{stem}.glb' --triangles 200 --keep-going -j 1",
         testing::kCommand},
        options);
    EXPECT_EQ(result.exit_code, 6) << result.error;
    EXPECT_THAT(statuses(), ElementsAre("made", "failed", "made"));
    EXPECT_THAT(manifest()["items"][1]["error"].get<std::string>(), HasSubstr("memory"));
}

TEST_F(BatchTest, DrawingThatCrashesItsReaderFailsAlone)
{
    const auto drawings = testing::hostileDrawings();
    const auto drawing = std::find_if(drawings.begin(), drawings.end(),
                                      [](const testing::HostileDrawing& one) { return one.name == "convolution"; });
    writeFile(directory() / "masks/b.SVG", drawing->text());
    const auto result = batch({"--keep-going"});
    EXPECT_EQ(result.exit_code, 6) << result.error;
    EXPECT_THAT(statuses(), ElementsAre("made", "failed", "made"));
    EXPECT_EQ(manifest()["items"][1]["exit_code"], 3);
    EXPECT_THAT(manifest()["items"][1]["error"].get<std::string>(), HasSubstr("b.SVG: SVG image "));
}

TEST_F(BatchTest, SkipsWhatIsUpToDate)
{
    ASSERT_EQ(batch({}).exit_code, 0);
    const auto first = files("out");
    const json rows = timeless().at("items");
    const auto result = batch({});
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_THAT(result.error, HasSubstr("3 skipped"));
    EXPECT_THAT(statuses(), ElementsAre("skipped", "skipped", "skipped"));
    // The rows keep the figures of the files.
    for (std::size_t i = 0; i < 3; ++i) {
        json row = timeless().at("items")[i];
        row["status"] = "made";
        EXPECT_EQ(row, rows[i]);
    }

    fs::remove(directory() / "out/a.glb");
    ASSERT_EQ(batch({}).exit_code, 0);
    EXPECT_THAT(statuses(), ElementsAre("made", "skipped", "skipped"));

    std::string changed = first.at("b.glb");
    changed[changed.size() / 2] ^= 1;
    writeFile(directory() / "out/b.glb", changed);
    ASSERT_EQ(batch({}).exit_code, 0);
    EXPECT_THAT(statuses(), ElementsAre("skipped", "made", "skipped"));
    EXPECT_EQ(files("out"), first);

    // A new date without a change does not make the picture again.
    fs::last_write_time(directory() / "masks/a.pgm", fs::file_time_type::clock::now());
    writeFile(directory() / "masks/c.pgm", discPicture(24, 8.0));
    ASSERT_EQ(batch({}).exit_code, 0);
    EXPECT_THAT(statuses(), ElementsAre("skipped", "skipped", "made"));

    ASSERT_EQ(batch({"--contact-angle", "50deg"}).exit_code, 0);
    EXPECT_THAT(statuses(), ElementsAre("made", "made", "made"));
    ASSERT_EQ(batch({"--contact-angle", "50deg", "-j", "1", "-v", "--progress", "none"}).exit_code, 0);
    EXPECT_THAT(statuses(), ElementsAre("skipped", "skipped", "skipped"));
    ASSERT_EQ(batch({"--contact-angle", "50deg", "--no-resume"}).exit_code, 0);
    EXPECT_THAT(statuses(), ElementsAre("made", "made", "made"));
}

TEST_F(BatchTest, ChangedGroundMakesAllAgain)
{
    writeFile(directory() / "ground.pgm", discPicture(8, 3.0));
    const std::vector<std::string> options{"--surface", "ground.pgm", "--surface-depth", "0.1mm"};
    ASSERT_EQ(batch(options).exit_code, 0);
    ASSERT_EQ(batch(options).exit_code, 0);
    EXPECT_THAT(statuses(), ElementsAre("skipped", "skipped", "skipped"));
    writeFile(directory() / "ground.pgm", discPicture(8, 2.0));
    ASSERT_EQ(batch(options).exit_code, 0);
    EXPECT_THAT(statuses(), ElementsAre("made", "made", "made"));
}

TEST_F(BatchTest, WritesReportsBesideDroplets)
{
    ASSERT_EQ(batch({}).exit_code, 0);
    const std::vector<std::string> with_reports{"--json", "reports/{stem}.json"};
    ASSERT_EQ(batch(with_reports).exit_code, 0);
    EXPECT_THAT(statuses(), ElementsAre("made", "made", "made"));
    const json report = json::parse(readFile(directory() / "reports/c.json"));
    EXPECT_EQ(report["schema"], "droplet-shape.report/1");
    EXPECT_EQ(report["shape"]["volume_m3"], manifest()["items"][2]["volume_m3"]);
    ASSERT_EQ(batch(with_reports).exit_code, 0);
    EXPECT_THAT(statuses(), ElementsAre("skipped", "skipped", "skipped"));
    fs::remove(directory() / "reports/a.json");
    ASSERT_EQ(batch(with_reports).exit_code, 0);
    EXPECT_THAT(statuses(), ElementsAre("made", "skipped", "skipped"));
}

TEST_F(BatchTest, SharesMakeTheWholeBatch)
{
    ASSERT_EQ(batch({"--recursive"}).exit_code, 0);
    const auto whole = files("out");
    fs::remove_all(directory() / "out");
    for (const char* share : {"1/3", "2/3", "3/3"}) {
        ASSERT_EQ(batch({"--recursive", "--shard", share}).exit_code, 0);
    }
    EXPECT_EQ(files("out"), whole);
    EXPECT_THAT(statuses("out/manifest-1-of-3.json"), ElementsAre("made", "made"));
    const json second = manifest("out/manifest-2-of-3.json");
    EXPECT_EQ(second["shard"], json({{"index", 2}, {"count", 3}}));
    ASSERT_EQ(second["items"].size(), 1U);
    EXPECT_EQ(second["items"][0]["index"], 2);
    EXPECT_EQ(second["items"][0]["output"], "out/b.glb");
    // A run without shares skips files of the shares, unless they have changed.
    writeFile(directory() / "out/c.glb", "changed");
    writeFile(directory() / "out/manifest-x-of-3.json", "not a manifest of a share");
    writeFile(directory() / "out/manifest-9-of-9.json", "broken");
    ASSERT_EQ(batch({"--recursive"}).exit_code, 0);
    EXPECT_THAT(statuses(), ElementsAre("skipped", "skipped", "made", "skipped"));
    fs::remove(directory() / "out/manifest-x-of-3.json");
    fs::remove(directory() / "out/manifest-9-of-9.json");
    // A share skips its own files; a share without pictures succeeds.
    ASSERT_EQ(batch({"--recursive", "--shard", "1/3"}).exit_code, 0);
    EXPECT_THAT(statuses("out/manifest-1-of-3.json"), ElementsAre("skipped", "skipped"));
    ASSERT_EQ(batch({"--shard", "7/8", "--manifest", "m.json"}).exit_code, 0);
    EXPECT_THAT(statuses("m-7-of-8.json"), IsEmpty());
}

TEST_F(BatchTest, ReplacesPlaceholders)
{
    const auto make = [&](const std::string& pattern) {
        fs::remove_all(directory() / "out");
        EXPECT_EQ(run({"batch", "masks", "masks/more/../a.pgm", "--recursive", "-o", "out/" + pattern}).exit_code, 0);
        std::vector<std::string> names;
        for (const auto& [name, content] : files("out")) {
            names.push_back(name);
        }
        return names;
    };
    EXPECT_THAT(make("{dir}/{name}.{index}.stl"),
                ElementsAre("a.pgm.1.stl", "a.pgm.5.stl", "b.SVG.2.stl", "c.pgm.3.stl", "more/d.pgm.4.stl"));
    EXPECT_THAT(make("{{{index}}}-{ext}-{parent}-{stem}.glb"),
                ElementsAre("{1}-pgm-masks-a.glb", "{2}-SVG-masks-b.glb", "{3}-pgm-masks-c.glb", "{4}-pgm-more-d.glb",
                            "{5}-pgm-masks-a.glb"));
}

TEST_F(BatchTest, FindsErrorsBeforeAnyWork)
{
    const auto expect_refused = [&](const std::vector<std::string>& arguments, int code, const std::string& words) {
        const auto result = run(arguments);
        EXPECT_EQ(result.exit_code, code) << words;
        EXPECT_THAT(result.error, HasSubstr(words));
        EXPECT_EQ(result.errorLines().size(), 1U) << result.error;
        EXPECT_FALSE(fs::exists(directory() / "out"));
    };
    expect_refused({"batch", "masks"}, 2, "--output is missing");
    expect_refused({"batch", "masks", "out/{stem}.glb"}, 2, "--output is missing; did you mean -o 'out/{stem}.glb'?");
    expect_refused({"batch", "masks", "out.stl"}, 2, "did you mean -o 'out.stl'?");
    expect_refused({"batch", "-o", "out/{stem}.glb"}, 2, "INPUT is missing");
    expect_refused({"batch", "masks", "-o", "-"}, 2, "--output");
    expect_refused({"batch", "-", "-o", "out/{stem}.glb"}, 2, "INPUT");
    expect_refused({"batch", "masks", "-o", "out/{stem}"}, 2, "no extension");
    expect_refused({"batch", "masks", "-o", "out/{stem}.xyz"}, 2, ".xyz");
    expect_refused({"batch", "masks", "-o", "out/{stm}.glb"}, 2, "{stem}, {name}");
    expect_refused({"batch", "masks", "-o", "out/{stem.glb"}, 2, "{stem}, {name}");
    expect_refused({"batch", "masks", "-o", "out/}.glb"}, 2, "{stem}, {name}");
    expect_refused({"batch", "masks", "-o", "out/one.glb"}, 2, "are the same");
    expect_refused({"batch", "masks/a.pgm", "masks/../masks/a.pgm", "-o", "out/{stem}.glb"}, 2, "are the same");
    expect_refused({"batch", "masks", "-o", "out/{stem}.glb", "--json", "out/{stem}.glb"}, 2, "are the same");
    expect_refused({"batch", "masks", "-o", "masks/{name}", "--format", "stl"}, 2, "are the same");
    expect_refused({"batch", "masks", "-o", "out/{stem}.glb", "--manifest", "masks/a.pgm"}, 2, "are the same");
    expect_refused({"batch", "masks", "-o", "out/{stem}.glb", "--manifest", "masks/notes.txt"}, 2,
                   "is not a droplet-shape.manifest/1");
    for (const char* share : {"0/3", "4/3", "1", "1/", "/3", "a/b", "1/0", "-1/3"}) {
        expect_refused({"batch", "masks", "-o", "out/{stem}.glb", "--shard", share}, 2, "--shard");
    }
    fs::create_directory(directory() / "none");
    expect_refused({"batch", "none", "-o", "out/{stem}.glb"}, 3, "none holds no pictures");
    writeFile(directory() / "none/page.pdf", "%PDF-1.7");
    expect_refused({"batch", "none", "-o", "out/{stem}.glb"}, 3, "left out: none/page.pdf, PDF (or Illustrator) files");
    expect_refused({"batch", "masks", "-o", "out/{stem}.glb", "--manifest", "/proc/none/m.json"}, 4, "/proc/none");
    expect_refused({"batch", "masks", "-o", "out/{stem}.glb", "--onto", "masks/notes.txt"}, 2, "--onto: ");
    EXPECT_EQ(readFile(directory() / "masks/notes.txt"), "not looked at");
}

TEST_F(BatchTest, LeavesOutPipes)
{
    // Nobody writes into these: reading one would take for ever.
    fs::create_directory(directory() / "none");
    ASSERT_EQ(::mkfifo((directory() / "pipe.png").c_str(), 0600), 0);
    ASSERT_EQ(::mkfifo((directory() / "none/pipe.png").c_str(), 0600), 0);
    const auto named = run({"batch", "pipe.png", "-o", "out/{stem}.glb"});
    EXPECT_EQ(named.exit_code, 2);
    EXPECT_THAT(named.error, HasSubstr("INPUT: 'pipe.png' must be a picture's file"));
    const auto found = run({"batch", "none", "-o", "out/{stem}.glb"});
    EXPECT_EQ(found.exit_code, 3);
    EXPECT_THAT(found.error, HasSubstr("none holds no pictures"));
    EXPECT_THAT(found.error, HasSubstr("left out: none/pipe.png, it is a pipe"));
    EXPECT_FALSE(fs::exists(directory() / "out"));
}

TEST_F(BatchTest, OutputThatCannotBeWrittenFailsAlone)
{
    fs::create_directories(directory() / "out/b.glb");
    const auto result = batch({"--keep-going"});
    EXPECT_EQ(result.exit_code, 6);
    EXPECT_THAT(statuses(), ElementsAre("made", "failed", "made"));
    EXPECT_EQ(manifest()["items"][1]["exit_code"], 4);
    EXPECT_THAT(result.error, HasSubstr("out/b.glb"));
}

TEST_F(BatchTest, PlaceholdersStayInTheirFolder)
{
    const auto refused = [&](const std::string& picture, const std::string& output, const std::string& word) {
        fs::create_directories(directory() / fs::path(picture).parent_path());
        writeFile(directory() / picture, discPicture(64, 24.0));
        const auto result = run({"batch", picture, "-o", output});
        EXPECT_EQ(result.exit_code, 2) << output;
        EXPECT_THAT(result.error, HasSubstr(word));
        EXPECT_FALSE(fs::exists(directory() / "out"));
        fs::remove(directory() / picture);
    };
    refused("...png", "out/sub/{stem}/x.glb", "'out/sub/../x.glb', outside of its folder");
    refused("..png", "out/sub/.{stem}/x.glb", "'out/sub/../x.glb', outside of its folder");
    refused("..png", "out/sub/{stem}{stem}/x.glb", "'out/sub/../x.glb', outside of its folder");
    refused("bare", "{ext}/x.glb", "'/x.glb', outside of its folder");
}

TEST_F(BatchTest, NamesInTextFilesHaveNoLineBreaks)
{
    writeFile(directory() / "two\nlines.pgm", discPicture(64, 24.0));
    const auto refused = run({"batch", "two\nlines.pgm", "-o", "out/{stem}.obj"});
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_THAT(refused.error, HasSubstr("two\\nlines.mtl"));
    EXPECT_FALSE(fs::exists(directory() / "out"));
    EXPECT_EQ(run({"batch", "two\nlines.pgm", "-o", "out/{stem}.glb"}).exit_code, 0);
}

TEST_F(BatchTest, NoClobberProtectsForeignFiles)
{
    ASSERT_EQ(batch({}).exit_code, 0);
    EXPECT_EQ(batch({"--no-clobber"}).exit_code, 0);
    EXPECT_THAT(statuses(), ElementsAre("skipped", "skipped", "skipped")) << "files of this batch";
    fs::remove(directory() / "out/a.glb");
    writeFile(directory() / "out/b.glb", "old");
    const auto refused = batch({"--keep-going", "--no-clobber"});
    EXPECT_EQ(refused.exit_code, 4);
    EXPECT_THAT(refused.error, HasSubstr("out/b.glb\": exists and must not be replaced"));
    EXPECT_EQ(readFile(directory() / "out/b.glb"), "old");
    EXPECT_FALSE(fs::exists(directory() / "out/a.glb")) << "refused before any work";
    EXPECT_EQ(batch({"--no-clobber", "--no-resume"}).exit_code, 4);
}

TEST_F(BatchTest, ManifestOnAFullDiskFails)
{
    const auto result = batch({"--manifest", "/dev/full"});
    EXPECT_EQ(result.exit_code, 4);
    EXPECT_THAT(result.error, HasSubstr("/dev/full"));
}

TEST_F(BatchTest, JsonProgressIsOneLinePerItem)
{
    writeFile(directory() / "masks/bb.pgm", "P5");
    const auto result = batch({"--progress", "json", "--keep-going"});
    const auto lines = result.errorLines();
    ASSERT_EQ(lines.size(), 4U);
    const std::vector<std::string> expected{"made", "made", "failed", "made"};
    for (std::size_t i = 0; i < 4; ++i) {
        const json line = json::parse(lines[i]);
        EXPECT_EQ(line["item"], i + 1);
        EXPECT_EQ(line["of"], 4);
        EXPECT_EQ(line["status"], expected[i]);
        EXPECT_EQ(line["error"].is_null(), i != 2);
    }
    EXPECT_THAT(batch({"-q"}).errorLines(), ElementsAre(HasSubstr("masks/bb.pgm")));
    CommandOptions terminal;
    terminal.error_is_terminal = true;
    EXPECT_THAT(batch({"--keep-going", "--no-resume"}, terminal).error, HasSubstr("manifest"));
}

TEST_F(BatchTest, ResumesAnInterruptedBatch)
{
    fs::remove_all(directory() / "masks");
    fs::create_directory(directory() / "masks");
    for (int i = 10; i < 60; ++i) {
        writeFile(directory() / ("masks/" + std::to_string(i) + ".pgm"), discPicture(100 + i, 40.0));
    }
    // The signal is sent when three of fifty droplets exist.
    CommandOptions options;
    options.directory = directory();
    const std::string script =
        "\"$0\" batch masks -o 'out/{stem}.glb' --triangles 30k -j 1 & "
        "while [ ! -e out/12.glb ]; do sleep 0.01; done; kill -TERM $!; wait $!; echo $?";
    const auto result = runProgram({"sh", "-c", script, testing::kCommand}, options);
    EXPECT_EQ(result.output, "143\n") << result.error;
    const auto made = files("out");
    ASSERT_LT(made.size(), 50U);
    const auto is_made = [](const std::string& status) { return status == "made"; };
    const auto before = statuses();
    EXPECT_EQ(before.size(), 50U);
    EXPECT_EQ(static_cast<std::size_t>(std::count_if(before.begin(), before.end(), is_made)), made.size());
    EXPECT_TRUE(std::is_partitioned(before.begin(), before.end(), is_made));

    const auto rest = runDroplet({"batch", "masks", "-o", "out/{stem}.glb", "--triangles", "30k", "-q"}, options);
    EXPECT_EQ(rest.exit_code, 0) << rest.error;
    EXPECT_EQ(manifest()["totals"]["skipped"], made.size());
    EXPECT_EQ(manifest()["totals"]["made"], 50 - made.size());
    const auto all = files("out");
    EXPECT_EQ(all.size(), 50U);
    for (const auto& [name, content] : made) {
        EXPECT_EQ(all.at(name), content) << name;
    }
}

// The sheet shows droplets made now or before, but no failed ones.
TEST_F(BatchTest, ContactSheetShowsAllFinishedDroplets)
{
    ASSERT_EQ(batch({"--contact-sheet", "sheets/all.png"}).exit_code, 0);
    const std::string all = readFile(directory() / "sheets/all.png");
    const Picture picture = readPicture(directory() / "sheets/all.png");
    EXPECT_GT(picture.width, 2 * 320);
    ASSERT_EQ(batch({"--contact-sheet", "again.png", "-j", "1"}).exit_code, 0);
    EXPECT_TRUE(readFile(directory() / "again.png") == all);
    const CommandResult one_scale = batch({"--contact-sheet", "again.png", "--same-scale"});
    EXPECT_THAT(one_scale.error, HasSubstr("sheet      again.png: 3 droplets; "));
    EXPECT_FALSE(readFile(directory() / "again.png") == all);
    const CommandResult events = batch({"--contact-sheet", "again.png", "--progress", "json"});
    EXPECT_THAT(events.error, HasSubstr(R"({"drawn":3,"of":3,"elapsed_s":)"));
    EXPECT_EQ(batch({"--same-scale"}).exit_code, 2);
    ASSERT_EQ(batch({"--contact-sheet", "ink.png", "--material", "ink"}).exit_code, 0);
    EXPECT_FALSE(readFile(directory() / "ink.png") == all);

    writeFile(directory() / "masks/broken.pgm", "no picture");
    EXPECT_EQ(batch({"--contact-sheet", "three.png", "--keep-going", "--material", "water"}).exit_code, 6);
    EXPECT_TRUE(readFile(directory() / "three.png") == all) << "a failed item is not shown";
}

TEST_F(BatchTest, EveryShareHasItsContactSheet)
{
    ASSERT_EQ(batch({"--shard", "2/2", "--contact-sheet", "sheet.png"}).exit_code, 0);
    EXPECT_TRUE(fs::exists(directory() / "sheet-2-of-2.png"));
    EXPECT_FALSE(fs::exists(directory() / "sheet.png"));
}

TEST_F(BatchTest, RefusesWrongContactSheets)
{
    for (const auto& [name, words] :
         {std::pair{"sheet.jpg", "a file that ends in .png"}, {"masks/a.png", "are the same"}}) {
        writeFile(directory() / "masks/a.png", "a picture");
        const CommandResult result = batch({"--contact-sheet", name});
        EXPECT_EQ(result.exit_code, 2);
        EXPECT_THAT(result.error, HasSubstr(words));
    }
    const CommandResult usd = run({"batch", "masks", "-o", "{stem}.usdz", "--contact-sheet", "sheet.png"});
    EXPECT_EQ(usd.exit_code, 2);
    EXPECT_THAT(usd.error, HasSubstr("--contact-sheet: USD and 3MF files are only written"));
}

}  // namespace
}  // namespace droplet
