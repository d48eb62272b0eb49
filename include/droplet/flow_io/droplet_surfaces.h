// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "droplet/body/droplet_body.h"
#include "droplet/flow/flow.h"
#include "droplet/flow/flow_terrain.h"
#include "droplet/surface/surface.h"
#include "droplet/vector.h"

namespace droplet {

/// Place and direction of a droplet in the object's frame: x runs ahead along the surface, z is the surface's normal.
struct DropletFrame {
    Vec3 place;   ///< [m]
    Vec3 ahead;   ///< unit
    Vec3 left;    ///< unit
    Vec3 normal;  ///< unit
};

/// Frame of a droplet: ahead is its velocity along the surface, at rest the part of gravity along it, on level ground
/// any fixed direction.
/// @param sample   the droplet
/// @param gravity  in the object's frame [m/s²]
DropletFrame frameOf(const FlowSample& sample, Vec3 gravity);

/// What shapes a droplet, in its frame.
BodyConditions conditionsOf(const FlowSample& sample, Vec3 gravity);

/// Surfaces of all droplets in the object's frame, one after another, each with the vertices and triangles of `bodies`.
/// They are open at the ground. uvs and contact angles are 0.
/// @param samples  the droplets
/// @param bodies   their shapes
/// @param gravity  in the object's frame [m/s²]
Surface dropletSurfaces(std::span<const FlowSample> samples, const DropletBodies& bodies, Vec3 gravity);

/// Closed droplets that sit on the object: surfaces as dropletSurfaces() makes them, followed by their bases.
///
/// Each droplet is bent along its normal to the ground below it and keeps its volume to 1 %, unless it would become
/// three times as high. Its rim lies on the object; at edges and steps it is drawn back to them. A ball in the air
/// stays one.
/// @param terrain  the object
/// @param samples  the droplets
/// @param bodies   their shapes
/// @param gravity  in the object's frame [m/s²]
Surface seatedDroplets(const FlowTerrain& terrain, std::span<const FlowSample> samples, const DropletBodies& bodies,
                       Vec3 gravity);

/// Volumes of the droplets in a surface of seatedDroplets() [m³], in their order.
/// @param seated  the surface
/// @param count   number of its droplets
/// @param bodies  their shapes
std::vector<double> seatedVolumes(const Surface& seated, std::size_t count, const DropletBodies& bodies);

}  // namespace droplet
