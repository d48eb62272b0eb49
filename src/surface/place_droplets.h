// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "droplet/surface/surface.h"
#include "surface/atlas.h"

namespace droplet {

/// The droplets of a surface.
struct DropletNumbers {
    static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> of;  ///< every vertex its own; kNone for vertices of no triangle
    std::uint32_t count = 0;
};

DropletNumbers numberDroplets(const Surface& surface);

/// Where every vertex lies: hits of vertex v are [starts[v], starts[v+1]), by ascending chart.
struct Hits {
    std::vector<Hit> all;
    std::vector<std::size_t> starts;

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

/// @param flat  every vertex in the picture's plane [m]
Hits findHits(const Surface& surface, const Atlas& atlas, const std::vector<Vec2>& flat);

/// Why a droplet is not laid, or on which chart.
enum class Fate { Laid, Outside, Across, Folded };

struct Placing {
    Fate fate = Fate::Laid;
    std::uint32_t chart = 0;
};

/// For every droplet the first chart that has all its vertices.
std::vector<Placing> placeDroplets(const Hits& hits, const DropletNumbers& droplets);

}  // namespace droplet
