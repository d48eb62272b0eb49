// SPDX-License-Identifier: GPL-3.0-or-later
#include "files.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <ostream>
#include <span>
#include <string_view>
#include <system_error>
#include <utility>

#include "canonical_paths.h"
#include "droplet/error.h"

namespace cli {
namespace {

namespace fs = std::filesystem;
using droplet::Error;
using droplet::ErrorCode;

/// Files by path and by inode, so that hard links are found, too.
class KnownFiles {
public:
    explicit KnownFiles(const std::vector<NamedFile>& files = {})
    {
        for (const NamedFile& file : files) {
            add(file);
        }
    }

    void add(const NamedFile& file)
    {
        by_path_.try_emplace(canonicalPath(file), &file);
        if (const auto node = nodeOf(file)) {
            by_node_.try_emplace(*node, &file);
        }
    }

    /// Known file that is the same; null if there is none.
    const NamedFile* find(const NamedFile& file)
    {
        if (const auto known = by_path_.find(canonicalPath(file)); known != by_path_.end()) {
            return known->second;
        }
        const auto node = nodeOf(file);
        const auto known = node ? by_node_.find(*node) : by_node_.end();
        return known == by_node_.end() ? nullptr : known->second;
    }

private:
    std::string canonicalPath(const NamedFile& file) { return isStream(file.path) ? file.path : paths_.of(file.path); }

    static std::optional<FileNode> nodeOf(const NamedFile& file)
    {
        return isStream(file.path) ? std::nullopt : cli::nodeOf(file.path);
    }

    CanonicalPaths paths_;
    std::map<std::string, const NamedFile*> by_path_;
    std::map<FileNode, const NamedFile*> by_node_;
};

/// Whether a path is the file that standard input reads, as in `program - out < out`.
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

[[noreturn]] void refuseUnreadable(const std::string& name)
{
    throw Error(ErrorCode::InvalidInput, name + " cannot be read: " + std::strerror(errno));
}

void readAll(int file, const std::string& name, const std::function<void(std::span<const std::byte>)>& take)
{
    std::vector<std::byte> part(std::size_t{1} << 18);
    for (;;) {
        const ssize_t got = read(file, part.data(), part.size());
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

void checkFiles(const std::vector<NamedFile>& inputs, const std::vector<NamedFile>& outputs,
                const droplet::OutputOptions& options)
{
    KnownFiles read(inputs);
    const auto stream = std::find_if(inputs.begin(), inputs.end(), [](const NamedFile& f) { return isStream(f.path); });
    KnownFiles written;
    for (const NamedFile& output : outputs) {
        if (const NamedFile* other = written.find(output)) {
            refuseClash(output.name, other->name, other->path);
        }
        written.add(output);
        if (isStream(output.path)) {
            continue;
        }
        if (const NamedFile* input = read.find(output)) {
            refuseClash(output.name, input->name, output.path);
        }
        if (stream != inputs.end() && isStandardInput(output.path)) {
            refuseClash(output.name, stream->name, output.path);
        }
        if (output.makes_folder) {
            makeFolderOf(output.path);
        }
        droplet::checkWritable(output.path, options);
    }
}

void makeFolderOf(const std::string& path)
{
    const fs::path folder = fs::path(path).parent_path();
    std::error_code failure;
    if (!folder.empty() && !fs::is_directory(folder, failure) && !fs::create_directories(folder, failure) && failure) {
        throw droplet::Error(droplet::ErrorCode::OutputFailed,
                             "folder " + folder.string() + " cannot be created: " + failure.message());
    }
}

bool isPicture(const std::string& path)
{
    constexpr std::array<std::string_view, 16> kExtensions{".png",  ".jpg", ".jpeg", ".bmp", ".tif", ".tiff",
                                                           ".webp", ".pbm", ".pgm",  ".ppm", ".pnm", ".svg",
                                                           ".svgz", ".jp2", ".exr",  ".hdr"};
    std::string extension = fs::path(path).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return std::find(kExtensions.begin(), kExtensions.end(), extension) != kExtensions.end();
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
