// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "bezier.h"
#include "droplet/liquid2d_io/liquid_drawing.h"
#include "droplet/outline/outline.h"

namespace droplet {

/// @throws Error InvalidArgument: the view is empty or larger than 32767 pixels a side
void validate(const LiquidView& view);

/// Polyline in pixels, y down.
std::vector<Vec2> toPixels(const std::vector<Vec2>& points, const LiquidView& view);

/// Curves that all drawings show [px], to be filled with the nonzero rule, one layer upon the other.
struct LiquidPaths {
    std::vector<BezierPath> liquid;    ///< with its holes
    std::vector<BezierPath> droplets;  ///< may overlap
    std::vector<BezierPath> foam;      ///< none if the look has no colour for it: then it is a hole of the liquid
    std::vector<BezierPath> lines;     ///< around all of these
};

/// Curves of a shape. Those of outlines differ from the shape by no more than a third of a pixel.
LiquidPaths liquidPaths(const LiquidShape& shape, const LiquidView& view, const LiquidLook& look);

}  // namespace droplet
