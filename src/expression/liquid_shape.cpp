// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/expression/liquid_shape.h"

namespace droplet {

double LiquidShape::area() const
{
    double area = 0.0;
    for (const auto* loops : {&liquid, &droplets}) {
        for (const Loop& loop : *loops) {
            area += signedArea(loop);
        }
    }
    return area;
}

}  // namespace droplet
