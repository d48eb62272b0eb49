// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "droplet/drawing/picture.h"
#include "droplet/shape/base_surface.h"
#include "droplet/surface/surface.h"
#include "droplet/vector.h"

namespace droplet {

/// What maps of droplets show, and how finely.
struct DropletMapOptions {
    Vec2 extent;           ///< window around the origin [m], both sides > 0
    int width = 1024;      ///< of the pictures [px], 16 to 8192; their height follows, so that pixels are nearly square
    bool is_tile = false;  ///< whether the window is repeated on all sides: what leans out over one of its edges comes
                           ///< in over the opposite one
    BaseSurface ground = {};  ///< under the droplets
};

/// Droplets and ground as seen from straight above, by means over pixels: what stands in for the mesh in engines. Upper
/// rows are those with the largest y. Where the ground has an end there is none beyond it: height 0, and open.
struct DropletMaps {
    FloatPicture height;     ///< of what is seen, over the plane [m]
    FloatPicture normal;     ///< outward unit normals: x right, y up, z towards the eye
    FloatPicture thickness;  ///< of the liquid along the line of sight [m]; its integral is the volume
    FloatPicture coverage;   ///< share of the pixel in which liquid is seen
    FloatPicture wetness;  ///< share of the pixel whose ground touches liquid; less where liquid leans out over its rim
    FloatPicture occlusion;  ///< share of even light from above that reaches what is seen, 0 to 1
};

/// Draws maps of droplets.
///
/// Guarantees: the same bytes with any number of threads. Integrals of thickness, coverage and wetness differ from
/// volume and areas by the error of 16 places in a pixel.
/// @param surface  valid and closed, rims stored twice
/// @param options  see there
/// @throws Error   InvalidArgument
DropletMaps dropletMaps(const Surface& surface, const DropletMapOptions& options);

}  // namespace droplet
