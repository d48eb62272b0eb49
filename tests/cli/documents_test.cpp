// SPDX-License-Identifier: GPL-3.0-or-later
// README.md and the pages in docs/ are true: their program is the one that package_test builds, their messages and keys
// are the program's, their links resolve.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "support/command.h"
#include "support/paths.h"

namespace droplet {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using testing::runDroplet;
using ::testing::StartsWith;

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

/// Markdown files in a folder and its subfolders, as sorted paths from the root.
std::vector<std::string> markdownIn(const std::string& folder)
{
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(inSource(folder))) {
        if (entry.path().extension() == ".md") {
            names.push_back(entry.path().lexically_relative(testing::kSourceDir).generic_string());
        }
    }
    std::sort(names.begin(), names.end());
    EXPECT_THAT(names, Not(IsEmpty())) << folder;
    return names;
}

/// README.md and the pages in docs/.
std::vector<std::string> documents()
{
    std::vector<std::string> names = markdownIn("docs");
    names.insert(names.begin(), "README.md");
    return names;
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

/// Fenced blocks of a language, in order.
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

/// Fenced blocks of a language in all documents.
std::vector<std::string> codeBlocksInDocuments(const std::string& language)
{
    std::vector<std::string> blocks;
    for (const std::string& name : documents()) {
        for (std::string& block : codeBlocks(sourceFile(name), language)) {
            blocks.push_back(std::move(block));
        }
    }
    return blocks;
}

std::string withoutLicenceLine(const std::string& content)
{
    EXPECT_THAT(content.substr(0, content.find('\n')), HasSubstr("SPDX-License-Identifier"));
    return content.substr(content.find('\n') + 1);
}

TEST(Readme, ShowsTheProgramOfTheConsumerTest)
{
    const std::string program = withoutLicenceLine(sourceFile("tests/consumer/main.cpp"));
    EXPECT_THAT(codeBlocks(sourceFile("README.md"), "cpp"), ElementsAre(program));
    EXPECT_THAT(codeBlocksInDocuments("cpp"), ElementsAre(program));
}

TEST(Readme, ShowsTheBuildOfTheConsumerTest)
{
    const std::string project = sourceFile("tests/consumer/CMakeLists.txt");
    const auto blocks = codeBlocksInDocuments("cmake");
    EXPECT_THAT(blocks, Not(IsEmpty()));
    for (const std::string& block : blocks) {
        EXPECT_THAT(project, HasSubstr(block));
    }
}

TEST(Readme, EveryCommandHasAPage)
{
    const std::string help = runDroplet({"--help"}).output;
    static const std::regex kCommand("\n  ([a-z0-9-]+) {2,}[^\n]*");
    const auto begin = help.find("\nCommands");
    const std::string list = begin == std::string::npos ? "" : help.substr(begin, help.find("\n\n", begin) - begin);
    for (std::sregex_iterator entry(list.begin(), list.end(), kCommand), end; entry != end; ++entry) {
        const std::string command = entry->str(1);
        EXPECT_THAT(sourceFile("docs/cli/" + command + ".md"),
                    AllOf(HasSubstr("\n# `droplet-shape " + command + "`"), HasSubstr("\n<!-- options of " + command)));
    }
    EXPECT_THAT(list, HasSubstr("\n  windshield "));
}

/// Sources of the program, with strings joined that are split over lines.
std::string joinedSources()
{
    std::string text;
    for (const char* folder : {"src", "cli"}) {
        for (const auto& entry : std::filesystem::recursive_directory_iterator(inSource(folder))) {
            if (entry.path().extension() == ".cpp") {
                text += testing::readFile(entry.path());
            }
        }
    }
    return std::regex_replace(text, std::regex(R"("\s*\n\s*")"), "");
}

TEST(Readme, TroubleshootingQuotesMessagesOfTheProgram)
{
    const std::string sources = joinedSources() + std::strerror(ENOSPC);
    int count = 0;
    for (const std::string& line : linesOf(sourceFile("docs/troubleshooting.md"))) {
        std::smatch message;
        if (!std::regex_search(line, message, std::regex("^\\| `([^`]+)`"))) {
            continue;
        }
        std::istringstream parts(std::regex_replace(message.str(1), std::regex(";? *… *"), "\n"));
        for (std::string part; std::getline(parts, part); ++count) {
            EXPECT_NE(sources.find(part), std::string::npos) << part << " in " << line;
        }
    }
    EXPECT_GT(count, 50);
}

/// Keys of a report as docs/reports.md shows them: neighbouring keys without members share a line; of the array `rows`,
/// the keys of the first row are shown.
std::string keysOf(const nlohmann::ordered_json& report, const std::string& rows)
{
    std::string keys;
    bool breaks = true;
    for (const auto& [key, value] : report.items()) {
        const auto& keyed = key == rows ? value.at(0) : value;
        if (keyed.is_object()) {
            keys += (breaks ? "" : "\n") + key + ":";
            for (const auto& member : keyed.items()) {
                keys += " " + member.key();
            }
            keys += "\n";
        } else {
            keys += (breaks ? "" : " ") + key;
        }
        breaks = keyed.is_object();
    }
    return keys + "\n";
}

TEST(Readme, PageHasTheExitCodesOfTheHelp)
{
    const std::string help = runDroplet({"--help"}).output;
    const std::string page = sourceFile("docs/cli/droplet-shape.md");
    const std::string heading = "Exit codes:";
    ASSERT_THAT(help, HasSubstr(heading));
    const std::string list = help.substr(help.find(heading) + heading.size());
    static const std::regex kEntry(R"((\d) ([^;]*[^;\s]))");
    int count = 0;
    for (std::sregex_iterator entry(list.begin(), list.end(), kEntry), end; entry != end; ++entry, ++count) {
        const std::string row = "\n| " + entry->str(1) + " | " + entry->str(2);
        EXPECT_NE(page.find(row), std::string::npos) << row;
    }
    EXPECT_EQ(count, 7);
}

TEST(Readme, PageHasTheKeysOfReports)
{
    testing::ScratchDirectory scratch;
    const auto report_of = [&](std::vector<std::string> arguments, const std::string& data) {
        const std::string path = (scratch.path() / "report.json").string();
        for (const std::string& argument :
             {inSource(data).string(), (scratch.path() / "droplet.glb").string(), std::string("--triangles"),
              std::string("1k"), std::string("--json"), path}) {
            arguments.push_back(argument);
        }
        const auto run = runDroplet(arguments);
        EXPECT_EQ(run.exit_code, 0) << run.error;
        return nlohmann::ordered_json::parse(testing::readFile(path));
    };
    const std::string page = sourceFile("docs/reports.md");
    EXPECT_THAT(codeBlocks(page, "report"), ElementsAre(keysOf(report_of({}, "data/letter_g_1bit.png"), "droplets")));
    const auto sequence = report_of({"animate"}, "data/closing");
    EXPECT_THAT(codeBlocks(page, "sequence-report"), ElementsAre(keysOf(sequence, "frames")));
    for (const char* key : {"id", "from", "volume_m3", "pressure_pa", "height_max_m", "holes"}) {
        EXPECT_TRUE(sequence["frames"][0]["droplets"][0].contains(key)) << key;
    }
    const auto liquid = runDroplet({"liquid2d", (scratch.path() / "dam.svg").string(), "--scene", "dam", "--time",
                                    "0.1s", "--particle-count", "100", "--json", "-", "--quiet"});
    EXPECT_EQ(liquid.exit_code, 0) << liquid.error;
    EXPECT_THAT(codeBlocks(page, "liquid2d-report"),
                ElementsAre(keysOf(nlohmann::ordered_json::parse(liquid.output), "frames")));
}

TEST(Readme, FirstPictureShowsTheFirstCommand)
{
    const std::string readme = sourceFile("README.md");
    const std::string command = codeBlocks(readme, "sh").at(0);
    std::smatch match;
    ASSERT_TRUE(std::regex_match(command, match, std::regex("scripts/run data/(\\S+) droplet\\.glb\n"))) << command;
    const std::string mask = match.str(1);
    EXPECT_LT(readme.find("(data/pictures/hero.png)"), readme.find(command));
    EXPECT_THAT(sourceFile("scripts/make-pictures"),
                HasSubstr("--mask \"$root/data/" + mask + "\" --around 1 --out \"$root/data/pictures/hero.png\""));
    testing::ScratchDirectory scratch;
    const auto run = runDroplet({inSource("data/" + mask).string(), (scratch.path() / "droplet.glb").string()});
    EXPECT_EQ(run.exit_code, 0) << run.error;
    EXPECT_THAT(scratch.names(), ElementsAre("droplet.glb"));
}

// ------------------------------------------------------------------------------------------------ pages and links

/// Anchor of a heading as Markdown renderers make it: lower case, dashes for spaces, without other punctuation.
std::string anchorOf(const std::string& heading)
{
    std::string anchor;
    for (const char c : heading) {
        if (c >= 'A' && c <= 'Z') {
            anchor += static_cast<char>(c - 'A' + 'a');
        } else if ((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-' || c == '_') {
            anchor += c;
        } else if (c == ' ') {
            anchor += '-';
        }
    }
    return anchor;
}

/// Lines outside fenced blocks.
std::vector<std::string> proseOf(const std::string& markdown)
{
    std::vector<std::string> prose;
    bool fenced = false;
    for (const std::string& line : linesOf(markdown)) {
        if (line.rfind("```", 0) == 0) {
            fenced = !fenced;
        } else if (!fenced) {
            prose.push_back(line);
        }
    }
    EXPECT_FALSE(fenced) << "a fence is not closed";
    return prose;
}

/// Anchors of all headings; repeated ones end in -1, -2 and so on.
std::set<std::string> anchorsOf(const std::string& markdown)
{
    std::set<std::string> anchors;
    std::map<std::string, int> count;
    static const std::regex kHeading("^#+ +(.*)$");
    for (const std::string& line : proseOf(markdown)) {
        std::smatch heading;
        if (std::regex_match(line, heading, kHeading)) {
            const std::string anchor = anchorOf(heading.str(1));
            const int before = count[anchor]++;
            anchors.insert(before == 0 ? anchor : anchor + "-" + std::to_string(before));
        }
    }
    return anchors;
}

/// Targets of links and pictures, except those on the web.
std::vector<std::string> relativeLinksOf(const std::string& markdown)
{
    static const std::regex kLink(R"re(\]\(([^)\s]+)[^)]*\)|^\[[^\]]+\]: *(\S+)|(?:href|src)="([^"]+)")re");
    static const std::regex kElsewhere("^[a-z]+:.*");
    std::vector<std::string> targets;
    for (const std::string& line : proseOf(markdown)) {
        for (std::sregex_iterator link(line.begin(), line.end(), kLink), end; link != end; ++link) {
            const std::string target = link->str(1) + link->str(2) + link->str(3);
            if (!std::regex_match(target, kElsewhere)) {
                targets.push_back(target);
            }
        }
    }
    return targets;
}

/// Destination of a link in a document, as a path from the root.
std::string destinationOf(const std::string& document, const std::string& target)
{
    const std::string file = target.substr(0, target.find('#'));
    if (file.empty()) {
        return document;
    }
    return (std::filesystem::path(document).parent_path() / file).lexically_normal().generic_string();
}

TEST(Readme, LinksResolve)
{
    std::vector<std::string> names = documents();
    for (const char* folder : {"bench", "data", "examples"}) {
        const auto more = markdownIn(folder);
        names.insert(names.end(), more.begin(), more.end());
    }
    names.insert(names.end(), {"CHANGELOG.md", "CONTRIBUTING.md", "RELEASING.md"});
    for (const std::string& name : names) {
        SCOPED_TRACE(name);
        for (const std::string& target : relativeLinksOf(sourceFile(name))) {
            const std::string destination = destinationOf(name, target);
            EXPECT_THAT(destination, Not(::testing::AnyOf(StartsWith(".."), StartsWith("/")))) << target;
            if (!std::filesystem::exists(inSource(destination))) {
                ADD_FAILURE() << target;
                continue;
            }
            const auto mark = target.find('#');
            if (mark != std::string::npos) {
                EXPECT_THAT(anchorsOf(sourceFile(destination)), Contains(target.substr(mark + 1))) << target;
            }
        }
    }
}

TEST(Readme, PagesAreShort)
{
    EXPECT_LE(sourceFile("README.md").size(), 10'000U);
    for (const std::string& name : markdownIn("docs")) {
        EXPECT_LE(sourceFile(name).size(), 25'000U) << name;
    }
}

TEST(Readme, PagesAreListedAndLinkBack)
{
    const auto destinations = [](const std::string& name) {
        std::vector<std::string> found;
        for (const std::string& target : relativeLinksOf(sourceFile(name))) {
            found.push_back(destinationOf(name, target));
        }
        return found;
    };
    EXPECT_THAT(destinations("README.md"), Contains("docs/README.md"));
    for (const std::string& name : markdownIn("docs")) {
        EXPECT_THAT(sourceFile(name), StartsWith("<!-- SPDX-License-Identifier: GPL-3.0-or-later -->\n# ")) << name;
        EXPECT_THAT(destinations(name), Contains("README.md")) << name;
        if (name != "docs/README.md") {
            EXPECT_THAT(destinations("docs/README.md"), Contains(name)) << name;
        }
    }
}

}  // namespace
}  // namespace droplet
