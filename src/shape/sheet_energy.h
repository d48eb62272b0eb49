// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/SparseCore>
#include <cstdint>
#include <vector>

#include "shape/area_vector.h"

namespace droplet {

/// Integrals over the liquid under a sheet; its base lies in z = 0.
struct SheetIntegrals {
    double area = 0.0;     ///< of the sheet [m²]
    double gravity = 0.0;  ///< ∫ w·x over the liquid [m²]
    double volume = 0.0;   ///< of the liquid [m³]

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

/// Entries of a sheet's matrices: one unknown for every vertex inside, its way along a direction of its own.
class SheetPattern {
public:
    explicit SheetPattern(const CapillarySurface& sheet);

    /// ∂²(area + gravity − λ volume) by the unknowns, lower triangle.
    /// @param directions  of all vertices, unit length; those of the rim do not count
    /// @param pressure    λ over the surface tension [1/m]
    [[nodiscard]] Eigen::SparseMatrix<double> hessian(const CapillarySurface& sheet,
                                                      const std::vector<Vec3>& directions, Vec3 weight,
                                                      double pressure) const;

    /// Lower triangle with the entries that may differ from 0, all 0.
    [[nodiscard]] const Eigen::SparseMatrix<double>& empty() const { return empty_; }

    /// The same as gradientsOf(), in parallel.
    [[nodiscard]] SheetGradients gradients(const CapillarySurface& sheet, Vec3 weight) const;

private:
    /// Lists of what adds up to every one of many sums.
    struct Gathering {
        std::vector<std::int32_t> starts;
        std::vector<std::int32_t> parts;  ///< in ascending order
    };
    /// @param sum_of  of every part, −1 for none
    static Gathering gather(const std::vector<std::int32_t>& sum_of, std::size_t sums);

    Eigen::SparseMatrix<double> empty_;
    Gathering entries_;  ///< for values of the matrix: six times a triangle and a pair of its corners
    Gathering corners_;  ///< for vertices: three times a triangle and its corner
};

}  // namespace droplet
