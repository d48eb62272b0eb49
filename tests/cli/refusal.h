// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "cli/in_process.h"
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
    void expectRefusal(const std::vector<std::string>& arguments, int exit_code,
                       const std::vector<std::string>& words) const
    {
        expectRefusal(arguments, exit_code, words, [&] { return runInProcess(arguments, directory()); });
    }

    /// The same of a program with its own input or environment.
    void expectRefusal(const std::vector<std::string>& arguments, int exit_code, const std::vector<std::string>& words,
                       const CommandOptions& options) const
    {
        expectRefusal(arguments, exit_code, words, [&] { return run(arguments, options); });
    }

    void expectOlderFiles() const
    {
        EXPECT_TRUE(readFile(directory() / "old.glb") == kOlder);
        EXPECT_TRUE(readFile(directory() / "old.json") == kOlder);
    }

    static constexpr const char* kOlder = "an older file\n";

private:
    void expectRefusal(const std::vector<std::string>& arguments, int exit_code, const std::vector<std::string>& words,
                       const std::function<CommandResult()>& run) const
    {
        std::string command = "droplet-shape";
        for (const std::string& argument : arguments) {
            command += " '" + argument + "'";
        }
        SCOPED_TRACE(command);
        const auto names = scratch_.names();
        expectOneLine(run(), exit_code, words);
        EXPECT_EQ(scratch_.names(), names) << "files came or went";
        expectOlderFiles();
    }

    ScratchDirectory scratch_;
};

}  // namespace droplet::testing
