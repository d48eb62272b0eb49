// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "windshield_view/bead.h"
#include "windshield_view/view_context.h"

namespace droplet {

/// What a slope of a film does to the picture behind it.
struct FilmOptics {
    Vec2f by_x;              ///< displacement for a unit slope along the glass's x [px]
    Vec2f by_y;              ///< likewise along its y
    float reflected = 0.0F;  ///< share of light that is reflected into the cabin

    /// Those in the middle of a tile.
    static FilmOptics of(const ViewContext& scene, std::size_t tile);
};

/// Wedge in a pixel.
struct BeadMet {
    WaterMet water;
    std::uint8_t pixel = 0;
};

/// Films and wedges in the pixels of a tile; none has both a film and a wedge. A film is so thin that its slope shifts
/// the picture behind it in proportion; the second order is a hundredth of that for the steepest films.
struct WaterLeft {
    std::array<float, kTilePixels> cover;    ///< share of a pixel that a film covers
    std::array<float, kTilePixels> shift_x;  ///< of the picture behind it [px]
    std::array<float, kTilePixels> shift_y;
    float reflected = 0.0F;  ///< share of light that films reflect into the cabin
    std::vector<BeadMet> beads;
};

}  // namespace droplet
