// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "droplet/footprint/domain.h"
#include "droplet/vector.h"

namespace droplet {

/// A closed polygon of rim vertices, liquid on its left.
using RimPolygon = std::vector<Vec2>;

/// Places rim vertices for any edge length along one footprint's loops. What does not depend on the edge length, the
/// liquid's local width, is worked out once.
class RimSampler {
public:
    /// @param widest  the longest edge that sample() is expected to be asked for [m]
    /// @throws Error  InvalidArgument if loops cross or touch
    RimSampler(const Footprint& footprint, double widest);

    /// Polygons along the loops, rim first: corners stay, edges are at most about `edge` long, shorter where the liquid
    /// is narrower or the rim curves more; the polygons do not cross and enclose the loops' area.
    /// @throws Error InvalidArgument if loops cross or touch
    [[nodiscard]] std::vector<RimPolygon> sample(double edge) const;

    /// Length of the loops' own detail: edges are not made shorter than this on account of width [m].
    [[nodiscard]] double finest() const { return finest_; }

private:
    std::vector<Loop> loops_;
    double widest_;
    std::vector<std::vector<double>> widths_;  ///< of the liquid at every point of every loop [m]; infinite where it is
                                               ///< certainly more than widest_
    double finest_ = 0.0;
};

}  // namespace droplet
