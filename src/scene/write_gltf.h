// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <iosfwd>

#include "droplet/scene/format.h"
#include "scene/scene.h"

namespace droplet {

/// The writer stores offsets as int; viewers have similar limits [bytes].
inline constexpr std::uint64_t kGltfFileLimit = std::uint64_t{1} << 31;

/// Writes a scene as glTF 2.0.
///
/// A crowd becomes skinned meshes with a joint for each copy, 62 copies in a mesh: few draw calls, which every reader
/// supports, and indices of joints fit into a byte. Two more joints are the scene's corners, since viewers compute
/// bounds once, from the first pose. A look has its extensions for transmission, ior and volume; none is required.
///
/// Compression stores vertices as integers in one cube, so that vertices which meshes share stay together; the copies
/// of a crowd have a cube of their own. A node that moves or carries others gets a child, which places the cube.
///
/// Guarantees: the same scene gives the same bytes; nothing is written if it throws.
/// @param file   Glb or Gltf
/// @return       bytes handed to the stream, which is left failed if it did not take everything
/// @throws Error InvalidArgument if the file would reach 2 GiB, or text would be compressed
std::uint64_t writeGltf(const Scene& scene, std::ostream& out, const AnimatedFile& file);

}  // namespace droplet
