// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>

#include "droplet/vector.h"

namespace droplet {

/// Straight line segment.
class Segment {
public:
    Segment(Vec2 from, Vec2 to) : from_(from), along_(to - from)
    {
        const double squared = dot(along_, along_);
        inverse_ = squared > 0.0 ? 1.0 / squared : 0.0;
    }

    [[nodiscard]] double squaredDistance(Vec2 p) const
    {
        const Vec2 offset = p - from_;
        const Vec2 apart = offset - std::clamp(dot(offset, along_) * inverse_, 0.0, 1.0) * along_;
        return dot(apart, apart);
    }

private:
    Vec2 from_;
    Vec2 along_;
    double inverse_ = 0.0;
};

}  // namespace droplet
