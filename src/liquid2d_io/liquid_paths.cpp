// SPDX-License-Identifier: GPL-3.0-or-later
#include "liquid_paths.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "brush_line.h"
#include "require.h"

namespace droplet {
namespace {

/// Greatest distance of curves from the shape [px].
constexpr double kTolerance = 0.3;

std::vector<BezierPath> pathsOf(const std::vector<Loop>& loops, const LiquidView& view)
{
    std::vector<BezierPath> paths;
    paths.reserve(loops.size());
    for (const Loop& loop : loops) {
        paths.push_back(fitBezier(toPixels(loop.points, view), kTolerance));
    }
    return paths;
}

}  // namespace

void validate(const LiquidView& view)
{
    requireWithin("view.width", view.width, 1, 32767);
    requireWithin("view.height", view.height, 1, 32767);
    require(view.size.x > 0.0 && std::isfinite(view.size.x), "view.size.x", view.size.x, "finite and more than 0 m");
    require(view.size.y > 0.0 && std::isfinite(view.size.y), "view.size.y", view.size.y, "finite and more than 0 m");
}

std::vector<Vec2> toPixels(const std::vector<Vec2>& points, const LiquidView& view)
{
    std::vector<Vec2> result;
    result.reserve(points.size());
    for (const Vec2 x : points) {
        result.push_back({x.x * view.width / view.size.x, (view.size.y - x.y) * view.height / view.size.y});
    }
    return result;
}

LiquidPaths liquidPaths(const LiquidShape& shape, const LiquidView& view, const LiquidLook& look)
{
    LiquidPaths paths;
    paths.liquid = pathsOf(shape.liquid, view);
    const double least = look.least_droplet * 1e-3 * view.size.x;
    std::vector<Loop> droplets;
    std::copy_if(shape.droplets.begin(), shape.droplets.end(), std::back_inserter(droplets),
                 [&](const Loop& loop) { return signedArea(loop) >= 0.25 * std::numbers::pi * least * least; });
    paths.droplets = pathsOf(droplets, view);
    if (look.foam) {
        paths.foam = pathsOf(shape.foam, view);
    }
    if (const double width = look.line_width * 1e-3 * view.width; width > 0.0) {
        // Foam is a hole of the liquid, which has the line.
        std::vector<BezierPath> outlines = paths.liquid;
        outlines.insert(outlines.end(), paths.droplets.begin(), paths.droplets.end());
        paths.lines = brushLines(outlines, width);
    }
    return paths;
}

}  // namespace droplet
