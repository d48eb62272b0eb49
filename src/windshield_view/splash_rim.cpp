// SPDX-License-Identifier: GPL-3.0-or-later
#include "windshield_view/splash_rim.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "hashed_number.h"

namespace droplet {

std::optional<SplashRim> SplashRim::of(const Splash& splash, double time)
{
    const std::optional<SplashRing> ring = ringOf(splash, time);
    if (!ring) {
        return std::nullopt;
    }
    const auto bits = std::bit_cast<std::uint64_t>(splash.position.x);
    return SplashRim{{static_cast<float>(splash.position.x), static_cast<float>(splash.position.y)},
                     static_cast<float>(ring->radius),
                     static_cast<float>(ring->half_width),
                     static_cast<float>(ring->age),
                     static_cast<std::uint32_t>(ring->knots),
                     static_cast<std::uint32_t>(bits ^ bits >> 32U)};
}

float SplashRim::halfWidthTowards(Vec2f direction) const
{
    const float turn = std::atan2(direction.y, direction.x) / (2.0F * std::numbers::pi_v<float>)+0.5F;
    const float at = turn * static_cast<float>(knots);
    const float begin = std::floor(at);
    const auto number = [&](float k) { return hashedNumber(seed + static_cast<std::uint32_t>(k) % knots); };
    const float x = at - begin;
    const float share = x * x * (3.0F - 2.0F * x);
    const float size = number(begin) + share * (number(begin + 1.0F) - number(begin));
    return std::max(half_width * (1.0F + age * (2.0F * size - 1.0F)), 1e-9F);
}

}  // namespace droplet
