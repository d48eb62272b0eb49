// SPDX-License-Identifier: GPL-3.0-or-later
// Files of a run: no command replaces a file that it reads, or writes a file twice, or replaces a file against
// --no-clobber. All of it is found before any file is read.
#include "cli/run_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "cli/in_process.h"
#include "droplet/error.h"
#include "support/command.h"
#include "support/fonts.h"
#include "support/paths.h"

namespace droplet {
namespace {

namespace fs = std::filesystem;
using testing::CommandResult;
using testing::inSource;
using testing::readFile;
using testing::runDroplet;
using testing::runInProcess;
using testing::ScratchDirectory;
using testing::writeFile;

/// Files with this content would be refused with another error once they are read.
constexpr const char* kNothing = "nothing that any option could read\n";

/// Option or argument that names a file.
struct FileOption {
    std::string name;                     ///< as in the help; arguments in capitals
    std::string value;                    ///< such as `out/%04d.png`
    std::string file = {};                ///< one of its files; empty: the value
    std::string content = kNothing;       ///< of an input
    std::vector<std::string> needs = {};  ///< further arguments

    [[nodiscard]] std::string path() const { return file.empty() ? value : file; }
    [[nodiscard]] bool isArgument() const { return name.front() != '-'; }
};

/// Files of one command.
struct CommandFiles {
    std::string command;  ///< empty: the command without a name
    std::string title;
    std::vector<FileOption> always;    ///< of every run, in the order of the arguments
    std::vector<std::string> rest;     ///< further arguments of every run
    std::vector<FileOption> inputs;    ///< one of the same name replaces that of `always`
    std::vector<FileOption> outputs;   ///< likewise
    std::string no_output_means = {};  ///< part of the message if an output or input does not exist in this form
};

FileOption withContent(const std::string& name, const std::string& value, const std::string& content)
{
    FileOption option{name, value};
    option.content = content;
    return option;
}

FileOption frames(const std::string& name, const std::string& pattern, const std::string& file)
{
    return {name, pattern, file};
}

FileOption needing(FileOption option, const std::vector<std::string>& needs)
{
    option.needs = needs;
    return option;
}

const FileOption kConfig = withContent("--config", "options.toml", "");
const FileOption kMaterials =
    withContent("--materials", "looks.toml", "[[droplet]]\nindex = \"all\"\nmaterial = \"ink\"\n");

const std::vector<CommandFiles>& all()
{
    const FileOption font = withContent("--font", "font.ttf", readFile(testing::colourFont()));
    const FileOption preview_input{"--ground", "ground.png"};
    static const std::vector<CommandFiles> commands{
        {"",
         "shape",
         {{"INPUT", "in.png"}, {"OUTPUT", "new.glb"}},
         {},
         {{"INPUT", "in.png"},
          kConfig,
          kMaterials,
          {"--seeds", "seeds.png"},
          {"--surface", "ground.exr"},
          {"--onto", "can.glb"},
          needing({"--ground", "ground.png"}, {"--preview", "new.png"}),
          needing({"--environment", "sky.exr"}, {"--preview", "new.png"})},
         {{"OUTPUT", "out.glb"},
          frames("OUTPUT", "out.obj", "out.mtl"),
          {"--json", "out.json"},
          {"--mask-out", "mask.png"},
          {"--export-evolver", "out.fe"},
          {"--html", "out.html"},
          frames("--maps", "maps.png", "maps-height.png"),
          frames("--maps", "maps.png", "maps-occlusion.png"),
          {"--preview", "out.png"},
          needing(frames("--preview", "turn.png", "turn-002.png"), {"--turntable", "3"})}},
        {"animate",
         "animate",
         {{"INPUT", "a.png"}, {"INPUT", "b.png"}, {"OUTPUT", "new.glb"}},
         {},
         {{"INPUT", "a.png"}, {"INPUT", "film.mp4"}, kConfig, {"--surface", "ground.exr"}},
         {{"OUTPUT", "out.glb"},
          frames("OUTPUT", "out/%04d.stl", "out/0002.stl"),
          frames("OUTPUT", "out/%04d.obj", "out/0002.mtl"),
          {"--json", "out.json"},
          {"--html", "out.html"},
          {"--contact-sheet", "sheet.png"},
          {"--preview", "out.mp4"},
          frames("--preview", "out/%04d.png", "out/0001.png")}},
        {"batch",
         "batch",
         {{"INPUT", "in.png"}, {"--output", "new/{stem}.glb"}},
         {},
         {{"INPUT", "in.png"},
          kConfig,
          kMaterials,
          {"--seeds", "seeds.png"},
          {"--surface", "ground.exr"},
          {"--onto", "can.glb"}},
         {frames("--output", "out/{stem}.glb", "out/in.glb"),
          frames("--mask-out", "out/{stem}.png", "out/in.png"),
          frames("--output", "out/{index}.obj", "out/1.mtl"),
          frames("--json", "out/{stem}.json", "out/in.json"),
          {"--manifest", "list.json"},
          {"--contact-sheet", "sheet.png"}}},
        {"compare",
         "compare",
         {{"A", "a.glb"}, {"B", "b.glb"}},
         {},
         {{"A", "a.glb"}, {"B", "b.glb"}, kConfig},
         {{"--json", "out.json"}, {"--picture", "out.png"}}},
        {"flow",
         "flow",
         {{"OBJECT", "object.glb"}, {"OUTPUT", "new.glb"}},
         {"--drops", "10"},
         {{"OBJECT", "object.glb"},
          kConfig,
          {"--mask", "mask.png"},
          {"--start", "start.csv"},
          {"--motion", "motion.csv"},
          needing({"--roughness-map", "rough.png"}, {"--roughness", "10um"}),
          {"--friction-map", "friction.png"}},
         {{"OUTPUT", "out.glb"},
          {"OUTPUT", "out.png"},
          {"OUTPUT", "out.mp4"},
          frames("OUTPUT", "out/%04d.png", "out/0002.png"),
          frames("OUTPUT", "out/%04d.obj", "out/0150.obj"),
          frames("OUTPUT", "out/%04d.obj", "out/checkpoint.state"),
          frames("--maps", "out/%04d.png", "out/0002-normal.png"),
          frames("--maps", "out/%d.exr", "out/3-age.exr"),
          {"--streaks", "streaks.glb"},
          {"--droplets", "droplets.csv"},
          {"--json", "out.json"},
          {"--html", "out.html"},
          {"--preview", "preview.png"},
          needing(frames("--preview", "turn.png", "turn-002.png"), {"--turntable", "3"})}},
        {"dew",
         "dew",
         {{"OBJECT", "object.glb"}, {"OUTPUT", "new.glb"}},
         {"--smallest", "2mm", "--largest", "3mm"},
         {{"OBJECT", "object.glb"},
          kConfig,
          {"--mask", "mask.png"},
          needing({"--environment", "sky.exr"}, {"--preview", "new.png"})},
         {{"OUTPUT", "out.glb"},
          {"OUTPUT", "out.obj"},
          {"--droplets", "droplets.csv"},
          {"--json", "out.json"},
          {"--preview", "preview.png"},
          needing(frames("--preview", "turn.png", "turn-002.png"), {"--turntable", "3"})}},
        {"glyphs",
         "text",
         {font, {"--output", "new.glb"}},
         {"--text", "O"},
         {font,
          kConfig,
          kMaterials,
          {"--surface", "ground.exr"},
          {"--onto", "can.glb"},
          {"--path", "path.svg"},
          needing({"--ground", "ground.png"}, {"--preview", "new.png"}),
          needing({"--environment", "sky.exr"}, {"--preview", "new.png"})},
         {{"--output", "out.glb"},
          frames("--output", "out.obj", "out.mtl"),
          {"--json", "out.json"},
          {"--html", "out.html"},
          frames("--maps", "maps.png", "maps-height.png"),
          {"--preview", "out.png"},
          needing(frames("--preview", "turn.png", "turn-002.png"), {"--turntable", "3"})}},
        {"glyphs",
         "glyphs",
         {font, {"--output", "new/{gid}.glb"}},
         {"--all"},
         {font, kConfig, kMaterials, {"--surface", "ground.exr"}},
         {frames("--output", "out/{gid}.glb", "out/0.glb"),
          frames("--output", "out/{gid}.obj", "out/0.mtl"),
          frames("--json", "out/{gid}.json", "out/0.json"),
          {"--manifest", "list.json"},
          {"--contact-sheet", "sheet.png"}}},
        {"glyphs",
         "charset",
         {font, {"--output", "new/{gid}.glb"}, {"--charset", "@set.txt", "set.txt", "O"}},
         {},
         {{"--charset", "@set.txt", "set.txt", "O"}},
         {frames("--output", "out/{codepoint}.glb", "out/U+004F.glb"), {"--manifest", "list.json"}}},
        {"liquid2d",
         "liquid2d",
         {{"OUTPUT", "new.svg"}},
         {},
         {{"--walls", "walls.png"},
          kConfig,
          {"--scene", "scene.toml"},
          {"--particles", "one.bgeo"},
          frames("--particles", "particles/%04d.bgeo", "particles/0004.bgeo")},
         {{"OUTPUT", "out.svg"},
          {"OUTPUT", "out.mp4"},
          {"OUTPUT", "out.json"},
          frames("OUTPUT", "out/%04d.png", "out/0001.png"),
          frames("OUTPUT", "out/%04d.svg", "out/checkpoint.state"),
          frames("--masks", "masks/%04d.png", "masks/0001.png"),
          frames("--particle-cache", "cache/%04d.csv", "cache/0001.csv"),
          {"--particle-cache", "cache.usda"},
          {"--json", "report.json"}}},
        {"morph",
         "morph",
         {{"INPUT", "a.png"}, {"INPUT", "b.png"}, {"OUTPUT", "new.glb"}},
         {},
         {{"INPUT", "a.png"}, kConfig, {"--surface", "ground.exr"}},
         {{"OUTPUT", "out.glb"},
          {"OUTPUT", "out.mp4"},
          frames("OUTPUT", "out/%04d.png", "out/0002.png"),
          frames("OUTPUT", "out/%04d.svg", "out/0120.svg"),
          frames("OUTPUT", "out/%04d.obj", "out/0003.obj"),
          frames("OUTPUT", "out/%04d.obj", "out/0003.mtl"),
          {"--json", "out.json"},
          {"--html", "out.html"},
          {"--contact-sheet", "sheet.png"},
          {"--preview", "preview.mp4"},
          frames("--preview", "preview/%04d.png", "preview/0002.png")},
         "needs droplets as OUTPUT"},
        {"wind-tunnel",
         "wind_tunnel",
         {},
         {},
         {kConfig},
         {{"OUTPUT", "out.csv"},
          {"--json", "out.json"},
          {"--chart", "out.svg"},
          {"--map", "map.png"},
          needing({"--trace", "trace.csv"}, {"--volume", "30uL", "--wind", "10m/s"})}},
        {"windshield",
         "windshield",
         {{"OUTPUT", "new.png"}},
         {},
         {kConfig,
          {"--background", "road.png"},
          {"--background", "road.mp4"},
          {"--environment", "sky.exr"},
          {"--drive-cycle", "cycle.csv"},
          {"--surface", "glass.glb"}},
         {{"OUTPUT", "out.png"},
          {"OUTPUT", "out.mp4"},
          frames("OUTPUT", "out/%04d.png", "out/0002.png"),
          frames("OUTPUT", "out/%04d.png", "out/checkpoint.state"),
          frames("--maps", "maps/%04d.png", "maps/0002-velocity.png"),
          {"--droplets", "droplets.csv"},
          {"--animation", "model.glb"},
          {"--json", "out.json"}}},
        {"windshield",
         "live",
         {{"--live", "new.html"}},
         {},
         {kConfig, {"--background", "road.png"}, {"--surface", "glass.glb"}},
         {{"--live", "out.html"}}},
    };
    return commands;
}

class RunFiles : public ::testing::TestWithParam<CommandFiles> {
protected:
    RunFiles() : before_(fs::current_path()) { fs::current_path(scratch_.path()); }
    ~RunFiles() override { fs::current_path(before_); }

