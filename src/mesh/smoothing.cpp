// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/smoothing.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace droplet {
namespace {

/// Cotangent of the angle at a between b and c, counter-clockwise.
double cotangent(Vec2 a, Vec2 b, Vec2 c)
{
    return dot(b - a, c - a) / cross(b - a, c - a);
}

/// Cotangent of a triangle's smallest angle; infinity if the triangle is not counter-clockwise.
double largestCotangent(Vec2 a, Vec2 b, Vec2 c)
{
    const double twice = cross(b - a, c - a);
    if (!(twice > 0.0)) {
        return std::numeric_limits<double>::infinity();
    }
    return std::max({dot(b - a, c - a), dot(c - b, a - b), dot(a - c, b - c)}) / twice;
}

/// Movable vertices of a mesh, with the triangles around them.
class Smoothing {
public:
    Smoothing(PlanarMesh& mesh, const SmoothRange& range)
        : mesh_(mesh), range_(range), starts_(range.end_vertex - range.first_vertex + 1, 0)
    {
        forEachMovableCorner([&](std::size_t i, std::uint32_t) { ++starts_[i + 1]; });
        for (std::size_t i = 1; i < starts_.size(); ++i) {
            starts_[i] += starts_[i - 1];
        }
        around_.resize(starts_.back());
        std::vector<std::uint32_t> filled(starts_.begin(), starts_.end() - 1);
        forEachMovableCorner([&](std::size_t i, std::uint32_t t) { around_[filled[i]++] = t; });
    }

    void sweep()
    {
        for (std::size_t i = 0; i + 1 < starts_.size(); ++i) {
            Vec2& vertex = mesh_.vertices[range_.first_vertex + i];
            Vec2 sum{};
            double weight = 0.0;
            for (std::uint32_t k = starts_[i]; k < starts_[i + 1]; ++k) {
                const Triangle& t = mesh_.triangles[around_[k]];
                const double twice = doubleArea(mesh_, t);
                sum = sum + (twice / 3.0) * ((at(t[0]) - vertex) + (at(t[1]) - vertex) + (at(t[2]) - vertex));
                weight += twice;
            }
            const Vec2 move = (1.0 / weight) * sum;
            const double size_squared = weight / static_cast<double>(starts_[i + 1] - starts_[i]);
            constexpr double kMinMove = 1e-3;  // relative to an edge
            if (dot(move, move) < kMinMove * kMinMove * size_squared) {
                continue;
            }
            const Vec2 from = vertex;
            const double worst_before = worst(i);
            vertex = from + move;
            if (worst(i) > worst_before || !isDelaunayAround(i)) {
                vertex = from;
            }
        }
    }

private:
    template <typename Visit>
    void forEachMovableCorner(const Visit& visit) const
    {
        for (std::uint32_t t = 0; t < range_.triangles; ++t) {
            for (const std::uint32_t v : mesh_.triangles[t]) {
                if (isMovable(v)) {
                    visit(v - range_.first_vertex, t);
                }
            }
        }
    }

    [[nodiscard]] bool isMovable(std::uint32_t v) const { return v >= range_.first_vertex && v < range_.end_vertex; }
    [[nodiscard]] Vec2 at(std::uint32_t v) const { return mesh_.vertices[v]; }

    /// Cotangent of the smallest angle around a vertex.
    [[nodiscard]] double worst(std::size_t i) const
    {
        double worst = 0.0;
        for (std::uint32_t k = starts_[i]; k < starts_[i + 1]; ++k) {
            const Triangle& t = mesh_.triangles[around_[k]];
            worst = std::max(worst, largestCotangent(at(t[0]), at(t[1]), at(t[2])));
        }
        return worst;
    }

    /// Whether every inner edge of the triangles around a vertex is Delaunay: the two angles that face it sum to at
    /// most 180°. Otherwise the stiffness between its ends would be positive, and heights could be negative.
    [[nodiscard]] bool isDelaunayAround(std::size_t i) const
    {
        for (std::uint32_t n = starts_[i]; n < starts_[i + 1]; ++n) {
            const Triangle& t = mesh_.triangles[around_[n]];
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t a = t[(k + 1) % 3];
                const std::uint32_t b = t[(k + 2) % 3];
                // One of the two angles must be obtuse. For edges that face the vertex itself, it may be the angle
                // behind them.
                const bool may_be_obtuse =
                    t[k] == range_.first_vertex + i || dot(at(a) - at(t[k]), at(b) - at(t[k])) < 0.0;
                if (may_be_obtuse && !mesh_.onRim(a) && !mesh_.onRim(b) &&
                    cotangent(at(t[k]), at(a), at(b)) + facing(b, a) < 0.0) {
                    return false;
                }
            }
        }
        return true;
    }

    /// Cotangent of the angle to the left of the edge from a to b. If neither end moves, the angle is assumed to be
    /// 90°, because angles of lattice triangles are smaller.
    [[nodiscard]] double facing(std::uint32_t a, std::uint32_t b) const
    {
        const std::uint32_t end = isMovable(a) ? a : b;
        if (!isMovable(end)) {
            return 0.0;
        }
        const std::size_t i = end - range_.first_vertex;
        for (std::uint32_t n = starts_[i]; n < starts_[i + 1]; ++n) {
            const Triangle& t = mesh_.triangles[around_[n]];
            for (std::size_t k = 0; k < 3; ++k) {
                if (t[(k + 1) % 3] == a && t[(k + 2) % 3] == b) {
                    return cotangent(at(t[k]), at(a), at(b));
                }
            }
        }
        return 0.0;
    }

    PlanarMesh& mesh_;
    SmoothRange range_;
    std::vector<std::uint32_t> starts_;  ///< first index into around_ for every movable vertex
    std::vector<std::uint32_t> around_;  ///< triangles around the vertices
};

}  // namespace

void smooth(PlanarMesh& mesh, const SmoothRange& range)
{
    constexpr int kSweeps = 4;  // the band is two triangles wide; four sweeps carry a move across it and back
    Smoothing smoothing(mesh, range);
    for (int k = 0; k < kSweeps; ++k) {
        smoothing.sweep();
    }
}

}  // namespace droplet
