// SPDX-License-Identifier: GPL-3.0-or-later
#include "windshield/motion.h"

#include <numbers>

#include "wind/random.h"

namespace droplet {

Vec2 fluctuationOf(std::uint64_t id, double time, const Fluctuation& fluctuation, std::uint64_t seed)
{
    if (fluctuation.acceleration == 0.0) {
        return {};
    }
    const RandomStream random(seed, RandomPurpose::Fluctuation, id);
    const double since = time / fluctuation.interval + random.uniform(0);
    const double begun = std::floor(since);
    const double passed = since - begun;
    const auto number = static_cast<std::uint64_t>(begun);
    const auto push = [&](std::uint64_t k) {
        // One draw gives both components, each with variance 1.
        const std::uint64_t bits = random.bits(k + 1);
        const auto component = [](std::uint64_t half) {
            return std::numbers::sqrt3 * (static_cast<double>(half) * 0x1p-31 - 1.0);
        };
        return Vec2{component(bits >> 32U), component(bits & 0xFFFFFFFFU)};
    };
    const double b = passed * passed * (3.0 - 2.0 * passed);
    const double a = 1.0 - b;
    return (fluctuation.acceleration / std::sqrt(a * a + b * b)) * (a * push(number) + b * push(number + 1));
}

MotionStep advance(const DropletForces& forces, Vec2 driving, Vec2 velocity, double dt)
{
    const bool at_rest = velocity == Vec2{};
    if (at_rest && sizeOf(driving) <= forces.retention) {
        return {};
    }
    const double m = forces.mass;
    const double x = forces.viscous * dt / m;
    const double lost = -std::expm1(-x);
    const double decay = 1.0 - lost;
    // Single and double integral of e^(−x s) over [0, 1].
    const double once = x > 0.0 ? lost / x : 1.0;
    const double twice =
        x > 0.02 ? (1.0 - once) / x : 0.5 - x / 6.0 * (1.0 - x / 4.0 * (1.0 - x / 5.0 * (1.0 - x / 6.0)));
    const Vec2 free = decay * velocity + (once * dt / m) * driving;
    const double speed = sizeOf(free);
    const double loss = once * dt / m * forces.sliding_friction;
    if (speed <= loss) {
        // Share of dt until the stop, for a speed that falls linearly.
        const double begins = sizeOf(velocity);
        const double share = begins > 0.0 ? begins / (begins + (loss - speed)) : 0.0;
        return {(0.5 * share * dt) * velocity, {}};
    }
    const Vec2 net = driving - (forces.sliding_friction / speed) * free;
    return {(once * dt) * velocity + (twice * dt * dt / m) * net, (1.0 - loss / speed) * free};
}

}  // namespace droplet