    /// Arguments of a run with some options, which replace those of every run.
    [[nodiscard]] std::vector<std::string> argumentsOf(const std::vector<FileOption>& given) const
    {
        const CommandFiles& of = GetParam();
        std::vector<FileOption> options = of.always;
        for (const FileOption& one : given) {
            const auto same = std::find_if(options.begin(), options.end(),
                                           [&](const FileOption& other) { return other.name == one.name; });
            if (same == options.end()) {
                options.push_back(one);
            } else {
                *same = one;
            }
        }
        std::vector<std::string> arguments;
        if (!of.command.empty()) {
            arguments.push_back(of.command);
        }
        const auto is_given = [&](const std::string& name) {
            return std::any_of(options.begin(), options.end(), [&](const FileOption& o) { return o.name == name; });
        };
        for (const FileOption& one : options) {
            if (one.isArgument()) {
                arguments.push_back(one.value);
            }
        }
        for (const FileOption& one : options) {
            if (!one.isArgument()) {
                arguments.insert(arguments.end(), {one.name, one.value});
            }
            if (!one.needs.empty() && !is_given(one.needs.front())) {
                arguments.insert(arguments.end(), one.needs.begin(), one.needs.end());
            }
        }
        arguments.insert(arguments.end(), of.rest.begin(), of.rest.end());
        return arguments;
    }

