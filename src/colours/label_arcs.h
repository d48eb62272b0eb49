// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "outline/borders.h"

namespace droplet {

/// Image of labels; everything outside has label 0, which is dry.
struct LabelView {
    int width = 0;
    int height = 0;
    const std::vector<std::uint8_t>& labels;

    [[nodiscard]] std::uint8_t at(int x, int y) const
    {
        return x < 0 || y < 0 || x >= width || y >= height
                   ? std::uint8_t{0}
                   : labels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                            static_cast<std::size_t>(x)];
    }
};

/// Piece of the boundary of two labels, between two junctions or closed.
struct LabelArc {
    Border crossings;       ///< from the left label into the right one
    std::uint8_t left = 0;  ///< not 0; less than the right one, unless that is 0
    std::uint8_t right = 0;
    std::optional<std::size_t> from;  ///< junction before the first crossing; empty for a closed arc
    std::optional<std::size_t> to;    ///< junction after the last crossing
};

/// Place where three or four labels meet: the square between the centres of four pixels.
struct LabelJunction {
    int x = 0;  ///< of the upper left pixel; −1 at the left border of the image
    int y = 0;
};

/// Use of an arc by a loop.
struct ArcUse {
    std::size_t arc = 0;
    bool is_reversed = false;
};

/// Border of a region, or of a hole in it: arcs in order, with the region on the left.
struct LabelLoop {
    std::uint8_t label = 0;
    std::vector<ArcUse> arcs;
};

/// All boundaries between the labels of an image. Every arc is used by the loop on its left and, unless its right label
/// is 0, by the loop on its right. Regions are 8-connected; where two pairs of pixels touch at one corner, the pair
/// with the larger label is connected.
struct LabelArcs {
    std::vector<LabelArc> arcs;
    std::vector<LabelJunction> junctions;
    std::vector<LabelLoop> loops;  ///< by label, then in reading order
};

/// @throws Error InvalidInput if the boundaries are too long
LabelArcs followLabels(const LabelView& labels);

}  // namespace droplet
