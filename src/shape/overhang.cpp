// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape/overhang.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "blocks.h"

namespace droplet {
namespace {

/// Sides of a footprint's rim, and which of them are beside a place.
class RimSides {
public:
    explicit RimSides(const PlanarMesh& footprint)
    {
        for (std::size_t loop = 0; loop < footprint.loopCount(); ++loop) {
            Vec2 a = footprint.vertices[footprint.loop_starts[loop + 1] - 1];
            for (std::uint32_t v = footprint.loop_starts[loop]; v < footprint.loop_starts[loop + 1]; ++v) {
                sides_.push_back({a, footprint.vertices[v]});
                a = footprint.vertices[v];
                low_ = std::min(low_, a.y);
                high_ = std::max(high_, a.y);
            }
        }
        rows_.resize(sides_.size());
        for (std::size_t k = 0; k < sides_.size(); ++k) {
            const auto [first, last] = std::minmax({rowOf(sides_[k][0].y), rowOf(sides_[k][1].y)});
            for (std::size_t row = first; row <= last; ++row) {
                rows_[row].push_back(k);
            }
        }
    }

    [[nodiscard]] bool isInside(Vec2 place) const
    {
        bool is_inside = false;
        for (const std::size_t k : rows_[rowOf(place.y)]) {
            const auto& [a, b] = sides_[k];
            if ((a.y > place.y) != (b.y > place.y) && place.x < a.x + (place.y - a.y) / (b.y - a.y) * (b.x - a.x)) {
                is_inside = !is_inside;
            }
        }
        return is_inside;
    }

    /// Squared distance of a place, if it is more than another one; otherwise something below that [m²].
    /// @param near  side that is likely near; receives the nearest one that was looked at
    [[nodiscard]] double squaredIfMore(Vec2 place, double least, std::size_t& near) const
    {
        double nearest = squaredTo(place, near);
        for (std::size_t k = 0; k < sides_.size() && nearest > least; ++k) {
            const double squared = squaredTo(place, k);
            if (squared < nearest) {
                nearest = squared;
                near = k;
            }
        }
        return nearest;
    }

private:
    [[nodiscard]] std::size_t rowOf(double y) const
    {
        const auto count = static_cast<double>(rows_.size());
        return static_cast<std::size_t>(std::clamp((y - low_) / (high_ - low_) * count, 0.0, count - 1.0));
    }

    [[nodiscard]] double squaredTo(Vec2 place, std::size_t k) const
    {
        const auto& [a, b] = sides_[k];
        const Vec2 side = b - a;
        const Vec2 arm = place - a - std::clamp(dot(place - a, side) / dot(side, side), 0.0, 1.0) * side;
        return dot(arm, arm);
    }

    std::vector<std::array<Vec2, 2>> sides_;
    std::vector<std::vector<std::size_t>> rows_;  ///< sides that reach into strips of equal width
    double low_ = std::numeric_limits<double>::infinity();
    double high_ = -std::numeric_limits<double>::infinity();
};

}  // namespace

double overhangOf(const CapillarySurface& sheet)
{
    const RimSides rim(rimOf(sheet));
    double overhang = 0.0;
    for (const double part :
         mapBlocks<double>(sheet.vertices.size() - sheet.rimVertexCount(), [&](std::size_t begin, std::size_t end) {
             double farthest = 0.0;
             std::size_t near = 0;
             for (std::size_t i = begin; i < end; ++i) {
                 const Vec3& p = sheet.vertices[sheet.rimVertexCount() + i];
                 if (!rim.isInside({p.x, p.y})) {
                     farthest = std::max(farthest, rim.squaredIfMore({p.x, p.y}, farthest, near));
                 }
             }
             return farthest;
         })) {
        overhang = std::max(overhang, part);
    }
    return std::sqrt(overhang);
}

}  // namespace droplet
