// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <numbers>

#include "droplet/vector.h"

namespace droplet {

/// Cubic spline kernel of Monaghan and Lattanzio (1985), normalised in the plane. Its support is two spacings, which
/// keeps about 13 neighbours.
class Kernel {
public:
    /// @param spacing  of particles at rest [m], > 0
    explicit Kernel(double spacing)
        : support_(2.0 * spacing),
          inverse_(1.0 / support_),
          scale_(40.0 / (7.0 * std::numbers::pi * support_ * support_)),
          slope_scale_(6.0 * scale_ * inverse_ * inverse_),
          // Hexagonal lattice of one particle per spacing².
          area_(1.0 / latticeSum(spacing))
    {
    }

    /// Distance from which on the kernel is zero [m].
    [[nodiscard]] double support() const { return support_; }

    /// Value at a distance [1/m²].
    [[nodiscard]] double operator()(double distance) const
    {
        const double q = distance * inverse_;
        if (q >= 1.0) {
            return 0.0;
        }
        const double rest = 1.0 - q;
        return scale_ * (q <= 0.5 ? 1.0 - 6.0 * q * q * rest : 2.0 * rest * rest * rest);
    }

    /// Value, and derivative by the distance, divided by the distance [1/m⁴], which times the difference of two places
    /// is the gradient; at a distance below the support.
    struct Both {
        double value;
        double slope_over_distance;
    };
    [[nodiscard]] Both both(double distance) const
    {
        const double q = distance * inverse_;
        const double rest = 1.0 - q;
        if (q <= 0.5) {
            return {scale_ * (1.0 - 6.0 * q * q * rest), slope_scale_ * (3.0 * q - 2.0)};
        }
        return {scale_ * 2.0 * rest * rest * rest, -slope_scale_ * rest * rest / q};
    }

    /// Area of a particle [m²], such that areas times kernels sum to one on the lattice at rest.
    [[nodiscard]] double area() const { return area_; }

private:
    [[nodiscard]] double latticeSum(double spacing) const;

    double support_;
    double inverse_;
    double scale_;
    double slope_scale_;
    double area_;
};

/// Distance of neighbours in the hexagonal lattice that has one particle per spacing² [m].
double latticeStep(double spacing);

}  // namespace droplet
