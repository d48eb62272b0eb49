// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstddef>

#include "droplet/mesh/planar_mesh.h"

namespace droplet {

// Work is counted, never timed: the same input ends at the same place on every machine. Two models have their own unit:
// height fields an unknown in an iteration of a linear system, about 0.3 µs, as SolveOptions::max_work; sheets 2 ns.

/// Units of a sheet's work in one of a height field's.
inline constexpr double kSheetUnits = 150.0;

/// Work of one factorisation for the triangles of a sheet, in its unit.
inline double factorWork(std::size_t triangles)
{
    return std::pow(static_cast<double>(triangles), 1.5);
}

/// Triangles of a sheet that so many factorisations with some work are enough for.
/// @param work  in the unit of sheets, at least 0
inline std::size_t trianglesFor(double work, double factorisations)
{
    constexpr double kMost = 1e9;
    return static_cast<std::size_t>(std::fmin(std::pow(work / factorisations, 2.0 / 3.0), kMost));
}

/// Work that may be done, and what was done of it.
struct Work {
    double most = 0.0;
    double done = 0.0;

    [[nodiscard]] double left() const { return std::fmax(most - done, 0.0); }
    [[nodiscard]] bool isLeft() const { return done < most; }
};

/// Unknowns of a height field: vertices inside.
inline std::size_t unknownsOf(const PlanarMesh& mesh)
{
    return mesh.vertices.size() - mesh.rimVertexCount();
}

/// Most work of a height field by default: half a minute for about ten thousand unknowns.
inline double fieldWork(std::size_t unknowns)
{
    constexpr double kBase = 6e7;
    constexpr double kPerUnknown = 2000.0;
    return kBase + kPerUnknown * static_cast<double>(unknowns);
}

}  // namespace droplet
