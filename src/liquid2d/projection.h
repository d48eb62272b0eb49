// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "neighbours.h"

namespace droplet {

/// Limits of a projection.
struct ProjectionOptions {
    double tolerance = 0.0;  ///< mean rate of compression at which iterations stop [1/s]
    int min_iterations = 2;
    int max_iterations = 100;
};

/// Change of a velocity [m/s].
struct Change {
    float x = 0.0F;
    float y = 0.0F;
};

/// Velocities that pressures cause, and what they leave.
struct Projection {
    std::vector<Change> change;  ///< of the velocities
    int iterations = 0;
    double residual = 0.0;  ///< mean rate of compression that is left [1/s]
};

/// Rates at which densities, relative to that at rest, grow by velocities [1/s].
std::vector<float> compressionRates(const Neighbourhood& near, std::span<const Vec2> velocity,
                                    const WallSamples& walls);

/// Greatest speed of a particle towards or from a neighbour, of the liquid or the walls [m/s].
double approachSpeed(const Neighbourhood& near, std::span<const Vec2> velocity, const WallSamples& walls);

/// Pressures, none below zero, that keep `rate` from compressing any particle: the velocities that they cause lower the
/// rate of each particle with pressure to zero, and that of each other particle below zero.
/// @param rate      rate of compression to undo [1/s]
/// @param pressure  of each particle, times the step over density: the first guess, and the result [m²/s]
Projection project(const Neighbourhood& near, std::span<const float> rate, std::vector<float>& pressure,
                   const ProjectionOptions& options);

}  // namespace droplet
