// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "droplet/liquid2d/particle_frame.h"
#include "liquid2d/bounds.h"
#include "liquid2d/cell_grid.h"

namespace droplet {

/// Particles by place, and the droplets that they belong to.
class OtherLiquid {
public:
    /// @param frame  with a particle
    /// @param group  of each particle's droplet, by id
    OtherLiquid(const ParticleFrame& frame, const std::vector<std::uint32_t>& group)
        : reach_(kNear * frame.spacing), cells_(boundsOf(frame.position).lower, boundsOf(frame.position).upper, reach_)
    {
        for (const std::uint32_t i : cells_.sort(frame.position)) {
            position_.push_back(frame.position[i]);
            group_.push_back(group[frame.id[i]]);
        }
    }

    /// Distance beyond which particles do not count [m].
    [[nodiscard]] double reach() const { return reach_; }

    /// Distance of a place from the nearest particle whose droplet counts, or the reach [m].
    template <typename Counts>
    [[nodiscard]] double distance(Vec2 place, const Counts& counts) const
    {
        double square = reach_ * reach_;
        const int column = cells_.column(place.x);
        const int row = cells_.row(place.y);
        for (int r = row - 1; r <= row + 1; ++r) {
            const auto [first, last] = cells_.range(r, column - 1, column + 1);
            for (std::uint32_t k = first; k < last; ++k) {
                const Vec2 away = place - position_[k];
                if (dot(away, away) < square && counts(group_[k])) {
                    square = dot(away, away);
                }
            }
        }
        return std::sqrt(square);
    }

private:
    /// Distance from liquid at which a droplet begins to flow together with it, in spacings: the reach of a kernel in
    /// bulk liquid and that of the droplet's rim.
    static constexpr double kNear = 3.0;

    double reach_;
    CellGrid cells_;
    std::vector<Vec2> position_;  ///< sorted
    std::vector<std::uint32_t> group_;
};

}  // namespace droplet
