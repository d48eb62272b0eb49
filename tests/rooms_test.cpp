// SPDX-License-Identifier: GPL-3.0-or-later
// Rooms of the source tree include each other only as the table in docs/architecture.md allows.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "support/command.h"
#include "support/paths.h"

namespace droplet {
namespace {

namespace fs = std::filesystem;
using ::testing::Contains;
using testing::inSource;
using ::testing::IsEmpty;
using ::testing::Key;
using ::testing::Not;

struct Room {
    std::string name;
    std::string includes;  ///< cell of the table
};

/// Rows of the table, with the core first.
std::vector<Room> roomsOfTable()
{
    const std::string page = testing::readFile(inSource("docs/architecture.md"));
    const auto begin = page.find("<!-- rooms: begin -->");
    const auto end = page.find("<!-- rooms: end -->");
    std::vector<Room> rooms;
    std::istringstream lines(page.substr(begin, end - begin));
    const std::regex row(R"(\| (\w+) \|.*\|.*\| ?([^|]*?) ?\|)");
    for (std::string line; std::getline(lines, line);) {
        std::smatch cells;
        if (std::regex_match(line, cells, row) && cells[1] != "room") {
            rooms.push_back({cells[1], cells[2]});
        }
    }
    return rooms;
}

/// Rooms that each room may include. "all but X" means every room above it but X.
std::map<std::string, std::set<std::string>> allowed()
{
    std::map<std::string, std::set<std::string>> includes;
    std::set<std::string> above;
    for (const Room& room : roomsOfTable()) {
        std::set<std::string> named;
        std::istringstream words(std::regex_replace(room.includes, std::regex(","), " "));
        const bool all_but = room.includes.starts_with("all but ");
        for (std::string word; words >> word;) {
            if (word != "all" && word != "but") {
                EXPECT_THAT(above, Contains(word))
                    << room.name << " must be in a row below the rooms that it may include";
                named.insert(word);
            }
        }
        if (all_but) {
            std::set<std::string> rest;
            std::set_difference(above.begin(), above.end(), named.begin(), named.end(),
                                std::inserter(rest, rest.end()));
            named = rest;
        }
        includes[room.name] = named;
        above.insert(room.name);
    }
    return includes;
}

/// Room of a header or source, from its path below src/ or include/droplet/.
std::string roomOf(const fs::path& file)
{
    if (file.has_parent_path()) {
        return file.begin()->string();
    }
    const std::string stem = file.stem().string();
    return stem == "droplet" || stem == "pipeline" ? "droplet" : "core";
}

struct Include {
    std::string from;
    std::string to;
    std::string where;  ///< file and header
    bool is_public = false;
};

/// All includes from one room into another.
std::vector<Include> includesOfSources()
{
    std::vector<Include> includes;
    const std::regex include("#include [<\"]([^>\"]+)[>\"]");
    for (const std::string top : {"include/droplet", "src", "cli", "c/src"}) {
        const fs::path root = inSource(top);
        for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root)) {
            const fs::path below = fs::relative(entry.path(), root);
            if (below.extension() != ".h" && below.extension() != ".cpp") {
                continue;
            }
            const std::string from = top == "cli" ? "cli" : top == "c/src" ? "c" : roomOf(below);
            std::istringstream lines(testing::readFile(entry.path()));
            for (std::string line; std::getline(lines, line);) {
                std::smatch found;
                if (!std::regex_search(line, found, include)) {
                    continue;
                }
                const std::string header = found[1];
                const bool is_public = header.starts_with("droplet/");
                const bool is_private = !is_public && !fs::exists(entry.path().parent_path() / header) &&
                                        fs::exists(fs::path(inSource("src")) / header);
                if (is_public || is_private) {
                    const std::string to = roomOf(is_public ? header.substr(8) : header);
                    if (to != from) {
                        includes.push_back({from, to, (top / below).string() + " includes " + header, is_public});
                    }
                }
            }
        }
    }
    return includes;
}

TEST(Rooms, IncludeOnlyWhatTheTableAllows)
{
    const auto table = allowed();
    ASSERT_GT(table.size(), 15U);
    for (const Include& inclusion : includesOfSources()) {
        ASSERT_THAT(table, Contains(Key(inclusion.from))) << inclusion.where;
        EXPECT_THAT(table.at(inclusion.from), Contains(inclusion.to)) << inclusion.where;
        EXPECT_TRUE(inclusion.from != "cli" || inclusion.is_public)
            << inclusion.where << ": the command may only include public headers";
    }
}

TEST(Rooms, UseAllThatTheTableAllows)
{
    std::map<std::string, std::set<std::string>> used;
    for (const Include& inclusion : includesOfSources()) {
        used[inclusion.from].insert(inclusion.to);
    }
    for (const auto& [room, may] : allowed()) {
        if (room == "cli") {
            continue;
        }
        for (const std::string& other : may) {
            EXPECT_THAT(used[room], Contains(other)) << room << " does not include a room of its row";
        }
    }
}

// If two types have one name, the linker uses one for both, and the program fails at run time.
TEST(Rooms, NoTwoTypesHaveOneName)
{
    std::map<std::string, std::string> places;
    const std::regex type(R"(^(?:struct|class|enum class) (\w+)(?: final)?(?: :[^:].*)?(?: \{.*)?$)");
    for (const std::string top : {"include/droplet", "src"}) {
        for (const fs::directory_entry& entry : fs::recursive_directory_iterator(inSource(top))) {
            if (entry.path().extension() != ".h") {
                continue;
            }
            std::istringstream lines(testing::readFile(entry.path()));
            for (std::string line; std::getline(lines, line);) {
                std::smatch found;
                if (std::regex_match(line, found, type)) {
                    const auto [known, is_new] = places.emplace(found[1], entry.path().string());
                    EXPECT_TRUE(is_new) << found[1] << " in " << entry.path() << " and " << known->second;
                }
            }
        }
    }
    EXPECT_GT(places.size(), 100U);
}

TEST(Rooms, EveryFolderIsInTheTable)
{
    const auto table = allowed();
    for (const std::string top : {"include/droplet", "src"}) {
        for (const fs::directory_entry& entry : fs::directory_iterator(inSource(top))) {
            const std::string name = entry.path().filename().string();
            if (entry.is_directory() && name != "cmake") {
                EXPECT_THAT(table, Contains(Key(name)));
            }
        }
    }
    EXPECT_THAT(table, Not(IsEmpty()));
}

}  // namespace
}  // namespace droplet
