// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "droplet/expression/expression.h"

namespace droplet {

/// Tapering body of a particle in flight: a polyline with a width at every point.
struct Tail {
    std::vector<Vec2> place;    ///< head first [m]
    std::vector<double> width;  ///< over that of the particle without a tail
};

/// Radius of a tail along its skeleton, over that of its head: falls from 1 at 0 to 0 at 1.
/// @param slope  0.2 (thick) … 1.2 (thin)
double taper(double along, double slope);

/// Radius along a skeleton, from 0 to 1, over that of the head.
using Taper = std::function<double(double along)>;

/// Radius of the head of a tail of a length that has the area of a disc, both over the disc's radius.
double headRadius(double length, const Taper& taper);

/// Tails of the particles in flight, by index in the frame; those without a tail have no points.
std::vector<Tail> tailsOf(const ExpressionState& state, const ParticleFrame& frame, const ExpressionOptions& options);

}  // namespace droplet
