// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <polyclipping/clipper.hpp>

namespace droplet {

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
