// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape/faceted_ground.h"

#include <algorithm>
#include <cmath>

namespace droplet {
namespace {

/// Box around a triangle, seen from above.
struct Box {
    Vec2 low;
    Vec2 high;
};

Box boxOf(const std::vector<Vec3>& vertices, const Triangle& t)
{
    Box box{{vertices[t[0]].x, vertices[t[0]].y}, {vertices[t[0]].x, vertices[t[0]].y}};
    for (const std::uint32_t v : t) {
        box.low = {std::min(box.low.x, vertices[v].x), std::min(box.low.y, vertices[v].y)};
        box.high = {std::max(box.high.x, vertices[v].x), std::max(box.high.y, vertices[v].y)};
    }
    return box;
}

}  // namespace

FacetedGround::FacetedGround(const CapillarySurface& base) : vertices_(base.vertices), triangles_(base.triangles)
{
    constexpr double kTrianglesPerCell = 2.0;
    Box all = boxOf(vertices_, triangles_.front());
    for (const Triangle& t : triangles_) {
        const Box own = boxOf(vertices_, t);
        all.low = {std::min(all.low.x, own.low.x), std::min(all.low.y, own.low.y)};
        all.high = {std::max(all.high.x, own.high.x), std::max(all.high.y, own.high.y)};
    }
    low_ = all.low;
    const Vec2 extent = all.high - all.low;
    cell_ = std::sqrt(kTrianglesPerCell * extent.x * extent.y / static_cast<double>(triangles_.size()));
    columns_ = static_cast<std::size_t>(extent.x / cell_) + 1;
    rows_ = static_cast<std::size_t>(extent.y / cell_) + 1;
    const auto for_cells = [&](std::size_t k, auto&& use) {
        const Box own = boxOf(vertices_, triangles_[k]);
        for (std::size_t j = cellOf(own.low.y - low_.y, rows_); j <= cellOf(own.high.y - low_.y, rows_); ++j) {
            for (std::size_t i = cellOf(own.low.x - low_.x, columns_); i <= cellOf(own.high.x - low_.x, columns_);
                 ++i) {
                use(j * columns_ + i);
            }
        }
    };
    starts_.assign(columns_ * rows_ + 1, 0);
    for (std::size_t k = 0; k < triangles_.size(); ++k) {
        for_cells(k, [&](std::size_t cell) { ++starts_[cell + 1]; });
    }
    for (std::size_t cell = 1; cell < starts_.size(); ++cell) {
        starts_[cell] += starts_[cell - 1];
    }
    found_.resize(starts_.back());
    std::vector<std::size_t> ends(starts_.begin(), starts_.end() - 1);
    for (std::size_t k = 0; k < triangles_.size(); ++k) {
        for_cells(k, [&](std::size_t cell) { found_[ends[cell]++] = static_cast<std::uint32_t>(k); });
    }
}

std::size_t FacetedGround::cellOf(double from_low, std::size_t count) const
{
    return std::min(static_cast<std::size_t>(std::max(from_low, 0.0) / cell_), count - 1);
}

std::optional<double> FacetedGround::heightAt(Vec2 place) const
{
    constexpr double kRounding = 1e-12;  // of a triangle: places on edges are inside
    const Vec2 from_low = place - low_;
    const std::size_t cell = cellOf(from_low.y, rows_) * columns_ + cellOf(from_low.x, columns_);
    for (std::size_t i = starts_[cell]; i < starts_[cell + 1]; ++i) {
        const Triangle& t = triangles_[found_[i]];
        const auto at = [&](std::size_t k) { return Vec2{vertices_[t[k]].x, vertices_[t[k]].y}; };
        const double whole = cross(at(1) - at(0), at(2) - at(0));
        const double b = cross(place - at(0), at(2) - at(0)) / whole;
        const double c = cross(at(1) - at(0), place - at(0)) / whole;
        if (b >= -kRounding && c >= -kRounding && b + c <= 1.0 + kRounding) {
            return (1.0 - b - c) * vertices_[t[0]].z + b * vertices_[t[1]].z + c * vertices_[t[2]].z;
        }
    }
    return std::nullopt;
}

}  // namespace droplet
