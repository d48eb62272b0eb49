// SPDX-License-Identifier: GPL-3.0-or-later
// `droplet-shape glyphs`: texts, sets of glyphs, errors.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "cli/refusal.h"
#include "droplet/drawing/picture.h"
#include "support/command.h"
#include "support/fonts.h"

namespace droplet {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using testing::CommandOptions;
using testing::CommandResult;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::kSans;
using testing::kVariable;
using testing::readFile;
using ::testing::SizeIs;
using ::testing::StartsWith;
using ::testing::UnorderedElementsAre;
using testing::writeFile;

class Glyphs : public testing::RefusalTest {
protected:
    [[nodiscard]] CommandResult glyphs(std::vector<std::string> arguments, const char* font = kSans) const
    {
        arguments.insert(arguments.begin(), {"glyphs", "--font", font});
        return run(arguments);
    }

    void succeeds(const std::vector<std::string>& arguments, const char* font = kSans) const
    {
        const CommandResult result = glyphs(arguments, font);
        EXPECT_EQ(result.exit_code, 0) << result.error;
    }

    void refuses(std::vector<std::string> arguments, int exit_code, const std::vector<std::string>& words,
                 const char* font = kSans) const
    {
        arguments.insert(arguments.begin(), {"glyphs", "--font", font});
        expectRefusal(arguments, exit_code, words);
    }

    [[nodiscard]] json parsed(const std::string& name) const { return json::parse(readFile(directory() / name)); }

    [[nodiscard]] std::set<std::string> filesIn(const std::string& folder) const
    {
        std::set<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(directory() / folder)) {
            names.insert(entry.path().filename().string());
        }
        return names;
    }
};

// A line of type fills the picture's width, and its lines are level.
TEST_F(Glyphs, PreviewLooksFromTheFrontAndIsAsHighAsTheTextNeeds)
{
    const std::vector<std::string> text{"--text", "Water", "-o", "w.glb", "--triangles", "2k", "--preview"};
    const auto preview = [&](const std::string& name, const std::vector<std::string>& view) {
        std::vector<std::string> arguments = text;
        arguments.push_back(name);
        arguments.insert(arguments.end(), view.begin(), view.end());
        succeeds(arguments);
        return readPicture(directory() / name);
    };
    const Picture own = preview("own.png", {});
    EXPECT_EQ(own.width, 1280);
    EXPECT_LT(own.height, 480);
    EXPECT_EQ(own.height % 2, 0);
    const std::string size = "1280x" + std::to_string(own.height);
    EXPECT_EQ(preview("front.png", {"--camera", "-90deg,60deg", "--preview-size", size}), own);
    EXPECT_EQ(preview("small.png", {"--preview-size", "64x48"}).height, 48);
    EXPECT_EQ(preview("above.png", {"--view", "top", "--preview-size", "64x48"}).height, 48);
}

TEST_F(Glyphs, TurntableIsAVideo)
{
    succeeds({"--text", "W", "-o", "w.glb", "--triangles", "500", "--turntable", "w.mp4", "--preview-size", "64x48"});
    const auto seen =
        testing::runProgram({"ffprobe", "-v", "error", "-count_frames", "-show_entries", "stream=nb_read_frames", "-of",
                             "csv=p=0", (directory() / "w.mp4").string()});
    EXPECT_EQ(seen.output, "120\n");
}

TEST_F(Glyphs, WritesATextToOneFile)
{
    succeeds({"--text", "Water", "-o", "water.glb", "--triangles", "3k", "--json", "water.json"});
    EXPECT_THAT(readFile(directory() / "water.glb"), StartsWith("glTF"));
    const json report = parsed("water.json");
    EXPECT_EQ(report["input"]["path"], kSans);
    EXPECT_TRUE(report["input"]["width_px"].is_null());
    EXPECT_EQ(report["input"]["type"]["text"], "Water");
    EXPECT_EQ(report["input"]["type"]["family"], "DejaVu Sans");
    EXPECT_TRUE(report["input"]["type"]["glyph"].is_null());
    EXPECT_NEAR(report["input"]["type"]["em_m"].get<double>(), 0.02, 1e-15);
    EXPECT_EQ(report["mesh"]["droplets"], 5);
    EXPECT_EQ(report["mesh"]["holes"], 2);
    EXPECT_EQ(report["output"]["closed"], true);
    EXPECT_NEAR(report["shape"]["contact_angle_deg"]["mean"].get<double>(), 40.0, 1e-6)
        << "all letters have the same angle";
    for (const json& letter : report["droplets"]) {
        EXPECT_NEAR(letter["contact_angle_deg"]["mean"].get<double>(), 40.0, 1e-6);
    }
}

