// SPDX-License-Identifier: GPL-3.0-or-later
// Modified Bessel functions: M. Abramowitz, I. A. Stegun, "Handbook of Mathematical Functions" (1964), section 9.6.
#include "disc.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "system.h"

namespace droplet::bench {
namespace {

// The error of the polygon's area is 2/3 (π/n)² = 1.5e-9, far below the finest mesh's error of 6e-7.
constexpr std::size_t kPoints = 65'536;

}  // namespace

Disc::Disc(double capillary_lengths)
    : size_(capillary_lengths),
      weight_(Liquid{}.density * kStandardGravity),
      kappa_(std::sqrt(weight_ / Liquid{}.surface_tension)),
      radius_(size_ / kappa_)
{
}

Domain Disc::domain() const
{
    Loop loop;
    for (std::size_t i = 0; i < kPoints; ++i) {
        const double angle = 2.0 * std::numbers::pi * static_cast<double>(i) / kPoints;
        loop.points.push_back({radius_ * std::cos(angle), radius_ * std::sin(angle)});
    }
    loop.corner.assign(kPoints, 0);
    return {{{loop, {}}}, {2.0 * radius_, 2.0 * radius_}};
}

double Disc::heightError(const CapillarySurface& field) const
{
    const double scale = field.pressure / weight_;
    const double rim = std::cyl_bessel_i(0.0, size_);
    double largest = 0.0;
    for (const Vec3& p : field.vertices) {
        const double exact = scale * (1.0 - std::cyl_bessel_i(0.0, kappa_ * length(Vec2{p.x, p.y})) / rim);
        largest = std::max(largest, std::abs(p.z - exact));
    }
    return largest / (scale * (1.0 - 1.0 / rim));
}

double Disc::middleError(const CapillarySurface& field) const
{
    const double exact = field.pressure / weight_ * (1.0 - 1.0 / std::cyl_bessel_i(0.0, size_));
    return std::abs(height(field) / exact - 1.0);
}

double Disc::volumeError(const CapillarySurface& field) const
{
    const double ratio = std::cyl_bessel_i(1.0, size_) / (size_ * std::cyl_bessel_i(0.0, size_));
    const double exact = 2.0 * std::numbers::pi * radius_ * radius_ * field.pressure / weight_ * (0.5 - ratio);
    return std::abs(volume(field) / exact - 1.0);
}

}  // namespace droplet::bench
