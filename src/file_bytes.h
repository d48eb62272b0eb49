// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <vector>

namespace droplet {

using Bytes = std::vector<std::byte>;

/// What is wrong with a file; readFile adds which.
class Damage : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// Up to `most` bytes of a file; of one whose first byte is not `expected`, the beginning alone, so that an endless
/// device is not read for ever.
/// @throws Damage where it cannot be read
Bytes readBytes(const std::filesystem::path& path, std::size_t most, const std::function<bool(std::byte)>& expected);

/// Runs a reader of a file. What it throws becomes one line that names the file.
/// @throws Error InvalidInput
void readFile(const std::filesystem::path& path, const std::function<void()>& read);

}  // namespace droplet
