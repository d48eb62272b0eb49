// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "support/command.h"

namespace droplet::testing {

/// Runs droplet-shape in a directory that holds a good picture, `disc.pgm`, and older outputs, `old.glb` and
/// `old.json`, which no failing run may touch.
class RefusalTest : public ::testing::Test {
protected:
    RefusalTest()
    {
        writeFile(directory() / "disc.pgm", discPicture(64, 24.0));
        writeFile(directory() / "old.glb", kOlder);
        writeFile(directory() / "old.json", kOlder);
    }

    [[nodiscard]] const std::filesystem::path& directory() const { return scratch_.path(); }

    [[nodiscard]] CommandResult run(const std::vector<std::string>& arguments, CommandOptions options = {}) const
    {
        options.directory = directory();
        return runDroplet(arguments, options);
    }

    /// Expects an exit code, one line on standard error that contains all words, and unchanged files.
    void expectRefusal(const std::vector<std::string>& arguments, int exit_code, const std::vector<std::string>& words,
                       const CommandOptions& options = {}) const
    {
        std::string command = "droplet-shape";
        for (const std::string& argument : arguments) {
            command += " '" + argument + "'";
        }
        SCOPED_TRACE(command);
        const auto names = scratch_.names();
        const CommandResult result = run(arguments, options);
        EXPECT_EQ(result.exit_code, exit_code);
        EXPECT_EQ(result.output, "");
        EXPECT_THAT(result.errorLines(), ::testing::SizeIs(1)) << result.error;
        EXPECT_THAT(result.error, ::testing::StartsWith("droplet-shape: "));
        EXPECT_THAT(result.error, ::testing::EndsWith("\n"));
        for (const std::string& word : words) {
            EXPECT_THAT(result.error, ::testing::HasSubstr(word));
        }
        EXPECT_EQ(scratch_.names(), names) << "files came or went";
        expectOlderFiles();
    }

    void expectOlderFiles() const
    {
        EXPECT_TRUE(readFile(directory() / "old.glb") == kOlder);
        EXPECT_TRUE(readFile(directory() / "old.json") == kOlder);
    }

    static constexpr const char* kOlder = "an older file\n";

private:
    ScratchDirectory scratch_;
};

}  // namespace droplet::testing
