// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "droplet/mesh/planar_mesh.h"
#include "droplet/shape/solve.h"

namespace droplet {

/// How a droplet can be filled and drained without solving again, in fills: multiples of the liquid it was solved with.
struct FillRange {
    double min = 0.0;
    double max = 2.0;

    /// @throws Error InvalidArgument unless 0 ≤ least ≤ 1 ≤ most, least < most, both finite
    void validate() const;
};

/// What one more fill adds to a height field.
struct FillGain {
    std::vector<double> height;     ///< at every vertex of the mesh [m]; 0 on the rim
    std::vector<double> rim_slope;  ///< to ∂u/∂n at every rim vertex
    double pressure = 0.0;          ///< [Pa]
};

/// Guarantees: returns only when what these options solve is affine in the volume.
/// @throws Error InvalidArgument with Model::Exact or no_penetration
void requireRefillable(const SolveOptions& options);

/// How solved droplets grow with the amount of liquid: with f times of it, heights are u + (f − 1)·gain, exactly, as
/// the linear model is affine in the volume. With FillSharing::Each one fill is every droplet's own volume, with
/// FillSharing::Total that of the reservoir, which fills all of them at one pressure.
///
/// Guarantees: gains are volumes to 1e-10, and the same at any number of threads, as in solve.
/// @param meshes   what was solved on
/// @param fields   what solve returned
/// @param options  what it was solved with; linear, without no_penetration
/// @throws Error   InvalidArgument for options or fields of other meshes; NoSuchDroplet if there is no liquid to
///                 multiply, or the solver fails
std::vector<FillGain> gainsPerFill(const std::vector<PlanarMesh>& meshes, const std::vector<HeightField>& fields,
                                   const SolveOptions& options);

}  // namespace droplet
