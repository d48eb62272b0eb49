// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "droplet/surface/surface.h"
#include "surface/atlas.h"

namespace droplet {

/// Droplets of a surface.
struct DropletNumbers {
    static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> of;  ///< droplet of every vertex; kNone without a triangle
    std::uint32_t count = 0;
};

/// Numbers the droplets in the order of their triangles.
DropletNumbers numberDroplets(const Surface& surface);

/// Charts under every vertex: hits of vertex v are [starts[v], starts[v+1]), by ascending chart.
struct Hits {
    std::vector<Hit> all;
    std::vector<std::size_t> starts;
    std::vector<bool> is_cut;  ///< of every vertex: whether the object is cut out on a chart under it

    [[nodiscard]] std::span<const Hit> at(std::size_t v) const
    {
        return std::span(all).subspan(starts[v], starts[v + 1] - starts[v]);
    }
    [[nodiscard]] const Hit* on(std::size_t v, std::uint32_t chart) const
    {
        const std::span<const Hit> hits = at(v);
        const auto found = std::find_if(hits.begin(), hits.end(), [&](const Hit& h) { return h.chart == chart; });
        return found == hits.end() ? nullptr : &*found;
    }
};

/// Finds the charts under every vertex.
/// @param flat      vertices in the picture's plane [m]
/// @param is_there  whether the object is there at a point of a facet; empty: everywhere
Hits findHits(const Surface& surface, const Atlas& atlas, const std::vector<Vec2>& flat,
              const std::function<bool(const Facet&, Vec2)>& is_there);

/// Whether a droplet is placed on the object, or why not.
enum class PlacementResult { Placed, Outside, Across, Folded, CutOut };

/// Chart of a droplet.
struct DropletPlacement {
    PlacementResult result = PlacementResult::Placed;
    std::uint32_t chart = 0;
};

/// Finds the first chart that contains all vertices, for every droplet.
std::vector<DropletPlacement> placeDroplets(const Hits& hits, const DropletNumbers& droplets);

}  // namespace droplet
