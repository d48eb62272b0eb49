// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "droplet/io/output.h"
#include "droplet/surface/surface.h"

namespace droplet {

/// Surface from a file, with warnings about data that was ignored.
struct ReadSurface {
    Surface surface;                    ///< valid
    std::vector<std::string> warnings;  ///< one line each
};

/// Format of a file that readSurface reads, by its extension. A file of another extension that begins as a .glb is one,
/// such as a .vrm.
/// @throws Error InvalidArgument for other files, or a format that is only written
Format readableFormat(const std::filesystem::path& path);

/// Reads a surface in one of the formats that this library writes, but USD: glTF 2.0 (.glb, .gltf), Wavefront OBJ, PLY
/// (text or binary little-endian), STL (text or binary). The file extension decides. OBJ and STL are read in
/// millimetres, unless a comment by this library states another unit; glTF and OBJ are y up. Faces with more than three
/// corners are read as triangles about one of them; lines and points are ignored.
///
/// Vertices at exactly the same place are welded. A missing normal is the mean over the triangles around the vertex,
/// weighted by their angles there; STL has facet normals, by the winding. A PLY from this library has one normal per
/// vertex, on the rim the liquid's. Contact angles are read from glTF and PLY, texture coordinates from glTF.
/// mean_height is 0. Animations, skins and morph targets of glTF are ignored, with a warning.
///
/// Guarantees: the surface is valid.
/// @param path   file to read
/// @throws Error InvalidArgument for an unknown extension; InvalidInput, naming the file: it cannot be read, is
///               damaged, has no triangles, numbers that are not finite, or more than 2²⁶ triangles
ReadSurface readSurface(const std::filesystem::path& path);

}  // namespace droplet
