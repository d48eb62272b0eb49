// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "droplet/liquid2d/fluid.h"

namespace droplet {

/// A method that moves a liquid's particles.
class FluidSolver {
public:
    FluidSolver() = default;
    FluidSolver(const FluidSolver&) = delete;
    FluidSolver& operator=(const FluidSolver&) = delete;
    virtual ~FluidSolver() = default;

    /// Longest step that a state allows [s].
    [[nodiscard]] virtual double longestStep(const FluidState& state) const = 0;
    /// Greatest part of a spacing that an emitter's liquid moves in a step.
    [[nodiscard]] virtual double emitterCourant() const = 0;
    /// Whether a place lies in liquid without a surface that has no room for more, at the last step. DFSPH never tells.
    [[nodiscard]] virtual bool isFull(Vec2 /*place*/) const { return false; }
    /// Begins a run of steps: what follows depends on the states alone, not on runs before.
    virtual void begin() {}
    /// Moves the particles of a state on by dt, and counts iterations and rescues; the state's time stays.
    virtual void step(FluidState& state, double dt) = 0;
};

}  // namespace droplet
