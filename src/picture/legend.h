// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "droplet/picture/paint.h"
#include "droplet/picture/picture.h"
#include "picture/optics.h"

namespace droplet {

/// The colour of paint, linear, within a triangle at weights u of its second and v of its third vertex.
Vec3f paintAt(const Paint& paint, const Triangle& triangle, float u, float v);

/// Draws the colours with their numbers along the right edge; nothing in a picture smaller than 320 by 240.
void drawLegend(Picture& picture, const Paint& paint);

}  // namespace droplet
