// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "windshield_view/backdrop.h"

namespace droplet {

/// Linear light of pixels, row by row from the top left.
struct LightPicture {
    int width = 0;
    int height = 0;
    std::vector<Float4> light;
};

/// Blurs a picture as a lens with a round aperture does: the light of every point is spread evenly over a disc. Beyond
/// its edges the picture is mirrored.
///
/// Guarantees: light is conserved; the same bytes with any number of threads.
/// @param diameter  diameter of the disc [px], ≥ 0
LightPicture defocused(LightPicture sharp, float diameter);

}  // namespace droplet
