// SPDX-License-Identifier: GPL-3.0-or-later
#include "region.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "kernel.h"

namespace droplet {
namespace {

/// Calls work(a, b) for every side of every loop.
template <typename Work>
void forSides(const Region& region, const Work& work)
{
    for (const std::vector<Vec2>& loop : region.loops) {
        for (std::size_t i = 0; i < loop.size(); ++i) {
            work(loop[i], loop[(i + 1) % loop.size()]);
        }
    }
}

/// Whether the ray from a point to the right meets a side.
bool meetsRay(Vec2 a, Vec2 b, Vec2 point)
{
    return (a.y <= point.y) != (b.y <= point.y) && point.x < a.x + (b.x - a.x) * (point.y - a.y) / (b.y - a.y);
}

/// Circle around the corners of a polygon.
struct Disc {
    Vec2 middle{};
    double radius = 0.0;
};

std::optional<Disc> discOf(const Region& region)
{
    constexpr std::size_t kLeastCorners = 24;
    constexpr double kRounding = 1e-6;
    if (region.loops.size() != 1 || region.loops[0].size() < kLeastCorners) {
        return std::nullopt;
    }
    const std::vector<Vec2>& corners = region.loops[0];
    const RegionMoments moments = momentsOf(region);
    const double radius = length(corners[0] - moments.centroid);
    const double side = length(corners[1] - corners[0]);
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const Vec2 next = corners[k + 1 == corners.size() ? 0 : k + 1];
        if (std::abs(length(corners[k] - moments.centroid) - radius) > kRounding * radius ||
            std::abs(length(next - corners[k]) - side) > kRounding * radius) {
            return std::nullopt;
        }
    }
    return Disc{moments.centroid, std::sqrt(moments.area / std::numbers::pi)};
}

/// Abscissae at which a region's sides cross a horizontal line, in order.
std::vector<double> crossings(const Region& region, double y)
{
    std::vector<double> xs;
    forSides(region, [&](Vec2 a, Vec2 b) {
        if ((a.y <= y) != (b.y <= y)) {
            xs.push_back(a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y));
        }
    });
    std::sort(xs.begin(), xs.end());
    return xs;
}

}  // namespace

Region rectangle(Vec2 lower, Vec2 upper)
{
    return {{{lower, {upper.x, lower.y}, upper, {lower.x, upper.y}}}};
}

Region circle(Vec2 centre, double radius)
{
    constexpr int kCorners = 96;
    constexpr double kTurn = 2.0 * std::numbers::pi / kCorners;
    // Radius of the corners of a polygon with the circle's area.
    const double outer = radius * std::sqrt(kTurn / std::sin(kTurn));
    Region region{{{}}};
    for (int k = 0; k < kCorners; ++k) {
        region.loops.front().push_back(centre + outer * Vec2{std::cos(k * kTurn), std::sin(k * kTurn)});
    }
    return region;
}

bool contains(const Region& region, Vec2 point)
{
    bool is_inside = false;
    forSides(region, [&](Vec2 a, Vec2 b) { is_inside = is_inside != meetsRay(a, b, point); });
    return is_inside;
}

Interior::Interior(const Region& region)
{
    forSides(region, [&](Vec2 a, Vec2 b) {
        sides_.push_back({a, b});
        low_ = std::min(low_, a.y);
        high_ = std::max(high_, a.y);
    });
    strips_.resize(std::max<std::size_t>(sides_.size() / 4, 1));
    for (std::uint32_t k = 0; k < sides_.size(); ++k) {
        const auto& [a, b] = sides_[k];
        for (std::size_t s = strip(std::min(a.y, b.y)); s <= strip(std::max(a.y, b.y)); ++s) {
            strips_[s].push_back(k);
        }
    }
}

bool Interior::contains(Vec2 point) const
{
    if (!(point.y >= low_ && point.y <= high_)) {
        return false;
    }
    bool is_inside = false;
    for (const std::uint32_t k : strips_[strip(point.y)]) {
        is_inside = is_inside != meetsRay(sides_[k].a, sides_[k].b, point);
    }
    return is_inside;
}

std::size_t Interior::strip(double y) const
{
    const double part = high_ > low_ ? (y - low_) / (high_ - low_) : 0.0;
    return std::min(static_cast<std::size_t>(part * static_cast<double>(strips_.size())), strips_.size() - 1);
}

