// SPDX-License-Identifier: GPL-3.0-or-later
// --help, manual page and completions agree with each other and with the program.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "droplet/droplet.h"
#include "droplet/units.h"
#include "support/command.h"
#include "support/paths.h"

namespace droplet {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using testing::readFile;
using testing::runDroplet;
using testing::runProgram;

std::string sourceFile(const std::string& name)
{
    return readFile(testing::inSource("cli/") + name);
}

std::string help(const std::string& command = "")
{
    return command.empty() ? runDroplet({"--help"}).output : runDroplet({command, "--help"}).output;
}

/// Commands that --help lists.
std::vector<std::string> commands()
{
    std::istringstream lines(help());
    std::vector<std::string> names;
    bool listed = false;
    for (std::string line; std::getline(lines, line);) {
        if (listed && line.rfind("  ", 0) == 0) {
            names.push_back(line.substr(2, line.find(' ', 2) - 2));
        }
        listed = line.starts_with("Commands") || (listed && !line.empty());
    }
    return names;
}

std::set<std::string> longOptions(const std::string& text)
{
    std::set<std::string> options;
    for (auto at = text.find("--"); at != std::string::npos; at = text.find("--", at + 2)) {
        const auto end = text.find_first_not_of("abcdefghijklmnopqrstuvwxyz-", at + 2);
        if (end != at + 2) {
            options.insert(text.substr(at, end - at));
        }
    }
    return options;
}

std::string replaced(std::string text, const std::string& from, const std::string& to)
{
    for (auto at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
        text.replace(at, from.size(), to);
    }
    return text;
}

/// Manual page without the escapes of dashes.
std::string manual()
{
    return replaced(sourceFile("droplet-shape.1"), "\\-", "-");
}

/// Completions that bash offers after these words.
std::vector<std::string> completions(const std::vector<std::string>& words)
{
    std::string script = "source \"$1\"; COMP_WORDS=(droplet-shape";
    for (const std::string& word : words) {
        script += " '" + word + "'";
    }
    script += "); COMP_CWORD=" + std::to_string(words.size()) + R"(; _droplet_shape; printf '%s\n' "${COMPREPLY[@]}")";
    const std::string file = testing::inSource("cli/completion/droplet-shape.bash");
    const auto result = runProgram({"bash", "-c", script, "bash", file});
    EXPECT_EQ(result.error, "");
    std::istringstream lines(result.output);
    std::vector<std::string> offered;
    for (std::string line; std::getline(lines, line);) {
        if (!line.empty()) {
            offered.push_back(line);
        }
    }
    return offered;
}

TEST(Documentation, TablesManualAndCompletionsAreMadeFromTheHelp)
{
    const auto made = runProgram({testing::inSource("scripts/make-docs"), "--check", testing::kCommand});
    EXPECT_EQ(made.exit_code, 0) << "run scripts/make-docs\n" << made.output << made.error;
    EXPECT_EQ(made.output, "");
}

TEST(Documentation, CompletionOffersTheOptionsOfTheCommand)
{
    const auto expect_options = [](const std::vector<std::string>& words, const std::string& text) {
        const auto offered = completions(words);
        EXPECT_EQ(std::set<std::string>(offered.begin(), offered.end()), longOptions(text)) << words.front();
    };
    expect_options({"--"}, help());
    expect_options({"in.png", "--"}, help());
    for (const std::string& command : commands()) {
        expect_options({command, "--"}, help(command));
        EXPECT_THAT(completions({command.substr(0, 2)}), ::testing::Contains(command));
    }
}

TEST(Documentation, EveryOptionInTheHelpIsAccepted)
{
    for (const std::string& option : longOptions(help())) {
        EXPECT_THAT(runDroplet({option}).error, Not(HasSubstr("unknown option"))) << option;
    }
    for (const std::string& command : commands()) {
        for (const std::string& option : longOptions(help(command))) {
            EXPECT_THAT(runDroplet({command, option}).error, Not(HasSubstr("unknown option")))
                << command << " " << option;
        }
    }
}

TEST(Documentation, DefaultsInTheHelpAreThoseOfTheLibrary)
{
    const std::string text = help();
    const auto default_of = [&](const std::string& option) {
        const auto begin = text.find('[', text.find("\n  " + option + " ")) + 1;
        return text.substr(begin, text.find(']', begin) - begin);
    };
    const DropletOptions options;
    EXPECT_DOUBLE_EQ(parseQuantity(default_of("--width"), Dimension::Length), options.trace.width);
    EXPECT_DOUBLE_EQ(std::stod(default_of("--threshold")), options.trace.threshold);
    EXPECT_DOUBLE_EQ(std::stod(default_of("--speck-size")), options.trace.speck_size);
    EXPECT_EQ(options.solve.fill.by, FillBy::ContactAngle);
    EXPECT_DOUBLE_EQ(parseQuantity(default_of("--contact-angle"), Dimension::Angle), options.solve.fill.amount);
    EXPECT_EQ(default_of("--fill"), options.solve.fill.sharing == FillSharing::Each ? "each" : "total");
    EXPECT_EQ(default_of("--liquid"), options.solve.liquid.name);
    EXPECT_DOUBLE_EQ(parseQuantity(default_of("--gravity"), Dimension::Acceleration), options.solve.gravity);
    EXPECT_EQ(default_of("--model"), options.solve.model == Model::Auto ? "auto" : "another");
    EXPECT_DOUBLE_EQ(parseQuantity(default_of("--tilt"), Dimension::Angle), options.solve.tilt);
    EXPECT_DOUBLE_EQ(parseQuantity(default_of("--tilt-direction"), Dimension::Angle), options.solve.tilt_direction);
    EXPECT_EQ(default_of("--surface"), options.solve.ground.flat() ? "flat" : "curved");
    EXPECT_FALSE(options.solve.no_penetration);
    EXPECT_EQ(default_of("--triangles"), std::to_string(options.mesh.triangles / 1000) + "k");
    EXPECT_EQ(default_of("--channel"), "auto");
    EXPECT_EQ(default_of("--grading"), options.mesh.grading ? std::to_string(*options.mesh.grading) : "auto");
    EXPECT_EQ(default_of("--solver"), "auto");
    EXPECT_EQ(options.solve.solver, Solver::Auto);
}

TEST(Documentation, HelpAndManualNameEveryLiquidAndUnit)
{
    for (const std::string& text : {help(), manual()}) {
        for (const Liquid& liquid : liquids()) {
            EXPECT_THAT(text, HasSubstr(liquid.name));
        }
        for (const Dimension dimension : {Dimension::Length, Dimension::Volume, Dimension::Angle,
                                          Dimension::SurfaceTension, Dimension::Density, Dimension::Acceleration}) {
            std::istringstream words(replaced(replaced(unitsOf(dimension), ",", ""), " or ", " "));
            for (std::string unit; words >> unit;) {
                EXPECT_THAT(text, HasSubstr(" " + unit)) << unit;
            }
        }
    }
}

TEST(Documentation, CompletionOffersNamesThatAreAccepted)
{
    EXPECT_THAT(completions({"in.png", "out.glb", "--channel", ""}), ElementsAre("auto", "alpha", "luma"));
    EXPECT_THAT(completions({"--fill", "t"}), ElementsAre("total"));
    EXPECT_THAT(completions({"--format", "=", "g"}), ElementsAre("glb", "gltf"));
    EXPECT_THAT(completions({"--width", ""}), IsEmpty());
    std::vector<std::string> names;
    for (const Liquid& liquid : liquids()) {
        names.push_back(liquid.name);
    }
    EXPECT_EQ(completions({"--liquid", ""}), names);
    for (const char* option : {"--channel", "--fill", "--liquid", "--model", "--material", "--format", "--progress",
                               "--grading", "--solver", "--view", "--segment", "--preview-colour"}) {
        const auto offered = completions({option, ""});
        EXPECT_THAT(offered, Not(IsEmpty())) << option;
        for (const std::string& name : offered) {
            // A run without INPUT ends with this message after all options are accepted.
            EXPECT_THAT(runDroplet({option, name}).error, HasSubstr("INPUT is missing")) << option << " " << name;
        }
    }
}

TEST(Documentation, CompletionOffersFiles)
{
    testing::ScratchDirectory scratch;
    const std::string beginning = (scratch.path() / "my").string();
    testing::writeFile(beginning + " logo.png", "");
    EXPECT_THAT(completions({beginning}), ElementsAre(beginning + " logo.png"));
    for (const char* option :
         {"--json", "--preview", "--ground", "--surface", "--onto", "--export-evolver", "--config"}) {
        EXPECT_THAT(completions({option, beginning}), ElementsAre(beginning + " logo.png")) << option;
    }
}

/// Completions that fish offers after a line.
std::string offeredByFish(const std::string& line)
{
    const std::string file = testing::inSource("cli/completion/droplet-shape.fish");
    const auto result = runProgram({"fish", "--no-config", "-c", "source '" + file + "'; complete -C '" + line + "'"});
    EXPECT_EQ(result.exit_code, 0) << "fish must be installed (Debian: fish)";
    EXPECT_EQ(result.error, "");
    return result.output;
}

TEST(Documentation, FishCompletesOptionsAndTheirValues)
{
    EXPECT_THAT(offeredByFish("droplet-shape --volume"),
                AllOf(HasSubstr("--volume\t"), Not(HasSubstr("--volume-mode"))));
    EXPECT_THAT(offeredByFish("droplet-shape animate --volume"), HasSubstr("--volume-mode\t"));
    EXPECT_THAT(offeredByFish("droplet-shape anim"), HasSubstr("animate\t"));
    EXPECT_THAT(offeredByFish("droplet-shape --model "), AllOf(HasSubstr("linear"), HasSubstr("exact")));
}

/// Completions for zsh after these words: the specifications that are passed to zsh's functions.
std::string offeredByZsh(const std::string& words)
{
    const std::string file = testing::inSource("cli/completion/_droplet-shape");
    const auto result = runProgram({"zsh", "-f", "-c",
                                    "_arguments() { print -rl -- \"$@\"; }; _describe() { print -rl -- ${(P)2}; }; "
                                    "words=(droplet-shape " +
                                        words + " ''); CURRENT=${#words}; source '" + file + "'"});
    EXPECT_EQ(result.exit_code, 0) << "zsh must be installed (Debian: zsh)";
    EXPECT_EQ(result.error, "");
    return result.output;
}

TEST(Documentation, ZshCompletesOptionsAndTheirValues)
{
    EXPECT_THAT(offeredByZsh(""), AllOf(HasSubstr("animate:"), HasSubstr("\n--model["),
                                        HasSubstr(":(auto linear exact)\n"), Not(HasSubstr("--volume-mode["))));
    EXPECT_THAT(offeredByZsh("animate"), AllOf(HasSubstr("--volume-mode["), HasSubstr(":(total track fill)\n")));
}

TEST(Documentation, ManualIsCleanRoff)
{
    const std::string file = testing::inSource("cli/droplet-shape.1");
    const auto formatted = runProgram({"groff", "-man", "-ww", "-Tutf8", "-P-cbou", file});
    ASSERT_EQ(formatted.exit_code, 0) << "groff must be installed (Debian: groff-base)";
    EXPECT_EQ(formatted.error, "");
    EXPECT_THAT(formatted.output, HasSubstr("DROPLET-SHAPE(1)"));
}

}  // namespace
}  // namespace droplet
