// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "droplet/windshield/runoff.h"
#include "windshield_view/water_raster.h"

namespace droplet {

/// Film that runs off, in the pixels of a raster: a quadratic spline of its cells, whose means over the pixels have all
/// its water; what lies beyond the edge is in the pixels there. Its normals have the relief of RunoffRelief in the
/// pixels' middles.
/// @param film  there are cells
/// @return      water of every pixel, row by row from the upper left
std::vector<WaterPixel> filmOn(const WaterRaster& raster, const Runoff& film);

}  // namespace droplet
