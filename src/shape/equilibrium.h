// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "droplet/shape/fill.h"
#include "shape/constrained.h"
#include "shape/energy.h"

namespace droplet {

/// The surface of one droplet on its way to equilibrium.
struct Sheet {
    std::vector<double> height;      ///< u at every vertex [m]
    std::vector<std::uint8_t> held;  ///< 1 at inner vertices that lie on the ground; empty: at none
    std::vector<double> flux;        ///< through the rim, inward, at rim vertices
    double volume = 0.0;             ///< ∫(u − h) [m³]
    double pressure = 0.0;           ///< λ/σ [1/m]
};

/// The sheet without liquid: u = h.
Sheet emptySheet(const Energy& energy);

/// A droplet's energy with the solver of its linear systems.
struct Member {
    Energy* energy = nullptr;
    ConstrainedSolver* solver = nullptr;
    Sheet* sheet = nullptr;
};

/// How sheets are brought to equilibrium.
struct SettleOptions {
    Fill fill;                        ///< of all members together, at one pressure
    double tolerance = 1e-9;          ///< of the exact model's residual, relative to pressure and size
    double linear_tolerance = 1e-10;  ///< of the linear model's systems
    std::size_t max_steps = 40;
    double max_work = std::numeric_limits<double>::infinity();  ///< after which no step is begun
};

/// How it went.
struct Settled {
    bool converged = false;
    bool stable = true;  ///< with one reservoir under a ceiling: whether it stays one
    std::size_t newton_steps = 0;
    std::size_t iterations = 0;  ///< most of any linear system
    double work = 0.0;           ///< as in SolveOptions::max_work
    double residual = 0.0;
};

/// Finds the sheets' equilibrium at one pressure and the fill's amount.
///
/// The linear model is affine in the volume, so its first step is exact, and with no_penetration the first step whose
/// set of held vertices is right. With the exact model Newton's method goes on from the sheets as they are.
Settled settle(const std::vector<Member>& members, const SettleOptions& options);

/// The largest thickness of all sheets [m], or their mean contact angle [rad].
double amountOf(const std::vector<Member>& members, FillBy by);

}  // namespace droplet
