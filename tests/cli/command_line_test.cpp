// SPDX-License-Identifier: GPL-3.0-or-later
// Which of several values counts: of the command line and a configuration file, of options that exclude each other, of
// an option's two names.
#include "cli/command_line.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "droplet/error.h"
#include "support/command.h"

namespace droplet {
namespace {

using testing::ScratchDirectory;
using testing::writeFile;
using Given = std::vector<std::pair<std::string, std::string>>;

/// What a command line and a configuration file give, or the refusal.
struct Outcome {
    Given given;
    std::string refusal;
};

Outcome outcomeOf(std::vector<std::string> arguments, const std::string& file = "")
{
    const ScratchDirectory scratch;
    writeFile(scratch.path() / "options.toml", file);
    cli::CommandLine line({"program", "", "[OPTIONS]", ""});
    line.add("Group", "--gap", "LENGTH", "Gap [none]");
    line.add("Group", "--mark", "TEXT", "Mark [none]");
    line.add("Group", "--colour", "COLOUR", "Colour of the liquid");
    line.add("Group", "--paint", "plain|contours", "Colours of the picture [plain]");
    line.add("Group", "--width,--size", "LENGTH", "Width");
    line.add("Group", "--pixel-size", "LENGTH", "Size of a pixel");
    line.add("Group", "--scale", "NUMBER", "Scale");
    line.add("Group", "--config", "FILE", "Options");
    line.exclude({"--width", "--pixel-size"});
    line.exclude({"--width", "--scale"});
    line.moveWords("--colour", {"plain", "contours"}, "--paint");
    arguments.insert(arguments.begin(), {"program", "--config", (scratch.path() / "options.toml").string()});
    std::vector<const char*> argv;
    for (const std::string& argument : arguments) {
        argv.push_back(argument.c_str());
    }
    try {
        line.parse(static_cast<int>(argv.size()), argv.data());
    } catch (const Error& error) {
        return {{}, error.what()};
    }
    Outcome outcome;
    for (const auto& [name, value] : line.given()) {
        if (name != "--config") {
            outcome.given.emplace_back(name, value);
        }
    }
    return outcome;
}

TEST(CommandLine, AWordThatStatesADefaultMeansIt)
{
    EXPECT_EQ(outcomeOf({"--gap", "none"}).given, Given{});
    EXPECT_EQ(outcomeOf({"--gap", "none"}, "gap = \"3mm\"").given, Given{});
    EXPECT_EQ(outcomeOf({}, "gap = \"none\"").given, Given{});
    EXPECT_EQ(outcomeOf({"--gap", "3mm"}, "gap = \"none\"").given, (Given{{"--gap", "3mm"}}));
    EXPECT_EQ(outcomeOf({"--mark", "none"}).given, (Given{{"--mark", "none"}})) << "a text may be any word";
}

TEST(CommandLine, WordsOfAnotherOptionCountThere)
{
    EXPECT_EQ(outcomeOf({"--colour", "contours"}).given, (Given{{"--paint", "contours"}}));
    EXPECT_EQ(outcomeOf({"--colour", "red"}).given, (Given{{"--colour", "red"}}));
    EXPECT_EQ(outcomeOf({"--colour", "red", "--colour", "contours"}).given,
              (Given{{"--colour", "red"}, {"--paint", "contours"}}));
    EXPECT_EQ(outcomeOf({"--colour", "contours", "--paint", "plain"}).refusal,
              "--paint: given 2 times, must be given once");
    EXPECT_EQ(outcomeOf({"--colour", "contours"}, "paint = \"plain\"").given, (Given{{"--paint", "contours"}}));
    EXPECT_EQ(outcomeOf({"--paint", "plain"}, "colour = \"contours\"").given, (Given{{"--paint", "plain"}}));
    EXPECT_EQ(outcomeOf({"--colour", "red"}, "colour = \"contours\"").given,
              (Given{{"--colour", "red"}, {"--paint", "contours"}}));
}

TEST(CommandLine, TheCommandLineReplacesWhatExcludesIt)
{
    EXPECT_EQ(outcomeOf({"--size", "2cm"}, "pixel-size = \"1um\"").given, (Given{{"--width", "2cm"}}));
    EXPECT_EQ(outcomeOf({"--pixel-size", "1um"}, "width = \"2cm\"").given, (Given{{"--pixel-size", "1um"}}));
    EXPECT_EQ(outcomeOf({"--scale", "2"}, "width = \"2cm\"").given, (Given{{"--scale", "2"}})) << "every group counts";
    EXPECT_NE(outcomeOf({}, "width = \"2cm\"\nscale = 2").refusal, "");
}

TEST(CommandLine, TwoNamesOfOneOptionInAFileAreRefused)
{
    const std::string refusal = outcomeOf({}, "size = \"1cm\"\nwidth = \"2cm\"").refusal;
    EXPECT_NE(refusal.find("options.toml:2: 'width' gives --width a second time"), std::string::npos) << refusal;
    EXPECT_NE(outcomeOf({}, "paint = \"plain\"\ncolour = \"contours\"").refusal, "");
    EXPECT_EQ(outcomeOf({"--width", "3cm"}, "size = \"1cm\"\nwidth = \"2cm\"").given, (Given{{"--width", "3cm"}}));
}

}  // namespace
}  // namespace droplet
