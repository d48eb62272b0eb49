// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <string>
#include <vector>

#include "cli/commands.h"
#include "support/command.h"

namespace droplet::testing {

/// Runs droplet-shape in this process, all commands included: for command lines that are refused, hundreds of which
/// would take seconds as programs of their own.
/// @param directory  working directory; ours if empty
inline CommandResult runInProcess(const std::vector<std::string>& arguments,
                                  const std::filesystem::path& directory = {})
{
    std::vector<cli::Command> commands(cli::dropletCommands().begin(), cli::dropletCommands().end());
    commands.insert(commands.end(), cli::motionCommands().begin(), cli::motionCommands().end());
    std::vector<const char*> argv{"droplet-shape"};
    std::transform(arguments.begin(), arguments.end(), std::back_inserter(argv),
                   [](const std::string& argument) { return argument.c_str(); });
    const std::filesystem::path ours = std::filesystem::current_path();
    if (!directory.empty()) {
        std::filesystem::current_path(directory);
    }
    ::testing::internal::CaptureStdout();
    ::testing::internal::CaptureStderr();
    CommandResult result;
    result.exit_code = cli::runGuarded(static_cast<int>(argv.size()), argv.data(), commands);
    result.output = ::testing::internal::GetCapturedStdout();
    result.error = ::testing::internal::GetCapturedStderr();
    std::filesystem::current_path(ours);
    return result;
}

/// Expects an exit code, nothing on standard output, and one line on standard error that contains all words.
inline void expectOneLine(const CommandResult& result, int exit_code, const std::vector<std::string>& words)
{
    EXPECT_EQ(result.exit_code, exit_code) << result.error;
    EXPECT_EQ(result.output, "");
    EXPECT_THAT(result.errorLines(), ::testing::SizeIs(1)) << result.error;
    EXPECT_THAT(result.error, ::testing::StartsWith("droplet-shape: "));
    EXPECT_THAT(result.error, ::testing::EndsWith("\n"));
    for (const std::string& word : words) {
        EXPECT_THAT(result.error, ::testing::HasSubstr(word));
    }
}

}  // namespace droplet::testing
