// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "droplet/mesh/planar_mesh.h"
#include "droplet/shape/solve.h"

namespace droplet {

/// Smallest, mean (by rim length) and largest contact angle along a rim [rad].
struct ContactAngle {
    double min = 0.0;
    double mean = 0.0;
    double max = 0.0;
};

/// What can be measured on a solved droplet, or on several together; all integrals over the mesh itself.
struct ShapeFigures {
    double footprint_area = 0.0;  ///< [m²]
    double rim_length = 0.0;      ///< [m]
    double volume = 0.0;          ///< ∫u [m³]
    double height_max = 0.0;      ///< [m]
    double liquid_area = 0.0;     ///< ∫√(1+|∇u|²), the true area of the liquid's surface [m²]
    double surface_energy = 0.0;  ///< σ · liquid_area [J]
    double gravity_energy = 0.0;  ///< ½ρg∫u² [J]
    double slope_max = 0.0;       ///< steepest triangle [rad]
    ContactAngle contact_angle;
};

/// Measures one droplet.
/// @param mesh     the mesh `field` was solved on
/// @param field    heights
/// @param options  the physics it was solved with
ShapeFigures measure(const PlanarMesh& mesh, const HeightField& field, const SolveOptions& options);

/// Figures of several droplets together: sums, extremes, means weighted by rim length.
ShapeFigures combine(const std::vector<ShapeFigures>& droplets);

}  // namespace droplet
