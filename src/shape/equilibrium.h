// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "droplet/shape/fill.h"
#include "shape/constrained.h"
#include "shape/energy.h"

namespace droplet {

/// Surface of one droplet, not yet in equilibrium.
struct Sheet {
    std::vector<double> height;      ///< u at every vertex [m]
    std::vector<std::uint8_t> held;  ///< 1 at inner vertices that lie on the ground; empty: none
    std::vector<double> flux;        ///< inward flux through the rim at rim vertices
    double volume = 0.0;             ///< ∫(u − h) [m³]
    double pressure = 0.0;           ///< λ/σ [1/m]
};

/// Sheet without liquid: u = h.
Sheet emptySheet(const Energy& energy);

/// Energy of a droplet, with its sheet and the solver of its linear systems.
struct Member {
    Energy* energy = nullptr;
    ConstrainedSolver* solver = nullptr;
    Sheet* sheet = nullptr;
};

/// Options of settle().
struct SettleOptions {
    Fill fill;                              ///< fill of all members together, at one pressure
    std::optional<double> max_height = {};  ///< thickness at which a contact angle is not raised any more [m]
    double tolerance = 1e-9;                ///< residual of the exact model, relative to pressure and size
    double linear_tolerance = 1e-10;        ///< residual of the linear model's systems
    std::size_t max_steps = 40;
    double max_work = std::numeric_limits<double>::infinity();  ///< work after which no step begins
};

/// Result of settle().
struct Settled {
    bool converged = false;
    bool stable = true;  ///< false if one reservoir under a ceiling drains into one droplet
    std::size_t newton_steps = 0;
    std::size_t iterations = 0;  ///< largest number for a linear system
    double work = 0.0;           ///< as in SolveOptions::max_work
    double residual = 0.0;
};

/// Finds the equilibrium of sheets at one pressure and the amount of the fill.
///
/// The linear model is affine in the volume, so its first step is exact; with no_penetration, the first step with the
/// right set of held vertices. The exact model continues Newton's method from the given sheets.
Settled settle(const std::vector<Member>& members, const SettleOptions& options);

/// Largest thickness of all sheets [m], or their mean contact angle [rad].
double amountOf(const std::vector<Member>& members, FillBy by);

}  // namespace droplet
