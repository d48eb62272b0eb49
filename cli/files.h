// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <iosfwd>
#include <span>
#include <string>
#include <vector>

#include "droplet/io/output.h"

namespace cli {

/// Path that stands for standard input or standard output.
inline constexpr const char* kStandardStream = "-";

/// Whether a path stands for standard input or standard output.
bool isStream(const std::string& path);

/// Whether a file has the extension of a picture format that can be read.
bool isPicture(const std::string& path);

/// Extension of a file with its dot, in lower case.
std::string lowerExtension(const std::string& path);

/// Reads a file and calls `take` for each part of it.
/// @throws droplet::Error InvalidInput if the file cannot be read
void readFile(const std::string& path, const std::function<void(std::span<const std::byte>)>& take);

/// Content of a file.
/// @throws droplet::Error InvalidInput if the file cannot be read
std::string textOf(const std::string& path);

/// Bytes of standard input.
/// @param max_pixels       limit of the picture's pixels
/// @throws droplet::Error  InvalidInput: unreadable, or longer than any picture of so many pixels
std::vector<std::byte> readStandardInput(std::size_t max_pixels);

/// File to be written.
struct OutputFile {
    std::string path;  ///< or kStandardStream
    std::function<void(std::ostream&)> write;
};

/// Writes all files, or none.
///
/// The writes are nested: each file is written after all bytes of the one before it are on disk, and before that one is
/// renamed into place. So a full disk or an unwritable report leaves all older files unchanged; only a failed rename
/// can separate them.
/// @throws droplet::Error OutputFailed; whatever `write` throws
void writeTogether(const std::vector<OutputFile>& files, const droplet::OutputOptions& options);

/// Writes text to standard output.
void print(const std::string& text);

}  // namespace cli
