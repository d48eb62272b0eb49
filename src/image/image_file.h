// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

#include "droplet/error.h"
#include "file_bytes.h"

namespace droplet {

[[noreturn]] void throwOutOfMemory();

/// Reads a whole file, which may be a pipe; if it does not begin like an image, only its beginning.
/// @throws Error InvalidInput
std::vector<std::byte> readImageFile(const std::filesystem::path& path);

/// Reads a file and decodes its bytes; the messages of errors name the file.
template <class Decode>
auto fromImageFile(const std::filesystem::path& path, const Decode& decode)
{
    const std::vector<std::byte> encoded = readImageFile(path);
    try {
        return decode(std::span<const std::byte>(encoded));
    } catch (const Error& error) {
        throw Error(error.code(), shown(path) + ": " + error.what());
    }
}

}  // namespace droplet
