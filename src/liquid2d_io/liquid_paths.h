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

/// Curves that all vector drawings show for outlines [px].
std::vector<BezierPath> pathsOf(const std::vector<Loop>& loops, const LiquidView& view);

/// Width of outlines [px]; 0: none.
double lineWidth(const LiquidLook& look, const LiquidView& view);

}  // namespace droplet
