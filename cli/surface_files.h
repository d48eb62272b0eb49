// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "droplet/io/output.h"
#include "droplet/surface/surface.h"
#include "files.h"

namespace cli {

/// The .mtl file beside an .obj file; none for other names, formats and standard output.
std::optional<std::string> materialFile(const std::string& path, droplet::Format format);

/// Where a surface goes, and how.
struct SurfaceTarget {
    std::string path;
    droplet::Format format = droplet::Format::Glb;
    droplet::WriteOptions options;
};

/// A surface's file, and that of its material if it has one. The surface and `bytes` must live until they are written.
/// @param bytes  gets the length of the first
std::vector<OutputFile> surfaceFiles(const droplet::Surface& surface, SurfaceTarget target, std::uint64_t& bytes);

}  // namespace cli
