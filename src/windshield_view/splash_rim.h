// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>

#include "droplet/windshield/splash.h"
#include "windshield_view/glass_frame.h"

namespace droplet {

/// Rim of a splash's ring, as it is drawn. Rims become fainter, and gather in knots of random sizes, both in proportion
/// to their ages.
struct SplashRim {
    Vec2f middle;             ///< [m]
    float radius = 0.0F;      ///< of the middle of the rim [m]
    float half_width = 0.0F;  ///< [m]
    float age = 0.0F;         ///< share of its lifetime
    std::uint32_t knots = 0;
    std::uint32_t seed = 0;

    /// Rim at a time [s]; empty if there is none.
    static std::optional<SplashRim> of(const Splash& splash, double time);

    /// Share that it covers of what is below it.
    [[nodiscard]] float strength() const { return 1.0F - age; }
    /// Half of its width in a direction from its middle; at most twice half_width [m].
    /// @param direction  unit
    [[nodiscard]] float halfWidthTowards(Vec2f direction) const;
    /// Distance from the middle beyond which there is no rim [m].
    [[nodiscard]] float reach() const { return radius + 2.0F * half_width; }
};

}  // namespace droplet
