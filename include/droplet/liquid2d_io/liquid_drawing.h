// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "droplet/drawing/drawing.h"
#include "droplet/drawing/picture.h"
#include "droplet/expression/liquid_shape.h"
#include "droplet/liquid2d/fluid_scene.h"

namespace droplet {

/// Window of a drawing.
struct LiquidView {
    Vec2 size;       ///< of the window, whose lower left corner is at the origin [m], > 0
    int width = 0;   ///< [px], ≥ 1
    int height = 0;  ///< [px], ≥ 1; pixels are square if it has the window's ratio
};

/// Colours and lines of a drawing.
struct LiquidLook {
    std::string name;                  ///< such as "flat"
    Colour water{};                    ///< of the liquid
    Colour droplet{};                  ///< of detached droplets
    std::optional<Colour> foam;        ///< of foam; empty: what is behind shows
    Colour line{};                     ///< of the liquid's outlines
    double line_width = 0.0;           ///< of the outlines, at most, in thousandths of the window's width; 0: none
    Colour wall{};                     ///< of walls
    std::optional<Colour> background;  ///< empty: transparent
    double least_droplet = 2.0;        ///< diameter of a disc with the area of the smallest droplet that is drawn, in
                                       ///< thousandths of the window's width, ≥ 0: less looks like dust
};

/// All looks: `flat`, `comic`, `ink`, `night`.
const std::vector<LiquidLook>& liquidLooks();

/// Look with a given name.
/// @throws Error InvalidArgument if there is none; the message lists all names
const LiquidLook& liquidLookNamed(std::string_view name);

/// Everything that a drawing shows.
struct DrawnLiquid {
    const LiquidShape& shape;          ///< of the liquid
    const std::vector<Region>& walls;  ///< that are visible
};

/// Writes a drawing as SVG: Bézier curves in groups named `liquid`, `droplets`, `foam`, `lines` and `walls`, one above
/// the other, so that each can be selected in a program. Outlines differ from the shape by no more than a third of a
/// pixel. Lines are shapes, for they thin out at tips and along threads.
///
/// Guarantees: the same shape gives the same bytes; the stream is left failed if it did not take everything.
void writeLiquidSvg(const DrawnLiquid& scene, const LiquidView& view, const LiquidLook& look, std::ostream& out);

/// Draws the picture of writeLiquidSvg() as pixels, with transparency where nothing is drawn.
/// @throws Error InvalidArgument: the view is empty or larger than 32767 pixels a side
Layer liquidLayer(const DrawnLiquid& scene, const LiquidView& view, const LiquidLook& look);

/// Coverage of every pixel by liquid: 65535 times the covered part of its area, which is exact.
/// @throws Error InvalidArgument: the view is empty
DeepPicture liquidMask(const LiquidShape& shape, const LiquidView& view);

}  // namespace droplet
