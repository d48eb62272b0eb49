// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "droplet/domain/domain.h"
#include "droplet/vector.h"

namespace droplet {

/// Closed polygon of rim vertices, liquid on its left.
using RimPolygon = std::vector<Vec2>;

/// Places rim vertices for any edge length along one footprint's loops. The liquid's local width, which does not depend
/// on the edge length, is computed once.
class RimSampler {
public:
    /// @param widest  longest edge that sample() will probably be called with [m]
    /// @throws Error  InvalidArgument if loops cross or touch
    RimSampler(const Footprint& footprint, double widest);

    /// Polygons along the loops, rim first. Corners stay. Edges are at most about `edge` long, and shorter where the
    /// liquid is narrower or the rim curves more. The polygons do not cross and enclose the loops' area.
    /// @throws Error InvalidArgument if loops cross or touch
    [[nodiscard]] std::vector<RimPolygon> sample(double edge) const;

    /// Length of the loops' own detail; small width makes no edge shorter than this [m].
    [[nodiscard]] double finest() const { return finest_; }

private:
    std::vector<Loop> loops_;
    double widest_;
    std::vector<std::vector<double>> widths_;  ///< width of the liquid at every point of every loop [m]; infinite where
                                               ///< it is certainly more than widest_
    double finest_ = 0.0;
};

}  // namespace droplet
