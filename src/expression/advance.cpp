// SPDX-License-Identifier: GPL-3.0-or-later
// Air: "Expressive Rendering for 2D Animations of Liquids", equation 2, and thresholds that set themselves. Departures:
// the paper's criterion of aeration needs stresses, this one is that of Ihmsen et al. 2012; and the paper lets air in
// behind waves too, so there is a gate here that only their crests pass.
#include <algorithm>
#include <cmath>
#include <limits>

#include "droplet/error.h"
#include "droplet/expression/expression.h"
#include "drops.h"
#include "require.h"
#include "surface_kernel.h"
#include "surroundings.h"

namespace droplet {
namespace {

/// Coverage below which a particle lies at the free surface: on the flat surface of a lattice it is 0.78.
constexpr double kSurface = 0.86;

/// Coverage of a particle where the surface is bent outwards as much as a crest.
constexpr double kBent = 0.74;

/// Part of τ₂ at which aeration begins: τ₁.
constexpr double kLeastAeration = 0.1;

/// A droplet that has touched liquid loses its flight so many times as fast as it gained it.
constexpr double kLanding = 3.0;

/// Bodies of up to so many particles are always drawn as a droplet.
constexpr std::uint32_t kSmall = 10;

/// Part of their ellipse that the particles of larger bodies fill if they are drawn as a droplet, at first and later.
/// Straight rows fill 0.95, half a ring 0.55.
constexpr double kFilled = 0.8;
constexpr double kStillFilled = 0.65;

/// Greatest length over the width of such a body, at first and later: longer ones are films and threads.
constexpr double kLongest = 4.0;
constexpr double kStillLongest = 5.0;

/// Time of flight that is remembered, without tails [s].
constexpr double kFlight = 0.25;

/// Times in which a claw grows at a crest, and shrinks after it [s].
constexpr double kGrowing = 0.2;
constexpr double kShrinking = 0.35;

/// Time in which the fastest speed is forgotten [s].
constexpr double kMemory = 4.0;

/// Spacings per second below which motion does not count as fast [1/s].
constexpr double kSeen = 30.0;

/// Maximum number of frames whose positions are kept.
constexpr std::size_t kMaxPast = 16;

/// Speed that one particle in twenty exceeds.
double highSpeed(const ParticleFrame& frame)
{
    std::vector<double> speeds;
    for (const Vec2 v : frame.velocity) {
        speeds.push_back(length(v));
    }
    const auto at = speeds.begin() + static_cast<std::ptrdiff_t>(speeds.size() - 1 - speeds.size() / 20);
    std::nth_element(speeds.begin(), at, speeds.end());
    return *at;
}

/// How much a particle belongs to the crest of a wave, in [0, 1]: it is fast, and its surface moves outwards, so it
/// lies on the front and not on the back of the wave.
double crest(Vec2 velocity, Vec2 outward, double fast)
{
    const double speed = length(velocity);
    const double size = length(outward);
    if (!(speed > 0.0) || !(size > 0.0) || !(fast > 0.0)) {
        return 0.0;
    }
    return smoothRamp(speed / fast, 0.6, 0.9) * smoothRamp(dot(velocity, outward) / (speed * size), 0.3, 0.7);
}

/// How much a particle lies on the back of a wave, in [0, 1]: its surface moves inwards.
double back(Vec2 velocity, Vec2 outward)
{
    const double size = length(velocity) * length(outward);
    return size > 0.0 ? smoothRamp(-dot(velocity, outward) / size, 0.1, 0.5) : 0.0;
}

/// Updates which particles are drawn as droplets.
void updateDroplets(ExpressionState& state, const ParticleFrame& frame, const Surroundings& around,
                    const ExpressionOptions& options, double dt)
{
    const std::size_t count = frame.position.size();
    std::vector<std::vector<std::uint32_t>> members(count);  // of small bodies, by their names
    for (std::uint32_t i = 0; i < count; ++i) {
        if (around.size[i] <= options.droplet_size) {
            members[around.body[i]].push_back(i);
        }
    }
    const double longest = std::max(options.tail_length, kFlight);
    for (const std::vector<std::uint32_t>& body : members) {
        if (body.empty()) {
            continue;
        }
        std::uint32_t name = ExpressionState::kNoGroup;
        bool was_drop = false;
        for (const std::uint32_t i : body) {
            name = std::min(name, frame.id[i]);
            was_drop = was_drop || state.group[frame.id[i]] != ExpressionState::kNoGroup;
        }
        bool is_drop = body.size() <= kSmall;
        if (!is_drop) {
            const DropEllipse ellipse = ellipseOf(body, frame);
            is_drop = ellipse.fill > (was_drop ? kStillFilled : kFilled) &&
                      ellipse.stretch * ellipse.stretch < (was_drop ? kStillLongest : kLongest);
        }
        for (const std::uint32_t i : body) {
            const std::uint32_t id = frame.id[i];
            state.flight[id] = std::min(state.flight[id] + dt, longest);
            state.group[id] = is_drop ? name : ExpressionState::kNoGroup;
            state.landed[id] = 0;
        }
    }
    for (std::size_t i = 0; i < count; ++i) {
        if (around.size[i] <= options.droplet_size) {
            continue;
        }
        // Droplets that have landed keep their tails until they are gone.
        const std::uint32_t id = frame.id[i];
        state.flight[id] = std::max(std::min(state.flight[id], options.tail_length) - kLanding * dt, 0.0);
        state.landed[id] = 1;
        if (!(state.flight[id] > 0.0)) {
            state.group[id] = ExpressionState::kNoGroup;
        }
    }
}

/// Whether a particle may hold air: a share of all, spread evenly over the ids.
bool mayHoldAir(std::uint32_t id, double share)
{
    // Fibonacci hashing: 2³² over the golden ratio.
    return static_cast<double>(id * 2654435769U) < share * 4294967296.0;
}

}  // namespace

ExpressionState advanceExpression(ExpressionState state, const ParticleFrame& frame, const ExpressionOptions& options)
{
    options.validate();
    frame.validate();
    const double dt = state.past.empty() ? 0.0 : frame.time - state.past.front().time;
    if (!state.past.empty() && !(dt > 0.0)) {
        throw Error(ErrorCode::InvalidInput, fmt::format("a frame at {} s follows one at {} s; it must be later",
                                                         numberText(frame.time), numberText(state.past.front().time)));
    }
    const std::size_t count = frame.position.size();
    std::size_t ids = state.air.size();
    for (const std::uint32_t id : frame.id) {
        ids = std::max<std::size_t>(ids, std::size_t{id} + 1);
    }
    state.air.resize(ids);
    state.flight.resize(ids);
    state.curl.resize(ids);
    state.group.resize(ids, ExpressionState::kNoGroup);
    state.landed.resize(ids, 0);
    ExpressionState::Past now{frame.time, {}};
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    now.position.resize(ids, {kNone, kNone});
    for (std::size_t i = 0; i < count; ++i) {
        now.position[frame.id[i]] = frame.position[i];
    }
    state.past.insert(state.past.begin(), std::move(now));
    while (state.past.size() > kMaxPast ||
           (state.past.size() > 2 && state.past.rbegin()[1].time < frame.time - options.tail_length)) {
        state.past.pop_back();
    }
    state.aeration.assign(count, 0.0);
    ++state.frames;
    const bool needs_surroundings = options.tail_length > 0.0 || options.air > 0.0;
    if (count == 0 || !needs_surroundings) {
        return state;
    }

    // Air has thresholds of all particles, claws are at the surface.
    const Surroundings around = surroundingsOf(frame, options.air > 0.0     ? std::numeric_limits<double>::infinity()
                                                      : options.claws > 0.0 ? kSurface
                                                                            : 0.0);
    updateDroplets(state, frame, around, options, dt);
    if (options.claws > 0.0 || options.air > 0.0) {
        // The fastest time so far, forgotten within seconds; not slower than a motion that one sees.
        state.speed = std::max({highSpeed(frame), state.speed * std::exp(-dt / kMemory), kSeen * frame.spacing});
    }
    if (options.claws > 0.0) {
        for (std::size_t i = 0; i < count; ++i) {
            const double coverage = frame.density.empty() ? around.coverage[i] : frame.density[i];
            const bool is_surface = coverage < kSurface && around.size[i] > options.droplet_size;
            // The crest itself: the surface is bent outwards.
            const double bent = smoothRamp(coverage, kSurface, kBent);
            const double gate = is_surface ? bent * crest(frame.velocity[i], around.outward[i], state.speed) : 0.0;
            double& curl = state.curl[frame.id[i]];
            curl = std::clamp(curl + dt * (gate / kGrowing - (1.0 - gate) / kShrinking), 0.0, 1.0);
        }
    }
    if (options.air > 0.0) {
        const double weight = 1.0 / static_cast<double>(state.frames);
        const double largest = *std::max_element(around.churn.begin(), around.churn.end());
        state.aeration_limit += weight * (largest - state.aeration_limit);
        const double begin = kLeastAeration * state.aeration_limit;
        for (std::size_t i = 0; i < count; ++i) {
            // Densities know of walls, sums over particles do not.
            const double coverage = frame.density.empty() ? around.coverage[i] : frame.density[i];
            const bool is_surface = coverage < kSurface && around.size[i] > options.droplet_size &&
                                    mayHoldAir(frame.id[i], options.eraser_share);
            const double gate = options.crest_gate ? crest(frame.velocity[i], around.outward[i], state.speed) : 1.0;
            const double churn = state.aeration_limit > 0.0
                                     ? std::clamp((around.churn[i] - begin) / (state.aeration_limit - begin), 0.0, 1.0)
                                     : 0.0;
            // On a crest the surface stretches evenly, which the criterion hardly sees; so the gate itself counts.
            const double entering = is_surface ? (options.crest_gate ? gate * (0.5 + 0.5 * churn) : churn) : 0.0;
            const double slow = 1.0 - smoothRamp(length(frame.velocity[i]) / state.speed, 0.3, 1.0);
            // A crest that has passed leaves no holes behind: air goes as fast as it came.
            const double behind = options.crest_gate && is_surface ? back(frame.velocity[i], around.outward[i]) : 0.0;
            const double leaving = std::max(options.release * slow, options.air * behind);
            double& air = state.air[frame.id[i]];
            air = std::clamp(air + (options.air * entering - leaving) * dt, 0.0, options.max_air);
            state.aeration[i] = entering;
        }
    }
    return state;
}

}  // namespace droplet
