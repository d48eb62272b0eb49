// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "droplet/expression/liquid_shape.h"
#include "droplet/liquid2d/fluid_scene.h"

namespace droplet {

/// Options of morph().
struct MorphOptions {
    Vec2 size{20e-3, 10e-3};        ///< of the window, whose lower left corner is at the origin [m], > 0
    std::size_t frames = 120;       ///< of the whole, at least three for every transition
    std::size_t particles = 12000;  ///< of the liquid, 1000 … 200 000
    double surface_tension = 1.0;   ///< how fast the liquid rounds itself on its way, 0 … 10

    /// @throws Error InvalidArgument, naming field, value and constraint
    void validate() const;
};

/// What takes the outlines of a frame.
/// @param frame  number of the frame, from 0
using MorphSink = std::function<void(std::size_t frame, const LiquidShape& shape)>;

/// Lets a 2D liquid flow from one footprint to the next.
///
/// A target-driven liquid: every particle has a place in the next footprint, by optimal transport, and a force steers
/// it there (Shi and Yu 2005: feedback of velocity and shape), while the liquid stays incompressible and surface
/// tension rounds it. In the first part of a way neighbours are steered together, as Thürey et al. 2006 steer large
/// scales alone, so that details flow freely.
///
/// Guarantees: the first and last frame of each transition have exactly the footprints; the inverse root of a frame's
/// area goes from that of one footprint to that of the next as the liquid goes its way, 10t³ − 15t⁴ + 6t⁵, and the area
/// is within 0.1 % of that, so that liquid which is in both stays in its place; loops are closed and do not cross; the
/// same bytes at any number of threads.
/// @param footprints  two or more, each with an area > 0, inside of the window
/// @param options     number of frames and particles
/// @param take        called for every frame, in order; the time of a shape is that share of all transitions that lies
///                    behind it
/// @throws Error      InvalidArgument
void morph(const std::vector<Region>& footprints, const MorphOptions& options, const MorphSink& take);

}  // namespace droplet