    /// Lays out the inputs of every run and one more.
    void layOut(const FileOption& input) const
    {
        for (const FileOption& one : GetParam().always) {
            if (one.name != "OUTPUT" && one.name != "--output") {
                store(one.path(), one.content);
            }
        }
        store(input.path(), input.content);
    }

    static void store(const std::string& path, const std::string& content)
    {
        makeFolder(path);
        writeFile(path, content);
    }

    static void makeFolder(const std::string& path)
    {
        if (fs::path(path).has_parent_path()) {
            fs::create_directories(fs::path(path).parent_path());
        }
    }

    /// Whether options cannot be combined, or need a program that was built with more.
    [[nodiscard]] static bool isElsewhere(const CommandResult& refused)
    {
        const std::string& words = GetParam().no_output_means;
        return (!words.empty() && refused.error.find(words) != std::string::npos) ||
               refused.error.find("--maps and --onto exclude each other") != std::string::npos ||
               refused.error.find("this build has no page") != std::string::npos;
    }

    [[nodiscard]] static std::set<std::string> everything()
    {
        std::set<std::string> paths;
        for (const fs::directory_entry& entry : fs::recursive_directory_iterator(".")) {
            paths.insert(entry.path().string());
        }
        return paths;
    }

    static void clear()
    {
        for (const fs::directory_entry& entry : fs::directory_iterator(".")) {
            fs::remove_all(entry.path());
        }
    }

