// SPDX-License-Identifier: GPL-3.0-or-later
// What README.md says is so: its program is the one package_test builds, its options are the command's, its files
// exist.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "support/command.h"
#include "support/paths.h"

namespace droplet {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using testing::runDroplet;

std::filesystem::path inSource(const std::string& name)
{
    return std::filesystem::path(testing::kSourceDir) / name;
}

std::string sourceFile(const std::string& name)
{
    const std::string content = testing::readFile(inSource(name));
    EXPECT_THAT(content, Not(IsEmpty())) << name;
    return content;
}

std::vector<std::string> linesOf(const std::string& text)
{
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) {
        lines.push_back(line);
    }
    return lines;
}

/// The fenced blocks of that language, in order.
std::vector<std::string> codeBlocks(const std::string& markdown, const std::string& language)
{
    std::vector<std::string> blocks;
    bool inside = false;
    for (const std::string& line : linesOf(markdown)) {
        if (!inside && line == "```" + language) {
            inside = true;
            blocks.emplace_back();
        } else if (inside && line == "```") {
            inside = false;
        } else if (inside) {
            blocks.back() += line + '\n';
        }
    }
    return blocks;
}

std::string withoutLicenceLine(const std::string& content)
{
    EXPECT_THAT(content.substr(0, content.find('\n')), HasSubstr("SPDX-License-Identifier"));
    return content.substr(content.find('\n') + 1);
}

/// An option as it is shown: with its short name and its argument, and its default, empty if it has none.
struct Shown {
    std::string usage;
    std::string fallback;

    friend bool operator==(const Shown&, const Shown&) = default;
    friend void PrintTo(const Shown& shown, std::ostream* out) { *out << shown.usage << " [" << shown.fallback << "]"; }
};

/// By long name.
using Options = std::map<std::string, Shown>;

std::string longName(const std::string& usage)
{
    std::smatch match;
    EXPECT_TRUE(std::regex_search(usage, match, std::regex("--[a-z-]+"))) << usage;
    return match.str();
}

/// What stands in brackets at the end of a text.
std::string bracketed(const std::string& text)
{
    std::smatch match;
    return std::regex_search(text, match, std::regex(R"(\[([^\]]*)\]\s*$)")) ? match.str(1) : "";
}

Options optionsInHelp(const std::string& command = "")
{
    Options options;
    std::string usage;
    std::string meaning;
    const auto finish = [&] {
        if (!usage.empty()) {
            options[longName(usage)] = {usage, bracketed(meaning)};
        }
        usage.clear();
    };
    static const std::regex kOption(R"(^  ((-[a-z], )?--[a-z-]+( [A-Z]+)?)( {2,}(.*))?$)");
    static const std::regex kMore("^ {10,}(.*)$");
    for (const std::string& line :
         linesOf(command.empty() ? runDroplet({"--help"}).output : runDroplet({command, "--help"}).output)) {
        std::smatch match;
        if (std::regex_match(line, match, kOption)) {
            finish();
            usage = match.str(1);
            meaning = match.str(5);
        } else if (std::regex_match(line, match, kMore)) {
            meaning += " " + match.str(1);
        } else {
            finish();
        }
    }
    return options;
}

/// The cells of a row of a table, without the marks of code.
std::vector<std::string> cellsOf(const std::string& row)
{
    std::vector<std::string> cells;
    std::istringstream stream(std::regex_replace(row, std::regex("`"), ""));
    std::string cell;
    std::getline(stream, cell, '|');
    while (std::getline(stream, cell, '|')) {
        cells.push_back(std::regex_replace(cell, std::regex("^ +| +$"), ""));
    }
    return cells;
}

/// The options in the tables of README, by the command whose section they stand in, "" being the main job.
std::map<std::string, Options> optionsInReadme()
{
    std::map<std::string, Options> sections;
    std::string command;
    static const std::regex kHeading("^##+ (`droplet-shape ([a-z-]+)`)?.*$");
    for (const std::string& line : linesOf(sourceFile("README.md"))) {
        std::smatch heading;
        if (std::regex_match(line, heading, kHeading)) {
            command = heading.str(2);
        } else if (line.rfind("| `-", 0) == 0) {
            const auto cells = cellsOf(line);
            EXPECT_EQ(cells.size(), 3U) << line;
            sections[command][longName(cells.at(0))] = {cells.at(0), cells.at(2)};
        }
    }
    return sections;
}

TEST(Readme, ShowsTheProgramThatIsBuiltOutside)
{
    EXPECT_THAT(codeBlocks(sourceFile("README.md"), "cpp"),
                ElementsAre(withoutLicenceLine(sourceFile("tests/consumer/main.cpp"))));
}

TEST(Readme, ShowsHowItIsBuiltOutside)
{
    const std::string project = sourceFile("tests/consumer/CMakeLists.txt");
    const auto blocks = codeBlocks(sourceFile("README.md"), "cmake");
    EXPECT_THAT(blocks, Not(IsEmpty()));
    for (const std::string& block : blocks) {
        EXPECT_THAT(project, HasSubstr(block));
    }
}

