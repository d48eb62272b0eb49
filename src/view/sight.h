// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>

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

    ViewOptions options;
    Glass glass;
    Eye eye;
    Tiles tiles;
    Backdrop backdrop;
};

}  // namespace droplet
