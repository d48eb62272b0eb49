// SPDX-License-Identifier: GPL-3.0-or-later
// Bender, Koschier: Divergence-free SPH for incompressible and viscous fluids. IEEE TVCG 23(3), 2017.
// Departures: gaps and compression are mended by the positions (Cornelis, Bender, Gissler, Ihmsen, Teschner: An
// optimized source term formulation for incompressible SPH. The Visual Computer 35, 2019), because velocities that mend
// them shake liquid at rest.
#include "dfsph.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "blocks.h"
#include "bounds.h"
#include "forces.h"
#include "kernel.h"
#include "neighbours.h"
#include "projection.h"
#include "reorder.h"
#include "wall_samples.h"

namespace droplet {
namespace {

/// Part of an error of density that velocities mend in a step. More would shake the liquid; less would let the bottom
/// of deep liquid be compressed.
constexpr double kRestored = 0.05;

/// Speed of a fall through one spacing counts so many times in the limit of the step, so that liquid at rest stays so.
constexpr double kFall = 4.0;

/// Longest way in a step, in spacings, so that no particle crosses another one's support unseen.
constexpr double kMaxWay = 1.2;

/// Lack of density beyond which liquid falls together freely.
constexpr double kGap = 0.1;

/// Iterations that push particles apart in a step; what is left then is mended in later steps.
constexpr int kMaxSpreading = 3;

/// Kinematic viscosity that damps disorder of the particles and leaves larger motion alone: for still water, and for a
/// drop of 4000 particles that oscillates, half of it lets the noise grow [m²/s].
double leastViscosity(const FluidScene& scene)
{
    const double fall = std::sqrt(length(scene.gravity) * scene.size.y);
    return 0.02 * scene.spacing * fall + 0.04 * std::sqrt(scene.surface_tension * scene.spacing / scene.density);
}

class Dfsph final : public FluidSolver {
public:
    Dfsph(const FluidScene& scene, const FluidOptions& options)
        : scene_(scene),
          options_(options),
          kernel_(scene.spacing),
          walls_(scene, kernel_),
          viscosity_(scene.viscosity.value_or(leastViscosity(scene)))
    {
    }

    [[nodiscard]] double longestStep(const FluidState& state) const override
    {
        double fastest = walls_.moves() ? walls_.maxSpeed() : 0.0;
        for (const Vec2 v : state.velocity) {
            fastest = std::max(fastest, length(v));
        }
        const double d = scene_.spacing;
        const double fall = std::sqrt(length(scene_.gravity) * d);
        constexpr double kLongest = std::numeric_limits<double>::max();
        const auto time = [](double way, double speed) { return speed > 0.0 ? way / speed : kLongest; };
        double dt =
            std::min(time(courant() * d, state.approach_speed + kFall * fall), time(kMaxWay * d, fastest + fall));
        if (scene_.surface_tension > 0.0) {
            // Period of the shortest capillary waves.
            dt = std::min(
                dt, 0.4 * std::sqrt(scene_.density * d * d * d / (2.0 * std::numbers::pi * scene_.surface_tension)));
        }
        if (viscosity_ > 0.0) {
            dt = std::min(dt, 0.125 * d * d / viscosity_);
        }
        return dt;
    }

    [[nodiscard]] double emitterCourant() const override { return courant(); }

    void step(FluidState& state, double dt) override
    {
        state.affine.clear();
        const WallSamples walls = sortAndSample(state);
        const CellGrid& cells = *cells_;
        const Neighbourhood near({state.position, cells, walls, *wall_cells_}, kernel_);
        state.density = near.density();

        accelerate(state, near, dt);
        keepDivergenceFree(state, near, walls, dt);
        move(state, near, walls, dt);
        keepOutOfWalls(state, near, walls, dt);
    }

private:
    /// Greatest way of two neighbours towards each other in a step, in spacings.
    [[nodiscard]] double courant() const { return options_.courant.value_or(0.4); }

    /// Sorts the particles by cells, and samples the walls near them.
    WallSamples sortAndSample(FluidState& state)
    {
        Bounds box{scene_.size, {}};
        box.include(state.position);
        if (state.position.empty()) {
            box = {{}, {}};
        }
        const double reach = kernel_.support();
        const Vec2 lower = box.lower - Vec2{reach, reach};
        const Vec2 upper = box.upper + Vec2{reach, reach};
        cells_.emplace(lower, upper, reach);
        wall_cells_.emplace(lower, upper, reach);
        const std::vector<std::uint32_t> order = cells_->sort(state.position);
        reorder(state.position, order);
        reorder(state.velocity, order);
        reorder(state.id, order);
        reorder(state.pressure, order);
        WallSamples walls = walls_.at(state.time);
        const std::vector<std::uint32_t> wall_order = wall_cells_->sort(walls.position);
        reorder(walls.position, wall_order);
        reorder(walls.normal, wall_order);
        reorder(walls.velocity, wall_order);
        reorder(walls.area, wall_order);
        return walls;
    }

