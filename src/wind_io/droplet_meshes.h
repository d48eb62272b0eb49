// SPDX-License-Identifier: GPL-3.0-or-later
// The meshes of a windshield's scene.
#pragma once

#include <cstddef>
#include <cstdint>

#include "droplet/windshield/glass.h"
#include "io/droplet_meshes.h"

namespace droplet {

/// Resolution of a cap.
struct CapDetail {
    std::uint32_t around = 24;
    std::uint32_t rings = 9;
};

/// Closed mesh of a cap with its base, z off the glass. Its volume is that of the true cap with contact radius 1.
/// @param angle  contact angle [rad]
DropletMesh capMesh(double angle, const CapDetail& detail);

/// Mesh of the glass, with its front to -Y.
DropletMesh glassMesh(const Glass& glass);

/// Adds the glass, its material and its node to a scene; returns the node.
std::size_t addGlass(Scene& scene, const DropletMesh& pane);

}  // namespace droplet
