// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "view/backdrop.h"

namespace droplet {

/// Linear light of pixels, row by row from the top left.
struct LightPicture {
    int width = 0;
    int height = 0;
    std::vector<Four> light;
};

/// A picture out of focus: every point's light is spread evenly over a disc, as by a lens with a round aperture; beyond
/// its edges the picture is mirrored. Light is kept.
///
/// Guarantees: the same bytes at any number of threads.
/// @param diameter  of the disc [px], ≥ 0
LightPicture defocused(LightPicture sharp, float diameter);

}  // namespace droplet
