// SPDX-License-Identifier: GPL-3.0-or-later
// scripts/regress on folders of references.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "support/command.h"
#include "support/paths.h"

namespace droplet {
namespace {

using testing::CommandResult;
using ::testing::HasSubstr;
using testing::runDroplet;
using ::testing::StartsWith;

CommandResult regress(std::vector<std::string> arguments)
{
    arguments.insert(arguments.begin(), {testing::inSource("scripts/regress"), "--program", testing::kCommand});
    return testing::runProgram(arguments);
}

TEST(Regress, ComparesAnyFolderOfReferences)
{
    const testing::ScratchDirectory scratch;
    const std::filesystem::path folder = scratch.path();
    testing::writeFile(folder / "disc.pgm", testing::discPicture(40, 15.0));
    const auto make = [&](const std::string& name, const std::vector<std::string>& options) {
        std::vector<std::string> arguments = {(folder / "disc.pgm").string(), (folder / name).string(), "--quiet",
                                              "--triangles", "400"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        ASSERT_EQ(runDroplet(arguments).exit_code, 0);
    };
    make("same.glb", {"--width", "9mm"});
    make("other.stl", {"--width", "9mm"});
    testing::writeFile(folder / "cases",
                       "# a name, a mask, options\n"
                       "same   disc.pgm  --triangles 400 --width 9mm\n"
                       "other  0.5 disc.pgm  --triangles 400 --width '9mm'  # regress does not use the number\n");
    const CommandResult unchanged = regress({folder.string()});
    EXPECT_EQ(unchanged.exit_code, 0) << unchanged.output << unchanged.error;
    EXPECT_THAT(unchanged.output, HasSubstr("2 of 2 unchanged"));

    make("other.stl", {"--width", "9mm", "--contact-angle", "50deg"});
    const CommandResult changed = regress({folder.string(), "--pictures", (folder / "pictures").string()});
    EXPECT_EQ(changed.exit_code, 1);
    EXPECT_THAT(changed.output, HasSubstr("1 of 2 unchanged"));
    EXPECT_THAT(changed.output, HasSubstr("the largest distance of"));
    EXPECT_THAT(testing::readFile(folder / "pictures/other.png"), StartsWith("\x89PNG"));
    EXPECT_FALSE(std::filesystem::exists(folder / "pictures/same.png"));
    EXPECT_EQ(regress({folder.string(), "--tolerance", "1mm"}).exit_code, 0);

    testing::writeFile(folder / "cases", "same disc.pgm --width 9lm\nmissing disc.pgm\n");
    const CommandResult failed = regress({folder.string()});
    EXPECT_EQ(failed.exit_code, 1);
    EXPECT_THAT(failed.output, HasSubstr("was not made"));
    EXPECT_THAT(failed.output, HasSubstr("was not compared"));
    EXPECT_EQ(regress({(folder / "pictures").string()}).exit_code, 2);
}

TEST(Regress, GoldenDropletsAreUnchanged)
{
    const CommandResult result = regress({});
    EXPECT_EQ(result.exit_code, 0) << result.output << result.error;
}

}  // namespace
}  // namespace droplet
