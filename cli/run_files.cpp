// SPDX-License-Identifier: GPL-3.0-or-later
#include "run_files.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <map>
#include <string_view>
#include <system_error>
#include <utility>

#include "canonical_paths.h"
#include "droplet/error.h"
#include "droplet/io/object.h"
#include "file_node.h"
#include "files.h"
#include "library_message.h"
#include "option_values.h"
#include "path_separators.h"

namespace cli {
namespace {

namespace fs = std::filesystem;

bool contains(const FrameNumbers& numbers, std::size_t number)
{
    return number >= numbers.first && (!numbers.last || number <= *numbers.last);
}

/// Numbers of a pattern's existing files that the run would write.
std::vector<std::size_t> existingNumbers(const NamedFile& frames)
{
    std::vector<std::size_t> numbers = frames.pattern->numbers();
    std::erase_if(numbers, [&](std::size_t number) { return !contains(frames.numbers, number); });
    return numbers;
}

/// Number of a file that another pattern of the same folder writes, too.
std::optional<std::size_t> commonNumber(const NamedFile& a, const NamedFile& b)
{
    // Names that first agree at a later number need a run of over 100,000 frames.
    constexpr std::size_t kMost = 100'000;
    const std::size_t last =
        std::min(a.numbers.last.value_or(std::numeric_limits<std::size_t>::max()), a.numbers.first + kMost);
    for (std::size_t number = a.numbers.first; number <= last; ++number) {
        const auto other = b.pattern->numberIn(a.pattern->nameAt(number));
        if (other && contains(b.numbers, *other)) {
            return number;
        }
    }
    return std::nullopt;
}

/// Files by canonical path and by inode, so that links and hard links are found, too.
class KnownFiles {
public:
    /// File that is known, and the path that it shares.
    struct Match {
        const NamedFile* file;
        std::string path;
    };

    /// @param stream  what kStandardStream stands for
    KnownFiles(CanonicalPaths& paths, Stream stream) : paths_(paths), stream_(stream) {}

    void add(const NamedFile& file)
    {
        if (file.pattern) {
            patterns_.emplace_back(folderOf(*file.pattern), &file);
            for (const std::size_t number : existingNumbers(file)) {
                addNode(cli::nodeOf(file.pattern->at(number)), file);
            }
            return;
        }
        if (by_path_.try_emplace(isStream(file.path) ? file.path : paths_.of(file.path), &file).second) {
            addNode(nodeOf(file), file);
        }
    }

    /// Known file that is one of the given file or pattern.
    std::optional<Match> find(const NamedFile& file)
    {
        return file.pattern ? findFrames(file) : findFile(file.path, nodeOf(file));
    }

private:
    [[nodiscard]] std::optional<FileNode> nodeOf(const NamedFile& file) const
    {
        return isStream(file.path) ? cli::nodeOf(stream_) : cli::nodeOf(file.path);
    }

    void addNode(const std::optional<FileNode>& node, const NamedFile& file)
    {
        if (node) {
            by_node_.try_emplace(*node, &file);
        }
    }

    std::string folderOf(const NumberedPath& pattern)
    {
        return fs::path(paths_.of(pattern.at(0))).parent_path().string();
    }

    std::optional<Match> findFile(const std::string& path, const std::optional<FileNode>& node)
    {
        const std::string canonical = isStream(path) ? path : paths_.of(path);
        if (const auto known = by_path_.find(canonical); known != by_path_.end()) {
            return Match{known->second, path};
        }
        for (const auto& [folder, frames] : patterns_) {
            if (isFrame(canonical, folder, *frames)) {
                return Match{frames, path};
            }
        }
        const auto known = node ? by_node_.find(*node) : by_node_.end();
        return known == by_node_.end() ? std::nullopt : std::optional(Match{known->second, path});
    }

