// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "droplet/mask/mask.h"

namespace droplet {

/// Step from a pixel to a neighbour; y down.
struct Step {
    int x = 0;
    int y = 0;
};

/// East, north, west, south. When you face direction k + 1, your right hand points in direction k.
inline constexpr std::array<Step, 4> kSteps{{{1, 0}, {0, -1}, {-1, 0}, {0, 1}}};

/// Crossing from a liquid pixel into a dry neighbour.
struct Crossing {
    int x = 0;
    int y = 0;
    int direction = 0;

    [[nodiscard]] Step toward() const { return kSteps[static_cast<std::size_t>(direction)]; }

    bool operator==(const Crossing&) const = default;
};

/// Crossings in order around a component or hole, liquid on the left as you go.
using Border = std::vector<Crossing>;

/// All borders between liquid and dry in a mask, as OpenCV's findContours finds them, in reading order of their starts.
/// The border of a component starts west of the component's first pixel; the border of a hole starts west of the hole's
/// first pixel. Liquid is 8-connected, dry 4-connected; everything outside the mask is dry.
/// @param mask   valid
/// @param level  coverage from which a pixel is liquid
/// @throws Error InvalidInput: a mask of 2^31 pixels or more, or borders that are too long
std::vector<Border> followBorders(const Mask& mask, std::uint16_t level);

}  // namespace droplet
