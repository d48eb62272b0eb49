// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include "droplet/colours/colour_domain.h"

namespace droplet::testing {

/// Footprints of regions of a width [m].
/// @param edge  as in ColourTraceOptions
inline ColourDomain tracedAt(const ColourRegions& regions, double width, std::optional<double> edge = std::nullopt)
{
    ColourTraceOptions options;
    options.trace.width = width;
    options.edge = edge;
    return traceColours(regions, options);
}

inline std::vector<Loop> loopsOf(const ColourDomain& traced)
{
    std::vector<Loop> loops;
    for (const Footprint& footprint : traced.domain.droplets) {
        loops.push_back(footprint.rim);
        loops.insert(loops.end(), footprint.holes.begin(), footprint.holes.end());
    }
    return loops;
}

inline double totalArea(const ColourDomain& traced)
{
    double sum = 0.0;
    for (const Footprint& footprint : traced.domain.droplets) {
        sum += area(footprint);
    }
    return sum;
}

using Edge = std::tuple<double, double, double, double>;

/// Edges that no neighbour has in the other direction.
inline std::vector<Edge> outerEdges(const ColourDomain& traced)
{
    std::map<Edge, int> edges;
    for (const Loop& loop : loopsOf(traced)) {
        for (std::size_t i = 0; i < loop.points.size(); ++i) {
            const Vec2 a = loop.points[i];
            const Vec2 b = loop.points[(i + 1) % loop.points.size()];
            ++edges[{a.x, a.y, b.x, b.y}];
        }
    }
    std::vector<Edge> outer;
    for (const auto& [edge, count] : edges) {
        EXPECT_EQ(count, 1) << "an edge of two droplets on the same side";
        const auto& [ax, ay, bx, by] = edge;
        if (edges.count({bx, by, ax, ay}) == 0) {
            outer.push_back(edge);
        }
    }
    return outer;
}

}  // namespace droplet::testing
