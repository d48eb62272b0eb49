// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "droplet/mesh/planar_mesh.h"
#include "droplet/shape/capillary_surface.h"
#include "droplet/shape/solve.h"
#include "droplet/vector.h"

namespace droplet {

/// Why a sheet ends before its target.
enum class SheetEnd {
    Reached,    ///< the target
    NoAngle,    ///< the mean contact angle along the rim has its maximum before the target
    NoHeight,   ///< the height has its maximum before the target
    Unstable,   ///< no equilibrium with more liquid was found
    Contact,    ///< with more liquid the surface touches itself
    NotHeld,    ///< the rim has an angle of 180° all along: more liquid would roll away over the ground
    OutOfWork,  ///< the work was limited
};

/// How hard solveSheet() tries.
enum class SheetEffort {
    Trial,   ///< 30 % of the work or a second, at least 4 %; a sheet that misses the target may have any triangles
    Slight,  ///< 4 %; the end of what the footprint holds is not confirmed
    Modest,  ///< 30 %; likewise
    Full,    ///< at the end, finer triangles confirm it
};

/// Result of solveSheet().
struct SheetResult {
    CapillarySurface surface;          ///< with a footprint: the target, or the last equilibrium before the end
    SheetEnd end = SheetEnd::Reached;  ///< whether it is the target
    std::optional<Vec3> contact;       ///< with SheetEnd::Contact: where the surface touches itself [m]
    double volume = 0.0;               ///< of the sheet [m³]
    double contact_angle = 0.0;        ///< mean along the rim of the sheet [rad]
    std::size_t newton_steps = 0;      ///< in all
    double work = 0.0;                 ///< in all, as SolveOptions::max_work
    double residual = 0.0;             ///< relative, of the forces on the sheet
};

/// Fills a footprint up to the amount of a fill, also where liquid hangs over its rim, and beyond a contact angle of
/// 90°.
///
/// The liquid's surface is a triangle mesh in space, pinned along the rim. Area and gravity are minimised under the
/// volume, from dry ground by steps of the volume; each step is an equilibrium, and a minimum. Where liquid would lie
/// on the ground outside of the footprint, it does, as on ground that it does not wet. Corners of the rim that point
/// inward are rounded to half the mean edge of the footprint's triangles: no triangles can follow liquid around a sharp
/// one. The sheet has as many triangles as the footprint's mesh, to 10 %, but for droplets of less than 361. The work
/// is limited, to about half a minute at 40 000 triangles and one and a half at any number, or to max_work of the
/// options, but for the final triangles. Work is counted, not timed: the same input ends at the same place. An end is
/// confirmed on edges one and a half times those of the footprint.
///
/// Guarantees: a given volume is met to 1e-10; the sheet is not below the ground, and does not cross itself; the same
/// input gives the same bits.
/// @param footprint  valid; on flat ground its inner triangles are not used at the end
/// @param options    liquid, gravity, tilt, ground and fill; model, no_penetration, volumes and solver are not used.
///                   Beyond the end of a ball or a pipe there is no ground
/// @param effort     how much work an end is worth
/// @throws Error     InvalidArgument: options, or a footprint beyond the end of the ground
SheetResult solveSheet(const PlanarMesh& footprint, const SolveOptions& options,
                       SheetEffort effort = SheetEffort::Full);

/// Fills several footprints at one pressure, as one reservoir, whatever the fill's sharing.
/// @param footprints  at least one
/// @param options     as of one footprint; a volume is that of all together
/// @param effort      as of one footprint
/// @param reached     called with the share of the amount that is reached, on the calling thread; may be empty
/// @return            the surface covers all of them; separate() gives each its own
SheetResult solveSheet(const std::vector<PlanarMesh>& footprints, const SolveOptions& options,
                       SheetEffort effort = SheetEffort::Full, const std::function<void(double)>& reached = {});

/// Footprints as one mesh: all rims first. Its loops are those of the footprints, one after another.
/// @param footprints  at least one
PlanarMesh join(const std::vector<PlanarMesh>& footprints);

/// Fills or drains a sheet on the same triangles. They can follow only so far: beyond, the end is SheetEnd::Unstable.
/// @param sheet    result of solveSheet
/// @param volume   wanted [m³], > 0
/// @param options  options it was solved with
/// @throws Error   InvalidArgument: options, or a volume that is not positive
SheetResult refill(const CapillarySurface& sheet, double volume, const SolveOptions& options);

/// Moves a sheet along with its rim, and fills or drains it to the amount of a fill, on the same triangles.
///
/// The rim goes to its new place in steps; each step is an equilibrium, and a minimum. The result is what liquid does
/// whose rim moves slowly: where several equilibria exist, solveSheet() may find another one, as it fills dry ground.
/// If the rim moves, turns or grows as a whole, so do the triangles.
///
/// Guarantees: a given volume is met to 1e-10; the sheet is not below the ground, and does not cross itself; the same
/// input gives the same bits. Triangles keep a tenth of the angles of `first`, or 18°, and their area is between 0.44
/// and 2.25 times that of `first`. Corners of the rim that point inward stay as they are, unlike those of solveSheet().
/// @param first      sheet with which the run of motions began, result of solveSheet
/// @param last       the same sheet at its present place
/// @param footprint  that of `first`, with the same loops, its rim moved
/// @param options    liquid, gravity, tilt and fill, as for solveSheet
/// @return           the end is Reached, or the triangles cannot follow: then solve the sheet anew
/// @throws Error     InvalidArgument: options, or sheets and a footprint that do not belong together
SheetResult follow(const CapillarySurface& first, const CapillarySurface& last, const PlanarMesh& footprint,
                   const SolveOptions& options);

}  // namespace droplet
