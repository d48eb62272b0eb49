// SPDX-License-Identifier: GPL-3.0-or-later
// What both solvers share: liquid at the start, emitters, steps, and the margin beyond which particles are removed.
#include "droplet/liquid2d/fluid.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "dfsph.h"
#include "droplet/error.h"
#include "free_places.h"
#include "grid_liquid.h"
#include "kernel.h"
#include "number_text.h"
#include "region.h"
#include "reorder.h"
#include "require.h"

namespace droplet {
namespace {

void validate(const FluidOptions& options)
{
    if (options.courant) {
        const bool is_grid = options.solver == PressureSolver::Grid;
        require(*options.courant > 0.0 && *options.courant <= (is_grid ? 6.0 : 1.0), "courant", *options.courant,
                is_grid ? "more than 0 and at most 6" : "more than 0 and at most 1");
    }
    require(options.density_error > 0.0, "density_error", options.density_error, "more than 0");
    require(options.divergence_error > 0.0, "divergence_error", options.divergence_error, "more than 0");
    require(options.max_iterations >= 2, "max_iterations", options.max_iterations, "at least 2");
}

}  // namespace

class FluidStepper::Steps {
public:
    Steps(FluidScene scene, FluidOptions options) : scene_(std::move(scene)), options_(std::move(options))
    {
        scene_.validate();
        validate(options_);
        solver_ = options_.solver == PressureSolver::Grid ? gridLiquid(scene_, options_) : dfsph(scene_, options_);
    }

    void advance(FluidState& state, double until)
    {
        solver_->begin();
        while (state.time < until) {
            step(state, until);
        }
    }

    /// Longest step that the state allows.
    [[nodiscard]] double longestStep(const FluidState& state) const
    {
        double dt = solver_->longestStep(state);
        for (const Emitter& emitter : scene_.emitters) {
            dt = std::min(dt, solver_->emitterCourant() * scene_.spacing / length(emitter.velocity));
        }
        return dt;
    }

private:
    void step(FluidState& state, double until)
    {
        const double longest = longestStep(state);
        const double left = until - state.time;
        const double parts = std::ceil(left / longest);
        const bool is_last = !(parts > 1.0);
        const double dt = is_last ? left : left / parts;
        if (!(until - dt < until)) {
            throw Error(ErrorCode::NoSuchDroplet,
                        fmt::format("at {} s a step of {} s is too short to add up: gravity, speeds or forces are too "
                                    "large for a spacing of {} m",
                                    numberText(state.time), numberText(dt), numberText(scene_.spacing)));
        }
        solver_->step(state, dt);
        emit(state, dt);
        state.time = is_last ? until : state.time + dt;
        state.step = dt;
        remove(state);
        ++state.counts.steps;
    }

    /// Places what has left the nozzles at the end of a step.
    void emit(FluidState& state, double dt) const
    {
        const double step = latticeStep(scene_.spacing);
        const double row_height = 0.5 * std::sqrt(3.0) * step;
        for (std::size_t k = 0; k < scene_.emitters.size(); ++k) {
            const Emitter& emitter = scene_.emitters[k];
            const double active = std::min(state.time + dt, emitter.end) - std::max(state.time, emitter.begin);
            if (!(active > 0.0)) {
                continue;
            }
            const double speed = length(emitter.velocity);
            const Vec2 ahead = (1.0 / speed) * emitter.velocity;
            const Vec2 across{-ahead.y, ahead.x};
            const double before = state.emitted[k];
            state.emitted[k] += speed * active;
            const auto columns = static_cast<int>(std::max(std::floor(emitter.width / step), 1.0));
            const bool is_blocked = solver_->isFull(emitter.position + step * ahead);
            for (double row = std::floor(before / row_height) + 1.0; row * row_height <= state.emitted[k]; row += 1.0) {
                const double gone = state.emitted[k] - row * row_height;
                const bool is_odd = std::fmod(row, 2.0) != 0.0;
                const int count = std::max(columns - (is_odd ? 0 : 1), 1);
                // Every row reaches to the edges, which stay straight where the jet stretches.
                const double wide = count > 1 ? step * (columns - 1) / (count - 1) : 0.0;
                if (is_blocked) {
                    state.counts.blocked += static_cast<std::uint64_t>(count);
                    continue;
                }
                for (int c = 0; c < count && state.position.size() < scene_.max_particles; ++c) {
                    const double offset = (c - 0.5 * (count - 1)) * wide;
                    addParticle(state, emitter.position + gone * ahead + offset * across, emitter.velocity);
                    ++state.counts.emitted;
                }
            }
        }
    }

