// SPDX-License-Identifier: GPL-3.0-or-later
// Morphological closing by a disc, as two offsets of polygons: A. Johnson, Clipper.
#include "mesh/round_inward.h"

#include <algorithm>
#include <cmath>
#include <polyclipping/clipper.hpp>
#include <utility>
#include <vector>

#include "droplet/domain/domain.h"
#include "droplet/error.h"
#include "droplet/mesh/triangulate.h"
#include "mesh/clipper_paths.h"
#include "mesh/mean_edge.h"
#include "mesh/rim_corner.h"

namespace droplet {
namespace {

using ClipperLib::Path;
using ClipperLib::Paths;

/// Distance between arcs and their chords, and of vertices that are dropped, over the radius.
constexpr double kChord = 0.002;
constexpr double kDropped = 0.004;
/// Shortest edge that is kept, over the radius: where arcs meet the rim, polygons have edges of any length. Edges of
/// arcs are 0.13 long.
constexpr double kShortest = 0.06;
/// Longest edge of an arc's polygon, over the radius, and the least turn of an arc whose shape is kept [rad].
constexpr double kArcEdge = 0.25;
constexpr double kArcTurn = 0.5;
/// Edges of the mesh along an arc. With one or two, liquid that rolls over the arc has facets, which shine as beads.
constexpr std::size_t kArcParts = 4;
/// Units of Clipper's integers in a radius.
constexpr double kUnits = 1e5;
/// Edges over the mean edge of a mesh between which no new triangles are needed.
constexpr double kFiner = 0.8;
constexpr double kCoarser = 1.5;
/// Area of loops that vanish, over the squared edge.
constexpr double kSpeck = 1e-3;
/// Largest growth of the footprint.
constexpr double kGrowth = 0.0075;
/// Halvings of the radius until the footprint grows by no more, slits with a narrow mouth do not become holes, and
/// holes stay.
constexpr int kRounds = 5;

double turnAt(const std::vector<Vec2>& loop, std::size_t i)
{
    const std::size_t count = loop.size();
    const Vec2 in = loop[i] - loop[(i + count - 1) % count];
    const Vec2 out = loop[(i + 1) % count] - loop[i];
    return turnBetween(in, out);
}

std::vector<std::vector<Vec2>> loopsOf(const PlanarMesh& mesh)
{
    std::vector<std::vector<Vec2>> loops;
    for (std::size_t k = 0; k < mesh.loopCount(); ++k) {
        loops.emplace_back(mesh.vertices.begin() + mesh.loop_starts[k],
                           mesh.vertices.begin() + mesh.loop_starts[k + 1]);
    }
    return loops;
}

bool hasInnerCorner(const std::vector<std::vector<Vec2>>& loops)
{
    return std::any_of(loops.begin(), loops.end(), [](const std::vector<Vec2>& loop) {
        for (std::size_t i = 0; i < loop.size(); ++i) {
            if (turnAt(loop, i) < -kCorner) {
                return true;
            }
        }
        return false;
    });
}

/// Closing of a polygon: never less than the polygon, whose other corners stay sharp.
Paths closed(const Paths& paths)
{
    ClipperLib::Clipper clipper;
    clipper.AddPaths(paths, ClipperLib::ptSubject, true);
    clipper.AddPaths(offset(offset(paths, kUnits, kChord * kUnits), -kUnits, kChord * kUnits), ClipperLib::ptSubject,
                     true);
    Paths result;
    clipper.Execute(ClipperLib::ctUnion, result, ClipperLib::pftNonZero, ClipperLib::pftNonZero);
    ClipperLib::CleanPolygons(result, kDropped * kUnits);
    return result;
}

/// Loop with its corners, and with points at short distances: those of a rim are taken from them.
Loop subdivided(const std::vector<Vec2>& points, double distance)
{
    Loop loop;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Vec2 side = points[(i + 1) % points.size()] - points[i];
        const auto parts = static_cast<std::size_t>(std::ceil(length(side) / distance));
        for (std::size_t part = 0; part < std::max<std::size_t>(parts, 1); ++part) {
            const bool is_corner = part == 0 && std::abs(turnAt(points, i)) > kCorner;
            loop.points.push_back(points[i] + (static_cast<double>(part) / static_cast<double>(parts)) * side);
            loop.corner.push_back(is_corner ? 1 : 0);
        }
    }
    return loop;
}

/// Marks the points that divide the arcs of a loop into parts: as corners, they stay vertices of the mesh.
/// @param radius  of the arcs [m]
void keepArcs(Loop& loop, double radius)
{
    const std::size_t count = loop.points.size();
    const auto is_on_arc = [&](std::size_t i) {
        const double turn = turnAt(loop.points, i);
        const double before = length(loop.points[i] - loop.points[(i + count - 1) % count]);
        const double after = length(loop.points[(i + 1) % count] - loop.points[i]);
        return turn < 0.0 && turn > -kCorner && std::min(before, after) < kArcEdge * radius;
    };
    const auto first = [&] {
        std::size_t i = 0;
        while (i < count && is_on_arc(i)) {
            ++i;
        }
        return i;
    }();
    for (std::size_t step = 0; step < count;) {
        std::vector<std::size_t> arc;
        double turned = 0.0;
        for (; step < count && is_on_arc((first + step) % count); ++step) {
            arc.push_back((first + step) % count);
            turned -= turnAt(loop.points, arc.back());
        }
        for (std::size_t part = 0; turned > kArcTurn && part <= kArcParts; ++part) {
            loop.corner[arc[part * (arc.size() - 1) / kArcParts]] = 1;
        }
        step += arc.empty() ? 1 : 0;
    }
}

/// Footprint of the loops that are more than specks.
/// @param unit  length of Clipper's unit [m]
Footprint footprintOf(const Paths& paths, double unit, double edge)
{
    const double shortest = kShortest * kUnits * unit;
    Footprint footprint;
    for (const Path& path : paths) {
        if (std::abs(ClipperLib::Area(path)) * unit * unit < kSpeck * edge * edge) {
            continue;
        }
        Loop loop;
        for (const ClipperLib::IntPoint& p : path) {
            const Vec2 place{static_cast<double>(p.X) * unit, static_cast<double>(p.Y) * unit};
            if (loop.points.empty() || length(place - loop.points.back()) > shortest) {
                loop.points.push_back(place);
            }
        }
        while (loop.points.size() > 3 && length(loop.points.back() - loop.points.front()) <= shortest) {
            loop.points.pop_back();
        }
        loop = subdivided(loop.points, 0.5 * edge);
        keepArcs(loop, kUnits * unit);
        if (ClipperLib::Orientation(path)) {
            footprint.rim = std::move(loop);
        } else {
            footprint.holes.push_back(std::move(loop));
        }
    }
    return footprint;
}

}  // namespace

