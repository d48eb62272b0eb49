// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/carry_points.h"

#include <algorithm>
#include <complex>
#include <cstddef>
#include <cstdint>

namespace droplet {
namespace {

using Place = std::complex<double>;

/// Edge of a rim that moves.
struct Edge {
    Place from;
    Place side;
    Place moved_from;
    Place turn;  ///< and growth
};

std::vector<Edge> edgesOf(const PlanarMesh& before, const PlanarMesh& after)
{
    const auto at = [](const PlanarMesh& mesh, std::uint32_t v) {
        return Place(mesh.vertices[v].x, mesh.vertices[v].y);
    };
    std::vector<Edge> edges;
    for (std::size_t loop = 0; loop < before.loopCount(); ++loop) {
        for (std::uint32_t v = before.loop_starts[loop]; v < before.loop_starts[loop + 1]; ++v) {
            const std::uint32_t next = nextOnRim(before, loop, v);
            const Place side = at(before, next) - at(before, v);
            edges.push_back({at(before, v), side, at(after, v), (at(after, next) - at(after, v)) / side});
        }
    }
    return edges;
}

/// Squared distance of a place to an edge, over the squared length of the edge.
double squaredDistance(const Edge& edge, Place place)
{
    const Place along = (place - edge.from) / edge.side;
    return std::norm(along - std::clamp(along.real(), 0.0, 1.0));
}

}  // namespace

std::vector<Vec2> carryPoints(const PlanarMesh& before, const PlanarMesh& after, const std::vector<Vec2>& points)
{
    // Below this squared distance a point is on the edge; above it, the edge counts by the inverse fourth power, so
    // that those two at a corner decide about points there.
    constexpr double kOn = 1e-20;
    const std::vector<Edge> edges = edgesOf(before, after);
    std::vector<Vec2> moved;
    moved.reserve(points.size());
    for (const Vec2 point : points) {
        const Place place{point.x, point.y};
        Place motion;
        double total = 0.0;
        for (const Edge& edge : edges) {
            const double distance = std::norm(edge.side) * (squaredDistance(edge, place) + kOn);
            const double weight = std::abs(edge.side) / (distance * distance);
            motion += weight * (edge.moved_from - edge.from + (edge.turn - 1.0) * (place - edge.from));
            total += weight;
        }
        const Place there = place + motion / total;
        moved.push_back({there.real(), there.imag()});
    }
    return moved;
}

}  // namespace droplet
