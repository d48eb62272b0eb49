// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "droplet/liquid2d/fluid_scene.h"
#include "droplet/liquid2d/particle_frame.h"

namespace droplet {

/// Event counters since the start.
struct FluidCounts {
    std::uint64_t steps = 0;                  ///< of time
    std::uint64_t density_iterations = 0;     ///< of the equations that keep the density
    std::uint64_t divergence_iterations = 0;  ///< of the equations that keep the velocity free of divergence
    std::uint64_t emitted = 0;                ///< particles released by emitters
    std::uint64_t removed = 0;                ///< particles that left the window and its margin
    std::uint64_t rescued = 0;                ///< times that a particle was put back out of a wall
    std::uint64_t blocked = 0;                ///< particles that emitters kept, for a closed vessel was full
};

/// State of a 2D liquid.
struct FluidState {
    double time = 0.0;                        ///< [s]
    std::vector<Vec2> position;               ///< [m], sorted by cells of the neighbour search
    std::vector<Vec2> velocity;               ///< [m/s]
    std::vector<std::uint32_t> id;            ///< of each particle, unique
    std::vector<double> density;              ///< relative to that at rest
    std::vector<double> pressure;             ///< over the density [m²/s²]
    std::vector<std::array<Vec2, 2>> affine;  ///< gradients of the velocity's x and y [1/s]; DFSPH has none
    std::vector<double> emitted;              ///< length of liquid that each emitter has released [m]
    std::uint32_t next_id = 0;                ///< of the next particle
    double approach_speed = 0.0;              ///< that bounds the next step: of the fastest liquid [m/s]
    double density_error = 0.0;               ///< mean compression at the end of the last step
    double step = 0.0;                        ///< length of the last step [s]
    FluidCounts counts;                       ///< since the start
};

/// Accelerations that a caller adds at every step [m/s²], for the particles of a state at its time.
using FluidControl = std::function<void(const FluidState& state, std::span<Vec2> acceleration)>;

/// How the pressure is found.
enum class PressureSolver {
    Grid,   ///< on a grid of two spacings, to which particles bring their velocities (Jiang et al. 2015)
    Dfsph,  ///< from particle to particle, by divergence-free SPH (Bender and Koschier 2017)
};

/// Options of advanceFluid().
struct FluidOptions {
    PressureSolver solver = PressureSolver::Grid;  ///< method
    /// Longest way in a step, in spacings: on a grid of liquid, up to 6, 3 if empty; with DFSPH of two neighbours
    /// towards each other, up to 1, 0.4 if empty.
    std::optional<double> courant;
    double density_error = 1e-3;     ///< DFSPH: mean compression at which iterations stop, > 0
    double divergence_error = 1e-4;  ///< DFSPH: mean compression per step that is left in the velocity, > 0
    int max_iterations = 100;        ///< DFSPH: of each solver in a step, ≥ 2
    FluidControl control = {};       ///< further accelerations; may be empty
};

/// Fills the scene's bodies with particles on a hexagonal lattice or in rings, one per spacing². Where bodies overlap,
/// the first one has the place; beyond the margin there are none.
/// @throws Error InvalidArgument: the scene is invalid, has neither liquid nor emitters, more than max_particles, or
/// too
///               long walls
FluidState startFluid(const FluidScene& scene);

/// Advances an incompressible liquid in the plane, with steps as long as the fastest liquid allows.
///
/// Guarantees: no particle enters a wall; the same bytes at any number of threads. With DFSPH, momentum and angular
/// momentum stay as they are up to rounding if there are no walls, gravity and control; a grid takes from a turning
/// body a part of its angular momentum that is proportional to the step.
/// @param state    from startFluid() or this function, for the same scene
/// @param scene    valid
/// @param until    time to advance to [s]; the last step ends there
/// @param options  in their ranges: accuracy, further accelerations
/// @throws Error   InvalidArgument; NoSuchDroplet if steps become too short to add up
FluidState advanceFluid(FluidState state, const FluidScene& scene, double until, const FluidOptions& options = {});

/// Advances states of one scene, as advanceFluid() does, with the same bytes. It keeps its memory from call to call, so
/// that frames of few steps take less time.
class FluidStepper {
public:
    /// @throws Error  InvalidArgument
    explicit FluidStepper(FluidScene scene, FluidOptions options = {});
    FluidStepper(FluidStepper&&) noexcept;             ///< moves its memory
    FluidStepper& operator=(FluidStepper&&) noexcept;  ///< moves its memory
    ~FluidStepper();

    /// State at a later time.
    /// @throws Error  NoSuchDroplet if steps become too short to add up
    [[nodiscard]] FluidState advance(FluidState state, double until);
    /// Longest step from a state [s].
    [[nodiscard]] double longestStep(const FluidState& state) const;

private:
    class Steps;
    std::unique_ptr<Steps> steps_;
};

/// Longest step that advanceFluid() takes from a state [s].
/// @throws Error  InvalidArgument
double longestStep(const FluidState& state, const FluidScene& scene, const FluidOptions& options = {});

/// Particles of a state.
ParticleFrame frameOf(const FluidState& state, const FluidScene& scene);

/// Pressure at each particle [Pa].
std::vector<double> pressures(const FluidState& state, const FluidScene& scene);

/// Place of a wall's region at a time.
Region wallAt(const Wall& wall, double time);

/// Places of a scene's visible walls at a time.
std::vector<Region> visibleWalls(const FluidScene& scene, double time);

/// State as bytes, for resuming.
std::string bytesOf(const FluidState& state);

/// State from its bytes.
/// @throws Error InvalidInput if the bytes are damaged; the message begins with `name`
FluidState fluidStateFromBytes(std::string_view bytes, const std::string& name);

}  // namespace droplet