TEST(Readme, OptionsAndDefaultsAreTheCommands)
{
    const Options known = optionsInHelp();
    EXPECT_EQ(known.size(), 48U);
    for (const auto& [command, options] : optionsInReadme()) {
        if (command.empty()) {
            EXPECT_EQ(options, known);
            continue;
        }
        // A command's section has what is its own; the rest is as in the first table.
        Options own = optionsInHelp(command);
        EXPECT_THAT(own, Not(IsEmpty())) << command;
        for (const auto& [name, shown] : known) {
            const auto same = own.find(name);
            if (same != own.end() && same->second == shown) {
                own.erase(same);
            }
        }
        EXPECT_EQ(options, own) << command;
    }
}

TEST(Readme, EveryCommandHasASection)
{
    const std::string help = runDroplet({"--help"}).output;
    static const std::regex kCommand("\n  ([a-z-]+) {2,}[^\n]*");
    const auto begin = help.find("\nCommands:\n");
    const std::string list = begin == std::string::npos ? "" : help.substr(begin, help.find("\n\n", begin) - begin);
    for (std::sregex_iterator entry(list.begin(), list.end(), kCommand), end; entry != end; ++entry) {
        EXPECT_EQ(optionsInReadme().count(entry->str(1)), 1U) << entry->str(1);
    }
}

TEST(Readme, ExitCodesAreTheCommands)
{
    const std::string help = runDroplet({"--help"}).output;
    const std::string readme = sourceFile("README.md");
    const std::string heading = "Exit codes:";
    ASSERT_THAT(help, HasSubstr(heading));
    const std::string list = help.substr(help.find(heading) + heading.size());
    static const std::regex kEntry(R"((\d) ([^;]*[^;\s]))");
    int count = 0;
    for (std::sregex_iterator entry(list.begin(), list.end(), kEntry), end; entry != end; ++entry, ++count) {
        const std::string row = "\n| " + entry->str(1) + " | " + entry->str(2);
        EXPECT_NE(readme.find(row), std::string::npos) << row;
    }
    EXPECT_EQ(count, 7);
}

TEST(Readme, ReportHasTheKeysShown)
{
    const auto blocks = codeBlocks(sourceFile("README.md"), "report");
    ASSERT_EQ(blocks.size(), 1U);
    testing::ScratchDirectory scratch;
    const std::string report = (scratch.path() / "report.json").string();
    const auto run = runDroplet({inSource("data/letter_g_1bit.png").string(), (scratch.path() / "droplet.glb").string(),
                                 "--triangles", "1k", "--json", report});
    ASSERT_EQ(run.exit_code, 0) << run.error;
    std::string written;
    const auto json = nlohmann::ordered_json::parse(testing::readFile(report));
    bool breaks = true;  // keys without others below them share a line with those next to them
    for (const auto& [key, value] : json.items()) {
        const auto& keyed = key == "droplets" ? value.at(0) : value;
        if (keyed.is_object()) {
            written += (breaks ? "" : "\n") + key + ":";
            for (const auto& member : keyed.items()) {
                written += " " + member.key();
            }
            written += "\n";
            breaks = true;
        } else {
            written += (breaks ? "" : " ") + key;
            breaks = false;
        }
    }
    EXPECT_EQ(blocks[0], written + "\n");
}

TEST(Readme, FirstPictureIsWhatTheFirstCommandMakes)
{
    const std::string readme = sourceFile("README.md");
    const std::string command = codeBlocks(readme, "sh").at(0);
    std::smatch match;
    ASSERT_TRUE(std::regex_match(command, match, std::regex("scripts/run data/(\\S+) droplet\\.glb\n"))) << command;
    const std::string mask = match.str(1);
    EXPECT_LT(readme.find("(data/pictures/hero.png)"), readme.find(command));
    EXPECT_THAT(sourceFile("scripts/make-pictures"), HasSubstr("\npicture hero " + mask + "\n"));
    testing::ScratchDirectory scratch;
    const auto run = runDroplet({inSource("data/" + mask).string(), (scratch.path() / "droplet.glb").string()});
    EXPECT_EQ(run.exit_code, 0) << run.error;
    EXPECT_THAT(scratch.names(), ElementsAre("droplet.glb"));
}

/// A heading's anchor as Markdown renderers make it: lower case, spaces to dashes, other marks left out.
std::string anchorOf(const std::string& heading)
{
    std::string anchor;
    for (const char c : heading) {
        if (c >= 'A' && c <= 'Z') {
            anchor += static_cast<char>(c - 'A' + 'a');
        } else if ((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-') {
            anchor += c;
        } else if (c == ' ') {
            anchor += '-';
        }
    }
    return anchor;
}

TEST(Readme, LinksLeadSomewhere)
{
    for (const std::string name : {"README.md", "data/README.md", "CHANGELOG.md"}) {
        const std::string text = sourceFile(name);
        std::vector<std::string> anchors;
        for (const std::string& line : linesOf(text)) {
            if (line.rfind('#', 0) == 0) {
                anchors.push_back("#" + anchorOf(line.substr(line.find(' ') + 1)));
            }
        }
        static const std::regex kLink(R"(\]\(([^)\s]+)\))");
        for (std::sregex_iterator link(text.begin(), text.end(), kLink), end; link != end; ++link) {
            const std::string target = link->str(1);
            if (target.front() == '#') {
                EXPECT_THAT(anchors, ::testing::Contains(target)) << name;
            } else {
                EXPECT_TRUE(std::filesystem::exists(inSource(name).parent_path() / target)) << name << ": " << target;
            }
        }
    }
}

}  // namespace
}  // namespace droplet
