// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "droplet/surface/surface.h"

namespace droplet {

/// A surface from a file, and what of the file it does not hold.
struct ReadSurface {
    Surface surface;
    std::vector<std::string> warnings;  ///< a line each
};

/// Reads a surface from a file as this library writes them: glTF 2.0 (.glb, .gltf), Wavefront OBJ, PLY (text or binary
/// little-endian), STL (text or binary), by its extension. OBJ and STL are taken to be in millimetres, or what a file
/// of ours says, glTF and OBJ to be y up. All triangles are read; other faces are refused, lines and points passed
/// over.
///
/// Vertices at the very same place are welded. Missing normals are those of the triangles around a place, weighted by
/// their angles there; STL's are the facets' own, by their winding. A PLY of ours has one normal for every place,
/// on the rim the liquid's. Contact angles are read where glTF or PLY have them, texture coordinates from glTF.
/// mean_height is 0. What moves in glTF is taken at rest, with a warning.
///
/// Guarantees: the surface is valid.
/// @throws Error InvalidArgument for extensions of no known format; InvalidInput, naming the file, where it cannot be
///               read, is damaged, has no triangles, numbers that are not finite, or beyond 2²⁶ triangles
ReadSurface readSurface(const std::filesystem::path& path);

}  // namespace droplet
