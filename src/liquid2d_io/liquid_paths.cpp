// SPDX-License-Identifier: GPL-3.0-or-later
#include "liquid_paths.h"

#include <cmath>

#include "require.h"

namespace droplet {
namespace {

/// Greatest distance of curves from the shape [px].
constexpr double kTolerance = 0.3;

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

std::vector<BezierPath> pathsOf(const std::vector<Loop>& loops, const LiquidView& view)
{
    std::vector<BezierPath> paths;
    paths.reserve(loops.size());
    for (const Loop& loop : loops) {
        paths.push_back(fitBezier(toPixels(loop.points, view), kTolerance));
    }
    return paths;
}

double lineWidth(const LiquidLook& look, const LiquidView& view)
{
    return look.line_width * 1e-3 * view.width;
}

}  // namespace droplet