bool hasInnerCorner(const PlanarMesh& footprint)
{
    return hasInnerCorner(loopsOf(footprint));
}

std::optional<PlanarMesh> roundInward(const PlanarMesh& footprint, double radius, double edge)
{
    const std::vector<std::vector<Vec2>> loops = loopsOf(footprint);
    const bool has_corner = radius > 0.0 && hasInnerCorner(loops);
    const double own_edge = meanEdge(area(footprint), footprint.triangles.size());
    if (!has_corner && edge > kFiner * own_edge && edge < kCoarser * own_edge) {
        return std::nullopt;
    }
    for (int round = 0; round < kRounds; ++round, radius *= 0.5) {
        const double unit = (has_corner ? radius : edge) / kUnits;
        const Paths paths = pathsOf(footprint, unit);
        Footprint rounded = footprintOf(has_corner ? closed(paths) : paths, unit, edge);
        const bool has_grown = has_corner && area(rounded) > (1.0 + kGrowth) * area(footprint);
        if (rounded.rim.points.empty() || rounded.holes.size() + 1 != loops.size() || has_grown) {
            continue;
        }
        try {
            return triangulate({{std::move(rounded)}, {}}, {.edge = edge}).front();
        } catch (const Error&) {
            // Loops that leave out vertices may touch each other.
        }
    }
    return std::nullopt;
}

}  // namespace droplet
