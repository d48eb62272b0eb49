// SPDX-License-Identifier: GPL-3.0-or-later
// The meshes of a scene of droplets.
#pragma once

#include <tiny_gltf.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "droplet/vector.h"
#include "droplet/windshield/glass.h"
#include "io/byte_stream.h"

namespace droplet {

/// A mesh's arrays, +Z up.
struct Net {
    std::vector<Vec3> positions;
    std::vector<Vec3> normals;
    std::vector<Triangle> triangles;
};

struct CapDetail {
    std::uint32_t around = 24;
    std::uint32_t rings = 9;
};

/// A cap with its base, of the volume that a cap of contact radius 1 has; closed, z off the glass.
/// @param angle  of contact [rad]
Net capNet(double angle, const CapDetail& detail);

/// The glass, its front to -Y.
Net glassNet(const Glass& glass);

/// Announces a mesh; its bytes are those of writeNet.
/// @return  number of the mesh
int addNet(tinygltf::Model& model, const Net& net, const char* name, int material);
void writeNet(const Net& net, ByteStream& bytes);

/// Adds the glass, its material and a node that shows it; returns the node. Its bytes are those of writeNet.
int addGlass(tinygltf::Model& model, const Net& pane);

}  // namespace droplet
