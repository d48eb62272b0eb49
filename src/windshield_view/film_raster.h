// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "droplet/windshield/runoff.h"
#include "windshield_view/runoff_relief.h"
#include "windshield_view/water_raster.h"

namespace droplet {

/// Film that runs off, in the pixels of a raster: a quadratic spline of its cells, whose means over the pixels have all
/// its water; what lies beyond the edge is in the pixels there. Its normals have the relief of RunoffRelief in the
/// pixels' middles.
class FilmRaster {
public:
    /// @param raster  must outlive this
    /// @param film    there are cells; must outlive this
    FilmRaster(const WaterRaster& raster, const Runoff& film);

    /// Film in the pixels of a row, from the left.
    /// @param row  from above
    /// @param to   a value for each pixel
    void row(std::size_t row, std::span<WaterPixel> to) const;

private:
    /// Cells that reach the pixels along an axis, the same number for each; some add nothing.
    struct Taps {
        std::size_t count = 0;           ///< for each pixel
        std::vector<std::size_t> first;  ///< cell of each pixel, from the lower end of the axis
        /// What a cell adds, pixel by pixel: to the mean over the pixel, to its mean slope along the axis [1/m], and to
        /// the mean again.
        std::vector<Float4> shares;
    };
    struct Axis;
    static Taps tapsOf(const Axis& axis);

    const WaterRaster& raster_;
    const Runoff& film_;
    RunoffRelief relief_;
    Taps across_;
    std::vector<RunoffRelief::Column> columns_;  ///< of the pixels' middles
    Taps up_;
};

}  // namespace droplet
