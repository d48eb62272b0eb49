// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "droplet/flow/flow_terrain.h"
#include "flow/landing.h"
#include "rays/nearest.h"

namespace droplet {

struct FlowTerrain::Content {
    explicit Content(FlowSurface of);

    FlowSurface surface;
    Landing landing;
    std::vector<double> area_until;  // area of all faces up to and with each [m²]
    Vec3 low;                        // bounding box [m]
    Vec3 high;
    NearestTriangles tree;  // scaled to [−1, 1]

    [[nodiscard]] Vec3 middle() const { return 0.5 * (low + high); }
    /// Half the longest side of the bounding box [m].
    [[nodiscard]] double halfSize() const;
    /// Whether a droplet can go from one face to another over faces that are near a place.
    [[nodiscard]] bool areJoined(std::uint32_t from, std::uint32_t to, Vec3 place, double reach) const;
};

}  // namespace droplet
