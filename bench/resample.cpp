// SPDX-License-Identifier: GPL-3.0-or-later
#include "resample.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace droplet::bench {
namespace {

/// Adds evenly spaced points along a chain, with its first point and without its last.
void addEvenly(const std::vector<Vec2>& chain, double spacing, bool begins_at_corner, Loop& loop)
{
    std::vector<double> at{0.0};
    for (std::size_t i = 1; i < chain.size(); ++i) {
        at.push_back(at.back() + length(chain[i] - chain[i - 1]));
    }
    const auto pieces = static_cast<std::size_t>(std::max(1.0, std::round(at.back() / spacing)));
    std::size_t segment = 0;
    for (std::size_t piece = 0; piece < pieces; ++piece) {
        const double where = at.back() * static_cast<double>(piece) / static_cast<double>(pieces);
        while (at[segment + 1] < where) {
            ++segment;
        }
        const double share = (where - at[segment]) / (at[segment + 1] - at[segment]);
        loop.points.push_back(chain[segment] + share * (chain[segment + 1] - chain[segment]));
        loop.corner.push_back(begins_at_corner && piece == 0 ? 1 : 0);
    }
}

Loop resampled(const Loop& loop, double spacing)
{
    const auto first =
        static_cast<std::size_t>(std::find(loop.corner.begin(), loop.corner.end(), 1) - loop.corner.begin());
    const bool has_corners = first < loop.points.size();
    Loop result;
    std::vector<Vec2> chain;
    bool begins_at_corner = has_corners;
    for (std::size_t k = 0; k <= loop.points.size(); ++k) {
        const std::size_t i = ((has_corners ? first : 0) + k) % loop.points.size();
        chain.push_back(loop.points[i]);
        if (chain.size() > 1 && (loop.corner[i] == 1 || k == loop.points.size())) {
            addEvenly(chain, spacing, begins_at_corner, result);
            chain = {loop.points[i]};
        }
    }
    return result;
}

}  // namespace

Domain resampled(const Domain& domain, double spacing)
{
    Domain result = domain;
    for (Footprint& footprint : result.droplets) {
        footprint.rim = resampled(footprint.rim, spacing);
        for (Loop& hole : footprint.holes) {
            hole = resampled(hole, spacing);
        }
    }
    return result;
}

}  // namespace droplet::bench
