// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "droplet/expression/liquid_shape.h"
#include "droplet/liquid2d/particle_frame.h"

namespace droplet {

/// Starting points of the controls.
enum class LiquidStyle {
    Realistic,  ///< no tails, no erasers
    Cartoon,    ///< detached droplets have tails
    Wave,       ///< tails, and claws at the crests of waves
    Paper,      ///< tails, and air that hollows the crests of waves
};

/// Style with a name.
/// @throws Error InvalidArgument if there is none; the message lists all names
LiquidStyle liquidStyleNamed(std::string_view name);

/// Controls of the surface drawn around particles.
struct ExpressionOptions {
    double tail_length = 0.0;    ///< time whose way the tail of a detached droplet shows [s], ≥ 0
    double tail_slope = 0.7;     ///< of the tail's radius at its end, 0.2 (thick) … 1.2 (thin)
    double max_tail = 8.0;       ///< length of a tail in radii of its droplet, ≥ 0
    double air = 0.0;            ///< strength of aeration: α in areas of a particle per second, ≥ 0
    double release = 0.0;        ///< strength of release: β in areas of a particle per second, ≥ 0
    double max_air = 2.0;        ///< A_max in areas of a particle, ≥ 0
    double eraser_share = 0.15;  ///< share of particles that may hold air, 0 … 1
    double claws = 0.0;          ///< length of the claws at the crests of waves, in spacings, 0 … 100
    bool crest_gate = true;      ///< air enters at the crests of waves alone; false: as in the paper
    double smoothing = 1.0;      ///< radius of the surface's kernel in bulk liquid: (1 + smoothing)·spacing, 0 … 2
    double fairing = 1.0;        ///< how much wrinkles of a few particles are smoothed away, 0 … 10
    double resolution = 0.5;     ///< side of the grid's cells in spacings, 0.2 … 1
    double min_area = 0.25;      ///< loops below this area, in areas of a particle, are dropped, ≥ 0
    double droplet_size = 60.0;  ///< detached bodies of up to so many particles count as droplets, ≥ 0

    /// @throws Error InvalidArgument, naming field, value and constraint
    void validate() const;
};

/// Controls of a style.
ExpressionOptions expressionOf(LiquidStyle style);

/// What the surface remembers of the particles from frame to frame. Arrays by particle have the particle's id as index.
struct ExpressionState {
    /// Particle that is not drawn as a part of a droplet.
    static constexpr std::uint32_t kNoGroup = 0xFFFFFFFFU;
    /// Positions at an earlier frame.
    struct Past {
        double time = 0.0;           ///< [s]
        std::vector<Vec2> position;  ///< by id [m]; not a number for particles that were not there
    };
    std::vector<Past> past;            ///< latest first; the latest is the last frame
    std::vector<double> air;           ///< A_air by id, in areas of a particle
    std::vector<double> curl;          ///< by id: how far a claw has grown at the particle, in [0, 1]
    std::vector<double> flight;        ///< time by id that the particle's droplet has been in flight [s]
    std::vector<std::uint32_t> group;  ///< by id: smallest id of the droplet that the particle is drawn in, or kNoGroup
    std::vector<std::uint8_t> landed;  ///< by id: 1 if that droplet has touched liquid, 0 if not
    std::vector<double> aeration;      ///< by particle of the last frame, in [0, 1]
    double aeration_limit = 0.0;       ///< τ₂: mean of the largest aeration of each frame [1/s]
    double speed = 0.0;                ///< greatest lately that one particle in twenty exceeded [m/s]
    std::uint64_t frames = 0;          ///< number of frames
    std::vector<LiquidHole> holes;     ///< of the frame that was drawn last, by remember()
    bool remembers = false;            ///< whether a frame was drawn
};

/// Updates the memory of the particles with the next frame: their paths, flights and air.
/// @param state    from this function; empty before the first frame
/// @param frame    valid, later than the one before
/// @param options  valid, the same for all frames
/// @return         the new state
/// @throws Error   InvalidInput: the frame is invalid, not later than the last one, or spread too far; InvalidArgument
///                 for options
ExpressionState advanceExpression(ExpressionState state, const ParticleFrame& frame, const ExpressionOptions& options);

/// Outlines of the liquid at the last frame that `state` has seen.
///
/// Guarantees: loops are closed and do not cross; an isolated droplet has the area of its particles, with its tail; the
/// same bytes at any number of threads.
/// @param state    from advanceExpression() with this frame
/// @param frame    the same frame
/// @param options  valid
/// @throws Error   InvalidArgument for options
LiquidShape liquidShape(const ExpressionState& state, const ParticleFrame& frame, const ExpressionOptions& options);

/// Remembers the holes of a frame that was drawn, so that holes of the next one last: small ones are drawn once they
/// are a twelfth of a second old, and none closes before a tenth of a second. Without it all holes are drawn.
/// @param state  from advanceExpression()
/// @param shape  from liquidShape() with this state
ExpressionState remember(ExpressionState state, const LiquidShape& shape);

/// State as bytes, for resuming.
std::string bytesOf(const ExpressionState& state);

/// State from its bytes.
/// @throws Error InvalidInput if the bytes are damaged; the message begins with `name`
ExpressionState expressionFromBytes(std::string_view bytes, const std::string& name);

}  // namespace droplet
