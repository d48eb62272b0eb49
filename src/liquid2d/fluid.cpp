// SPDX-License-Identifier: GPL-3.0-or-later
// Bender, Koschier: Divergence-free SPH for incompressible and viscous fluids. IEEE TVCG 23(3), 2017.
// Departures: gaps and compression are mended by the positions (Cornelis, Bender, Gissler, Ihmsen, Teschner: An
// optimized source term formulation for incompressible SPH. The Visual Computer 35, 2019), because velocities that mend
// them shake liquid at rest.
#include "droplet/liquid2d/fluid.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "blocks.h"
#include "droplet/error.h"
#include "forces.h"
#include "kernel.h"
#include "neighbours.h"
#include "number_text.h"
#include "projection.h"
#include "region.h"
#include "require.h"
#include "wall_samples.h"

namespace droplet {
namespace {

template <typename Value>
void reorder(std::vector<Value>& values, const std::vector<std::uint32_t>& order)
{
    std::vector<Value> sorted(order.size());
    forBlocks(order.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
            sorted[k] = values[order[k]];
        }
    });
    values = std::move(sorted);
}

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

/// What a run of steps needs of a scene.
class Stepper {
public:
    Stepper(const FluidScene& scene, const FluidOptions& options)
        : scene_(scene),
          options_(options),
          kernel_(scene.spacing),
          walls_(scene, kernel_),
          viscosity_(scene.viscosity.value_or(leastViscosity(scene)))
    {
    }

    void advance(FluidState& state, double until)
    {
        while (state.time < until) {
            step(state, until);
        }
    }

    /// Longest step that the state allows.
    [[nodiscard]] double longestStep(const FluidState& state) const
    {
        double fastest = walls_.moves() ? walls_.maxSpeed() : 0.0;
        for (const Vec2 v : state.velocity) {
            fastest = std::max(fastest, length(v));
        }
        const double d = scene_.spacing;
        const double fall = std::sqrt(length(scene_.gravity) * d);
        constexpr double kLongest = std::numeric_limits<double>::max();
        const auto time = [](double way, double speed) { return speed > 0.0 ? way / speed : kLongest; };
        double dt = std::min(time(options_.courant * d, state.approach_speed + kFall * fall),
                             time(kMaxWay * d, fastest + fall));
        if (scene_.surface_tension > 0.0) {
            // Period of the shortest capillary waves.
            dt = std::min(
                dt, 0.4 * std::sqrt(scene_.density * d * d * d / (2.0 * std::numbers::pi * scene_.surface_tension)));
        }
        if (viscosity_ > 0.0) {
            dt = std::min(dt, 0.125 * d * d / viscosity_);
        }
        for (const Emitter& emitter : scene_.emitters) {
            dt = std::min(dt, options_.courant * d / length(emitter.velocity));
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
        emit(state, dt);
        const WallSamples walls = sortAndSample(state);
        const CellGrid& cells = *cells_;
        const Neighbourhood near({state.position, cells, walls, *wall_cells_}, kernel_);
        state.density = near.density();

        accelerate(state, near, dt);
        keepDivergenceFree(state, near, walls, dt);
        move(state, near, walls, dt);
        state.time = is_last ? until : state.time + dt;
        state.step = dt;
        keepOutOfWalls(state, near, walls, dt);
        remove(state);
        ++state.counts.steps;
    }

    /// Sorts the particles by cells, and samples the walls near them.
    WallSamples sortAndSample(FluidState& state)
    {
        Vec2 lower = scene_.size;
        Vec2 upper{};
        for (const Vec2 x : state.position) {
            lower = {std::min(lower.x, x.x), std::min(lower.y, x.y)};
            upper = {std::max(upper.x, x.x), std::max(upper.y, x.y)};
        }
        const double reach = kernel_.support();
        if (state.position.empty()) {
            lower = upper = {};
        }
        lower = lower - Vec2{reach, reach};
        upper = upper + Vec2{reach, reach};
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
            for (double row = std::floor(before / row_height) + 1.0; row * row_height <= state.emitted[k]; row += 1.0) {
                const double gone = state.emitted[k] - row * row_height;
                const bool is_odd = std::fmod(row, 2.0) != 0.0;
                const int count = std::max(columns - (is_odd ? 0 : 1), 1);
                for (int c = 0; c < count && state.position.size() < scene_.max_particles; ++c) {
                    const double offset = (c - 0.5 * (count - 1)) * step;
                    place(state, emitter.position + gone * ahead + offset * across, emitter.velocity);
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
        }
    }

public:
    static void place(FluidState& state, Vec2 position, Vec2 velocity)
    {
        state.position.push_back(position);
        state.velocity.push_back(velocity);
        state.id.push_back(state.next_id++);
        state.density.push_back(1.0);
        state.pressure.push_back(0.0);
    }

private:
    const FluidScene& scene_;
    const FluidOptions& options_;
    Kernel kernel_;
    WallSampler walls_;
    double viscosity_;
    std::optional<CellGrid> cells_;
    std::optional<CellGrid> wall_cells_;
};

void validate(const FluidOptions& options)
{
    require(options.courant > 0.0 && options.courant <= 1.0, "courant", options.courant, "more than 0 and at most 1");
    require(options.density_error > 0.0, "density_error", options.density_error, "more than 0");
    require(options.divergence_error > 0.0, "divergence_error", options.divergence_error, "more than 0");
    require(options.max_iterations >= 2, "max_iterations", options.max_iterations, "at least 2");
}

}  // namespace

namespace {

/// Places for liquid at the start.
class FreePlaces {
public:
    FreePlaces(const FluidScene& scene, const Kernel& kernel)
        : scene_(scene),
          walls_(WallSampler(scene, kernel).at(0.0)),
          lower_(Vec2{-scene.margin, -scene.margin}),
          upper_(scene.size + Vec2{scene.margin, scene.size.y + scene.margin}),
          cells_(lower_, upper_, kernel.support()),
          order_(cells_.sort(walls_.position)),
          taken_(lower_, upper_, kernel.support())
    {
        for (const Wall& wall : scene.walls) {
            regions_.push_back(wallAt(wall, 0.0));
        }
    }

