// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "droplet/io/output.h"
#include "numbered_path.h"

namespace cli {

/// Numbers of the frames that get a file each.
struct FrameNumbers {
    std::size_t first = 1;
    std::optional<std::size_t> last;  ///< empty: not known before the run
};

/// File that an option or argument names, or one file for every frame.
struct NamedFile {
    std::string name;                     ///< name of the option or argument, for messages
    std::string path;                     ///< or kStandardStream; with `pattern` its text
    std::optional<NumberedPath> pattern;  ///< set if every frame gets a file
    FrameNumbers numbers;                 ///< with `pattern`
    bool makes_folder = false;            ///< whether its folder is made if it does not exist, as that of a pattern is
};

/// All files that a run reads and writes. Every command lists them before it works.
struct RunFiles {
    std::vector<NamedFile> read;
    std::vector<NamedFile> written;

    /// Adds a file that is read, if its option is given, and the buffers beside it if it is a .gltf.
    void reads(const std::string& name, const std::optional<std::string>& path);
    /// Adds a file that is written, if its option is given.
    void writes(const std::string& name, const std::optional<std::string>& path);
    /// Adds a file that is written, whose folder is made if it does not exist.
    void writesInFolder(const std::string& name, const std::string& path);
    /// Adds a file for every frame that is written.
    void writesFrames(const std::string& name, const NumberedPath& pattern, const FrameNumbers& numbers);
};

/// Creates the folder of a file, if it does not exist.
/// @throws droplet::Error OutputFailed
void makeFolderOf(const std::string& path);

/// Refuses a run in which two outputs are one file, or an output is an input. Files are compared by their names,
/// without links, and by device and inode. Of patterns, all files count that the run would write. Changes nothing on
/// disk.
/// @throws droplet::Error InvalidArgument
void refuseClashes(const RunFiles& files);

/// Finds errors before any work is done: those of refuseClashes(), and outputs that cannot be written or must not be
/// replaced. Creates the folders of patterns and of files that make theirs.
/// @throws droplet::Error InvalidArgument, OutputFailed
void checkFiles(const RunFiles& files, const droplet::OutputOptions& options);

}  // namespace cli
