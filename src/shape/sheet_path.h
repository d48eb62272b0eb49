// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "droplet/mesh/planar_mesh.h"
#include "droplet/shape/sheet.h"
#include "shape/area_vector.h"
#include "shape/sheet_base.h"

namespace droplet {

/// What a sheet should become.
struct SheetTarget {
    FillBy by = FillBy::Volume;             ///< volume, largest height, or mean contact angle along the rim
    double amount = 0.0;                    ///< [m³], [m] or [rad], > 0; an angle ≤ π
    std::optional<double> max_height = {};  ///< height at which an angle is not raised any more [m]
};

/// Liquid and accuracy of a sheet.
struct SheetOptions {
    Vec3 weight;                     ///< w = ρ(g⊥e_z − g∥)/σ [1/m²]
    double edge = 0.0;               ///< largest edge of a triangle where an end is confirmed [m], > 0
    double path_edge = 0.0;          ///< the same on the way; at least edge
    std::size_t triangles = 0;       ///< number at the end, > 0; fewer where small ones fail at a fold
    double min_step = 1e-3;          ///< smallest step of the volume, over the volume
    double tolerance = 1e-9;         ///< relative residual of an equilibrium, and error of the target
    bool is_end_confirmed = true;    ///< on triangles of the final size
    bool mends = false;              ///< the final triangles, as of RemeshOptions
    bool is_largest_wanted = false;  ///< where the target is missed, the sheet with the largest share of it, not the
                                     ///< last one
    bool is_end_wanted = true;       ///< otherwise a path that misses its target ends with any sheet
    double max_work = 5e9;    ///< sum over factorisations of the power 3/2 of the triangles; 1e9 take two seconds.
                              ///< Line searches and new triangles count as well;
                              ///< the final triangles have an allowance of their own
    BaseSurface ground = {};  ///< under the footprint, and around it
    std::function<void(double)> reached = {};  ///< called with the share of the target after steps of the volume
};

/// Angles between liquid and ground along the rim.
struct RimAngles {
    std::vector<double> angle;   ///< at every rim vertex, 0 … π [rad]
    std::vector<double> weight;  ///< length of the rim that belongs to it [m]

    [[nodiscard]] double mean() const;
};

/// Angles from the forces that the rim holds; they include the pressure and gravity on the triangles there.
/// @param pressure  λ over the surface tension [1/m]
/// @param ground    to which the angles are measured
RimAngles rimAngles(const CapillarySurface& sheet, Vec3 weight, double pressure, const BaseSurface& ground = {});

/// Equilibrium of a liquid that may hang over its rim.
struct FilledSheet {
    CapillarySurface mesh;
    double pressure = 0.0;  ///< λ over the surface tension [1/m]
    double volume = 0.0;    ///< [m³]
    double height = 0.0;    ///< [m]
    double angle = 0.0;     ///< mean along the rim [rad]
    SheetEnd end = SheetEnd::Reached;
    std::optional<Vec3> contact;  ///< with SheetEnd::Contact: where the sheet touches itself [m]
    int newton_steps = 0;         ///< in all
    double work = 0.0;            ///< in all, as SheetOptions::max_work
    double residual = 0.0;        ///< relative, of the last equilibrium
};

/// Fills a footprint from dry ground up to a target, by steps of the volume.
///
/// Guarantees: the sheet is in equilibrium, a minimum of its energy at its volume, which is met to 1e-10; its rim is
/// that of the footprint; nothing is below the ground. If the target is not reached, it is the last equilibrium before
/// the end.
/// @param footprint  of one droplet, or of several at one pressure, which touch each other no more than themselves
FilledSheet fillSheet(const PlanarMesh& footprint, const SheetTarget& target, const SheetOptions& options);

/// Sheet near an equilibrium, on flat ground.
struct SheetStart {
    CapillarySurface mesh;
    double pressure = 0.0;  ///< λ over the surface tension [1/m]
    double volume = 0.0;    ///< near that of the target [m³]
    bool is_last = true;  ///< meets the target, and must not touch itself; otherwise the result is a start in its turn
};

/// Leads a sheet to a target on triangles that are much like its own, of the edges and the number of the options.
/// @return  none if there is no such equilibrium near
std::optional<FilledSheet> settleSheet(SheetStart start, const SheetTarget& target, const SheetOptions& options);

/// Fills or drains an equilibrium to a target on the same triangles. They can follow only so far: the end is Unstable
/// where they wear out.
/// @param sheet     an equilibrium
/// @param pressure  of it, over the surface tension [1/m]
/// @param base      what it lies on
FilledSheet refillSheet(const CapillarySurface& sheet, double pressure, const SheetTarget& target, Vec3 weight,
                        const SheetBase& base);

}  // namespace droplet
