// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "droplet/mesh/planar_mesh.h"
#include "droplet/shape/figures.h"
#include "droplet/shape/solve.h"
#include "droplet/vector.h"

namespace droplet {

/// Surface of a droplet that may hang over its rim: triangles in space.
///
/// Invariants: a manifold whose boundary is the footprint's rim; the rim's vertices come first, in the order of the
/// footprint's; triangles are counter-clockwise from outside.
struct ParametricSheet {
    std::vector<Vec3> places;           ///< vertices [m]
    std::vector<Triangle> triangles;    ///< indices of three vertices
    std::uint32_t rim = 0;              ///< number of rim vertices, at z = 0
    std::vector<double> contact_angle;  ///< angle between liquid and ground at every rim vertex, 0 … π [rad]
    double pressure = 0.0;              ///< λ, the pressure at the plane's origin [Pa]
};

/// Why a sheet ends before its target.
enum class SheetEnd {
    Reached,   ///< the target
    NoAngle,   ///< the mean contact angle along the rim has its maximum before the target
    NoHeight,  ///< the height has its maximum before the target
    Unstable,  ///< no equilibrium with more liquid was found
};

/// Result of solveSheet().
struct SheetResult {
    ParametricSheet sheet;             ///< the target, or the last equilibrium before the end
    SheetEnd end = SheetEnd::Reached;  ///< whether it is the target
    double volume = 0.0;               ///< of the sheet [m³]
    double contact_angle = 0.0;        ///< mean along the rim of the sheet [rad]
    std::size_t newton_steps = 0;      ///< in all
};

/// Fills a footprint up to the amount of a fill, also where liquid hangs over its rim, and beyond a contact angle of
/// 90°.
///
/// The liquid's surface is a triangle mesh in space, pinned along the rim. Area and gravity are minimised under the
/// volume, from dry ground by steps of the volume; each step is an equilibrium, and a minimum. Where liquid would lie
/// on the ground outside of the footprint, it does, as on ground that it does not wet.
///
/// Guarantees: a given volume is met to 1e-10; the rim is that of the footprint; the sheet is not below the ground
/// where it leans over; the same input gives the same bits.
/// @param footprint  valid; its inner triangles are not used at the end
/// @param options    liquid, gravity, tilt and fill, of one droplet; the ground is flat; model, no_penetration, volumes
///                   and solver are not used
/// @throws Error     InvalidArgument: options, or ground that is not flat
SheetResult solveSheet(const PlanarMesh& footprint, const SolveOptions& options);

/// Measures a sheet, as measure() does a height field. Areas of the linear model and of steep triangles are 0.
/// @param footprint  that of solveSheet
/// @param sheet      result of solveSheet
/// @param options    options it was solved with
ShapeFigures measure(const PlanarMesh& footprint, const ParametricSheet& sheet, const SolveOptions& options);

}  // namespace droplet
