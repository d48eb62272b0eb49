// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "droplet/footprint/mask.h"
#include "image/image.h"

namespace droplet {

/// Decides which levels are liquid, and turns one plane of the image into coverage in place.
/// @throws Error InvalidInput: no alpha where alpha was asked
Mask maskFromImage(Image image, const MaskOptions& options);

}  // namespace droplet
