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

/// Stands for standard input or standard output in place of a path.
inline constexpr const char* kStandardStream = "-";

bool isStream(const std::string& path);

/// Whether a file is a picture of the formats we read, by its extension.
bool isPicture(const std::string& path);

/// A file that an option or argument names.
struct NamedFile {
    std::string name;  ///< of the option or argument, for messages
    std::string path;  ///< or kStandardStream
};

/// What is known to fail must fail before any work is done: two outputs in one place, an output that would replace an
/// input, what cannot be written.
/// @throws droplet::Error InvalidArgument, OutputFailed
void checkFiles(const std::vector<NamedFile>& inputs, const std::vector<NamedFile>& outputs,
                const droplet::OutputOptions& options);

/// Hands over what is in a file, part by part.
/// @throws droplet::Error InvalidInput: it cannot be read
void readFile(const std::string& path, const std::function<void(std::span<const std::byte>)>& take);

/// All that is in a file.
/// @throws droplet::Error InvalidInput: it cannot be read
std::string textOf(const std::string& path);

/// All of standard input.
/// @param max_pixels       of the largest picture it may be
/// @throws droplet::Error  InvalidInput: unreadable, or longer than any such picture
std::vector<std::byte> readStandardInput(std::size_t max_pixels);

/// A file to be written.
struct OutputFile {
    std::string path;  ///< or kStandardStream
    std::function<void(std::ostream&)> write;
};

/// Writes files so that all of them appear, or none.
///
/// Several files cannot appear at one instant. So each is written inside the writing of the one before it: after every
/// byte of that has been taken by the file system, before its file is renamed into place. A full disk or an unwritable
/// report thus leaves all older files as they stood; only a rename that fails could part them.
/// @throws droplet::Error OutputFailed; whatever `write` throws
void writeTogether(const std::vector<OutputFile>& files, const droplet::OutputOptions& options);

/// Writes text to standard output.
void print(const std::string& text);

}  // namespace cli
