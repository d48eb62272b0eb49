// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "droplet/domain/domain.h"
#include "droplet/shape/solve.h"

namespace droplet::bench {

/// Round footprint of water, whose heights are known exactly.
class Disc {
public:
    /// @param capillary_lengths  radius in units of √(σ/ρg); far below 1, tension shapes the droplet, far above, weight
    explicit Disc(double capillary_lengths);

    /// Polygon with enough points to represent the circle.
    [[nodiscard]] Domain domain() const;

    /// Largest error of the heights at the vertices against the exact ones,
    /// u = λ/ρg (1 − I₀(κr)/I₀(κR)) with κ² = ρg/σ, relative to the height in the middle.
    [[nodiscard]] double heightError(const CapillarySurface& field) const;

    /// Relative error of the largest height, which is in the middle.
    [[nodiscard]] double middleError(const CapillarySurface& field) const;

    /// Relative error of the volume, 2πR² λ/ρg (½ − I₁(κR)/(κR I₀(κR))). It is the squared error of the heights in the
    /// energy norm.
    [[nodiscard]] double volumeError(const CapillarySurface& field) const;

private:
    double size_;    // κR
    double weight_;  // ρg [N/m³]
    double kappa_;   // [1/m]
    double radius_;  // [m]
};

}  // namespace droplet::bench
