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

/// Draws the colours with their numbers in the upper right corner; nothing in a picture smaller than 320 by 240.
void drawLegend(Picture& picture, const Paint& paint);

}  // namespace droplet
