// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "droplet/footprint/domain.h"
#include "droplet/mesh/planar_mesh.h"
#include "droplet/shape/solve.h"

namespace droplet::bench {

/// A round footprint whose radius is three capillary lengths, so that neither tension nor weight is negligible: a
/// polygon of so many points that it counts as the circle.
Domain disc(const SolveOptions& physics);

/// Largest error of the heights at a mesh's vertices against the exact solution on that disc, u₁ = λ/ρg (1 −
/// I₀(κr)/I₀(κR)) with κ² = ρg/σ, relative to the height in the middle.
double errorOnDisc(const PlanarMesh& mesh, const HeightField& field, const SolveOptions& physics);

}  // namespace droplet::bench
