// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "droplet/expression/expression.h"
#include "particle_cells.h"

namespace droplet {

/// Radius of a tail at u of its length, in radii of its head: a cubic Hermite curve from 1 to 0.
/// @param slope  fall at the head; 1 is a cone
double tailProfile(double u, double slope);

/// Radius of a tail's head, in radii of the disc of its area.
class TailRadius {
public:
    /// @param slope  of tailProfile()
    explicit TailRadius(double slope);
    /// @param length  of the tail in radii of the disc
    [[nodiscard]] double operator()(double length) const;

private:
    std::vector<double> length_, radius_;
};

/// Piece of a tail: discs whose radius changes evenly from one end to the other. In spacings, absolute.
struct TailPiece {
    Vec2 from{}, to{};
    double from_radius = 0.0;
    double to_radius = 0.0;
};

/// Particle of a droplet with a tail, contracted. In spacings, absolute.
struct TailHead {
    std::uint32_t sorted = 0;  ///< among the sorted particles
    Vec2 centre{};
    double scale = 1.0;  ///< of its kernel's support
};

/// Tails of the detached droplets of a frame.
struct Tails {
    std::vector<TailHead> heads;
    std::vector<TailPiece> pieces;
};

/// What tails are made from.
struct TailInput {
    const ExpressionState& state;
    const std::vector<std::uint32_t>& memory;  ///< for each particle of the frame its place in the state
    const ParticleFrame& frame;
    const ParticleCells& cells;
    const std::vector<std::uint64_t>& full;  ///< cells of each tile that are surely liquid
};

Tails tailsOf(const TailInput& input, const ExpressionOptions& options);

}  // namespace droplet
