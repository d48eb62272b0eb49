// SPDX-License-Identifier: GPL-3.0-or-later
// What README.md shows as code is code that package_test builds and runs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace droplet {
namespace {

std::string sourceFile(const std::string& name)
{
    std::ifstream file(std::filesystem::path(DROPLET_SOURCE_DIR) / name);
    EXPECT_TRUE(file.is_open()) << name;
    return {std::istreambuf_iterator<char>(file), {}};
}

/// The fenced blocks of that language, in order.
std::vector<std::string> codeBlocks(const std::string& markdown, const std::string& language)
{
    std::vector<std::string> blocks;
    bool inside = false;
    std::istringstream lines(markdown);
    for (std::string line; std::getline(lines, line);) {
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
    EXPECT_THAT(content.substr(0, content.find('\n')), ::testing::HasSubstr("SPDX-License-Identifier"));
    return content.substr(content.find('\n') + 1);
}

TEST(Readme, ShowsTheProgramThatIsBuiltOutside)
{
    EXPECT_THAT(codeBlocks(sourceFile("README.md"), "cpp"),
                ::testing::ElementsAre(withoutLicenceLine(sourceFile("tests/consumer/main.cpp"))));
}

TEST(Readme, ShowsHowItIsBuiltOutside)
{
    const std::string project = sourceFile("tests/consumer/CMakeLists.txt");
    const auto blocks = codeBlocks(sourceFile("README.md"), "cmake");
    EXPECT_THAT(blocks, ::testing::Not(::testing::IsEmpty()));
    for (const std::string& block : blocks) {
        EXPECT_THAT(project, ::testing::HasSubstr(block));
    }
}

}  // namespace
}  // namespace droplet
