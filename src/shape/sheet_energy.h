// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/SparseCore>
#include <cstdint>
#include <vector>

#include "shape/area_vector.h"
#include "shape/mesh_pattern.h"

namespace droplet {

/// Integrals over the liquid under a sheet; its base lies in z = 0.
struct SheetIntegrals {
    double area = 0.0;     ///< of the sheet [m²]
    double gravity = 0.0;  ///< ∫ w·x over the liquid [m²]
    double volume = 0.0;   ///< of the liquid [m³]

    friend SheetIntegrals operator+(const SheetIntegrals& a, const SheetIntegrals& b)
    {
        return {a.area + b.area, a.gravity + b.gravity, a.volume + b.volume};
    }
    friend SheetIntegrals operator-(const SheetIntegrals& a, const SheetIntegrals& b)
    {
        return {a.area - b.area, a.gravity - b.gravity, a.volume - b.volume};
    }

    /// Energy over the surface tension [m²].
    [[nodiscard]] double energy() const { return area + gravity; }
};

/// Integrates over a sheet.
/// @param weight  w = ρ(g⊥e_z − g∥)/σ, gradient of gravity's potential over the surface tension [1/m²]
SheetIntegrals integrate(const CapillarySurface& sheet, Vec3 weight);

/// Derivatives by the place of every vertex.
struct SheetGradients {
    std::vector<Vec3> energy;  ///< of area and gravity [m]
    std::vector<Vec3> volume;  ///< [m²]; twice a third of the area around the vertex, along its normal
    std::vector<double> area;  ///< a third of the triangles around the vertex [m²]
};

/// Gradients at all vertices, on the rim too: there they are forces.
SheetGradients gradientsOf(const CapillarySurface& sheet, Vec3 weight);

/// The same at the rim's vertices alone.
SheetGradients rimGradientsOf(const CapillarySurface& sheet, Vec3 weight);

/// Gradients at all vertices, in parallel.
/// @param pattern  of the sheet's triangles
SheetGradients gradientsOf(const CapillarySurface& sheet, Vec3 weight, const MeshPattern& pattern);

/// ∂²(area + gravity − λ volume) by the ways of the vertices inside along directions of their own, lower triangle.
/// @param directions  of all vertices, unit length; those of the rim do not count
/// @param pressure    λ over the surface tension [1/m]
/// @param pattern     of the sheet's triangles
Eigen::SparseMatrix<double> hessianOf(const CapillarySurface& sheet, const std::vector<Vec3>& directions, Vec3 weight,
                                      double pressure, const MeshPattern& pattern);

}  // namespace droplet
