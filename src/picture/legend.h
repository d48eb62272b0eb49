// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "droplet/mesh/planar_mesh.h"
#include "droplet/picture/paint.h"
#include "droplet/picture/picture.h"
#include "picture/optics.h"

namespace droplet {

/// A place in a triangle.
struct PaintPoint {
    float u = 0.0F;      ///< weight of the second vertex
    float v = 0.0F;      ///< weight of the third vertex
    double slope = 0.0;  ///< how much values change there along a line's width on the picture
};

/// The colour of paint, linear, within a triangle.
Vec3f paintAt(const Paint& paint, const Triangle& triangle, const PaintPoint& point);

/// How much of a picture of that size a legend takes at its right edge; 0 in one smaller than 320 by 240 [px].
int legendWidth(const Paint& paint, int width, int height);

/// Draws the colours with their numbers at the right edge, where there is room for them.
void drawLegend(Picture& picture, const Paint& paint);

}  // namespace droplet
