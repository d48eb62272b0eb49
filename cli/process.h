// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

namespace cli {

/// Running program, with its standard error in a file.
struct Process {
    pid_t id = -1;
    std::FILE* input = nullptr;   ///< pipe to its standard input, or null
    std::FILE* output = nullptr;  ///< pipe from its standard output, or null
    std::FILE* log = nullptr;     ///< temporary file that receives its standard error
};

/// Standard stream of a program that is a pipe to this process.
enum class Piped { Input, Output };

/// Started program, or the reason for the failure.
struct Started {
    Process process;
    int failure = 0;  ///< 0, or an error number of errno
};

/// Starts a program.
/// @param command    name, looked up in PATH, and arguments
/// @param inherited  open file that becomes the program's file descriptor 3
Started start(const std::vector<std::string>& command, Piped piped, std::optional<int> inherited = {});

/// Limits the private memory of a running program, and lets it write no core file.
/// @param bytes  beyond which its allocations fail
void limitMemory(pid_t id, std::size_t bytes);

/// Limits the processor time of a running program, counted from now. SIGXCPU ends it.
/// @param seconds  at least 1
void limitTime(pid_t id, std::size_t seconds);

/// Waits for the end of a program and returns its status.
int waitFor(pid_t id);

/// Beginning of a program's log, up to 4096 bytes.
std::string logText(std::FILE* log);

/// First line of a program's log, without the addresses that ffmpeg's messages contain: [mp4 @ 0x55d0c0de]. They differ
/// from run to run.
std::string firstLine(std::FILE* log);

/// File name that ffmpeg cannot take for an option or a protocol.
std::string plainName(const std::string& path);

}  // namespace cli