bool isInsideOnLeft(const Region& region, const std::vector<Vec2>& loop)
{
    Vec2 middle;
    Vec2 along;
    double longest = 0.0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const Vec2 side = loop[(i + 1) % loop.size()] - loop[i];
        if (length(side) > longest) {
            longest = length(side);
            middle = loop[i] + 0.5 * side;
            along = side;
        }
    }
    return contains(region, middle + 1e-6 * Vec2{-along.y, along.x});
}

RegionMoments momentsOf(const Region& region)
{
    RegionMoments moments;
    for (const std::vector<Vec2>& loop : region.loops) {
        double area = 0.0;
        Vec2 first;
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const Vec2 a = loop[i];
            const Vec2 b = loop[(i + 1) % loop.size()];
            area += 0.5 * cross(a, b);
            first = first + (cross(a, b) / 6.0) * (a + b);
        }
        const double sign = isInsideOnLeft(region, loop) ? 1.0 : -1.0;
        moments.area += sign * area;
        moments.centroid = moments.centroid + sign * first;
    }
    if (moments.area > 0.0) {
        moments.centroid = (1.0 / moments.area) * moments.centroid;
    }
    return moments;
}

void visitLattice(const Region& region, const LatticePart& part, const std::function<void(Vec2)>& visit)
{
    double lowest = std::numeric_limits<double>::infinity();
    double highest = -lowest;
    double left = lowest;
    forSides(region, [&](Vec2 a, Vec2) {
        lowest = std::min(lowest, a.y);
        highest = std::max(highest, a.y);
        left = std::min(left, a.x);
    });
    const double step = latticeStep(part.spacing);
    const double row_height = 0.5 * std::sqrt(3.0) * step;
    const double top = std::min(highest, part.upper.y);
    for (double row = std::max(std::ceil((part.lower.y - lowest) / row_height - 0.5), 0.0);; row += 1.0) {
        const double y = lowest + (row + 0.5) * row_height;
        if (!(y < top)) {
            return;
        }
        const double begin = left + (std::fmod(row, 2.0) == 0.0 ? 0.5 : 1.0) * step;
        const std::vector<double> xs = crossings(region, y);
        for (std::size_t k = 0; k + 1 < xs.size(); k += 2) {
            // A fourth of a step of leeway, so that two sides a whole number of steps apart do not depend on rounding.
            double column =
                std::max(std::ceil((xs[k] - begin) / step + 0.25), std::ceil((part.lower.x - begin) / step));
            const double end = std::min(xs[k + 1] - 0.25 * step, part.upper.x);
            for (; begin + column * step < end; column += 1.0) {
                visit({begin + column * step, y});
            }
        }
    }
}

void visitRings(const Region& region, const LatticePart& part, const std::function<void(Vec2)>& visit)
{
    const std::optional<Disc> disc = discOf(region);
    const auto holds = [&](double middle, double lower, double upper) {
        return middle - disc->radius > lower && middle + disc->radius < upper;
    };
    if (!disc || !holds(disc->middle.x, part.lower.x, part.upper.x) ||
        !holds(disc->middle.y, part.lower.y, part.upper.y)) {
        visitLattice(region, part, visit);
        return;
    }
    // As far apart as the rows of the lattice.
    const double row_height = 0.5 * std::sqrt(3.0) * latticeStep(part.spacing);
    const int rings = std::max(static_cast<int>(std::lround(disc->radius / row_height)), 1);
    const double step = disc->radius / rings;
    for (int ring = 0; ring < rings; ++ring) {
        const double area = std::numbers::pi * step * step * (2.0 * ring + 1.0);
        const int count = std::max(static_cast<int>(std::lround(area / (part.spacing * part.spacing))), 1);
        const double radius = count > 1 ? (ring + 0.5) * step : 0.0;
        for (int k = 0; k < count; ++k) {
            const double angle = 2.0 * std::numbers::pi * k / count;
            visit(disc->middle + radius * Vec2{std::cos(angle), std::sin(angle)});
        }
    }
}

std::vector<Vec2> latticeIn(const Region& region, double spacing)
{
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    std::vector<Vec2> points;
    visitLattice(region, {spacing, {-kInfinity, -kInfinity}, {kInfinity, kInfinity}},
                 [&](Vec2 point) { points.push_back(point); });
    return points;
}

}  // namespace droplet
