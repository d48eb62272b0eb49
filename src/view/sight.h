// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>

#include "droplet/view/view.h"
#include "picture/tone.h"
#include "view/backdrop.h"
#include "view/eye.h"
#include "view/tiles.h"

namespace droplet {

/// A share in 255ths.
inline std::uint8_t level8(float share)
{
    return static_cast<std::uint8_t>(nearest(255.0F * share, 255));
}

/// What the eye sees through dry glass, and how it looks.
struct Sight {
    Sight(const Glass& its_glass, const ViewOptions& its_options)
        : options(its_options),
          glass(its_glass),
          eye(glass, options),
          tiles(eye, glass, options),
          backdrop(options.width, options.height, eye.halfWidth(),
                   0.5F * eye.tangent() * static_cast<float>(options.height))
    {
    }

    /// Place of a ray within a pixel, from its middle: one of n in a row.
    [[nodiscard]] float offset(int k) const
    {
        return (static_cast<float>(k) + 0.5F) / static_cast<float>(options.samples) - 0.5F;
    }

    /// Backdrop pixels that a ray through a droplet stands for: across a droplet goes about the whole picture.
    /// @param diameter  [px]
    [[nodiscard]] std::uint8_t levelFor(float diameter) const
    {
        constexpr float kShare = 0.8F;
        return backdrop.levelOf(kShare * static_cast<float>(options.width) /
                                std::max(diameter * static_cast<float>(options.samples), 1.0F));
    }

    /// At how many moments something is looked at that moves while the shutter is open, so that it goes no further than
    /// about a pixel from one to the next.
    /// @return  a power of two
    [[nodiscard]] int momentsOf(Vec2 position, double speed) const
    {
        const auto place = options.open_time > 0.0 && speed > 0.0 ? glass.place(position) : std::nullopt;
        if (!place) {
            return 1;
        }
        constexpr double kApart = 1.25;  // [px]
        constexpr double kMax = 64.0;
        const double pixel = static_cast<double>(eye.tangent()) * std::max(eye.seen(*place).point.y, 1e-3);
        const double moments = std::ceil(speed * options.open_time / (kApart * pixel));
        return static_cast<int>(std::bit_ceil(static_cast<unsigned>(std::clamp(moments, 1.0, kMax))));
    }

    /// When one of the moments is, from the state's time [s].
    [[nodiscard]] double timeOf(int moment, int moments) const
    {
        return options.open_time * ((moment + 0.5) / moments - 0.5);
    }

    ViewOptions options;
    Glass glass;
    Eye eye;
    Tiles tiles;
    Backdrop backdrop;
};

}  // namespace droplet
