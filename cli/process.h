// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <sys/types.h>

#include <cstdio>
#include <optional>
#include <string>
#include <vector>

namespace cli {

/// Another program under way, with its words in a file.
struct Process {
    pid_t id = -1;
    std::FILE* input = nullptr;   ///< its standard input, to be written; or none
    std::FILE* output = nullptr;  ///< its standard output, to be read; or none
    std::FILE* words = nullptr;   ///< what it says on standard error
};

enum class Piped { Input, Output };

/// Starts a program.
/// @param command    its name, looked up as the shell does, and its arguments
/// @param inherited  a file of ours that is its number 3
/// @return           or the cause why there is none: errno's
struct Started {
    Process process;
    int failure = 0;
};
Started start(const std::vector<std::string>& command, Piped piped, std::optional<int> inherited = {});

/// Its status, once it has ended.
int waitFor(pid_t id);

/// What a program said, or the beginning of it.
std::string wordsOf(std::FILE* words);

/// The first line a program said.
std::string firstLine(std::FILE* words);

/// A file's name that ffmpeg takes for no option and no protocol.
std::string plainName(const std::string& path);

}  // namespace cli
