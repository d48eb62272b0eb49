// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <new>
#include <string>
#include <system_error>

#include "droplet/error.h"
#include "droplet/footprint/mask.h"
#include "footprint/image.h"
#include "footprint/image_header.h"

namespace droplet {

namespace {

/// A path as it can stand in a message of one line.
std::string shown(const std::filesystem::path& path)
{
    std::string text = path.string();
    std::replace_if(
        text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }, '?');
    return text;
}

[[noreturn]] void throwUnreadable(const std::filesystem::path& path, int error)
{
    throw Error(ErrorCode::InvalidInput, "cannot read " + shown(path) + ": " + std::generic_category().message(error));
}

/// The whole file, which may be a pipe; of one that does not begin like an image, the beginning, so that an
/// endless device is not read for ever.
std::vector<std::byte> readFile(const std::filesystem::path& path)
{
    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    const std::unique_ptr<std::FILE, Close> file(std::fopen(path.c_str(), "rb"));
    if (!file) {
        throwUnreadable(path, errno);
    }
    std::vector<std::byte> bytes;
    std::vector<std::byte> chunk(std::size_t{1} << 16);
    while (true) {
        errno = 0;
        const std::size_t count = std::fread(chunk.data(), 1, chunk.size(), file.get());
        const int error = errno;
        bytes.insert(bytes.end(), chunk.begin(), chunk.begin() + static_cast<std::ptrdiff_t>(count));
        if (count < chunk.size()) {
            if (std::ferror(file.get()) != 0) {
                throwUnreadable(path, error);
            }
            return bytes;
        }
        if (!imageFormat(bytes)) {
            return bytes;
        }
        std::error_code no_size;  // a pipe has none, and needs none
        if (const auto size = std::filesystem::file_size(path, no_size); !no_size) {
            bytes.reserve(size);
        }
    }
}

[[noreturn]] void throwOutOfMemory()
{
    throw Error(ErrorCode::InvalidInput, "the image needs more memory than there is");
}

}  // namespace

Mask decodeMask(std::span<const std::byte> encoded, const MaskOptions& options)
{
    try {
        return maskFromImage(decodeImage(encoded, options.max_pixels), options);
    } catch (const std::bad_alloc&) {
        throwOutOfMemory();
    }
}

Mask readMask(const std::filesystem::path& path, const MaskOptions& options)
{
    std::vector<std::byte> encoded;
    try {
        encoded = readFile(path);
    } catch (const std::bad_alloc&) {
        throwOutOfMemory();
    }
    try {
        return decodeMask(encoded, options);
    } catch (const Error& error) {
        throw Error(error.code(), shown(path) + ": " + error.what());
    }
}

}  // namespace droplet