    /// Calls visit(place) for the places of a body that neither walls nor earlier bodies take.
    template <typename Visit>
    void visit(const Region& body, const Visit& visit)
    {
        std::vector<Vec2> own;
        visitLattice(body, {scene_.spacing, lower_, upper_}, [&](Vec2 place) {
            if (isFree(place)) {
                visit(place);
                own.push_back(place);
            }
        });
        bodies_.push_back(body);
        places_.insert(places_.end(), own.begin(), own.end());
        taken_order_ = taken_.sort(places_);
    }

private:
    [[nodiscard]] bool isFree(Vec2 place) const
    {
        const auto holds = [place](const Region& region) { return contains(region, place); };
        return std::none_of(regions_.begin(), regions_.end(), holds) &&
               std::none_of(bodies_.begin(), bodies_.end(), holds) && !isAtWall(place) && !isAtParticle(place);
    }

    /// Calls meets(index) for what a grid has around a place, until it returns true.
    template <typename Meets>
    static bool anyAround(Vec2 place, const CellGrid& cells, const std::vector<std::uint32_t>& order,
                          const Meets& meets)
    {
        const int column = cells.column(place.x);
        const int row = cells.row(place.y);
        for (int r = row - 1; r <= row + 1; ++r) {
            const auto [first, last] = cells.range(r, column - 1, column + 1);
            for (std::uint32_t k = first; k < last; ++k) {
                if (meets(order[k])) {
                    return true;
                }
            }
        }
        return false;
    }

    [[nodiscard]] bool isAtWall(Vec2 place) const
    {
        const double clearance = 0.4 * scene_.spacing;
        return anyAround(place, cells_, order_, [&](std::uint32_t k) {
            const Vec2 arm = place - walls_.position[k];
            const Vec2 normal = walls_.normal[k];
            return std::abs(cross(normal, arm)) < scene_.spacing && dot(arm, normal) > 0.0 &&
                   dot(arm, normal) < walls_.depth + clearance;
        });
    }

    /// Beside an earlier body: particles of two bodies that share a side are at least half a spacing apart.
    [[nodiscard]] bool isAtParticle(Vec2 place) const
    {
        return !places_.empty() && anyAround(place, taken_, taken_order_, [&](std::uint32_t k) {
            return length(place - places_[k]) < 0.5 * scene_.spacing;
        });
    }

    const FluidScene& scene_;
    WallSamples walls_;
    std::vector<Region> regions_;  ///< of the walls
    Vec2 lower_;                   ///< beyond these corners particles are removed
    Vec2 upper_;
    CellGrid cells_;  ///< of the walls' samples
    std::vector<std::uint32_t> order_;
    std::vector<Region> bodies_;  ///< so far
    std::vector<Vec2> places_;    ///< of their particles
    CellGrid taken_;
    std::vector<std::uint32_t> taken_order_;
};

}  // namespace

FluidState startFluid(const FluidScene& scene)
{
    scene.validate();
    FluidState state;
    state.emitted.resize(scene.emitters.size());
    FreePlaces places(scene, Kernel(scene.spacing));
    for (const LiquidBody& body : scene.liquid) {
        const Vec2 centre = momentsOf(body.region).centroid;
        places.visit(body.region, [&](Vec2 place) {
            if (state.position.size() >= scene.max_particles) {
                refuseValue("max_particles", scene.max_particles, "at least the number that the liquid needs");
            }
            const Vec2 arm = place - centre;
            Stepper::place(state, place, body.velocity + body.spin * Vec2{-arm.y, arm.x});
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
    scene.validate();
    validate(options);
    Stepper(scene, options).advance(state, until);
    return state;
}

double longestStep(const FluidState& state, const FluidScene& scene, const FluidOptions& options)
{
    scene.validate();
    validate(options);
    return Stepper(scene, options).longestStep(state);
}

ParticleFrame frameOf(const FluidState& state, const FluidScene& scene)
{
    return {state.time, scene.spacing, state.position, state.velocity, state.id, state.density};
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
