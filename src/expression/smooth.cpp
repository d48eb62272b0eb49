// SPDX-License-Identifier: GPL-3.0-or-later
// The rim of particles is wrinkled, for they lie in no order there. Yu and Turk (Reconstructing surfaces of
// particle-based fluids using anisotropic kernels. ACM TOG 32, 2013) average the particles' places before they draw a
// surface, which rounds whatever is thin. Here the outline is averaged instead, but nowhere moved farther than the
// particles leave open (as Bhattacharya, Gao and Bargteil: A level-set method for skinning animated particle data.
// IEEE TVCG 21, 2015, keep a surface between two others): wrinkles are less high than that, corners and tips are not.
// What is left of bends as short as a particle goes by Taubin: A signal processing approach to fair surface design.
// SIGGRAPH 1995.
#include "smooth.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "liquid2d/bounds.h"
#include "liquid2d/cell_grid.h"
#include "plain_length.h"

namespace droplet {
namespace {

/// Smaller loops are droplets of few particles, and smooth by themselves.
constexpr std::size_t kLeast = 24;

/// Square of the width of the average, in spacings, for a fairing of 1.
constexpr double kWidth = 2.0;

/// Greatest way of a point, in spacings.
constexpr double kWay = 0.6;

/// Greatest way of a point over the thickness of the liquid, or of the gap, there.
constexpr double kShare = 0.25;

/// Cosine between the normals of opposite sides.
constexpr double kOpposite = -0.3;

using Points = std::vector<Vec2>;

/// Moves each point towards the middle of the two beside it.
void relax(Points& points, Points& next, double factor)
{
    const auto relaxed = [factor](Vec2 before, Vec2 point, Vec2 after) {
        return point + factor * (0.5 * (after + before) - point);
    };
    const std::size_t last = points.size() - 1;
    next.front() = relaxed(points[last], points[0], points[std::min(last, std::size_t{1})]);
    for (std::size_t i = 1; i < last; ++i) {
        next[i] = relaxed(points[i - 1], points[i], points[i + 1]);
    }
    next.back() = relaxed(points[last == 0 ? 0 : last - 1], points[last], points[0]);
    points.swap(next);
}

/// Two steps: the first shrinks, the second grows by a little more, so that bends longer than the pass-band stay.
void removeShortBends(Points& points, int rounds)
{
    constexpr double kShrink = 0.5;
    constexpr double kGrow = -0.526;  // 1/0.5 + 1/−0.526 = 0.1: the pass-band that Taubin recommends
    Points next(points.size());
    for (int round = 0; round < rounds; ++round) {
        relax(points, next, kShrink);
        relax(points, next, kGrow);
    }
}

/// Average by a bell of `passes` binomials, twice: 2G − G² keeps bends longer than the bell as they are.
Points averaged(const Points& points, int passes)
{
    Points once = points;
    Points next(points.size());
    for (int k = 0; k < passes; ++k) {
        relax(once, next, 0.5);
    }
    Points twice = once;
    for (int k = 0; k < passes; ++k) {
        relax(twice, next, 0.5);
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
        once[i] = 2.0 * once[i] - twice[i];
    }
    return once;
}

/// Outward normals of length 1.
Points normalsOf(const Points& points)
{
    const std::size_t count = points.size();
    Points normals(count);
    for (std::size_t i = 0; i < count; ++i) {
        const Vec2 along = points[i + 1 == count ? 0 : i + 1] - points[i == 0 ? count - 1 : i - 1];
        const double size = plainLength(along);
        normals[i] = size > 0.0 ? Vec2{along.y / size, -along.x / size} : Vec2{};
    }
    return normals;
}

double lengthOf(const Points& points)
{
    double sum = plainLength(points.front() - points.back());
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        sum += plainLength(points[i + 1] - points[i]);
    }
    return sum;
}

/// As many points at equal distances: an average over points is one over lengths then.
Points evenlySpaced(const Points& points)
{
    const std::size_t count = points.size();
    const double step = lengthOf(points) / static_cast<double>(count);
    Points even;
    even.reserve(count);
    double done = 0.0;
    for (std::size_t i = 0; i < count && even.size() < count; ++i) {
        const Vec2 side = points[i + 1 == count ? 0 : i + 1] - points[i];
        const double size = plainLength(side);
        while (even.size() < count && step * static_cast<double>(even.size()) < done + size) {
            even.push_back(points[i] + ((step * static_cast<double>(even.size()) - done) / size) * side);
        }
        done += size;
    }
    return even;
}

/// Moves all points by the same way along their normals, so that the loop has an area again.
void restoreArea(Loop& loop, double area)
{
    // Newton's method: the area grows by the length times the way.
    constexpr int kSteps = 3;
    for (int step = 0; step < kSteps; ++step) {
        const double way = (area - signedArea(loop)) / lengthOf(loop.points);
        const Points normals = normalsOf(loop.points);
        for (std::size_t i = 0; i < normals.size(); ++i) {
            loop.points[i] = loop.points[i] + way * normals[i];
        }
    }
}

/// How far each point may go.
std::vector<std::vector<double>> waysOf(const std::vector<Loop>& loops, const std::vector<Points>& normals,
                                        double spacing)
{
    const double reach = kWay * spacing / kShare;
    Bounds box;
    Points at;
    Points normal;
    for (std::size_t k = 0; k < loops.size(); ++k) {
        box.include(loops[k].points);
        at.insert(at.end(), loops[k].points.begin(), loops[k].points.end());
        normal.insert(normal.end(), normals[k].begin(), normals[k].end());
    }
    CellGrid cells(box.lower, box.upper, reach);
    const std::vector<std::uint32_t> order = cells.sort(at);
    std::vector<std::vector<double>> ways;
    for (std::size_t k = 0; k < loops.size(); ++k) {
        std::vector<double> way;
        for (std::size_t i = 0; i < loops[k].points.size(); ++i) {
            const Vec2 x = loops[k].points[i];
            double square = reach * reach;
            for (int row = cells.row(x.y) - 1; row <= cells.row(x.y) + 1; ++row) {
                const auto [first, last] = cells.range(row, cells.column(x.x) - 1, cells.column(x.x) + 1);
                for (std::uint32_t m = first; m < last; ++m) {
                    const Vec2 across = at[order[m]] - x;
                    const double away = dot(across, across);
                    if (away < square && dot(normals[k][i], normal[order[m]]) < kOpposite) {
                        square = away;
                    }
                }
            }
            way.push_back(kShare * std::sqrt(square));
        }
        ways.push_back(std::move(way));
    }
    return ways;
}

}  // namespace

