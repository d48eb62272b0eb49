// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>
#include <variant>
#include <vector>

#include "droplet/mask/mask.h"
#include "droplet/vector.h"

namespace droplet {

/// Where liquid comes from that flows into a footprint.
enum class RevealFrom {
    Left,
    Right,
    Top,
    Bottom,
    Middle,  ///< of the footprint's bounding box
};

/// Finds a source by its name: left, right, top, bottom or middle.
/// @throws Error InvalidArgument
RevealFrom revealFromNamed(std::string_view name);

/// Source of the liquid: a side of the picture, its middle, or a place as shares of width and height, from the top
/// left.
using RevealSource = std::variant<RevealFrom, Vec2>;

/// Footprint that liquid flows into.
///
/// A front goes over the picture evenly. Where it meets a droplet, liquid flows on in it, along its strokes and around
/// its holes, half as fast along the rim as in the middle, so that its front is round. Droplets that are far from each
/// other begin one after the other.
class Reveal {
public:
    /// @param mask     valid, with liquid
    /// @param source   finite
    /// @throws Error InvalidArgument, InvalidInput without liquid
    Reveal(Mask mask, const RevealSource& source);

    /// Footprint at a time: what liquid has reached.
    ///
    /// Guarantees: it grows, from hardly anything at 0 to the whole mask at 1, exactly.
    /// @param time  share of the whole, 0 … 1
    /// @throws Error InvalidArgument
    [[nodiscard]] Mask at(double time) const;

private:
    Mask mask_;
    std::vector<float> arrival_;  ///< at every pixel [px at full speed]
    std::vector<float> speed_;    ///< of the front there, up to 1
    float end_ = 0.0F;            ///< when the front has left the last pixel
};

}  // namespace droplet
