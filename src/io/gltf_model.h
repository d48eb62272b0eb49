// SPDX-License-Identifier: GPL-3.0-or-later
// What all glTF files of ours are made of.
#pragma once

#include <tiny_gltf.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <ostream>
#include <vector>

#include "droplet/io/gltf.h"
#include "droplet/vector.h"
#include "io/byte_stream.h"

namespace droplet {

// The writer keeps offsets in int; viewers' limits are of the same order.
inline constexpr std::uint64_t kGltfFileLimit = std::uint64_t{1} << 31;

// 65535 restarts primitives; with fewer vertices it can be no index.
inline constexpr std::size_t kVerticesBeyond16Bit = 65535;

/// @param thickness  of a closed surface's liquid, where no thickness is known to viewers [m]
/// @throws Error     InvalidArgument if there is no such material
tinygltf::Material makeMaterial(Material material, double thickness, bool closed);

/// A model of one material, with the extensions it uses.
tinygltf::Model makeBareModel(Material material, double thickness, bool closed);

std::size_t bufferBytes(const tinygltf::Model& model);

/// Puts an array behind the last one in the buffer, at the next word; returns the accessor on it.
/// @param target  of the view; 0: none
int addArray(tinygltf::Model& model, int target, int component_type, int type, std::size_t count);
/// An array of floats for each vertex.
int addVertexArray(tinygltf::Model& model, int type, std::size_t count);
/// Indices of that many triangles, as wide as that many vertices need.
int addIndices(tinygltf::Model& model, std::size_t triangles, std::size_t vertices);
/// Bounds of vectors, as the floats they become, y up.
void addBounds(tinygltf::Accessor& accessor, const std::vector<Vec3>& vectors);

/// The model as JSON, with its buffer's length, but not its bytes.
nlohmann::json jsonOf(const tinygltf::Model& model);

/// Vectors turned to y up, as floats.
void writeVectors(const std::vector<Vec3>& vectors, ByteStream& bytes);
void writeIndices(const std::vector<Triangle>& triangles, std::size_t vertices, ByteStream& bytes);

/// Writes a GLB.
/// @param write_buffer  writes the bytes of the model's buffer
/// @return              bytes written
std::uint64_t writeBinary(std::ostream& out, const tinygltf::Model& model,
                          const std::function<void(ByteStream&)>& write_buffer);

}  // namespace droplet