    ScratchDirectory scratch_;
    fs::path before_;
};

TEST_P(RunFiles, NoOutputIsAnInput)
{
    for (const FileOption& input : GetParam().inputs) {
        for (const FileOption& output : GetParam().outputs) {
            // An output that is a hard link to an input, and one of its name.
            for (const bool by_name : {false, true}) {
                FileOption read = input;
                if (by_name && (input.value != input.path() ||
                                fs::path(input.value).extension() != fs::path(output.path()).extension())) {
                    continue;
                }
                if (by_name) {
                    read.value = output.path();
                }
                layOut(read);
                if (!by_name) {
                    makeFolder(output.path());
                    fs::create_hard_link(read.path(), output.path());
                }
                const std::vector<std::string> arguments = argumentsOf({read, output});
                SCOPED_TRACE(::testing::PrintToString(arguments));
                const auto files = everything();
                const CommandResult refused = runInProcess(arguments);
                if (!isElsewhere(refused)) {
                    EXPECT_EQ(refused.exit_code, 2) << refused.error;
                    EXPECT_THAT(refused.error, ::testing::HasSubstr("are the same"));
                    EXPECT_EQ(everything(), files) << "files came or went";
                    EXPECT_EQ(readFile(output.path()), input.content);
                }
                clear();
            }
        }
    }
}

TEST_P(RunFiles, NoClobberRefusesBeforeAnyWork)
{
    const FileOption& input = GetParam().inputs.front();
    for (const FileOption& output : GetParam().outputs) {
        if (output.name == "--manifest") {
            continue;  // it records what earlier runs made, and continues
        }
        layOut(input);
        store(output.path(), "an older file\n");
        std::vector<std::string> arguments = argumentsOf({output});
        arguments.emplace_back("--no-clobber");
        SCOPED_TRACE(::testing::PrintToString(arguments));
        const auto files = everything();
        const CommandResult refused = runInProcess(arguments);
        if (!isElsewhere(refused)) {
            EXPECT_EQ(refused.exit_code, 4) << refused.error;
            EXPECT_THAT(refused.error, ::testing::HasSubstr("exists and must not be replaced"));
            EXPECT_EQ(everything(), files) << "files came or went";
            EXPECT_EQ(readFile(output.path()), "an older file\n");
        }
        clear();
    }
}

/// Every option that names a file takes part in the tests above.
TEST(RunFilesOfHelp, TableHasAllFileOptions)
{
    const std::set<std::string> kinds{"FILE", "PATH", "PICTURE", "OBJECT", "GROUND", "OUTPUT"};
    std::map<std::string, std::set<std::string>> known;
    for (const CommandFiles& of : all()) {
        for (const auto* list : {&of.inputs, &of.outputs}) {
            for (const FileOption& option : *list) {
                known[of.command].insert(option.name);
            }
        }
    }
    // Films refuse objects; the option is declared to say so.
    known["animate"].insert("--onto");
    known["morph"].insert("--onto");
    // Either the output is a picture or there is a preview; a test of flow has it.
    known["flow"].insert("--environment");
    for (const auto& [command, names] : known) {
        const CommandResult help = runDroplet(command.empty() ? std::vector<std::string>{"--help"}
                                                              : std::vector<std::string>{command, "--help"});
        std::istringstream lines(help.output);
        std::size_t found = 0;
        for (std::string line; std::getline(lines, line);) {
            std::istringstream words(line);
            std::string name;
            std::string kind;
            words >> name;
            if (name.ends_with(',')) {
                words >> name;
            }
            words >> kind;
            if (name.starts_with("--") && kinds.contains(kind)) {
                EXPECT_TRUE(names.contains(name)) << command << " " << name << " " << kind;
                ++found;
            }
        }
        EXPECT_GE(found, 3U) << command << ": the help is read wrongly";
    }
}

INSTANTIATE_TEST_SUITE_P(Commands, RunFiles, ::testing::ValuesIn(all()), [](const auto& of) { return of.param.title; });

class FileClashes : public ::testing::Test {
protected:
    [[nodiscard]] std::string path(const std::string& name) const { return (scratch_.path() / name).string(); }

