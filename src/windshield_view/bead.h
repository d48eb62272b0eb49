// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>

#include "windshield_view/glass_frame.h"

namespace droplet {

/// Water that a ray meets on the glass.
struct WaterMet {
    float cover = 0.0F;    ///< share of the pixel
    Vec2f slope;           ///< slope of its surface along the glass's x and y
    bool is_bead = false;  ///< thick, like a droplet
};

/// Share of a pixel inside an edge, at a distance from it that is positive inside.
inline float within(float distance, float pixel)
{
    // Without a branch, unlike std::clamp.
    return std::min(std::max(distance / pixel + 0.5F, 0.0F), 1.0F);
}

/// Line of water on the glass whose section is half an ellipse.
struct Bead {
    float width = 0.0F;   ///< [m], > 0
    float height = 0.0F;  ///< over the width

    /// Water in a pixel.
    /// @param across     distance of the pixel's middle from the near edge, in the given direction [m]
    /// @param direction  unit
    /// @param pixel      size of a pixel's image on the glass [m]
    [[nodiscard]] WaterMet at(float across, Vec2f direction, float pixel) const
    {
        const float cover = within(across, pixel) + within(width - across, pixel) - 1.0F;
        if (!(cover > 0.0F)) {
            return {};
        }
        const float x = std::clamp(2.0F * across / width - 1.0F, -0.96F, 0.96F);
        const float slope = -2.0F * height * x / std::sqrt(1.0F - x * x);
        return {cover, {slope * direction.x, slope * direction.y}, true};
    }
};

}  // namespace droplet
