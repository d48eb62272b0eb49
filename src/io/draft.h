// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "droplet/io/output.h"

namespace droplet {

/// @throws Error OutputFailed, with path and cause
[[noreturn]] void throwOutputFailed(const std::filesystem::path& path, const std::string& cause);

/// @throws Error OutputFailed: a file exists, and OutputOptions::no_clobber protects it
[[noreturn]] void throwMustNotBeReplaced(const std::filesystem::path& path);

/// Output under way, as the system has it: see writeAtomically().
class Draft {
public:
    /// Finds where the path leads, checks it as checkWritable() does, and opens a file there, or the device or pipe.
    /// @throws Error OutputFailed
    Draft(const std::filesystem::path& path, const OutputOptions& options);
    /// Removes a file that was not committed.
    ~Draft();
    Draft(const Draft&) = delete;
    Draft& operator=(const Draft&) = delete;

    /// Writes bytes.
    /// @return  whether all of them, and all before, were written
    bool write(const char* bytes, std::size_t count);

    /// Why bytes were not written; empty if they were.
    [[nodiscard]] std::string problem() const;

    /// Lets the file appear at its path, with all data on the disk.
    /// @throws Error OutputFailed
    void commit();

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace droplet
