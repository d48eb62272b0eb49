// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <vector>

#include "droplet/surface/textured_mesh.h"

namespace droplet {

/// Reads an object from glTF 2.0: .glb, or .gltf with its buffers embedded or beside it. All triangles of the scene are
/// read, with their nodes' transforms. Points, lines, images and materials are ignored; skins and morphs stay at rest.
///
/// The object is turned exactly from +Y up to z up; writers that turn back to +Y up put it where its file has it.
/// uv is TEXCOORD_0 without a material's texture transform. A missing normal is the mean over the triangles around the
/// vertex, weighted by their angles there (Thürmer and Wüthrich 1998).
///
/// Guarantees: the result is valid.
/// @param path   file to read
/// @throws Error InvalidInput, naming the file: it cannot be read, is damaged, has no triangles, triangles without uv,
///               compressed data, numbers that are not finite, or more than 2²⁶ triangles
TexturedMesh readObject(const std::filesystem::path& path);

/// Paths of the buffers that a .gltf has beside it, so that a run can protect them. Other files, and files that
/// readObject() would refuse, have none.
std::vector<std::filesystem::path> buffersBeside(const std::filesystem::path& path);

}  // namespace droplet
