// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "droplet/expression/liquid_shape.h"
#include "droplet/liquid2d/particle_frame.h"

namespace droplet {

/// Starting points of the controls.
enum class LiquidStyle {
    Realistic,  ///< no tails, no erasers
    Cartoon,    ///< detached droplets have tails
    Wave,       ///< tails, and air that hollows the crests of waves
};

/// Controls of the surface drawn around particles.
struct ExpressionOptions {
    double tail_length = 0.0;    ///< time whose way the tail of a detached droplet shows [s], ≥ 0
    double tail_slope = 0.7;     ///< of the tail's radius at its end, 0.2 (thick) … 1.2 (thin)
    double max_tail = 8.0;       ///< length of a tail in radii of its droplet, ≥ 0
    double air = 0.0;            ///< strength of aeration: α in areas of a particle per second, ≥ 0
    double release = 0.0;        ///< strength of release: β in areas of a particle per second, ≥ 0
    double max_air = 2.0;        ///< A_max in areas of a particle, ≥ 0
    bool crest_gate = true;      ///< air enters at the crests of waves alone; false: as in the paper
    double smoothing = 1.0;      ///< radius of the surface's kernel in bulk liquid: (1 + smoothing)·spacing, 0 … 2
    double resolution = 0.5;     ///< side of the grid's cells in spacings, 0.2 … 1
    double min_area = 0.25;      ///< loops below this area, in areas of a particle, are dropped, ≥ 0
    double droplet_size = 60.0;  ///< detached bodies of up to so many particles count as droplets, ≥ 0

    /// @throws Error InvalidArgument, naming field, value and constraint
    void validate() const;
};

/// Controls of a style.
ExpressionOptions expressionOf(LiquidStyle style);

/// What the surface remembers of the particles from frame to frame.
struct ExpressionState {
    /// One particle's memory.
    struct Memory {
        std::uint32_t id = 0;   ///< of the particle
        double air = 0.0;       ///< A_air in areas of a particle
        std::vector<Vec2> way;  ///< positions of the last frames, latest first [m]
    };
    double time = 0.0;              ///< of the last frame [s]
    bool begun = false;             ///< whether there was a frame
    std::vector<double> times;      ///< of the positions, latest first [s]
    std::vector<Memory> particles;  ///< in the order of ids
    double aeration_limit = 0.0;    ///< τ₂: mean of the largest aeration of each frame
    std::uint64_t frames = 0;       ///< number of frames in that mean
};

/// Takes up a frame: updates ways and air.
ExpressionState advanceExpression(ExpressionState state, const ParticleFrame& frame, const ExpressionOptions& options);

/// Outlines of the liquid at the frame that `state` took up last.
LiquidShape liquidShape(const ExpressionState& state, const ParticleFrame& frame, const ExpressionOptions& options);

/// State as bytes, for resuming.
std::string bytesOf(const ExpressionState& state);

/// State from its bytes.
/// @throws Error InvalidInput if the bytes are damaged; the message begins with `name`
ExpressionState expressionFromBytes(const std::string& bytes, const std::string& name);

}  // namespace droplet