    /// Gravity, viscosity, surface tension and the caller's accelerations.
    void accelerate(FluidState& state, const Neighbourhood& near, double dt)
    {
        std::vector<Vec2> acceleration(state.position.size(), scene_.gravity);
        if (viscosity_ > 0.0) {
            addViscosity(acceleration, state, near, viscosity_);
        }
        if (scene_.surface_tension > 0.0) {
            addSurfaceTension(acceleration, state.position, *cells_,
                              {scene_.surface_tension / scene_.density, scene_.spacing});
        }
        if (options_.control) {
            options_.control(state, acceleration);
        }
        forBlocks(acceleration.size(), [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                state.velocity[i] = state.velocity[i] + dt * acceleration[i];
            }
        });
    }

    /// Takes from the velocities what would compress liquid, or close gaps in it too fast.
    void keepDivergenceFree(FluidState& state, const Neighbourhood& near, const WallSamples& walls, double dt)
    {
        std::vector<float> rate = compressionRates(near, state.velocity, walls);
        std::vector<float> pressure(rate.size());
        for (std::size_t i = 0; i < rate.size(); ++i) {
            const double error = state.density[i] - 1.0;
            rate[i] += static_cast<float>((kRestored * std::max(error, -kGap) + std::min(error + kGap, 0.0)) / dt);
            pressure[i] = static_cast<float>(state.pressure[i] * dt);
        }
        ProjectionOptions limits;
        limits.tolerance = options_.divergence_error / dt;
        limits.max_iterations = options_.max_iterations;
        const Projection projection = project(near, rate, pressure, limits);
        for (std::size_t i = 0; i < rate.size(); ++i) {
            state.velocity[i] = state.velocity[i] + Vec2{projection.change[i].x, projection.change[i].y};
            state.pressure[i] = double{pressure[i]} / dt;
        }
        state.counts.divergence_iterations += static_cast<std::uint64_t>(projection.iterations);
    }

    /// Moves the particles, and apart where they would be compressed; that leaves their velocities as they are.
    void move(FluidState& state, const Neighbourhood& near, const WallSamples& walls, double dt)
    {
        state.approach_speed = approachSpeed(near, state.velocity, walls);
        std::vector<float> rate = compressionRates(near, state.velocity, walls);
        for (std::size_t i = 0; i < rate.size(); ++i) {
            rate[i] += static_cast<float>((state.density[i] - 1.0) / dt);
        }
        ProjectionOptions limits;
        limits.tolerance = options_.density_error / dt;
        limits.min_iterations = 1;
        limits.max_iterations = kMaxSpreading;
        std::vector<float> pressure(rate.size());
        const Projection projection = project(near, rate, pressure, limits);
        for (std::size_t i = 0; i < rate.size(); ++i) {
            const Vec2 apart{projection.change[i].x, projection.change[i].y};
            state.position[i] = state.position[i] + dt * (state.velocity[i] + apart);
        }
        state.density_error = projection.residual * dt;
        state.counts.density_iterations += static_cast<std::uint64_t>(projection.iterations);
    }

    /// Puts particles back that crossed the surface of a wall in this step.
    void keepOutOfWalls(FluidState& state, const Neighbourhood& near, const WallSamples& walls, double dt)
    {
        const double patch = 0.7 * scene_.spacing;
        state.counts.rescued += static_cast<std::uint64_t>(near.sum([&](std::size_t i, auto, auto samples) {
            double rescued = 0.0;
            // Twice, because out of one wall may lead into another one.
            for (int round = 0; round < 2; ++round) {
                for (const auto& n : samples) {
                    const Vec2 normal = walls.normal[n.index];
                    const Vec2 velocity = walls.velocity[n.index];
                    const Vec2 arm = state.position[i] - (walls.position[n.index] + dt * velocity);
                    const double height = dot(arm, normal) - walls.depth;
                    if (height < 0.0 && height > -scene_.spacing && std::abs(cross(normal, arm)) < patch) {
                        state.position[i] = state.position[i] - height * normal;
                        const double inward = dot(state.velocity[i] - velocity, normal);
                        if (inward < 0.0) {
                            state.velocity[i] = state.velocity[i] - inward * normal;
                        }
                        rescued = 1.0;
                    }
                }
            }
            return rescued;
        }));
    }

    const FluidScene& scene_;
    const FluidOptions& options_;
    Kernel kernel_;
    WallSampler walls_;
    double viscosity_;
    std::optional<CellGrid> cells_;
    std::optional<CellGrid> wall_cells_;
};

}  // namespace

std::unique_ptr<FluidSolver> dfsph(const FluidScene& scene, const FluidOptions& options)
{
    return std::make_unique<Dfsph>(scene, options);
}

}  // namespace droplet