TEST_F(Glyphs, SummaryShowsTheText)
{
    const CommandResult result = glyphs({"--text", "A水", "-o", "a.stl", "--triangles", "500", "--em", "1cm"});
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_THAT(result.error, HasSubstr("'A水' in DejaVu Sans Book, em 10 mm\n"));
    EXPECT_THAT(result.error, HasSubstr("warning: the font has no glyph for U+6C34 '水'; left out\n"));
    EXPECT_THAT(result.error, ::testing::Not(HasSubstr("pixel")));
}

TEST_F(Glyphs, WritesOneFilePerCharacter)
{
    const CommandResult result = glyphs(
        {"--charset", "A-Ca水 ", "-o", "out/{name}.stl", "--json", "out/{codepoint}_{gid}.json", "--triangles", "300"});
    EXPECT_EQ(result.exit_code, 0) << result.error;
    EXPECT_THAT(result.error, HasSubstr("warning: the font has no glyph for U+6C34 '水'; left out\n"));
    EXPECT_THAT(result.error, HasSubstr("made       4 of 4"));
    EXPECT_THAT(filesIn("out"),
                UnorderedElementsAre("A_.stl", "B_.stl", "C_.stl", "a.stl", "U+0041_36.json", "U+0042_37.json",
                                     "U+0043_38.json", "U+0061_68.json", "manifest.json"));
    const json manifest = parsed("out/manifest.json");
    ASSERT_THAT(manifest["items"], SizeIs(4));
    for (const json& row : manifest["items"]) {
        EXPECT_EQ(row["status"], "made");
        EXPECT_EQ(row["closed"], true);
        EXPECT_GT(row["volume_m3"].get<double>(), 0.0);
    }
    EXPECT_EQ(manifest["items"][3]["name"], "glyph 'a'");
    ASSERT_THAT(manifest["left_out"], SizeIs(1)) << "white space in a charset is ignored";
    EXPECT_EQ(manifest["left_out"][0]["name"], "U+6C34 '水'");
    const json report = parsed("out/U+0041_36.json");
    EXPECT_EQ(report["input"]["type"]["glyph"], 36);
    EXPECT_EQ(report["input"]["type"]["glyph_name"], "A");
    EXPECT_EQ(report["input"]["type"]["character"], "U+0041");
    EXPECT_TRUE(report["input"]["type"]["text"].is_null());
}

TEST_F(Glyphs, GlyphOfASetEqualsTheSameGlyphAlone)
{
    succeeds({"--charset", "g&", "-o", "{name}.stl", "--triangles", "400", "-j", "2"});
    succeeds({"--text", "g", "-o", "text.stl", "--triangles", "400"});
    EXPECT_TRUE(readFile(directory() / "g.stl") == readFile(directory() / "text.stl"));
}

TEST_F(Glyphs, SameBytesWithAnyNumberOfThreads)
{
    for (const char* threads : {"1", "3"}) {
        const std::string folder = std::string("j") + threads;
        succeeds({"--charset", "a-h", "-o", folder + "/{name}.glb", "--triangles", "300", "-j", threads});
    }
    for (const std::string& name : filesIn("j1")) {
        if (name != "manifest.json") {
            EXPECT_TRUE(readFile(directory() / "j1" / name) == readFile(directory() / "j3" / name)) << name;
        }
    }
}

TEST_F(Glyphs, ListsGlyphsWithoutInkAsLeftOut)
{
    succeeds({"--charset", "U+00A0 U+0021", "-o", "out/{name}.stl", "--triangles", "200"});
    const json manifest = parsed("out/manifest.json");
    EXPECT_THAT(manifest["items"], SizeIs(1));
    ASSERT_THAT(manifest["left_out"], SizeIs(1));
    EXPECT_EQ(manifest["left_out"][0]["name"], "glyph 'nonbreakingspace'");
    EXPECT_EQ(manifest["left_out"][0]["reason"], "no ink");
}