    void remove(FluidState& state) const
    {
        const double margin = scene_.margin;
        std::vector<std::uint32_t> kept;
        for (std::size_t i = 0; i < state.position.size(); ++i) {
            const Vec2 x = state.position[i];
            // What is thrown over the upper edge comes back.
            if (x.x > -margin && x.y > -margin && x.x < scene_.size.x + margin && x.y < 2.0 * scene_.size.y + margin) {
                kept.push_back(static_cast<std::uint32_t>(i));
            }
        }
        if (kept.size() < state.position.size()) {
            state.counts.removed += state.position.size() - kept.size();
            reorder(state.position, kept);
            reorder(state.velocity, kept);
            reorder(state.id, kept);
            reorder(state.density, kept);
            reorder(state.pressure, kept);
            if (!state.affine.empty()) {
                reorder(state.affine, kept);
            }
        }
    }

    FluidScene scene_;
    FluidOptions options_;
    std::unique_ptr<FluidSolver> solver_;
};

FluidStepper::FluidStepper(FluidScene scene, FluidOptions options)
    : steps_(std::make_unique<Steps>(std::move(scene), std::move(options)))
{
}

FluidStepper::FluidStepper(FluidStepper&&) noexcept = default;
FluidStepper& FluidStepper::operator=(FluidStepper&&) noexcept = default;
FluidStepper::~FluidStepper() = default;

FluidState FluidStepper::advance(FluidState state, double until)
{
    steps_->advance(state, until);
    return state;
}

double FluidStepper::longestStep(const FluidState& state) const
{
    return steps_->longestStep(state);
}

FluidState startFluid(const FluidScene& scene)
{
    scene.validate();
    FluidState state;
    state.emitted.resize(scene.emitters.size());
    FreePlaces places(scene, state.time);
    for (const LiquidBody& body : scene.liquid) {
        const Vec2 centre = momentsOf(body.region).centroid;
        // Particles of two bodies that share a side are at least half a spacing apart.
        places.visit(body, 0.5, [&](Vec2 place) {
            if (state.position.size() >= scene.max_particles) {
                refuseValue("max_particles", scene.max_particles, "at least the number that the liquid needs");
            }
            const Vec2 arm = place - centre;
            addParticle(state, place, body.velocity + body.spin * Vec2{-arm.y, arm.x});
        });
    }
    if (state.position.empty() && scene.emitters.empty()) {
        throw Error(ErrorCode::InvalidArgument,
                    "liquid has no particle and there is no emitter; one of them must give liquid");
    }
    for (const Vec2 v : state.velocity) {
        state.approach_speed = std::max(state.approach_speed, length(v));
    }
    return state;
}

FluidState advanceFluid(FluidState state, const FluidScene& scene, double until, const FluidOptions& options)
{
    return FluidStepper(scene, options).advance(std::move(state), until);
}

double longestStep(const FluidState& state, const FluidScene& scene, const FluidOptions& options)
{
    return FluidStepper(scene, options).longestStep(state);
}

ParticleFrame frameOf(const FluidState& state, const FluidScene& scene)
{
    ParticleFrame frame{state.time, scene.spacing, state.position, state.velocity, state.id, state.density};
    for (const Wall& wall : scene.walls) {
        frame.walls.push_back(wallAt(wall, state.time));
    }
    return frame;
}

std::vector<double> pressures(const FluidState& state, const FluidScene& scene)
{
    std::vector<double> result(state.pressure.size());
    for (std::size_t i = 0; i < result.size(); ++i) {
        result[i] = scene.density * state.pressure[i];
    }
    return result;
}

}  // namespace droplet
