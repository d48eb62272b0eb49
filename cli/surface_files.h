// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "droplet/io/output.h"
#include "droplet/io/report.h"
#include "droplet/render/object_stand.h"
#include "droplet/surface/surface.h"
#include "droplet_options.h"
#include "files.h"

namespace cli {

/// Path of the .mtl file beside an .obj file; nothing for other names, formats and standard output.
/// @throws droplet::Error InvalidArgument: the .obj cannot hold its name
std::optional<std::string> materialFile(const std::string& path, droplet::Format format);

/// Path of a file beside another one, with `-word` before its ending: `logo-lod1.obj`.
std::string pathBeside(const std::string& path, const std::string& word);

/// Paths of the surfaces with fewer triangles; none in glTF, whose file holds them.
std::vector<std::string> levelPaths(const std::string& path, droplet::Format format, std::size_t count);

/// Levels of detail of a surface, but the first.
struct Levels {
    std::vector<droplet::Surface> surfaces;
    std::vector<droplet::LevelReport> reports;
    std::vector<std::string> warnings;  ///< of those with more triangles than asked for
};

/// Makes the levels of detail that the settings ask for.
/// @param whole   surface with two copies of its rim, which levels keep as a crease; they are joined if settings.weld.
///                One without triangles, a frame without liquid, has levels without any, and no reports
/// @param output  path of the surface's file
/// @throws droplet::Error InvalidArgument
Levels makeLevels(const droplet::Surface& whole, const DropletSettings& settings, const std::string& output,
                  droplet::Format format);

/// Surface that lies deeper in the ground.
/// @param depth  [m]
droplet::Surface lowered(droplet::Surface surface, double depth);

/// Path and format of a surface's file.
struct SurfaceTarget {
    std::string path;
    droplet::Format format = droplet::Format::Glb;
    droplet::WriteOptions options;
    const droplet::ObjectStand* object = nullptr;  ///< which the file has, too, with the surface on it; null: none
};

/// Writes a surface, and the object that it lies on if there is one; the path stays unused.
/// @return                bytes handed to the stream, which is left failed if it did not take everything
/// @throws droplet::Error InvalidArgument
std::uint64_t writeSurface(const droplet::Surface& surface, std::ostream& out, const SurfaceTarget& target);

/// Files of a surface and, in OBJ, its material; and of its levels. `surface`, object, levels and `bytes` must live
/// until they are written.
/// @param bytes  receives the size of the surface's file
std::vector<OutputFile> surfaceFiles(const droplet::Surface& surface, SurfaceTarget target, std::uint64_t& bytes);

}  // namespace cli
