// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "droplet/drawing/picture.h"
#include "droplet/mesh/planar_mesh.h"
#include "droplet/render/paint.h"
#include "render/optics.h"

namespace droplet {

/// Point in a triangle.
struct PaintPoint {
    float u = 0.0F;      ///< weight of the second vertex
    float v = 0.0F;      ///< weight of the third vertex
    double slope = 0.0;  ///< change of the values across a line's width in the picture
};

/// Linear colour of paint in a triangle.
Vec3f paintAt(const Paint& paint, const Triangle& triangle, const PaintPoint& point);

/// Width of the legend at the right edge of a picture; 0 in pictures smaller than 320 by 240 [px].
int legendWidth(const Paint& paint, int width, int height);

/// Draws the legend, colours with numbers, at the right edge if the picture is large enough.
void drawLegend(Picture& picture, const Paint& paint);

}  // namespace droplet