TEST_F(Glyphs, SkipsGlyphsThatAreUpToDate)
{
    const std::vector<std::string> job{"--charset", "ab", "-o", "{name}.stl", "--triangles", "200"};
    const auto with = [&](std::vector<std::string> more) {
        more.insert(more.begin(), job.begin(), job.end());
        return glyphs(more).error;
    };
    EXPECT_THAT(with({}), HasSubstr("made       2 of 2"));
    EXPECT_THAT(with({}), HasSubstr("made       0 of 2, 2 skipped"));
    EXPECT_THAT(with({"--em", "30mm"}), HasSubstr("made       2 of 2"));
    // With another glyph, the existing ones are skipped.
    EXPECT_THAT(glyphs({"--charset", "abc", "-o", "{name}.stl", "--triangles", "200", "--em", "30mm"}).error,
                HasSubstr("made       1 of 3, 2 skipped"));
}

TEST_F(Glyphs, WarnsAboutATowerEvenIfQuiet)
{
    const CommandResult result = glyphs(
        {"--charset", "o", "-o", "{name}.glb", "--height", "40mm", "--model", "linear", "--triangles", "500", "-q"});
    ASSERT_EQ(result.exit_code, 0) << result.error;
    EXPECT_THAT(result.error, AllOf(HasSubstr("warning: glyph 'o'"), HasSubstr("40 mm high, but a puddle")));
}

TEST_F(Glyphs, SharesMakeEveryGlyphOnce)
{
    for (const char* share : {"1/3", "2/3", "3/3"}) {
        succeeds({"--charset", "a-g", "-o", "out/{name}.stl", "--triangles", "200", "--shard", share});
    }
    EXPECT_THAT(filesIn("out"), SizeIs(7 + 3));
}

