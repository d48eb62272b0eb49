// SPDX-License-Identifier: GPL-3.0-or-later
// Small meshes of droplets, to be scaled.
#pragma once

#include <cstdint>

#include "droplet/body/droplet_body.h"
#include "io/droplet_meshes.h"

namespace droplet {

/// Resolution of a mesh.
struct BodyDetail {
    std::uint32_t around = 16;
    std::uint32_t rings = 6;
};

/// Volume of a droplet at rest whose contact radius is 1 m, without gravity [m³].
double unitVolume(const DropletBodies& bodies);

/// Half the length and half the width of a droplet [m].
Vec2 halfSizes(const DropletBodies& bodies, const BodyConditions& conditions);

/// Closed mesh of a droplet's body with its base, with fewer vertices. Half its length and half its width are 1 m; its
/// height makes the volume right.
/// @param conditions  on the ground
/// @param volume      of the mesh [m³]
DropletMesh unitBody(const DropletBodies& bodies, const BodyConditions& conditions, const BodyDetail& detail,
                     double volume);

/// Ball.
DropletMesh unitBall(const BodyDetail& detail, double volume);

}  // namespace droplet
