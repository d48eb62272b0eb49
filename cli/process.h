// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

namespace cli {

/// What the system knows a started program by.
using ProcessId = std::intptr_t;

/// Running program, with its standard error in a file.
struct Process {
    std::optional<ProcessId> id;
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

/// How a program ended.
struct ProcessEnd {
    int code = 0;                  ///< exit code; of a program that did not end by itself, not 0
    bool was_out_of_time = false;  ///< limitTime() has ended it
};

/// Temporary file that a started program opens, too. On Windows it stays if this process is killed.
class SharedFile {
public:
    SharedFile();
    /// Removes the file.
    ~SharedFile();
    SharedFile(const SharedFile&) = delete;
    SharedFile& operator=(const SharedFile&) = delete;

    /// For reading and writing; null, with errno, if there is none.
    [[nodiscard]] std::FILE* get() const { return file_; }
    /// By which the program opens it.
    [[nodiscard]] const std::string& name() const { return name_; }

private:
    std::FILE* file_ = nullptr;
    std::string name_;
};

/// Starts a program.
/// @param command  name, looked up in PATH, and arguments
/// @param shared   file that the program may open, or null
Started start(const std::vector<std::string>& command, Piped piped, const SharedFile* shared = nullptr);

/// File without a name of its own, which the system removes when it is closed; null, with errno, if there is none.
std::FILE* temporaryFile();

/// Limits the private memory of a running program, and lets it write no core file.
/// @param bytes  beyond which its allocations fail
void limitMemory(ProcessId id, std::size_t bytes);

/// Limits the processor time of a running program, counted from now. The system then ends it.
/// @param seconds  at least 1
void limitTime(ProcessId id, std::size_t seconds);

/// Waits for the end of a program.
ProcessEnd waitFor(ProcessId id);

/// Ends a program at once, and waits for its end.
void endNow(ProcessId id);

}  // namespace cli
