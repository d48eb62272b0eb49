// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "droplet/io/file_droplet.h"
#include "droplet/io/mesh_files.h"
#include "droplet/scene/compression.h"
#include "droplet/scene/format.h"
#include "droplet/surface/surface.h"

namespace droplet {

/// Options of all formats; a format ignores those that it cannot express.
struct WriteOptions {
    Material material = Material::Water;            ///< glTF, USD, 3MF, OBJ with material_file; without `droplets`
    std::optional<bool> closed = {};                ///< glTF: isClosed(surface), if already known
    LengthUnit unit = LengthUnit::Millimetre;       ///< OBJ and STL
    std::optional<std::string> material_file = {};  ///< OBJ: name of the file from writeMtl beside it
    Nodes nodes = Nodes::One;                       ///< glTF, USD and 3MF
    std::vector<FileDroplet> droplets = {};         ///< glTF, USD and 3MF as in their options; OBJ takes their looks
    std::string texture = {};                       ///< glTF and USDZ
    Compression compression = Compression::None;    ///< GLB
    std::span<const Surface> levels = {};           ///< glTF
};

/// Writes a surface to a stream in the given format. A surface without vertices (a frame without liquid) gives a file
/// without triangles.
/// @return       bytes handed to the stream, which is left failed if it did not take everything
/// @throws Error InvalidArgument, as the writer of the format does
std::uint64_t writeSurface(const Surface& surface, std::ostream& out, Format format, const WriteOptions& options = {});

/// Treatment of an existing file.
struct OutputOptions {
    bool no_clobber = false;  ///< refuse to replace a file; devices and pipes are written to all the same
};

/// Finds, without writing, reasons why writing to `path` would fail: a missing or read-only folder, a directory in the
/// file's place, an existing file that is read-only or must not be replaced.
/// @throws Error OutputFailed
void checkWritable(const std::filesystem::path& path, const OutputOptions& options = {});

/// Writes a file completely or not at all: `write` fills a temporary file beside `path`, which is flushed, checked,
/// closed and renamed to `path`. On any failure the temporary file is removed, and the old file at `path` stays.
///
/// If the file system supports it, the temporary file has no name until it is complete: even a killed process leaves
/// nothing behind, except in the instant in which an older file is replaced. Links are followed and kept, and so are an
/// existing file's permissions. With no_clobber a file that appears meanwhile is not replaced either.
/// Devices and pipes (/dev/full, /dev/stdout) are written to directly and checked.
/// @param path     file, device or pipe
/// @param write    must leave its stream failed if not all was written
/// @param options  treatment of an existing file
/// @return         bytes written
/// @throws Error   OutputFailed, naming path and cause; whatever `write` throws
std::uint64_t writeAtomically(const std::filesystem::path& path, const std::function<void(std::ostream&)>& write,
                              const OutputOptions& options = {});

/// Removes temporary files that have a name, and prevents new ones. For a signal handler that is about to end the
/// process; async-signal-safe.
void removeUnfinished() noexcept;

}  // namespace droplet
