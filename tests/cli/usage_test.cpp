// SPDX-License-Identifier: GPL-3.0-or-later
// Errors in the command line: exit code 2, and one line that says what is allowed, before any work is done.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "cli/refusal.h"
#include "support/command.h"

namespace droplet {
namespace {

using testing::CommandOptions;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::RefusalTest;
using ::testing::StartsWith;
using testing::writeFile;

class UsageTest : public RefusalTest {
protected:
    /// Expects that options prevent a run which would replace old.glb and old.json.
    void expectRefused(const std::vector<std::string>& options, const std::vector<std::string>& words) const
    {
        std::vector<std::string> arguments{"disc.pgm", "old.glb", "--json", "old.json"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        expectRefusal(arguments, 2, words);
    }

    void expectConfigRefused(const std::string& text, const std::vector<std::string>& words) const
    {
        SCOPED_TRACE(text);
        writeFile(directory() / "settings.toml", text);
        expectRefused({"--config", "settings.toml"}, words);
    }
};

TEST_F(UsageTest, HelpAndVersionGoToStandardOutput)
{
    for (const char* option : {"--help", "-h"}) {
        const auto help = run({option});
        EXPECT_EQ(help.exit_code, 0);
        EXPECT_THAT(help.output, HasSubstr("Usage: droplet-shape"));
        EXPECT_THAT(help.output, HasSubstr("Exit codes:"));
        EXPECT_THAT(help.error, IsEmpty());
    }
    const auto version = run({"--version"});
    EXPECT_EQ(version.exit_code, 0);
    EXPECT_THAT(version.output, StartsWith("droplet-shape "));
    EXPECT_THAT(version.error, IsEmpty());
}

TEST_F(UsageTest, HelpFitsATerminalOfEightyColumns)
{
    for (const std::string command : {"", "animate", "batch", "compare", "dew", "flow", "glyphs", "liquid2d", "morph",
                                      "wind-tunnel", "windshield"}) {
        std::istringstream help(
            run(command.empty() ? std::vector<std::string>{"--help"} : std::vector<std::string>{command, "--help"})
                .output);
        for (std::string line; std::getline(help, line);) {
            EXPECT_LE(line.size(), 80U) << command << ": " << line;
        }
    }
}

/// --help=json tells programs what --help tells people.
TEST_F(UsageTest, HelpForProgramsHasTheOptionsOfTheHelp)
{
    for (const std::string command : {"", "animate", "batch", "compare", "dew", "flow", "glyphs", "liquid2d", "morph",
                                      "studio", "wind-tunnel", "windshield"}) {
        SCOPED_TRACE(command);
        const auto told = [&](const std::string& form) {
            return run(command.empty() ? std::vector<std::string>{form} : std::vector<std::string>{command, form})
                .output;
        };
        const std::string text = told("--help");
        const auto json = nlohmann::json::parse(told("--help=json"));
        std::string all;
        for (const char c : text) {
            if (c != ' ' && c != '\n') {
                all += c;
            }
        }
        const auto expect_told = [&](std::string part) {
            part.erase(std::remove(part.begin(), part.end(), ' '), part.end());
            EXPECT_THAT(all, HasSubstr(part));
        };
        std::size_t names = 0;
        std::istringstream lines(text);
        for (std::string line; std::getline(lines, line);) {
            names += line.rfind("  --", 0) == 0 || line.rfind("  -", 0) == 0 ? 1 : 0;
        }
        EXPECT_EQ(json["options"].size(), names);
        for (const auto& option : json["options"]) {
            const auto of = [&](const char* key) { return option[key].get<std::string>(); };
            const std::string usual = of("default").empty() ? "" : "[" + of("default") + "]";
            expect_told(of("name") + of("value") + of("text") + usual);
            EXPECT_NE(of("kind"), "unknown") << of("name");
        }
    }
    expectRefused({"--help=xml"}, {"--help: 'xml' must be true, false or json"});
}

TEST_F(UsageTest, HelpOnAFullDeviceFails)
{
    CommandOptions options;
    options.output_file = "/dev/full";
    expectRefusal({"--help"}, 4, {"/dev/stdout", "No space left"}, options);
}

TEST_F(UsageTest, RefusesMissingAndExtraArguments)
{
    expectRefusal({}, 2, {"INPUT is missing", "--help"});
    expectRefusal({"disc.pgm"}, 2, {"OUTPUT is missing", "--help"});
    expectRefusal({"", "old.glb"}, 2, {"INPUT is missing"});
    expectRefusal({"disc.pgm", "old.glb", "third"}, 2, {"unexpected argument 'third'"});
}

TEST_F(UsageTest, RefusesUnknownOptions)
{
    expectRefused({"--trianglse", "5k"}, {"unknown option --trianglse", "--triangles"});
    expectRefused({"--zzz=3"}, {"unknown option --zzz", "--help"});
    expectRefused({"-x"}, {"unknown option -x"});
    expectRefused({"--wind", "5m/s"}, {"unknown option --wind"});
    expectRefused({"--wid", "5mm"}, {"unknown option --wid"});
    // Names of the same meaning that other programs have.
    expectRefused({"--jobs", "2"}, {"unknown option --jobs, did you mean --threads?"});
    expectRefusal({"flow", "a.obj", "b.glb", "--duration", "2s"}, 2, {"did you mean --time?"});
    expectRefusal({"liquid2d", "b.mp4", "--framerate", "30"}, 2, {"did you mean --fps?"});
}

TEST_F(UsageTest, RefusesUnknownCommands)
{
    expectRefusal({"glyph", "--all"}, 2, {"unknown command 'glyph', did you mean glyphs?"});
    expectRefusal({"wind-tunel"}, 2, {"did you mean wind-tunnel?"});
    expectRefusal({"windsheild", "a.png"}, 2, {"did you mean windshield?"});
    expectRefusal({"render"}, 2, {"OUTPUT is missing"});
    expectRefusal({"disc.pgm", "-o", "old.glb"}, 2, {"-o: OUTPUT needs no option"});
    writeFile(directory() / "batc", "no picture, but a file");
    expectRefusal({"batc", "old.glb"}, 3, {"batc"});
}

TEST_F(UsageTest, RefusesOptionsWithoutAValue)
{
    expectRefused({"--width"}, {"--width", "value is missing"});
    expectRefused({"--width="}, {"--width", "empty"});
    expectRefused({"--width", ""}, {"--width", "not a length"});
    expectRefused({"--open=maybe"}, {"--open", "'maybe'", "true or false"});
    expectRefused({"--width", "3mm", "--width", "4mm"}, {"--width", "2 times"});
}

TEST_F(UsageTest, RefusesBareNumbersAndNamesTheUnits)
{
    expectRefused({"--width", "20"}, {"--width", "'20' has no unit", "mm", "as in 4mm"});
    expectRefused({"--pixel-size", "20"}, {"--pixel-size", "no unit", "um"});
    expectRefused({"--volume", "30"}, {"--volume", "no unit", "uL", "as in 30uL"});
    expectRefused({"--height", "4"}, {"--height", "no unit", "mm"});
    expectRefused({"--contact-angle", "45"}, {"--contact-angle", "no unit", "deg or rad"});
    expectRefused({"--surface-tension", "72"}, {"--surface-tension", "no unit", "mN/m"});
    expectRefused({"--density", "1000"}, {"--density", "no unit", "kg/m3"});
    expectRefused({"--gravity", "9.81"}, {"--gravity", "no unit", "m/s2"});
    expectRefused({"--edge", "1"}, {"--edge", "no unit", "mm"});
    expectRefused({"--tilt", "45"}, {"--tilt", "no unit", "deg or rad"});
    expectRefused({"--tilt-direction", "45"}, {"--tilt-direction", "no unit", "deg or rad"});
    expectRefused({"--advancing", "45", "--receding", "9deg"}, {"--advancing", "no unit", "deg or rad"});
    expectRefused({"--advancing", "45deg", "--receding", "9"}, {"--receding", "no unit", "deg or rad"});
    expectRefused({"--surface-depth", "2"}, {"--surface-depth", "no unit", "mm"});
    expectRefused({"--surface", "sphere:R=40"}, {"--surface", "R", "'40' has no unit", "mm"});
    expectRefused({"--surface", "cylinder:R=33mm,axis=45"}, {"--surface", "axis", "'45' has no unit", "deg"});
}

TEST_F(UsageTest, RefusesQuantitiesOutOfRange)
{
    for (const char* length :
         {"0mm", "-1mm", "1e300m", "-1e300m", "1e-300m", "nan", "inf", "infmm", "1e999mm", "4uL"}) {
        expectRefused({"--width", length}, {"--width", length});
        expectRefused({"--pixel-size", length}, {"--pixel-size", length});
        expectRefused({"--height", length}, {"--height", length});
        expectRefused({"--edge", length}, {"--edge", length});
    }
    for (const char* volume : {"0uL", "-1uL", "1e300m3", "1e-300uL", "nan", "4mm"}) {
        expectRefused({"--volume", volume}, {"--volume", volume});
    }
    for (const char* angle : {"0deg", "-1deg", "179.1deg", "4rad", "nan", "infdeg"}) {
        expectRefused({"--contact-angle", angle}, {"--contact-angle", angle});
    }
    for (const char* tension : {"0mN/m", "-1mN/m", "1e300N/m"}) {
        expectRefused({"--surface-tension", tension}, {"--surface-tension", tension});
    }
    expectRefused({"--density", "-1kg/m3"}, {"--density", "from 0kg/m3"});
    for (const char* gravity : {"-1.1e6m/s2", "1.1e6m/s2", "-1e300m/s2", "nan", "-infm/s2", "9.81m"}) {
        expectRefused({"--gravity", gravity}, {"--gravity", gravity});
    }
    expectRefused({"--gravity", "-2e6m/s2"}, {"'-2e6m/s2'", "from -1e6m/s2 to 1e6m/s2"});
    for (const char* tilt : {"-1deg", "180.001deg", "4rad", "1e300deg", "nan", "infdeg", "4mm"}) {
        expectRefused({"--tilt", tilt}, {"--tilt", tilt});
        expectRefused({"--advancing", tilt, "--receding", "0deg"}, {"--advancing", tilt});
        expectRefused({"--advancing", "180deg", "--receding", tilt}, {"--receding", tilt});
    }
    expectRefused({"--tilt", "181deg"}, {"'181deg'", "from 0deg to 180deg"});
    for (const char* direction : {"-361deg", "361deg", "7rad", "nan", "down"}) {
        expectRefused({"--tilt-direction", direction}, {"--tilt-direction", direction});
    }
    expectRefused({"--tilt-direction", "361deg"}, {"from -360deg to 360deg"});
    for (const char* depth : {"0mm", "-1mm", "1e300m", "nan", "4uL"}) {
        expectRefused({"--surface-depth", depth}, {"--surface-depth", depth});
    }
    expectRefused({"--contact-angle", "90deg", "--model", "linear"},
                  {"below 90deg with --model linear; use --model auto"});
    expectRefused({"--contact-angle", "180deg"}, {"to 179deg"});
    expectRefused({"--width", "0mm"}, {"from 1nm to 1000m"});
}

TEST_F(UsageTest, RefusesNumbersOutOfRange)
{
    for (const char* threshold : {"0", "1", "-0.5", "2", "nan", "half", "0.5x"}) {
        expectRefused({"--threshold", threshold}, {"--threshold", threshold, "over 0 and under 1"});
    }
    for (const char* speck : {"-1", "nan", "inf", "some"}) {
        expectRefused({"--speck-size", speck}, {"--speck-size", speck, "at least 0"});
    }
    expectRefused({"--segment", "magic"}, {"--segment", "'magic'", "auto, threshold, adaptive, grabcut"});
    expectRefused({"--colour", "reddish"}, {"--colour", "'reddish'", "#e30613"});
    expectRefused({"--colour", "red", "--segment", "grabcut"}, {"--segment", "--colour"});
    expectRefused({"--channel", "alpha", "--segment", "adaptive"}, {"--segment adaptive", "--channel alpha"});
    expectRefused({"--smooth", "3"}, {"--smooth", "'3'"});
    expectRefused({"--fill-holes", "1mm"}, {"--fill-holes", "'1mm'", "mm2"});
    expectRefused({"--keep", "0"}, {"--keep", "'0'", "from 1 to 1M"});
    for (const char* count : {"0", "-5", "5.5", "1e9", "5kk", "k", "5G", "many", "nan"}) {
        expectRefused({"--triangles", count}, {"--triangles", count, "from 1 to 100M"});
    }
    for (const char* count : {"0", "-1", "1.5", "2000", "all"}) {
        expectRefused({"-j", count}, {"--threads", count, "from 1 to 1024"});
    }
}

TEST_F(UsageTest, RefusesMalformedGrounds)
{
    for (const char* ground : {"", "sphere", "sphere:", "sphere:R", "sphere:=40mm", "sphere:r=40mm", "sphere:R=4mm,",
                               "sphere:R=4mm,R=5mm", "sphere:R=4mm,axis=y", "sphere:R=4mm axis=y,R=3mm", "cylinder",
                               "cylinder:", "cylinder:R=3mm", "cylinder:axis=y", "cylinder:R=3mm,axis",
                               "cylinder:R=3mm,axis=x,axis=y", "cone:R=4mm", "Sphere:R=40mm", ":R=4mm"}) {
        expectRefused({"--surface", ground}, {"--surface", std::string("'") + ground + "'", "a height map's file",
                                              "sphere:R=LENGTH", "cylinder:R=LENGTH,axis=ANGLE"});
    }
    for (const char* radius : {"0mm", "-0mm", "1e-300m", "0.5nm", "1001m", "-1001m", "nan", "infm", "4uL", "--4mm"}) {
        expectRefused({"--surface", std::string("sphere:R=") + radius}, {"--surface: R", radius});
        expectRefused({"--surface", std::string("cylinder:axis=x,R=") + radius}, {"--surface: R", radius});
    }
    expectRefused({"--surface", "sphere:R=0mm"}, {"from 1nm to 1000m, or from -1000m to -1nm"});
    for (const char* axis : {"", "z", "X", "361deg", "nan", "1mm"}) {
        expectRefused({"--surface", std::string("cylinder:R=33mm,axis=") + axis}, {"--surface: axis", axis});
    }
}

TEST_F(UsageTest, AdvancingAndRecedingAngleBelongTogether)
{
    expectRefused({"--advancing", "90deg"}, {"--advancing and --receding", "--receding is missing"});
    expectRefused({"--receding", "30deg"}, {"--advancing and --receding", "--advancing is missing"});
    expectRefused({"--advancing", "30deg", "--receding", "31deg"}, {"--receding", "'31deg'", "at most", "'30deg'"});
}

TEST_F(UsageTest, RefusesUnknownNamesAndListsTheKnownOnes)
{
    expectRefused({"--model", "quadratic"}, {"--model", "'quadratic'", "linear, exact"});
    expectRefused({"--solver", "gauss"}, {"--solver", "'gauss'", "auto, llt, multigrid"});
    expectRefused({"--solver", "cholmod"}, {"--solver", "'cholmod' is no longer built in", "llt"});
    expectRefused({"--channel", "red"}, {"--channel", "'red'", "auto, alpha, luma"});
    expectRefused({"--fill", "some"}, {"--fill", "'some'", "each, total"});
    expectRefused({"--liquid", "milk"}, {"--liquid", "'milk'", "water", "mercury"});
    expectRefused({"--material", "silver"}, {"--material", "silver", "water", "plain", "gold"});
    expectRefused({"--format", "fbx"}, {"--format", "'fbx'", "glb, gltf, obj, ply, stl"});
    expectRefused({"--progress", "loud"}, {"--progress", "'loud'", "auto, none, json"});
}

TEST_F(UsageTest, RefusesOptionsThatExcludeEachOther)
{
    expectRefused({"--width", "2cm", "--pixel-size", "1um"}, {"--width and --pixel-size exclude each other"});
    expectRefused({"--volume", "1uL", "--height", "1mm"}, {"--volume and --height exclude each other"});
    expectRefused({"--volume", "1uL", "--contact-angle", "1deg"}, {"--contact-angle and --volume exclude each other"});
    expectRefused({"--height", "1mm", "--contact-angle", "1deg"}, {"--contact-angle and --height exclude each other"});
    expectRefused({"--triangles", "5k", "--edge", "1mm"}, {"--triangles and --edge exclude each other"});
    expectRefused({"--surface", "sphere:R=4cm", "--onto", "can.glb"}, {"--surface and --onto exclude each other"});
    expectRefused({"-q", "-v"}, {"--quiet and --verbose exclude each other"});
}

TEST_F(UsageTest, RefusesMeshesWithoutUvOnto)
{
    expectRefused({"--onto", "bunny.stl"}, {"--onto", "bunny.stl", ".glb, .gltf, .obj or .ply", "dew and flow"});
    expectRefused({"--onto", "bunny.fbx"}, {"--onto", "bunny.fbx", "must be a .glb, .gltf, .obj or .ply"});
    expectRefused({"--onto", "can.obj", "--scale", "2", "--object-size", "12cm"},
                  {"--scale and --object-size exclude each other"});
}

TEST_F(UsageTest, FillRangesContainTheDropletAndNeedTheLinearModelAndGltf)
{
    for (const char* wrong :
         {"2", "0..", "..2", "0...2", "a..b", "-1..2", "1.5..2", "0..0.5", "1..1", "0..inf", "0..1e9"}) {
        expectRefused({"--fill-range", wrong}, {"--fill-range", "'" + std::string(wrong) + "'", "0..2"});
    }
    expectRefused({"--fill-range", "0..2", "--no-penetration"}, {"--fill-range and --no-penetration exclude"});
    expectRefused({"--fill-range", "0..2", "--onto", "can.glb"}, {"--fill-range and --onto exclude each other"});
    for (const char* format : {"obj", "ply", "stl", "usda", "usdz"}) {
        expectRefused({"--fill-range", "0..2", "--format", format}, {"--fill-range", format, "glb and gltf"});
    }
}

TEST_F(UsageTest, OnlyAGlbIsCompressed)
{
    expectRefused({"--compress", "draco"}, {"--compress", "'draco'", "none, quantize, meshopt"});
    for (const char* compress : {"quantize", "meshopt"}) {
        for (const char* format : {"gltf", "obj", "ply", "stl", "usda", "usdz"}) {
            expectRefused({"--compress", compress, "--format", format}, {"--compress", format, "only glb"});
        }
    }
}

TEST_F(UsageTest, RefusesUnknownOutputFormats)
{
    expectRefusal({"disc.pgm", "new.fbx"}, 2, {"OUTPUT 'new.fbx'", ".fbx", "glb", "stl"});
    expectRefusal({"disc.pgm", "new"}, 2, {"OUTPUT 'new' has no extension", "glb", "--format"});
    expectRefusal({"disc.pgm", ".glb"}, 2, {"OUTPUT '.glb' has no extension"});
    expectRefusal({"disc.pgm", "-"}, 2, {"--format is missing", "glb"});
}

TEST_F(UsageTest, RefusesTwoFilesAtOnePath)
{
    expectRefusal({"disc.pgm", "disc.pgm", "--format", "glb"}, 2, {"OUTPUT and INPUT are the same"});
    expectRefusal({"disc.pgm", "./disc.pgm", "--format", "glb"}, 2, {"OUTPUT and INPUT are the same"});
    std::filesystem::create_symlink("disc.pgm", directory() / "link.glb");
    expectRefusal({"disc.pgm", "link.glb"}, 2, {"OUTPUT and INPUT are the same"});
    std::filesystem::create_hard_link(directory() / "disc.pgm", directory() / "hard.glb");
    expectRefusal({"disc.pgm", "hard.glb"}, 2, {"OUTPUT and INPUT are the same"});
    expectRefusal({"disc.pgm", "old.glb", "--json", "disc.pgm"}, 2, {"--json and INPUT are the same"});
    expectRefusal({"disc.pgm", "old.glb", "--json", "old.glb"}, 2, {"--json and OUTPUT are the same"});
    expectRefusal({"disc.pgm", "new.glb", "--json", "./new.glb"}, 2, {"--json and OUTPUT are the same"});
    expectRefusal({"disc.pgm", "-", "--format", "glb", "--json", "-"}, 2, {"--json and OUTPUT are the same"});
    expectRefusal({"disc.pgm", "old.glb", "--export-evolver", "disc.pgm"}, 2,
                  {"--export-evolver and INPUT are the same"});
    expectRefusal({"disc.pgm", "old.glb", "--export-evolver", "./old.glb"}, 2,
                  {"--export-evolver and OUTPUT are the same"});
    expectRefusal({"disc.pgm", "old.glb", "--json", "old.json", "--export-evolver", "old.json"}, 2,
                  {"--export-evolver and --json are the same"});
    expectRefusal({"disc.pgm", "old.glb", "--json", "-", "--export-evolver", "-"}, 2,
                  {"--export-evolver and --json are the same"});
    expectRefusal({"disc.pgm", "old.glb", "--surface", "old.glb"}, 2, {"OUTPUT and --surface are the same"});
    expectRefusal({"disc.pgm", "old.glb", "--onto", "old.glb"}, 2, {"OUTPUT and --onto are the same"});
    expectRefusal({"disc.pgm", "new.glb", "--surface", "old.json", "--json", "old.json"}, 2,
                  {"--json and --surface are the same"});
    writeFile(directory() / "settings.toml", "open = true\n");
    expectRefusal({"disc.pgm", "old.glb", "--json", "settings.toml", "--config", "settings.toml"}, 2,
                  {"--json and --config are the same"});
}

TEST_F(UsageTest, RefusesErrorsInConfigurationFiles)
{
    expectConfigRefused("widht = \"8cm\"\n", {"settings.toml:1", "unknown key 'widht'", "'width'"});
    expectConfigRefused("# fine\n\nx = 1\n", {"settings.toml:3", "unknown key 'x'"});
    expectConfigRefused("INPUT = \"disc.pgm\"\n", {"unknown key 'INPUT'"});
    expectConfigRefused("q = true\n", {"unknown key 'q'"});
    expectConfigRefused("config = \"other.toml\"\n", {"unknown key 'config'"});
    expectConfigRefused("help = true\n", {"unknown key 'help'"});
    expectConfigRefused("open\n", {"settings.toml:1", "'open' is not TOML", "expected '='", "'key = value'"});
    expectConfigRefused("width = 8cm\n", {"'width = 8cm'", "quotes", "width = \"8cm\""});
    expectConfigRefused("width =\n", {"settings.toml:1", "'width ='", "expected value"});
    expectConfigRefused("width = \"8cm\n", {"settings.toml:1", "'width = \"8cm' is not TOML"});
    expectConfigRefused("width = \"8cm\" 3\n", {"saw '3'"});
    expectConfigRefused("width = \"\\q\"\n", {"escape"});
    expectConfigRefused("[size]\nwidth = \"8cm\"\n", {"settings.toml:1", "begins a table"});
    expectConfigRefused("triangles = [1, 2]\n", {"settings.toml:1", "[1, 2]"});
    expectConfigRefused("triangles = 20\nwidth = 1979-05-27\n", {"settings.toml:2", "1979-05-27", "quotes"});
    expectConfigRefused("width = \"\"\"8cm\n", {"settings.toml:", "end"});
    expectConfigRefused("z = 1\na = 1\n", {"settings.toml:1", "unknown key 'z'"});
    expectConfigRefused("speck-size = inf\n", {"--speck-size (settings.toml:1)", "'inf'"});
    expectConfigRefused("threshold = 1.50\n", {"--threshold (settings.toml:1)", "'1.5'"});
    expectConfigRefused("triangles = 12345678901\n", {"--triangles (settings.toml:1)", "'12345678901'"});
    expectConfigRefused("open = true\nopen = false\n", {"settings.toml:2", "cannot redefine", "'open'"});
    expectConfigRefused("open = \"yes\"\n", {"--open (settings.toml:1)", "true or false"});
    expectConfigRefused("open = 1\n", {"--open (settings.toml:1)", "true or false"});
    expectConfigRefused("\nvolume = \"30\"\n", {"--volume (settings.toml:2)", "no unit"});
    expectConfigRefused("solver = \"cholmod\"\n", {"--solver (settings.toml:1)", "no longer built in"});
    expectConfigRefused("width = \"8cm\"\npixel-size = \"1um\"\n", {"--width and --pixel-size exclude each other"});
    expectRefused({"--config", "missing.toml"}, {"--config", "missing.toml", "No such file"});
    expectRefused({"--config", "."}, {"--config", "Is a directory"});
}

}  // namespace
}  // namespace droplet
