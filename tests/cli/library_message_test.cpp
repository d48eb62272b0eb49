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
        EXPECT_THAT(code, HasSubstr(std::string(named.phrase)));
    }
}

TEST(LibraryMessages, GetTheCommandsOptions)
{
    EXPECT_EQ(cli::withOptions("heights may be off; raise the number of triangles to 90k"),
              "heights may be off; raise the number of triangles (--triangles) to 90k");
    EXPECT_EQ(cli::withOptions("no pixel reaches the threshold 0.5"),
              "no pixel reaches the threshold (--threshold) 0.5");
    EXPECT_EQ(cli::withOptions("--threshold: no pixel reaches the threshold 0.5"),
              "--threshold: no pixel reaches the threshold 0.5");
    EXPECT_EQ(
        cli::withOptions("no pixel reaches the threshold 0.5; choose a threshold, 0.1 for one, or a colour"),
        "no pixel reaches the threshold (--threshold) 0.5; choose a threshold, 0.1 for one, or a colour (--colour)");
    EXPECT_EQ(cli::withOptions("no such droplet"), "no such droplet");
}

}  // namespace
}  // namespace droplet
