// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace droplet {

using Bytes = std::vector<std::byte>;

/// Fault of a file; readFile adds its name.
class Damage : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// Path for a message of one line.
std::string shown(const std::filesystem::path& path);

/// Reads up to `max` bytes of a file, which may be a pipe. Every 64 KiB it asks whether the bytes are as `expected`,
/// and stops if not, so that it does not read an endless device for ever.
/// @throws Damage if it cannot be read
Bytes readBytes(const std::filesystem::path& path, std::uint64_t max,
                const std::function<bool(const Bytes&)>& expected);

/// The same with a test of the first byte.
Bytes readBytes(const std::filesystem::path& path, std::uint64_t max, const std::function<bool(std::byte)>& expected);

/// Runs a reader of a file. Turns its errors into one line that names the file.
/// @throws Error InvalidInput
void readFile(const std::filesystem::path& path, const std::function<void()>& read);

}  // namespace droplet
