// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>

#include "droplet/io/gltf.h"
#include "droplet/io/mesh_files.h"
#include "droplet/surface/surface.h"

namespace droplet {

/// The formats a surface can be written in.
enum class Format { Glb, Gltf, Obj, Ply, Stl };

/// The format of that name, as in `glb` or of a file's extension, as in `.GLB`.
/// @throws Error InvalidArgument, listing the names known
Format formatNamed(std::string_view name);

/// Lower-case name of a format, also its extension without the dot.
const char* name(Format format);

/// What beside the surface decides what a file says, in the formats that can say it.
struct WriteOptions {
    Material material = Material::Water;            ///< of glTF, and of OBJ with material_file
    std::optional<bool> closed = {};                ///< of glTF: isClosed(surface), where that is known already
    LengthUnit unit = LengthUnit::Millimetre;       ///< of OBJ and STL
    std::optional<std::string> material_file = {};  ///< of OBJ: the file that writeMtl made, by its name beside it
};

/// Writes a surface to a stream in the given format; one without vertices, as of a frame without liquid, as a file that
/// holds nothing.
/// @return       bytes handed to the stream, which is left failed if it did not take everything
/// @throws Error InvalidArgument as the writers of each format
std::uint64_t writeSurface(const Surface& surface, std::ostream& out, Format format, const WriteOptions& options = {});

/// How an existing output is treated.
struct OutputOptions {
    bool no_clobber = false;  ///< refuse to replace an existing file; devices and pipes are not replaced
};

/// Throws what writing to `path` later would throw, where that can be known without writing: a missing or read-only
/// folder, a directory in its place, an existing file that is read-only or must not be replaced.
/// @throws Error OutputFailed
void checkWritable(const std::filesystem::path& path, const OutputOptions& options = {});

/// Writes a file whole or not at all: `write` fills a temporary file beside `path`, which is flushed, checked, closed
/// and renamed over `path`. On any failure the temporary file is removed and what stood at `path` before stays.
///
/// Where the file system knows files without a name, the temporary file has none until it is whole: even a killed
/// process leaves nothing behind, but for the instant in which an older file is replaced. A link is followed and kept,
/// an existing file's permissions are kept. With no_clobber a file that appears meanwhile is not replaced either.
/// Devices and pipes (/dev/full, /dev/stdout) are written to directly and checked.
/// @param write  must leave its stream failed if not all was written
/// @return       bytes written
/// @throws Error OutputFailed, naming path and cause; whatever `write` throws
std::uint64_t writeWhole(const std::filesystem::path& path, const std::function<void(std::ostream&)>& write,
                         const OutputOptions& options = {});

/// Removes the temporary files that have a name, for a handler of a signal that is about to end the process; from then
/// on no write makes one. Safe in a handler of signals.
void removeUnfinished() noexcept;

}  // namespace droplet
