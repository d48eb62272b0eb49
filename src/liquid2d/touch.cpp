// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/liquid2d/touch.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "free_places.h"
#include "require.h"

namespace droplet {
namespace {

void requireFinite(const char* name, Vec2 value)
{
    require(std::isfinite(value.x) && std::isfinite(value.y), name, length(value), "finite");
}

}  // namespace

void Pour::validate() const
{
    requireFinite("pour.middle", middle);
    require(radius > 0.0 && std::isfinite(radius), "pour.radius", radius, "finite and more than 0 m");
    requireFinite("pour.velocity", velocity);
}

FluidState poured(FluidState state, const FluidScene& scene, const Pour& pour)
{
    scene.validate();
    pour.validate();
    FreePlaces places(scene, state.time);
    places.take(state.position);
    // Nearer ones would be pressed apart, and the jet would burst.
    constexpr double kClearance = 0.9;
    places.visit({.region = circle(pour.middle, pour.radius)}, kClearance, [&](Vec2 place) {
        if (state.position.size() < scene.max_particles) {
            addParticle(state, place, pour.velocity);
            ++state.counts.emitted;
            state.approach_speed = std::max(state.approach_speed, length(pour.velocity));
        }
    });
    return state;
}

void Stir::validate() const
{
    requireFinite("stir.from", from);
    requireFinite("stir.to", to);
    require(radius > 0.0 && std::isfinite(radius), "stir.radius", radius, "finite and more than 0 m");
    require(seconds > 0.0 && std::isfinite(seconds), "stir.seconds", seconds, "finite and more than 0 s");
}

FluidState stirred(FluidState state, const Stir& stir)
{
    stir.validate();
    const Vec2 way = stir.to - stir.from;
    const double square = dot(way, way);
    const Vec2 velocity = (1.0 / stir.seconds) * way;
    for (std::size_t i = 0; i < state.position.size(); ++i) {
        const Vec2 arm = state.position[i] - stir.from;
        const double along = square > 0.0 ? std::clamp(dot(arm, way) / square, 0.0, 1.0) : 0.0;
        const double distance = length(arm - along * way) / stir.radius;
        if (distance < 1.0) {
            const double rest = 1.0 - distance * distance;
            const double share = rest * rest;  // ends smoothly at the rim
            state.velocity[i] = state.velocity[i] + share * (velocity - state.velocity[i]);
            state.approach_speed = std::max(state.approach_speed, length(state.velocity[i]));
        }
    }
    return state;
}

}  // namespace droplet
