// SPDX-License-Identifier: GPL-3.0-or-later
#include "files.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <ostream>
#include <span>
#include <string_view>

#include "droplet/error.h"

namespace cli {
namespace {

namespace fs = std::filesystem;
using droplet::Error;
using droplet::ErrorCode;

[[noreturn]] void refuseUnreadable(const std::string& name)
{
    throw Error(ErrorCode::InvalidInput, name + " cannot be read: " + std::strerror(errno));
}

void readAll(int file, const std::string& name, const std::function<void(std::span<const std::byte>)>& take)
{
    constexpr unsigned kPart = 1U << 18;
    std::vector<std::byte> part(kPart);
    for (;;) {
        const ssize_t got = read(file, part.data(), kPart);
        if (got < 0 && errno == EINTR) {
            continue;
        }
        if (got < 0) {
            refuseUnreadable(name);
        }
        if (got == 0) {
            return;
        }
        take(std::span(part).first(static_cast<std::size_t>(got)));
    }
}

/// Writes the first file, and before its end the others.
void writeNested(std::span<const OutputFile> files, const droplet::OutputOptions& options)
{
    if (files.empty()) {
        return;
    }
    const std::string& path = files.front().path;
    droplet::writeAtomically(
        isStream(path) ? "/dev/stdout" : path,
        [&](std::ostream& out) {
            files.front().write(out);
            if (out) {  // otherwise writeAtomically reports the cause
                writeNested(files.subspan(1), options);
            }
        },
        options);
}

}  // namespace

bool isStream(const std::string& path)
{
    return path == kStandardStream;
}

bool isPicture(const std::string& path)
{
    constexpr std::array<std::string_view, 19> kExtensions{".png", ".jpg",  ".jpeg", ".bmp", ".gif", ".ico", ".tga",
                                                           ".tif", ".tiff", ".webp", ".pbm", ".pgm", ".ppm", ".pnm",
                                                           ".svg", ".svgz", ".jp2",  ".exr", ".hdr"};
    return std::find(kExtensions.begin(), kExtensions.end(), lowerExtension(path)) != kExtensions.end();
}

std::string lowerExtension(const std::string& path)
{
    std::string extension = fs::path(path).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

void readFile(const std::string& path, const std::function<void(std::span<const std::byte>)>& take)
{
    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    const std::unique_ptr<std::FILE, Close> file(std::fopen(path.c_str(), "rb"));
    if (!file) {
        refuseUnreadable(path);
    }
    readAll(fileno(file.get()), path, take);
}

std::string textOf(const std::string& path)
{
    std::string text;
    readFile(path, [&](std::span<const std::byte> part) {
        text.append(reinterpret_cast<const char*>(part.data()), part.size());
    });
    return text;
}

std::vector<std::byte> readStandardInput(std::size_t max_pixels)
{
    // No supported picture is larger than 16 bits of red, green, blue and alpha for every pixel, and headers.
    const std::size_t longest = max_pixels * 8 + (std::size_t{1} << 20);
    std::vector<std::byte> bytes;
    readAll(STDIN_FILENO, "standard input", [&](std::span<const std::byte> part) {
        bytes.insert(bytes.end(), part.begin(), part.end());
        if (bytes.size() > longest) {
            throw Error(ErrorCode::InvalidInput,
                        "standard input is longer than any picture of " + std::to_string(max_pixels) + " pixels");
        }
    });
    return bytes;
}

void writeTogether(const std::vector<OutputFile>& files, const droplet::OutputOptions& options)
{
    writeNested(files, options);
}

void print(const std::string& text)
{
    droplet::writeAtomically("/dev/stdout", [&](std::ostream& out) { out << text; });
}

}  // namespace cli
