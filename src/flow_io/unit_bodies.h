// SPDX-License-Identifier: GPL-3.0-or-later
// Small meshes of droplets, to be scaled.
#pragma once

#include <array>
#include <cstdint>

#include "droplet/body/droplet_body.h"
#include "droplet/flow/flow_terrain.h"
#include "droplet/flow_io/droplet_surfaces.h"
#include "io/droplet_crowd.h"
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

/// Closed mesh of a droplet's body with its base, as baseTriangles() has it, with fewer vertices. Half its length and
/// half its width are 1 m; its height makes the volume right.
/// @param conditions  on the ground
/// @param volume      of the mesh [m³]
DropletMesh unitBody(const DropletBodies& bodies, const BodyConditions& conditions, const BodyDetail& detail,
                     double volume);

/// Frame of a droplet with a pose, whose file has +Y up.
DropletFrame frameOf(const DropletPose& pose);

/// Turn of a pose with such a frame.
std::array<float, 4> turnOf(const DropletFrame& frame);

/// A mesh of unitBody() as it sits on the ground in a pose.
/// @param rim  BodyDetail::around of the mesh
DropletShape seatedBody(const FlowTerrain& terrain, const DropletMesh& mesh, std::size_t rim, const DropletPose& pose);

/// A shape in a pose, in the object's frame.
DropletShape inObject(const DropletShape& shape, const DropletPose& pose);

/// Largest distance of a rim from the ground, over the contact radius.
/// @param vertices  of a mesh of unitBody(), or of seatedBody()
/// @param rim       BodyDetail::around of the mesh
double rimGap(const FlowTerrain& terrain, const std::vector<Vec3>& vertices, std::size_t rim, const DropletPose& pose);

/// Ball.
DropletMesh unitBall(const BodyDetail& detail, double volume);

/// Meshes that stand for all droplets, scaled. Each has the volume unitVolume().
struct UnitDroplets {
    DropletMesh resting;  ///< unitBody() on level ground
    DropletMesh running;  ///< unitBody() of usual length; +x is ahead
    DropletMesh falling;  ///< ball
};

/// @param volume   usual one of the droplets [m³]
/// @param gravity  [m/s²]
/// @param around   vertices around those on the ground, a multiple of 16
UnitDroplets unitDroplets(const DropletBodies& bodies, double volume, double gravity, std::uint32_t around);

}  // namespace droplet
