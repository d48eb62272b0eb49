// SPDX-License-Identifier: GPL-3.0-or-later
// The library names no options of the command; the command adds them.
#include "cli/library_message.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "support/command.h"
#include "support/paths.h"

namespace droplet {
namespace {

using ::testing::HasSubstr;

/// Lines of code of the library, without comments.
std::vector<std::string> linesOfLibrary()
{
    std::vector<std::string> found;
    for (const char* folder : {"src", "include"}) {
        for (const auto& entry : std::filesystem::recursive_directory_iterator(testing::inSource(folder))) {
            if (entry.path().extension() != ".cpp" && entry.path().extension() != ".h") {
                continue;
            }
            std::istringstream lines(testing::readFile(entry.path()));
            for (std::string line; std::getline(lines, line);) {
                if (line.find_first_not_of(' ') != line.find("//")) {
                    found.push_back(line);
                }
            }
        }
    }
    return found;
}

TEST(LibraryMessages, NameNoOptions)
{
    const std::regex option(R"re("[^"]*--[a-z]{2})re");
    for (const std::string& line : linesOfLibrary()) {
        EXPECT_FALSE(std::regex_search(line, option)) << line;
    }
}

// A phrase that the library no longer says would be of no use.
TEST(LibraryMessages, HaveEveryPhraseOfTheTable)
{
    std::string code;
    for (const std::string& line : linesOfLibrary()) {
        code += line + "\n";
    }
    for (const cli::NamedOption& named : cli::namedOptions()) {
        EXPECT_THAT(code, HasSubstr(std::string(named.words)));
    }
    for (const cli::NamedOption& named : cli::namedFields()) {
        EXPECT_THAT(code, HasSubstr(std::string(named.words)));
    }
}

// The main command's, as far as they matter here.
const cli::CommandTerms kTerms{{"--triangles", "--threshold", "--colour", "--segment", "--volume", "--contact-angle",
                                "--height", "--eye-distance", "--emitter"},
                               {}};

TEST(LibraryMessages, GetTheCommandsOptions)
{
    const auto with = [](const char* message) { return cli::withOptions(message, kTerms); };
    EXPECT_EQ(with("heights may be off; raise the number of triangles to 90k"),
              "heights may be off; raise the number of triangles (--triangles) to 90k");
    EXPECT_EQ(with("no pixel reaches the threshold 0.5"), "no pixel reaches the threshold (--threshold) 0.5");
    EXPECT_EQ(with("--threshold: no pixel reaches the threshold 0.5"),
              "--threshold: no pixel reaches the threshold 0.5");
    EXPECT_EQ(
        with("no pixel reaches the threshold 0.5; choose a threshold, 0.1 for one, or a colour"),
        "no pixel reaches the threshold (--threshold) 0.5; choose a threshold, 0.1 for one, or a colour (--colour)");
    EXPECT_EQ(with("no such droplet"), "no such droplet");
}

TEST(LibraryMessages, GetNoOptionsThatTheCommandLacks)
{
    const cli::CommandTerms dew{{"--mask", "--coverage"}, {}};
    EXPECT_EQ(cli::withOptions("raise the number of triangles", dew), "raise the number of triangles");
    EXPECT_EQ(cli::withOptions("give a segmentation method or a threshold", dew),
              "give a segmentation method or a threshold");
    EXPECT_EQ(cli::withOptions("give a segmentation method or a threshold", {{"--threshold"}, {}}),
              "give a segmentation method or a threshold (--threshold)");
}

TEST(LibraryMessages, NameTheOptionThatIsGiven)
{
    cli::CommandTerms terms = kTerms;
    EXPECT_EQ(cli::withOptions("none was found; ask for less", terms),
              "none was found; ask for less (--contact-angle, --volume, --height)");
    EXPECT_EQ(cli::withOptions("ask for less liquid, or look away", terms),
              "ask for less liquid (--contact-angle, --volume, --height), or look away");
    terms.given = {"--triangles", "--volume"};
    EXPECT_EQ(cli::withOptions("none was found; ask for less", terms), "none was found; ask for less (--volume)");
}

TEST(LibraryMessages, HaveOptionsInPlaceOfFields)
{
    const auto with = [](const char* message) { return cli::withOptions(message, kTerms); };
    EXPECT_EQ(with("eye_distance 0.5 m: the eye sees nothing"), "--eye-distance 0.5 m: the eye sees nothing");
    EXPECT_EQ(with("pane.glb: cannot be used: eye_distance 0.5 m: too far"),
              "pane.glb: cannot be used: --eye-distance 0.5 m: too far");
    EXPECT_EQ(with("emitter.place is inside the object"), "--emitter is inside the object");
    EXPECT_EQ(cli::withOptions("logo.png, frame 2: inflow of 20000 uL/s is too much: let less flow in, 1400 uL/s at "
                               "most, or take shorter steps",
                               {{"--feed", "--slow", "--fps"}, {"--feed"}}),
              "logo.png, frame 2: --feed of 20000 uL/s is too much: let less flow in, 1400 uL/s at most, or take "
              "shorter steps (--slow, --fps)");
    EXPECT_EQ(with("the file eye_distance is 3"), "the file eye_distance is 3") << "no field";
    EXPECT_EQ(cli::withOptions("emitter.place is inside the object", {}), "emitter.place is inside the object");
}

TEST(LibraryMessages, HaveTheOptionOfTheirFile)
{
    cli::RunFiles files;
    files.reads("INPUT", "in.png");
    files.reads("--mask", "spots.png");
    files.reads("--start", "a");
    files.writes("--json", "out/report.json");
    files.writesFrames("--maps", *cli::NumberedPath::of("maps/%03d.png", "--maps"), {1, 3});
    const auto with = [&](const char* message) { return cli::withOptionOfFile(message, files); };
    EXPECT_EQ(with("spots.png: empty, not an image"), "--mask: spots.png: empty, not an image");
    EXPECT_EQ(with("cannot read spots.png: Is a directory"), "--mask: cannot read spots.png: Is a directory");
    EXPECT_EQ(with("spots.png has no rows"), "--mask: spots.png has no rows");
    EXPECT_EQ(with("output \"out/report.json\": disk full"), "--json: output \"out/report.json\": disk full");
    EXPECT_EQ(with("output \"maps/002.png\": disk full"), "--maps: output \"maps/002.png\": disk full");
    EXPECT_EQ(with("in.png: empty, not an image"), "in.png: empty, not an image") << "arguments speak for themselves";
    EXPECT_EQ(with("--mask: spots.png: empty"), "--mask: spots.png: empty");
    EXPECT_EQ(with("more spots.png: empty"), "--mask: more spots.png: empty");
    EXPECT_EQ(with("my-spots.png: empty"), "my-spots.png: empty") << "another file";
    EXPECT_EQ(with("there is a droplet too many"), "there is a droplet too many");
}

}  // namespace
}  // namespace droplet