TEST_F(Glyphs, AllGlyphsHaveSafeFileNames)
{
    const CommandResult listed = glyphs({"--list"});
    EXPECT_EQ(listed.exit_code, 0);
    std::set<std::string> names;
    std::size_t count = 0;
    std::istringstream lines(listed.output);
    for (std::string line; std::getline(lines, line); ++count) {
        std::istringstream columns(line);
        std::vector<std::string> cells;
        for (std::string cell; std::getline(columns, cell, '\t');) {
            cells.push_back(cell);
        }
        ASSERT_THAT(cells, SizeIs(6)) << line;
        std::string name = cells[3];
        EXPECT_EQ(name.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._-"),
                  std::string::npos);
        std::transform(name.begin(), name.end(), name.begin(),
                       [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
        EXPECT_TRUE(names.insert(name).second) << name;
    }
    EXPECT_EQ(count, 6253U);
    EXPECT_THAT(listed.output, HasSubstr("\nglyph\t36\tA\tA_\tU+0041\tink\n"));
    EXPECT_THAT(listed.output, HasSubstr("\nglyph\t3\tspace\tspace\tU+0020\tno ink\n"));
    EXPECT_THAT(listed.output, StartsWith("glyph\t0\t.notdef\t_notdef\t-\tink\n"));
    EXPECT_THAT(glyphs({"--list"}, kVariable).output, StartsWith("axis\twght\t100..900\t400\tWeight\n"));
}

TEST_F(Glyphs, EqualHeightIsThatOfTheLetterO)
{
    const auto height = [&](const std::string& name) { return parsed(name)["shape"]["height_max_m"].get<double>(); };
    // The reference is solved with the default number of triangles.
    succeeds({"--text", "o", "-o", "o.stl", "--json", "o.json", "--contact-angle", "30deg"});
    succeeds({"--charset", "oiWm", "-o", "out/{name}.stl", "--json", "out/{name}.json", "--contact-angle", "30deg",
              "--equal-height", "--triangles", "600"});
    for (const char* name : {"o", "i", "W_", "m"}) {
        EXPECT_NEAR(height("out/" + std::string(name) + ".json"), height("o.json"), 1e-9 * height("o.json")) << name;
    }
    succeeds({"--text", "iW", "-o", "t.stl", "--json", "t.json", "--contact-angle", "30deg", "--equal-height",
              "--triangles", "900"});
    const json equal = parsed("t.json");
    for (const json& letter : equal["droplets"]) {
        EXPECT_NEAR(letter["height_max_m"].get<double>(), height("o.json"), 1e-9 * height("o.json"));
    }
    succeeds({"--text", "iW", "-o", "t.stl", "--json", "t.json", "--height", "0.3mm", "--equal-height", "--triangles",
              "900"});
    const json given = parsed("t.json");
    for (const json& letter : given["droplets"]) {
        EXPECT_NEAR(letter["height_max_m"].get<double>(), 0.3e-3, 1e-12);
    }
    refuses({"--text", "a", "-o", "x.glb", "--equal-height", "--volume", "1uL"}, 2, {"--equal-height and --volume"});
    refuses({"--text", "a", "-o", "x.glb", "--equal-height", "--fill", "total"}, 2,
            {"--equal-height and --fill total"});
}

TEST_F(Glyphs, AxesAndEmChangeTheFootprint)
{
    const auto area = [&](const std::vector<std::string>& more) {
        std::vector<std::string> job{"--text", "H", "-o", "h.stl", "--json", "h.json", "--triangles", "300"};
        job.insert(job.end(), more.begin(), more.end());
        succeeds(job, kVariable);
        return parsed("h.json")["mesh"]["footprint_area_m2"].get<double>();
    };
    const double regular = area({});
    EXPECT_GT(area({"--axis", "wght=900", "--axis", "slnt=-5"}), 1.3 * regular);
    EXPECT_EQ(parsed("h.json")["input"]["type"]["axes"]["wght"], 900);
    EXPECT_NEAR(area({"--em", "40mm"}), 4 * regular, 1e-2 * regular);
}

TEST_F(Glyphs, TextsMayHaveLinesAndBackslashes)
{
    const auto droplets = [&](const char* text) {
        succeeds({"--text", text, "-o", "t.stl", "--json", "t.json", "--triangles", "400", "--align", "centre",
                  "--line-spacing", "1.2"});
        return parsed("t.json")["mesh"]["droplets"].get<int>();
    };
    EXPECT_EQ(droplets("A\\nB"), 2);
    EXPECT_EQ(parsed("t.json")["input"]["type"]["text"], "A\nB");
    EXPECT_EQ(droplets("A\\\\B"), 3);
    EXPECT_EQ(droplets("A\nB"), 2);
}

TEST_F(Glyphs, TextFollowsThePathOfADrawing)
{
    const auto drawing = [&](const std::string& name, const std::string& content) {
        writeFile(directory() / name,
                  "<svg xmlns='http://www.w3.org/2000/svg' width='200mm' height='100mm' "
                  "viewBox='0 0 200 100'>" +
                      content + "</svg>");
    };
    const auto made = [&](const std::vector<std::string>& more, const std::string& name = "t.stl") {
        std::vector<std::string> job{"--text", "lll lll", "-o", name, "--json", "t.json", "--triangles", "400"};
        job.insert(job.end(), more.begin(), more.end());
        const CommandResult result = glyphs(job);
        EXPECT_EQ(result.exit_code, 0) << result.error;
        return result.error;
    };
    drawing("line.svg", "<path d='M10,50H190'/>");
    drawing("up.svg", "<path d='M50,90V10'/>");
    drawing("arc.svg", "<path d='M100,90A40,40 0 0 1 100,10A40,40 0 0 1 100,90'/>");
    drawing("two.svg", "<path d='M10,50H40'/><path d='M10,60H190'/>");
    drawing("short.svg", "<path d='M10,50h20'/>");
    drawing("dot.svg", "<path d='M10,50h0'/>");
    made({}, "none.stl");
    made({"--path", "line.svg"}, "line.stl");
    EXPECT_TRUE(readFile(directory() / "line.stl") == readFile(directory() / "none.stl")) << "a straight path";
    EXPECT_THAT(made({"--path", "two.svg"}), HasSubstr("two.svg has 2 paths, and the text follows the longest"));
    EXPECT_THAT(made({"--path", "short.svg"}), HasSubstr("longer than its path, and 3 letters are left out"));
    EXPECT_EQ(parsed("t.json")["mesh"]["droplets"], 3);
    EXPECT_THAT(made({"--path", "short.svg", "--path-width", "400mm"}), ::testing::Not(HasSubstr("warning")));
    EXPECT_EQ(parsed("t.json")["mesh"]["droplets"], 6);
    made({"--arc", "40mm"});
    const double arc = parsed("t.json")["mesh"]["footprint_area_m2"];
    made({"--path", "arc.svg", "--align", "centre"});
    EXPECT_NEAR(parsed("t.json")["mesh"]["footprint_area_m2"].get<double>(), arc, 1e-6 * arc);
    made({"--path", "up.svg", "--line-sizes", "1.5,1"});
    EXPECT_THAT(made({"--path", "line.svg", "--shift", "0.9"}), HasSubstr("letters are left out"));
    EXPECT_THAT(made({"--arc", "40mm", "--shift", "0.9"}), ::testing::Not(HasSubstr("left out")));
    refuses({"--text", "a", "-o", "x.glb", "--shift", "0.5"}, 2, {"--shift goes with --path or --arc"});
    refuses({"--text", "a", "-o", "x.glb", "--arc", "1m", "--shift", "2"}, 2, {"--shift", "from -1 to 1"});
    refuses({"--text", "a", "-o", "x.glb", "--path", "missing.svg"}, 3, {"--path: cannot read missing.svg"});
    refuses({"--text", "a", "-o", "x.glb", "--path", "disc.pgm"}, 3, {"--path: disc.pgm: is not an SVG drawing"});
    refuses({"--text", "a", "-o", "x.glb", "--path", "dot.svg"}, 3, {"--path: dot.svg: the drawing has no path"});
    refuses({"--text", "a\\nא", "-o", "x.glb", "--path", "line.svg", "--em", "1nm"}, 2,
            {"the text's path (--path) is too long", "less than 1048576 em"});
    refuses({"--text", "a", "-o", "x.glb", "--path", "short.svg", "--em", "1m"}, 3, {"--path: it is too short"});
    refuses({"--text", "a", "-o", "x.glb", "--path", "line.svg", "--arc", "1m"}, 2, {"--arc and --path exclude"});
    refuses({"--text", "a", "-o", "x.glb", "--path-width", "1m"}, 2, {"--path-width goes with --path"});
    refuses({"--text", "a", "-o", "x.glb", "--path", "line.svg", "--path-width", "0mm"}, 2, {"--path-width"});
    refuses({"--text", "a", "-o", "x.glb", "--path", "-"}, 2, {"--path must name a file"});
    refuses({"--charset", "a", "-o", "{name}.glb", "--path", "line.svg"}, 2, {"--path", "--text"});
    refuses({"--text", "a", "-o", "line.svg", "--path", "line.svg", "--format", "glb"}, 2, {"line.svg"});
}

TEST_F(Glyphs, LinesHaveTheirSizes)
{
    const auto area = [&](const std::string& text, const std::vector<std::string>& more) {
        std::vector<std::string> job{"--text", text, "-o", "t.stl", "--json", "t.json", "--triangles", "600"};
        job.insert(job.end(), more.begin(), more.end());
        succeeds(job);
        return parsed("t.json")["mesh"]["footprint_area_m2"].get<double>();
    };
    const double one = area("l", {});
    EXPECT_NEAR(area("l\\nl\\nl", {"--line-sizes", "3,2"}), 17.0 * one, 1e-9 * one) << "9 + 4 + 4";
    EXPECT_NEAR(area("l", {"--line-sizes", "0.5"}), 0.25 * one, 1e-9 * one);
    refuses({"--text", "a", "-o", "x.glb", "--line-sizes", "0"}, 2, {"--line-sizes", "from 0.05 to 20"});
    refuses({"--text", "a", "-o", "x.glb", "--line-sizes", "big"}, 2, {"--line-sizes"});
    refuses({"--charset", "a", "-o", "{name}.glb", "--line-sizes", "2"}, 2, {"--line-sizes", "--text"});
}

TEST_F(Glyphs, CharsetsMayComeFromAFile)
{
    writeFile(directory() / "words.txt", "ba-ba\n");
    succeeds({"--charset", "@words.txt", "-o", "out/{name}.stl", "--triangles", "200"});
    EXPECT_THAT(filesIn("out"), UnorderedElementsAre("a.stl", "b.stl", "hyphen.stl", "manifest.json"));
    writeFile(directory() / "blank.txt", " \n");
    refuses({"--charset", "@blank.txt", "-o", "{name}.glb"}, 3, {"--charset", "blank.txt holds no characters"});
    refuses({"--charset", "@none.txt", "-o", "{name}.glb"}, 3, {"--charset", "none.txt cannot be read"});
}

TEST_F(Glyphs, FailedGlyphsGiveExitCode6)
{
    // Under a ceiling, with so much weight, all dots fall off.
    const CommandResult result = glyphs({"--charset", ".:", "-o", "out/{name}.stl", "--triangles", "300", "--gravity",
                                         "-5000m/s2", "--volume", "20uL", "--keep-going"});
    EXPECT_EQ(result.exit_code, 6);
    const json manifest = parsed("out/manifest.json");
    EXPECT_EQ(manifest["totals"]["failed"], 2);
    EXPECT_EQ(manifest["items"][0]["exit_code"], 5);
}

TEST_F(Glyphs, RefusesWrongOptions)
{
    refuses({"--text", "a"}, 2, {"--output is missing"});
    refuses({"--text", "a", "-o", "{name}.glb"}, 2, {"--output", "{name}.glb", "--charset or --all"});
    refuses({"-o", "x.glb"}, 2, {"--text, --charset, --all or --list is missing"});
    refuses({"--text", "a", "--all", "-o", "x.glb"}, 2, {"--text and --all exclude each other"});
    refuses({"--text", "a", "-o", "x.png"}, 2, {"--output 'x.png'", "glb"});
    refuses({"--text", "a\\t", "-o", "x.glb"}, 2, {"--text", "\\n is a new line"});
    refuses({"--text", "a\xff", "-o", "x.glb"}, 2, {"UTF-8"});
    refuses({"--text", "a", "-o", "x.glb", "--arc", "0mm"}, 2, {"--arc", "not 0"});
    refuses({"--text", "aaaa", "-o", "x.glb", "--arc", "1mm"}, 2, {"--arc", "too small"});
    refuses({"--charset", "a", "-o", "{name}.glb", "--tracking", "0.1"}, 2, {"--tracking", "--text"});
    refuses({"--text", " ", "-o", "x.glb"}, 3, {"the text has no ink"});
    refuses({"--text", "水", "-o", "x.glb"}, 3, {"no glyph for U+6C34 '水'", "nothing is left"});
    refuses({"--charset", "水", "-o", "{name}.glb"}, 3, {"no glyph for U+6C34 '水'", "nothing is left"});
    refuses({"--charset", "U+00A0", "-o", "{name}.glb"}, 3, {"none of the chosen glyphs has ink"});
    refuses({"--charset", "b-a", "-o", "{name}.glb"}, 2, {"--charset", "runs backward"});
    refuses({"--charset", "ab", "-o", "x.glb"}, 2, {"are the same, 'x.glb'"});
    refuses({"--charset", "ab", "-o", "{nom}.glb"}, 2, {"--output", "{name}, {gid} or {codepoint}"});
    refuses({"--charset", "ab", "-o", "-"}, 2, {"--output"});
    refuses({"--text", "a", "-o", "x.glb", "--face-index", "1"}, 2, {"face index (--face-index) 1 is too large"});
    refuses({"--text", "a", "-o", "x.glb", "--face-index", "0.5"}, 2, {"--face-index", "whole number"});
    refuses({"--text", "a", "-o", "x.glb", "--axis", "wght=1"}, 2, {"axis 'wght': the font has no axes"});
    refuses({"--text", "a", "-o", "x.glb", "--axis", "wght=1"}, 2, {"wght from 100 to 900"}, kVariable);
    refuses({"--text", "a", "-o", "x.glb", "--axis", "weight"}, 2, {"--axis", "wght=700"}, kVariable);
    refuses({"--text", "a", "-o", "x.glb", "--em", "20"}, 2, {"--em", "mm"});
    refuses({"--text", "a", "-o", "x.glb", "--align", "left"}, 2, {"--align", "start, centre, end"});
    refuses({"--text", "a", "-o", "x.glb", "--line-spacing", "0"}, 2, {"--line-spacing", "from 0.01"});
    refuses({"--text", "a", "-o", "x.glb", "--shard", "1/2"}, 2, {"--shard goes with --charset or --all"});
    refuses({"--text", "a", "-o", "x.glb", "--keep-going"}, 2, {"--keep-going goes with --charset or --all"});
    refuses({"--all", "-o", "{name}.glb", "--onto", "can.glb"}, 2, {"--onto goes with --text alone"});
    refuses({"--all", "-o", "{name}.glb", "--align", "end"}, 2, {"--align goes with --text alone"});
    refuses({"--text", "a", "-o", "x.glb"}, 3, {"disc.pgm: is not a font"}, "disc.pgm");
    refuses({"--text", "a", "-o", "x.glb"}, 3, {"cannot read none.ttf"}, "none.ttf");
    refuses({"--text", "a", "-o", "x.glb"}, 2, {"--font must name a file"}, "-");
    refuses({"--text", "a", "-o", "x.glb", "--edge", "1nm"}, 2, {"--edge", "would take"});
    expectRefusal({"glyphs", "--text", "a", "-o", "x.glb"}, 2, {"--font must name a file"});
}

TEST_F(Glyphs, DoesNotReplaceTheFont)
{
    std::filesystem::copy_file(kSans, directory() / "font.glb");
    refuses({"--text", "a", "-o", "font.glb"}, 2, {"and --font are the same", "font.glb"}, "font.glb");
    refuses({"--charset", "a", "-o", "font.glb"}, 2, {"and --font are the same", "font.glb"}, "font.glb");
}

}  // namespace
}  // namespace droplet