std::vector<Loop> smoothed(std::vector<Loop> loops, double spacing, double fairing)
{
    if (loops.empty() || !(fairing > 0.0)) {
        return loops;
    }
    std::vector<double> areas;
    std::vector<Points> normals;
    for (Loop& loop : loops) {
        areas.push_back(signedArea(loop));
        if (loop.points.size() >= kLeast) {
            loop.points = evenlySpaced(loop.points);
            loop.corner.resize(loop.points.size());
        }
        normals.push_back(normalsOf(loop.points));
    }
    const std::vector<std::vector<double>> ways = waysOf(loops, normals, spacing);
    for (std::size_t k = 0; k < loops.size(); ++k) {
        Points& points = loops[k].points;
        if (points.size() < kLeast) {
            continue;
        }
        const double width =
            spacing * static_cast<double>(points.size()) / lengthOf(points);  // of a spacing, in points
        // A binomial has the variance of half a point.
        const Points fair = averaged(points, static_cast<int>(std::lround(2.0 * kWidth * fairing * width * width)));
        for (std::size_t i = 0; i < points.size(); ++i) {
            const double way = dot(fair[i] - points[i], normals[k][i]);
            points[i] = points[i] + std::clamp(way, -ways[k][i], ways[k][i]) * normals[k][i];
        }
        removeShortBends(points, static_cast<int>(std::lround(fairing * width * width)));
        restoreArea(loops[k], areas[k]);
    }
    return loops;
}

}  // namespace droplet
