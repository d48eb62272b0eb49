// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "droplet/surface/textured_mesh.h"

namespace droplet {

/// Axis that points up in a file.
enum class UpAxis { Y, Z };

/// How an object is read.
struct ObjectOptions {
    std::optional<double> scale = {};  ///< factor on the file's lengths, > 0
    std::optional<double> size = {};   ///< longest edge of the box around the object [m], > 0; not with `scale`
    std::optional<UpAxis> up = {};     ///< empty: y, in PLY z; ignored for glTF
    bool weights = false;              ///< read the vertices' weights; a TexturedMesh has none
};

/// Reads an object with texture coordinates: .glb, .gltf with its buffers embedded or beside it, .obj or .ply. All
/// triangles of a scene are read, with their nodes' transforms; polygons are divided into triangles. Points, lines,
/// images and materials are ignored; skins and morphs stay at rest. OBJ is in millimetres, unless a comment of this
/// library states another unit.
///
/// The object is turned exactly from +Y up to z up; writers that turn back to +Y up put it where its file has it.
/// uv is TEXCOORD_0 without a material's texture transform, or `vt`. A missing normal is the mean over the triangles
/// around the vertex, weighted by their angles there (Thürmer and Wüthrich 1998).
///
/// Guarantees: the result is valid.
/// @param path     file to read
/// @param options  scale, size and axes
/// @throws Error   InvalidArgument for an unknown extension or options; InvalidInput, naming the file: it cannot be
///                 read, is damaged, has no triangles, triangles without uv, compressed data, numbers that are not
///                 finite, more than 2²⁶ triangles, or is too small or too large to compute with
TexturedMesh readObject(const std::filesystem::path& path, const ObjectOptions& options = {});

/// Paths of the buffers that a .gltf has beside it, so that a run can protect them. Other files, and files that
/// readObject() would refuse, have none.
std::vector<std::filesystem::path> buffersBeside(const std::filesystem::path& path);

}  // namespace droplet
