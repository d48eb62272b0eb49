// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>

#include "droplet/vector.h"

namespace droplet {

/// The straight way between two places.
class Way {
public:
    Way(Vec2 from, Vec2 to) : from_(from), way_(to - from)
    {
        const double squared = dot(way_, way_);
        inverse_ = squared > 0.0 ? 1.0 / squared : 0.0;
    }

    [[nodiscard]] double squaredDistance(Vec2 p) const
    {
        const Vec2 begun = p - from_;
        const Vec2 apart = begun - std::clamp(dot(begun, way_) * inverse_, 0.0, 1.0) * way_;
        return dot(apart, apart);
    }

private:
    Vec2 from_;
    Vec2 way_;
    double inverse_ = 0.0;
};

}  // namespace droplet
