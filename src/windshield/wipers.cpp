// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/windshield/wipers.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "require.h"

namespace droplet {

double Wiper::angleAt(double time) const
{
    const double since = time - start;
    if (since <= 0.0) {
        return first;
    }
    const double within = since - period * std::floor(since / period);
    if (within >= stroke) {
        return first;
    }
    return first + (last - first) * 0.5 * (1.0 - std::cos(2.0 * std::numbers::pi * within / stroke));
}

void Wiper::validate() const
{
    require(std::isfinite(pivot.x) && std::isfinite(pivot.y), "wiper.pivot", length(pivot), "finite");
    require(inner >= 0.0 && std::isfinite(inner), "wiper.inner", inner, "finite and at least 0 m");
    require(outer > inner && std::isfinite(outer), "wiper.outer", outer, "finite and more than inner");
    require(std::isfinite(first), "wiper.first", first, "finite");
    require(std::isfinite(last) && last != first && std::abs(last - first) <= 2.0 * std::numbers::pi, "wiper.last",
            last, "other than first, by at most 2 pi");
    require(stroke > 0.0 && std::isfinite(stroke), "wiper.stroke", stroke, "finite and more than 0 s");
    require(period >= stroke && std::isfinite(period), "wiper.period", period, "finite and at least the stroke");
    require(std::isfinite(start), "wiper.start", start, "finite");
}

std::vector<Wiper> tandemWipers(const Glass& glass, double period)
{
    // Blades of about half the glass's width rest along its lower edge; on a low glass the height limits them. One
    // turns at the left pillar. The other continues into the first one's field, so that only the corner at the right
    // pillar and the upper edge stay wet, and nothing between the two.
    struct Half {
        double pivot;  // x of the pivot over the width
        double last;   // angle at the turn [rad]
    };
    std::vector<Wiper> wipers;
    for (const Half& half : {Half{1.0 / 16.0, 98.0 * kDegree}, Half{0.5, 135.0 * kDegree}}) {
        Wiper wiper;
        wiper.pivot = {half.pivot * glass.width(), -0.03 * glass.height()};
        wiper.outer = std::min(0.49 * glass.width(), 1.02 * glass.height());
        wiper.inner = 0.12 * wiper.outer;
        wiper.first = 4.0 * kDegree;
        wiper.last = half.last;
        wiper.stroke = 1.2;
        wiper.period = period;
        wipers.push_back(wiper);
    }
    return wipers;
}

}  // namespace droplet
