// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "droplet/vector.h"

namespace droplet {

/// Exact coverage of pixels by polygons whose sides do not cross.
class PixelCoverage {
public:
    /// @param width   of the picture [px], ≥ 1
    /// @param height  of the picture [px], ≥ 1
    PixelCoverage(int width, int height);

    /// Adds a side of a polygon. Seen with y down, rims run counter-clockwise and holes clockwise.
    void addLine(Vec2 a, Vec2 b);

    /// Covered part of the area of each pixel, row by row from the top, up to rounding errors from 0 to 1.
    [[nodiscard]] std::vector<double> shares() const;

private:
    [[nodiscard]] std::size_t index(int x, int y) const;
    void addInside(Vec2 a, Vec2 b);
    void addRow(int y, std::pair<double, double> range, double height);

    int width_;
    int height_;
    std::vector<double> sums_;  ///< of each pixel: its share less that of the pixel to the left of it
};

}  // namespace droplet
