// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "droplet/mesh/planar_mesh.h"
#include "droplet/shape/solve.h"

namespace droplet {

/// Range in which a viewer can fill and drain a droplet, in multiples of its solved amount (fills).
struct FillRange {
    double min = 0.0;         ///< smallest fill
    double max = 2.0;         ///< largest fill
    bool may_shrink = false;  ///< keep to the fills that exist

    /// Checks the range.
    /// @throws Error InvalidArgument unless 0 ≤ min ≤ 1 ≤ max, min < max, both finite
    void validate() const;
};

/// Change of a height field by one more fill.
struct FillGain {
    std::vector<double> height;     ///< change of u at every vertex of the mesh [m]; 0 on the rim
    std::vector<double> rim_slope;  ///< change of ∂u/∂n at every rim vertex
    double pressure = 0.0;          ///< change of the pressure [Pa]
};

/// Checks that a solution with these options can be refilled.
/// @throws Error InvalidArgument with no_penetration
void requireRefillable(const SolveOptions& options);

/// Computes how solved droplets grow with the amount of liquid. At fill f the heights are exactly u + (f − 1)·gain,
/// because the linear model is affine in the volume. With FillSharing::Each one fill is the volume of each droplet.
/// With FillSharing::Total it is the volume of the reservoir, which fills all droplets at one pressure.
///
/// Guarantees: volumes of the gains are exact to 1e-10; the same bits at any number of threads.
/// @param meshes   meshes that were solved
/// @param fields   result of solve
/// @param options  options of solve; linear model, without no_penetration
/// @throws Error   InvalidArgument: options, or fields that do not fit the meshes; NoSuchDroplet: there is no liquid to
///                 multiply, or the solver failed
std::vector<FillGain> gainsPerFill(const std::vector<PlanarMesh>& meshes, const std::vector<CapillarySurface>& fields,
                                   const SolveOptions& options);

}  // namespace droplet
