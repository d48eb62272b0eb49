// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <polyclipping/clipper.hpp>

#include "droplet/mesh/planar_mesh.h"

namespace droplet {

/// Loops of a footprint as Clipper's polygons.
/// @param unit  of Clipper's integers [m]
inline ClipperLib::Paths pathsOf(const PlanarMesh& footprint, double unit)
{
    ClipperLib::Paths paths(footprint.loopCount());
    for (std::size_t k = 0; k < footprint.loopCount(); ++k) {
        for (std::uint32_t v = footprint.loop_starts[k]; v < footprint.loop_starts[k + 1]; ++v) {
            const Vec2 p = footprint.vertices[v];
            paths[k].emplace_back(std::llround(p.x / unit), std::llround(p.y / unit));
        }
    }
    return paths;
}

/// Polygons of which every point within a distance is added, or taken away.
/// @param distance  in Clipper's integers; negative: taken away
/// @param chord     largest distance between arcs and their chords, in Clipper's integers
inline ClipperLib::Paths offset(const ClipperLib::Paths& paths, double distance, double chord)
{
    constexpr double kMiter = 2.0;  // of no account: corners are round
    ClipperLib::ClipperOffset offsetter(kMiter, chord);
    offsetter.AddPaths(paths, ClipperLib::jtRound, ClipperLib::etClosedPolygon);
    ClipperLib::Paths result;
    offsetter.Execute(result, distance);
    return result;
}

}  // namespace droplet
