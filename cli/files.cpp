// SPDX-License-Identifier: GPL-3.0-or-later
#include "files.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <map>
#include <optional>
#include <ostream>
#include <span>
#include <string_view>
#include <system_error>
#include <utility>

#include "droplet/error.h"

namespace cli {
namespace {

namespace fs = std::filesystem;
using droplet::Error;
using droplet::ErrorCode;

/// Files by their place and, whatever they are called, by what they are.
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
        places_.try_emplace(placeOf(file), &file);
        if (const auto node = nodeOf(file)) {
            nodes_.try_emplace(*node, &file);
        }
    }

    /// The file that this one is; none if it is new.
    [[nodiscard]] const NamedFile* find(const NamedFile& file) const
    {
        if (const auto place = places_.find(placeOf(file)); place != places_.end()) {
            return place->second;
        }
        const auto node = nodeOf(file);
        const auto known = node ? nodes_.find(*node) : nodes_.end();
        return known == nodes_.end() ? nullptr : known->second;
    }

private:
    using Node = std::pair<dev_t, ino_t>;

    static fs::path placeOf(const NamedFile& file)
    {
        std::error_code ignored;
        return isStream(file.path) ? fs::path(file.path)
                                   : fs::weakly_canonical(fs::absolute(file.path, ignored), ignored);
    }

    static std::optional<Node> nodeOf(const NamedFile& file)
    {
        struct stat status = {};
        if (isStream(file.path) || stat(file.path.c_str(), &status) != 0) {
            return std::nullopt;
        }
        return Node(status.st_dev, status.st_ino);
    }

    std::map<fs::path, const NamedFile*> places_;
    std::map<Node, const NamedFile*> nodes_;
};

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
    const KnownFiles read(inputs);
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
        droplet::checkWritable(output.path, options);
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
