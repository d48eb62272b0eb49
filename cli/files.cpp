// SPDX-License-Identifier: GPL-3.0-or-later
#include "files.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <ostream>
#include <span>

#include "droplet/error.h"

namespace cli {
namespace {

namespace fs = std::filesystem;
using droplet::Error;
using droplet::ErrorCode;

bool sameFile(const std::string& a, const std::string& b)
{
    std::error_code ignored;
    const auto place = [&](const std::string& path) {
        return fs::weakly_canonical(fs::absolute(path, ignored), ignored);
    };
    return a == b || fs::equivalent(a, b, ignored) || place(a) == place(b);
}

/// `program - out < out` would read what it is about to replace.
bool isStandardInput(const std::string& path)
{
    struct stat input = {};
    struct stat file = {};
    return fstat(STDIN_FILENO, &input) == 0 && stat(path.c_str(), &file) == 0 && S_ISREG(file.st_mode) &&
           input.st_dev == file.st_dev && input.st_ino == file.st_ino;
}

[[noreturn]] void refuseClash(const std::string& written, const std::string& other, const std::string& path)
{
    throw Error(ErrorCode::InvalidArgument,
                written + " and " + other + " are the same, '" + path + "'; they must be different files");
}

/// Writes the first file, and within that the others.
void writeNested(std::span<const OutputFile> files, const droplet::OutputOptions& options)
{
    if (files.empty()) {
        return;
    }
    const std::string& path = files.front().path;
    droplet::writeWhole(
        isStream(path) ? "/dev/stdout" : path,
        [&](std::ostream& out) {
            files.front().write(out);
            if (out) {  // else whoever opened it knows the cause
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

void checkFiles(const std::vector<NamedFile>& inputs, const std::vector<NamedFile>& outputs,
                const droplet::OutputOptions& options)
{
    for (auto output = outputs.begin(); output != outputs.end(); ++output) {
        for (auto other = outputs.begin(); other != output; ++other) {
            if (sameFile(other->path, output->path)) {
                refuseClash(output->name, other->name, other->path);
            }
        }
        if (isStream(output->path)) {
            continue;
        }
        for (const NamedFile& input : inputs) {
            if (isStream(input.path) ? isStandardInput(output->path) : sameFile(input.path, output->path)) {
                refuseClash(output->name, input.name, output->path);
            }
        }
        droplet::checkWritable(output->path, options);
    }
}

std::vector<std::byte> readStandardInput(std::size_t max_pixels)
{
    // 16 bits of red, green, blue and alpha for every pixel, and room for headers: no picture we read takes more.
    const std::size_t longest = max_pixels * 8 + (std::size_t{1} << 20);
    std::vector<std::byte> bytes;
    std::vector<std::byte> chunk(std::size_t{1} << 16);
    for (;;) {
        const ssize_t got = read(STDIN_FILENO, chunk.data(), chunk.size());
        if (got < 0 && errno == EINTR) {
            continue;
        }
        if (got < 0) {
            throw Error(ErrorCode::InvalidInput, std::string("standard input cannot be read: ") + std::strerror(errno));
        }
        if (got == 0) {
            return bytes;
        }
        bytes.insert(bytes.end(), chunk.begin(), chunk.begin() + got);
        if (bytes.size() > longest) {
            throw Error(ErrorCode::InvalidInput,
                        "standard input is longer than any picture of " + std::to_string(max_pixels) + " pixels");
        }
    }
}

void writeTogether(const std::vector<OutputFile>& files, const droplet::OutputOptions& options)
{
    writeNested(files, options);
}

void print(const std::string& text)
{
    droplet::writeWhole("/dev/stdout", [&](std::ostream& out) { out << text; });
}

}  // namespace cli
