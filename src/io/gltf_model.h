// SPDX-License-Identifier: GPL-3.0-or-later
// Common parts of the glTF writers.
#pragma once

#include <tiny_gltf.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <ostream>
#include <vector>

#include "droplet/io/gltf.h"
#include "droplet/surface/material.h"
#include "droplet/vector.h"
#include "io/byte_stream.h"

namespace droplet {

// The writer stores offsets as int; viewers have similar limits.
inline constexpr std::uint64_t kGltfFileLimit = std::uint64_t{1} << 31;

// Index 65535 restarts primitives; with fewer vertices it does not occur.
inline constexpr std::size_t kVerticesBeyond16Bit = 65535;

/// @param thickness  of the liquid under a closed surface, for viewers that do not measure it [m]
tinygltf::Material makeMaterial(const Look& look, double thickness, bool closed);

/// Adds a material and the extensions it uses to a model; returns its index.
int addMaterial(tinygltf::Model& model, const Look& look, double thickness, bool closed);

/// Model without content.
tinygltf::Model makeEmptyModel();

/// Model with one material and the extensions it uses.
/// @throws Error  InvalidArgument if there is no such material
tinygltf::Model makeBareModel(Material material, double thickness, bool closed);

std::size_t bufferBytes(const tinygltf::Model& model);

/// Appends an array to the buffer, aligned to a word; returns the index of its accessor.
/// @param target  target of the buffer view; 0: none
int addArray(tinygltf::Model& model, int target, int component_type, int type, std::size_t count);
/// Filters of a texture where it is smaller and larger than its picture: TINYGLTF_TEXTURE_FILTER_…
struct TextureFilters {
    int min = -1;
    int mag = -1;
};
/// Appends the bytes of a PNG to the buffer, as a texture that is clamped at its edges; returns the texture's index.
/// @param name  of the picture
int addTexture(tinygltf::Model& model, const char* name, std::size_t bytes, const TextureFilters& filters);
/// Appends an array of floats per vertex.
int addVertexArray(tinygltf::Model& model, int type, std::size_t count);
/// Appends indices of triangles, 16-bit or 32-bit depending on the number of vertices.
int addIndices(tinygltf::Model& model, std::size_t triangles, std::size_t vertices);
/// Adds the bounds of vectors, rounded to floats, y up.
void addBounds(tinygltf::Accessor& accessor, const std::vector<Vec3>& vectors);

/// The model as JSON, with the length of its buffer but without the bytes.
nlohmann::json jsonOf(const tinygltf::Model& model);

/// Writes vectors as floats, turned to y up.
void writeVectors(const std::vector<Vec3>& vectors, ByteStream& bytes);
void writeIndices(const std::vector<Triangle>& triangles, std::size_t vertices, ByteStream& bytes);

/// Writes a GLB.
/// @param write_buffer  writes the bytes of the model's buffer
/// @return              bytes written
std::uint64_t writeBinary(std::ostream& out, const tinygltf::Model& model,
                          const std::function<void(ByteStream&)>& write_buffer);
/// Writes a GLB from JSON, with a buffer of the given length in bytes.
std::uint64_t writeBinary(std::ostream& out, const nlohmann::json& content, std::size_t length,
                          const std::function<void(ByteStream&)>& write_buffer);

}  // namespace droplet
