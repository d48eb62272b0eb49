// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "droplet/footprint/mask.h"

namespace droplet {

/// A step from a pixel to a neighbour; y down.
struct Step {
    int x = 0;
    int y = 0;
};

/// East, north, west, south. Facing direction k + 1, the right hand points in direction k.
inline constexpr std::array<Step, 4> kSteps{{{1, 0}, {0, -1}, {-1, 0}, {0, 1}}};

/// A crossing from a liquid pixel into a dry neighbour.
struct Crossing {
    int x = 0;
    int y = 0;
    int direction = 0;

    [[nodiscard]] Step toward() const { return kSteps[static_cast<std::size_t>(direction)]; }

    bool operator==(const Crossing&) const = default;
};

/// Crossings in order around a component or hole, liquid on the left of one who faces along.
using Border = std::vector<Crossing>;

/// The borders of everything liquid in a mask, as OpenCV's findContours finds them. They come in reading order of where
/// they begin: a component's to the west of its first pixel, a hole's to the west of its own. Liquid is 8-connected,
/// dry 4-connected; outside the mask all is dry.
/// @param mask   valid
/// @param level  coverage from which a pixel is liquid
/// @throws Error InvalidInput: a mask of 2^31 pixels or more
std::vector<Border> followBorders(const Mask& mask, std::uint16_t level);

}  // namespace droplet
