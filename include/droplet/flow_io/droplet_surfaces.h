// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "droplet/body/droplet_body.h"
#include "droplet/flow/flow.h"
#include "droplet/flow/flow_terrain.h"
#include "droplet/render/stand_water.h"
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

/// Small-scale deformations of droplets that move, by the variation of the surface below them (Fournier, Habibi and
/// Poulin 1998, section 3.4). A random field over the surface moves the contact line outward and inward. The standard
/// deviation of its distance from the middle is a share of that; it is 0 at rest, grows with the speed to `amplitude`,
/// and falls again.
struct SmallDeformation {
    double amplitude = 0.0;               ///< largest share, from 0 to 0.3
    double length = 3e-3;                 ///< over which the field varies [m], > 0
    std::uint64_t seed = 1;               ///< of the random numbers
    const FlowTerrain* ground = nullptr;  ///< shape that the droplets are on, of an object that deforms: the field is
                                          ///< that of its first shape; null: it keeps its shape

    /// Share at a speed.
    /// @param speed  along the surface [m/s] ≥ 0
    [[nodiscard]] double at(double speed) const;
};

/// What shapes droplets on an object.
struct DropletShapes {
    const DropletBodies& bodies;  ///< models of their shapes
    Vec3 gravity;                 ///< in the object's frame [m/s²]
    SmallDeformation small = {};  ///< in addition
};

/// Surfaces of all droplets in the object's frame, one after another, each with the vertices and triangles of the
/// bodies. They are open at the ground. uvs and contact angles are 0.
Surface dropletSurfaces(std::span<const FlowSample> samples, const DropletShapes& shapes);

/// Droplets for a picture.
struct SettledDroplets {
    Surface surface;  ///< in the object's frame, closed or with rims in the object; may have no triangles
    std::vector<DropletBase> bases;  ///< of those that are not in the air
};

/// Closed droplets and ponds on an object.
struct SeatedDroplets {
    Surface surface;  ///< surfaces as dropletSurfaces() makes them of all that are no ponds; their bases; ponds
    std::vector<double> volumes;  ///< of all, in the order of the samples [m³]
};

/// Closed droplets that sit on the object.
///
/// Each droplet is bent along its normal to the ground below it and keeps its volume to 1 %, unless it would become
/// three times as high. Its rim lies on the object; at edges and steps it is drawn back to them. A ball in the air
/// stays one. A pond has a level, or a dome over a brim, and ends where the ground rises over it; its volume is exact.
/// @param terrain  the object
/// @param samples  the droplets
/// @param shapes   their shapes
SeatedDroplets seatedDroplets(const FlowTerrain& terrain, std::span<const FlowSample> samples,
                              const DropletShapes& shapes);

}  // namespace droplet
