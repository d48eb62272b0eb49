// SPDX-License-Identifier: GPL-3.0-or-later
//
// Polygons are united by Clipper, after B. R. Vatti, "A generic solution to polygon clipping" (1992), on integers. It
// leaves loops that touch at points, and its rounding of crossings may make others touch: these are found, and parted
// by taking a little off all round.

#include "footprint/contour_union.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <polyclipping/clipper.hpp>
#include <tuple>
#include <utility>

#include "droplet/error.h"

namespace droplet {
namespace {

using ClipperLib::IntPoint;
using ClipperLib::Path;
using ClipperLib::Paths;

__extension__ using Wide = __int128;

/// Integers per em: font units, of which an em has 2¹⁴ at most, and halves and quarters of them are exact for powers
/// of two. Single glyphs stay below the 2³⁰ up to which Clipper multiplies in 64 bits.
constexpr double kGrid = 67108864.0;

/// Vertices nearer than this to one another, or to the line through their neighbours, are one [grid]: 2⁻²⁰ em is what
/// rounding makes, not what anybody drew.
constexpr double kMerge = 64.0;

/// How far sides that touch are moved apart, each by half [grid].
constexpr double kGap = 16384.0;

IntPoint minus(const IntPoint& a, const IntPoint& b)
{
    return {a.X - b.X, a.Y - b.Y};
}

int turn(const IntPoint& a, const IntPoint& b)
{
    const Wide cross = static_cast<Wide>(a.X) * b.Y - static_cast<Wide>(a.Y) * b.X;
    return cross > 0 ? 1 : (cross < 0 ? -1 : 0);
}

/// An edge of one of several loops.
struct Edge {
    IntPoint from;
    IntPoint to;
    std::size_t loop = 0;
    std::size_t index = 0;

    [[nodiscard]] auto left() const { return std::min(from.X, to.X); }
    [[nodiscard]] auto right() const { return std::max(from.X, to.X); }
    [[nodiscard]] auto low() const { return std::min(from.Y, to.Y); }
    [[nodiscard]] auto high() const { return std::max(from.Y, to.Y); }
};

/// Whether two edges, whose boxes meet, have a point in common.
bool meet(const Edge& a, const Edge& b)
{
    const IntPoint along_a = minus(a.to, a.from);
    const IntPoint along_b = minus(b.to, b.from);
    return turn(along_a, minus(b.from, a.from)) * turn(along_a, minus(b.to, a.from)) <= 0 &&
           turn(along_b, minus(a.from, b.from)) * turn(along_b, minus(a.to, b.from)) <= 0;
}

/// Whether the second of two consecutive edges runs back along the first.
bool turnsBack(const Edge& first, const Edge& second)
{
    const IntPoint a = minus(first.to, first.from);
    const IntPoint b = minus(second.to, second.from);
    return turn(a, b) == 0 && static_cast<Wide>(a.X) * b.X + static_cast<Wide>(a.Y) * b.Y < 0;
}

/// Whether loops cross or touch one another or themselves.
bool touchAnywhere(const Paths& loops)
{
    std::vector<Edge> edges;
    for (std::size_t k = 0; k < loops.size(); ++k) {
        for (std::size_t i = 0; i < loops[k].size(); ++i) {
            edges.push_back({loops[k][i], loops[k][(i + 1) % loops[k].size()], k, i});
        }
    }
    std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) { return a.left() < b.left(); });
    for (std::size_t i = 0; i < edges.size(); ++i) {
        const Edge& a = edges[i];
        for (std::size_t j = i + 1; j < edges.size() && edges[j].left() <= a.right(); ++j) {
            const Edge& b = edges[j];
            if (b.low() > a.high() || b.high() < a.low()) {
                continue;
            }
            const std::size_t count = loops[a.loop].size();
            const bool then = a.loop == b.loop && (a.index + 1) % count == b.index;
            const bool before = a.loop == b.loop && (b.index + 1) % count == a.index;
            if (then || before ? turnsBack(then ? a : b, then ? b : a) : meet(a, b)) {
                return true;
            }
        }
    }
    return false;
}

Paths united(const Paths& contours)
{
    ClipperLib::Clipper clipper;
    clipper.StrictlySimple(true);
    Paths result;
    if (!clipper.AddPaths(contours, ClipperLib::ptSubject, true)) {
        return result;  // of nothing but points and lines
    }
    if (!clipper.Execute(ClipperLib::ctUnion, result, ClipperLib::pftNonZero, ClipperLib::pftNonZero)) {
        throw Error(ErrorCode::InvalidInput, "the contours cannot be united");
    }
    return result;
}

void clean(Paths& loops, double merge)
{
    for (Path& loop : loops) {
        ClipperLib::CleanPolygon(loop, merge);
    }
    loops.erase(std::remove_if(loops.begin(), loops.end(), [](const Path& loop) { return loop.size() < 3; }),
                loops.end());
}

/// Makes loops larger, or smaller if `by` is negative.
Paths offset(Paths loops, double by)
{
    // Clipper takes the first of the loops that reach lowest for an outer one; a hole may touch its rim there.
    std::stable_partition(loops.begin(), loops.end(), ClipperLib::Orientation);
    constexpr double kMiter = 4.0;
    ClipperLib::ClipperOffset offset(kMiter);
    offset.AddPaths(loops, ClipperLib::jtMiter, ClipperLib::etClosedPolygon);
    Paths result;
    offset.Execute(result, by);
    return result;
}

/// Loops that do not touch: what rounding left open is closed, then everything is made smaller by half the gap.
Paths parted(const Paths& loops)
{
    for (double gap = kGap; gap < 5.0 * kGap; gap *= 1.5) {
        Paths result = offset(offset(loops, kMerge), -kMerge - 0.5 * gap);
        clean(result, 0.25 * gap);
        if (!touchAnywhere(result)) {
            return result;
        }
    }
    throw Error(ErrorCode::InvalidInput, "contours touch and cannot be parted");
}

Paths rounded(const std::vector<Contour>& contours)
{
    Paths paths;
    for (const Contour& contour : contours) {
        Path path;
        for (const Vec2 p : contour) {
            path.emplace_back(std::llround(p.x * kGrid), std::llround(p.y * kGrid));
        }
        paths.push_back(std::move(path));
    }
    return paths;
}

}  // namespace

United unite(const std::vector<Contour>& contours, double speck)
{
    Paths loops = united(rounded(contours));
    clean(loops, kMerge);
    if (touchAnywhere(loops)) {
        loops = parted(loops);
    }
    United result;
    for (const Path& loop : loops) {
        if (std::abs(ClipperLib::Area(loop)) < speck * kGrid * kGrid) {
            ++result.specks;
            continue;
        }
        // From the leftmost point, whatever point Clipper began with.
        const auto first = std::min_element(loop.begin(), loop.end(), [](const IntPoint& a, const IntPoint& b) {
            return std::tie(a.X, a.Y) < std::tie(b.X, b.Y);
        });
        Contour contour;
        const auto add = [&](const IntPoint& p) {
            contour.push_back({static_cast<double>(p.X) / kGrid, static_cast<double>(p.Y) / kGrid});
        };
        std::for_each(first, loop.end(), add);
        std::for_each(loop.begin(), first, add);
        result.loops.push_back(std::move(contour));
    }
    std::sort(result.loops.begin(), result.loops.end(), [](const Contour& a, const Contour& b) {
        return std::tie(a.front().x, a.front().y) < std::tie(b.front().x, b.front().y);
    });
    return result;
}

}  // namespace droplet