    [[nodiscard]] cli::NumberedPath pattern(const std::string& name) const
    {
        return *cli::NumberedPath::of(path(name), "OUTPUT");
    }

    static std::string clashOf(const cli::RunFiles& files)
    {
        try {
            cli::refuseClashes(files);
            return "";
        } catch (const Error& error) {
            return error.what();
        }
    }

    ScratchDirectory scratch_;
};

TEST_F(FileClashes, LinksAreTheirTargets)
{
    writeFile(path("a.png"), "a");
    fs::create_symlink("a.png", path("link.glb"));
    fs::create_hard_link(path("a.png"), path("hard.glb"));
    for (const char* output : {"a.png", "./a.png", "link.glb", "hard.glb"}) {
        cli::RunFiles files;
        files.reads("INPUT", path("a.png"));
        files.writes("OUTPUT", path(output));
        EXPECT_THAT(clashOf(files), ::testing::StartsWith("OUTPUT and INPUT are the same")) << output;
    }
    cli::RunFiles files;
    files.reads("INPUT", path("a.png"));
    files.writes("OUTPUT", path("b.png"));
    EXPECT_EQ(clashOf(files), "");
}

TEST_F(FileClashes, BuffersOfAnObjectAreInputs)
{
    writeFile(path("can.gltf"), R"({"buffers": [{"uri": "data:,"}, {"uri": "can.bin", "byteLength": 4}, {}, 3]})");
    const auto clash = [&](const std::string& object) {
        cli::RunFiles files;
        files.reads("--onto", path(object));
        files.writes("--json", path("can.bin"));
        return clashOf(files);
    };
    EXPECT_THAT(clash("can.gltf"), ::testing::StartsWith("--json and a buffer of --onto are the same"));
    EXPECT_EQ(clash("none.gltf"), "");
    writeFile(path("broken.gltf"), "{\"buffers\": [");
    EXPECT_EQ(clash("broken.gltf"), "");
}

TEST_F(FileClashes, MasksOfASceneAreInputs)
{
    fs::create_directory(path("f"));
    writeFile(path("f/0002.png"), kNothing);
    writeFile(path("scene.toml"), "[[walls]]\nmask = \"f/0002.png\"\n");
    const CommandResult refused =
        runInProcess({"liquid2d", path("f/%04d.png"), "--scene", path("scene.toml"), "--time", "1s"});
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_THAT(refused.error, ::testing::StartsWith("droplet-shape: OUTPUT and a mask of --scene are the same"));
}

TEST_F(FileClashes, PatternsAreTheFilesOfTheirFrames)
{
    fs::create_directory(path("f"));
    fs::create_directory_symlink("f", path("g"));
    writeFile(path("f/0007.png"), "a");
    const auto clash = [&](const std::string& input, std::optional<std::size_t> last) {
        cli::RunFiles files;
        files.reads("INPUT", path(input));
        files.writesFrames("OUTPUT", pattern("g/%04d.png"), {1, last});
        return clashOf(files);
    };
    EXPECT_THAT(clash("f/0007.png", 7), ::testing::StartsWith("OUTPUT and INPUT are the same"));
    EXPECT_THAT(clash("f/0007.png", {}), ::testing::StartsWith("OUTPUT and INPUT are the same"));
    EXPECT_EQ(clash("f/0007.png", 6), "") << "a frame that the run does not write";
    EXPECT_EQ(clash("f/007.png", {}), "");
    EXPECT_EQ(clash("f/0000.png", {}), "");
    EXPECT_EQ(clash("0007.png", {}), "");
    fs::create_symlink("../f/0003.png", path("f/link.png"));
    EXPECT_THAT(clash("f/link.png", {}), ::testing::HasSubstr("are the same")) << "a link to a file that is made";
}

TEST_F(FileClashes, TwoOutputsAreNotOneFile)
{
    const auto clash = [&](const std::string& a, const std::string& b, std::optional<std::size_t> last) {
        cli::RunFiles files;
        files.writesFrames("OUTPUT", pattern(a), {1, last});
        files.writesFrames("--masks", pattern(b), {1, last});
        return clashOf(files);
    };
    EXPECT_THAT(clash("%04d.png", "%04d.png", 1), ::testing::StartsWith("--masks and OUTPUT are the same"));
    EXPECT_THAT(clash("%04d.png", "%d.png", {}), ::testing::HasSubstr("1000.png"));
    EXPECT_EQ(clash("%04d.png", "%d.png", 999), "");
    EXPECT_THAT(clash("a%d.png", "a1%d.png", 11), ::testing::HasSubstr("a11.png"));
    EXPECT_EQ(clash("%04d.png", "%04d.svg", {}), "");
    cli::RunFiles files;
    files.writesFrames("OUTPUT", pattern("%04d.png"), {1, 10});
    files.writes("--json", path("0010.png"));
    EXPECT_THAT(clashOf(files), ::testing::StartsWith("--json and OUTPUT are the same"));
    cli::RunFiles streams;
    streams.reads("INPUT", "-");
    streams.writes("OUTPUT", "-");
    EXPECT_EQ(clashOf(streams), "");
    streams.writes("--json", "-");
    EXPECT_THAT(clashOf(streams), ::testing::StartsWith("--json and OUTPUT are the same"));
}

}  // namespace
}  // namespace droplet
