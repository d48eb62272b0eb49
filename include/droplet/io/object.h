// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "droplet/surface/textured_mesh.h"

namespace droplet {

/// Reads an object from glTF 2.0: .glb, or .gltf with its buffers embedded or beside it. All triangles of the scene,
/// with their nodes' transforms; points, lines, images and materials are passed over, skins and morphs stay at rest.
///
/// From glTF's +Y up it is turned to z up, exactly, so that writers that turn back to +Y up put things where the
/// object's file has them. uv is TEXCOORD_0 as it stands, without a material's texture transform. Missing normals are
/// those of the triangles around a place, weighted by their angles there (Thürmer and Wüthrich 1998).
///
/// Guarantees: the result is valid.
/// @throws Error InvalidInput, naming the file, where it cannot be read, is damaged, has no triangles, a mesh of
///               triangles without uv, compressed or sparse data, numbers that are not finite, or beyond 2²⁶ triangles
TexturedMesh readObject(const std::filesystem::path& path);

}  // namespace droplet
