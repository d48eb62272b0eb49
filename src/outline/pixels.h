// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "droplet/outline/outline.h"
#include "droplet/vector.h"

namespace droplet {

/// Size of a picture's pixels [m].
/// @param width         of the picture [px]
/// @param raster_scale  as in Mask
inline double pixelSize(int width, const std::optional<double>& raster_scale, const TraceOptions& options)
{
    return options.pixel_size ? *options.pixel_size / raster_scale.value_or(1.0) : options.width / width;
}

/// Place of a point of a picture, whose middle is the origin [m].
/// @param point  from the top left [px]
inline Vec2 placeOf(Vec2 point, int width, int height, double pixel_size)
{
    return {(point.x - 0.5 * width) * pixel_size, (0.5 * height - point.y) * pixel_size};
}

}  // namespace droplet
