// SPDX-License-Identifier: GPL-3.0-or-later
#include "picture/legend.h"

#include <cmath>

#include "picture/ground.h"
namespace droplet {
Vec3f paintAt(const Paint& paint, const Triangle& t, float u, float v)
{
    const auto value = [&](const std::vector<double>& a) {
        const auto second = static_cast<double>(u);
        const auto third = static_cast<double>(v);
        return (1.0 - second - third) * a[t[0]] + second * a[t[1]] + third * a[t[2]];
    };
    const double here = value(paint.values);
    const double at = std::clamp((here - paint.low) / (paint.high - paint.low), 0.0, 1.0) *
                      static_cast<double>(paint.scale.size() - 1);
    const auto k = std::min(static_cast<std::size_t>(at), paint.scale.size() - 2);
    const Vec3 c =
        (1.0 - (at - static_cast<double>(k))) * paint.scale[k] + (at - static_cast<double>(k)) * paint.scale[k + 1];
    return {toLinear(static_cast<float>(c.x)), toLinear(static_cast<float>(c.y)), toLinear(static_cast<float>(c.z))};
}
void drawLegend(Picture&, const Paint&) {}
}  // namespace droplet
