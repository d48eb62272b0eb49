// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/image_file.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <new>
#include <system_error>

#include "image/image_header.h"

namespace droplet {

namespace {

[[noreturn]] void throwUnreadable(const std::filesystem::path& path, int error)
{
    throw Error(ErrorCode::InvalidInput, "cannot read " + shown(path) + ": " + std::generic_category().message(error));
}

std::vector<std::byte> readBytes(const std::filesystem::path& path)
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

}  // namespace

std::string shown(const std::filesystem::path& path)
{
    std::string text = path.string();
    std::replace_if(
        text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }, '?');
    return text;
}

void throwOutOfMemory()
{
    throw Error(ErrorCode::InvalidInput, "the image needs more memory than there is");
}

std::vector<std::byte> readImageFile(const std::filesystem::path& path)
{
    try {
        return readBytes(path);
    } catch (const std::bad_alloc&) {
        throwOutOfMemory();
    }
}

}  // namespace droplet
