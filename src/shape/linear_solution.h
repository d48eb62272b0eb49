// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

namespace droplet {

/// A linear system solved, or not.
struct LinearSolution {
    std::vector<double> values;  ///< at the mesh's inner vertices, in their order [m²]
    double integral = 0.0;       ///< ∫ of the values [m⁴]
    double residual = 0.0;       ///< relative, computed from the values
    std::size_t iterations = 0;  ///< 1 for a factorisation
    bool converged = false;      ///< residual below kLargestResidual
};

/// Residuals beyond this are no solution. Factorisations of a million triangles leave 1e-12, iterations stop at 1e-10.
inline constexpr double kLargestResidual = 1e-9;

}  // namespace droplet
