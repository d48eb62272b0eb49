// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "droplet/mask/mask.h"
#include "outline/borders.h"
#include "outline/corners.h"
#include "outline/slot.h"

namespace droplet {

/// The mask with a dry frame around it.
class CoverageField {
public:
    CoverageField(const Mask& mask, double threshold) : mask_(mask), threshold_(threshold) {}

    [[nodiscard]] bool inside(int x, int y) const { return x >= 0 && y >= 0 && x < mask_.width && y < mask_.height; }
    [[nodiscard]] double coverage(int x, int y) const { return inside(x, y) ? mask_.at(x, y) / 65535.0 : 0.0; }
    [[nodiscard]] double threshold() const { return threshold_; }

private:
    const Mask& mask_;
    double threshold_;
};

/// Whether the levels beside the borders' crossings carry their sub-pixel places.
bool looksAntiAliased(const CoverageField& field, const std::vector<Border>& borders);

/// Slots of a border or a part of one, with their places measured from the levels if those carry them.
SlotLoop placeSlots(const CoverageField& field, const Border& border, bool anti_aliased);

/// Fairs a loop without corners.
CorneredLoop fairWhole(SlotLoop slots);

/// Fairs a loop without corners, then with corners where they explain the mask far better.
/// @param coverage  as for findCorner
/// @param is_open   the loop is a piece of rim between its first and its last slot; it has no corners near these
CorneredLoop fairWithCorners(const SlotLoop& measured, const Coverage& coverage, bool is_open = false);

/// Points of a faired loop with its corners [px].
struct PixelLoop {
    std::vector<Vec2> points;
    std::vector<std::uint8_t> corner;
};

/// Builds the points of a faired loop with its corners.
PixelLoop withCorners(const CorneredLoop& cornered);

}  // namespace droplet
