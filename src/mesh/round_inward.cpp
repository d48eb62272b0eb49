// SPDX-License-Identifier: GPL-3.0-or-later
// Morphological closing by a disc, as two offsets of polygons: A. Johnson, Clipper.
#include "mesh/round_inward.h"

#include <algorithm>
#include <cmath>
#include <polyclipping/clipper.hpp>
#include <utility>
#include <vector>

#include "droplet/footprint/domain.h"
#include "droplet/mesh/triangulate.h"
#include "mesh/mean_edge.h"

namespace droplet {
namespace {

using ClipperLib::Path;
using ClipperLib::Paths;

/// Turn of the rim at a vertex that is a corner, and not a part of an arc [rad].
constexpr double kCorner = 0.5;
/// Distance between arcs and their chords, and of vertices that are dropped, over the radius.
constexpr double kChord = 0.002;
constexpr double kDropped = 0.004;
/// Units of Clipper's integers in a radius.
constexpr double kUnits = 1e5;
/// Edges over the mean edge of a mesh from which on new triangles are needed.
constexpr double kFiner = 0.8;
/// Area of loops that vanish, over the squared edge: less than a triangle or two.
constexpr double kSpeck = 1.0;

double turnAt(const std::vector<Vec2>& loop, std::size_t i)
{
    const std::size_t count = loop.size();
    const Vec2 in = loop[i] - loop[(i + count - 1) % count];
    const Vec2 out = loop[(i + 1) % count] - loop[i];
    return std::atan2(cross(in, out), dot(in, out));
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

Paths offset(const Paths& paths, double distance)
{
    ClipperLib::ClipperOffset offsetter(2.0, kChord * kUnits);
    offsetter.AddPaths(paths, ClipperLib::jtRound, ClipperLib::etClosedPolygon);
    Paths result;
    offsetter.Execute(result, distance);
    return result;
}

}  // namespace

std::optional<PlanarMesh> roundInward(const PlanarMesh& footprint, double radius, double edge)
{
    const std::vector<std::vector<Vec2>> loops = loopsOf(footprint);
    const bool has_corner = hasInnerCorner(loops);
    if (!has_corner && edge > kFiner * meanEdge(area(footprint), footprint.triangles.size())) {
        return std::nullopt;
    }
    const double unit = radius / kUnits;
    Paths paths;
    for (const std::vector<Vec2>& loop : loops) {
        Path& path = paths.emplace_back();
        for (const Vec2 p : loop) {
            path.emplace_back(std::llround(p.x / unit), std::llround(p.y / unit));
        }
    }
    if (has_corner) {
        paths = offset(offset(paths, kUnits), -kUnits);
        ClipperLib::CleanPolygons(paths, kDropped * kUnits);
    }
    Footprint rounded;
    for (const Path& path : paths) {
        if (std::abs(ClipperLib::Area(path)) * unit * unit < kSpeck * edge * edge) {
            continue;
        }
        Loop loop;
        for (const ClipperLib::IntPoint& p : path) {
            loop.points.push_back({static_cast<double>(p.X) * unit, static_cast<double>(p.Y) * unit});
        }
        for (std::size_t i = 0; i < loop.points.size(); ++i) {
            loop.corner.push_back(std::abs(turnAt(loop.points, i)) > kCorner ? 1 : 0);
        }
        if (ClipperLib::Orientation(path)) {
            rounded.rim = std::move(loop);
        } else {
            rounded.holes.push_back(std::move(loop));
        }
    }
    if (rounded.rim.points.empty()) {
        return std::nullopt;
    }
    return triangulate({{std::move(rounded)}, {}}, {.edge = edge}).front();
}

}  // namespace droplet
