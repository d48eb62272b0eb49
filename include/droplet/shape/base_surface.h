// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "droplet/vector.h"

namespace droplet {

/// The ground's height at a point of the plane, and the gradient of it.
struct GroundPoint {
    double height = 0.0;  ///< h, out of the plane [m]
    Vec2 gradient;        ///< ∇h
};

/// The ground a droplet stands on: a height field over the footprint's plane. Made without anything, it is the plane
/// itself.
class BaseSurface {
public:
    /// Guarantees wanted of it: the same point gives the same result on every thread.
    /// Throws Error InvalidArgument where there is no ground.
    using Sample = std::function<GroundPoint(Vec2)>;

    BaseSurface() = default;
    explicit BaseSurface(Sample sample);

    [[nodiscard]] bool flat() const { return !sample_; }
    [[nodiscard]] GroundPoint at(Vec2 p) const { return sample_ ? sample_(p) : GroundPoint{}; }

private:
    Sample sample_;
};

}  // namespace droplet
