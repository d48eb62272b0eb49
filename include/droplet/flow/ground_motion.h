// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "droplet/vector.h"

namespace droplet {

/// How the ground moves around the time at which it has a shape: place + velocity t + acceleration t²/2.
///
/// Invariants: both arrays have an element for every face, or none: then the ground rests.
struct GroundMotion {
    /// What a face, as a whole, has moved and how fast it is.
    struct Drift {
        Vec3 way;           ///< since `time` [m]
        Vec3 velocity;      ///< [m/s]
        Vec3 acceleration;  ///< [m/s²]
    };

    double time = 0.0;                              ///< at which the ground has the shape [s]
    std::vector<std::array<Vec3, 3>> velocity;      ///< of every face's corners [m/s]
    std::vector<std::array<Vec3, 3>> acceleration;  ///< of every face's corners [m/s²]

    /// Whether the ground does not move.
    [[nodiscard]] bool rests() const { return velocity.empty(); }
    /// Mean of a face's corners.
    /// @param face  number in FlowSurface::faces
    /// @param at    [s]
    [[nodiscard]] Drift driftOf(std::uint32_t face, double at) const;
};

}  // namespace droplet