    std::optional<Match> findFrames(const NamedFile& frames)
    {
        for (const std::size_t number : existingNumbers(frames)) {
            const std::string path = frames.pattern->at(number);
            if (auto match = findFile(path, cli::nodeOf(path))) {
                return match;
            }
        }
        const std::string folder = folderOf(*frames.pattern);
        for (const auto& [path, file] : by_path_) {
            if (isFrame(path, folder, frames)) {
                return Match{file, file->path};
            }
        }
        for (const auto& [other_folder, other] : patterns_) {
            if (const auto number = other_folder == folder ? commonNumber(frames, *other) : std::nullopt) {
                return Match{other, frames.pattern->at(*number)};
            }
        }
        return std::nullopt;
    }

    /// Whether a canonical path is one of the files of a pattern in a canonical folder.
    static bool isFrame(const std::string& path, const std::string& folder, const NamedFile& frames)
    {
        const std::size_t slash = path.find_last_of(kPathSeparators.data());
        if (slash == std::string::npos || std::string_view(path).substr(0, slash) != folder) {
            return false;
        }
        const auto number = frames.pattern->numberIn(path.substr(slash + 1));
        return number && contains(frames.numbers, *number);
    }

    CanonicalPaths& paths_;
    Stream stream_;
    std::map<std::string, const NamedFile*> by_path_;
    std::map<FileNode, const NamedFile*> by_node_;
    std::vector<std::pair<std::string, const NamedFile*>> patterns_;  ///< with their canonical folders
};

/// Refuses outputs that exist.
void refuseReplacing(const RunFiles& files)
{
    const droplet::OutputOptions options{true};
    std::error_code ignored;
    for (const NamedFile& output : files.written) {
        if (output.pattern) {
            for (const std::size_t number : existingNumbers(output)) {
                droplet::checkWritable(output.pattern->at(number), options);
            }
        } else if (!isStream(output.path) && fs::exists(output.path, ignored)) {
            droplet::checkWritable(output.path, options);
        }
    }
}

}  // namespace

void RunFiles::reads(const std::string& name, const std::optional<std::string>& path)
{
    if (path) {
        read.push_back({name, *path, {}, {}});
        for (const fs::path& buffer : droplet::buffersBeside(*path)) {
            read.push_back({"a buffer of " + name, buffer.string(), {}, {}});
        }
    }
}

void RunFiles::writes(const std::string& name, const std::optional<std::string>& path)
{
    if (path) {
        written.push_back({name, *path, {}, {}});
    }
}

void RunFiles::writesInFolder(const std::string& name, const std::string& path)
{
    writes(name, path);
    written.back().makes_folder = true;
}

void RunFiles::writesFrames(const std::string& name, const NumberedPath& pattern, const FrameNumbers& numbers)
{
    written.push_back({name, pattern.text(), pattern, numbers});
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

void refuseClashes(const RunFiles& files)
{
    CanonicalPaths paths;
    KnownFiles read(paths, Stream::Input);
    for (const NamedFile& input : files.read) {
        read.add(input);
    }
    KnownFiles written(paths, Stream::Output);
    const auto refuse_clash = [](const NamedFile& output, const KnownFiles::Match& other) {
        refuse(output.name + " and " + other.file->name + " are the same, '" + other.path +
               "'; they must be different files");
    };
    for (const NamedFile& output : files.written) {
        if (const auto other = written.find(output)) {
            refuse_clash(output, *other);
        }
        written.add(output);
        if (isStream(output.path)) {
            continue;
        }
        if (const auto input = read.find(output)) {
            refuse_clash(output, *input);
        }
    }
}

void checkFiles(const RunFiles& files, const droplet::OutputOptions& options)
{
    refuseClashes(files);
    inTermsOf({}, files, [&] {
        if (options.no_clobber) {
            refuseReplacing(files);
        }
        // Folders are made after all that could refuse the run in them, and before files beside their frames are
        // checked.
        for (const NamedFile& output : files.written) {
            if (output.pattern) {
                makeFolderOf(output.pattern->at(output.numbers.first));
            } else if (output.makes_folder) {
                makeFolderOf(output.path);
            }
        }
        for (const NamedFile& output : files.written) {
            if (output.pattern) {
                droplet::checkWritable(output.pattern->at(output.numbers.first), options);
            } else if (!isStream(output.path)) {
                droplet::checkWritable(output.path, options);
            }
        }
    });
}

}  // namespace cli
