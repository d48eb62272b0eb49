// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "droplet/flow/flow_droplet.h"
#include "droplet/flow/flow_terrain.h"
#include "flow/landing.h"
#include "rays/nearest.h"

namespace droplet {

struct FlowTerrain::Content {
    Content(FlowSurface of, GroundMotion moving, std::shared_ptr<const FlowSurface> at_rest);

    FlowSurface surface;
    GroundMotion motion;
    std::shared_ptr<const FlowSurface> rest;  // shape that what varies over the surface belongs to; null: this one
    NearestTriangles tree;                    // scaled to [−1, 1]
    Landing landing;
    std::vector<double> area_until;  // area of all faces up to and with each [m²]
    Vec3 low;                        // bounding box [m]
    Vec3 high;

    [[nodiscard]] Vec3 middle() const { return 0.5 * (low + high); }
    /// What a droplet feels of the ground's motion: that it accelerates, and for one that moves over the ground, that
    /// it turns and stretches [m/s²].
    [[nodiscard]] Vec3 feltOn(const FlowDroplet& droplet, double time) const;
    /// Half the longest side of the bounding box [m].
    [[nodiscard]] double halfSize() const;
};

}  // namespace droplet
