// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "cell_grid.h"
#include "droplet/liquid2d/fluid.h"
#include "kernel.h"
#include "region.h"
#include "wall_samples.h"

namespace droplet {

/// Adds a particle to a state.
inline void addParticle(FluidState& state, Vec2 position, Vec2 velocity)
{
    state.position.push_back(position);
    state.velocity.push_back(velocity);
    state.id.push_back(state.next_id++);
    state.density.push_back(1.0);
    state.pressure.push_back(0.0);
    if (!state.affine.empty()) {
        state.affine.emplace_back();
    }
}

/// Places for new liquid: those that neither walls nor liquid take.
class FreePlaces {
public:
    FreePlaces(const FluidScene& scene, double time) : FreePlaces(scene, Kernel(scene.spacing), time) {}

    /// Takes the places of particles.
    void take(const std::vector<Vec2>& places)
    {
        places_.insert(places_.end(), places.begin(), places.end());
        taken_order_ = taken_.sort(places_);
    }

    /// Calls visit(place) for the places of a body that neither walls nor earlier bodies take.
    /// @param clearance  from particles, in spacings, at most 1
    template <typename Visit>
    void visit(const LiquidBody& body, double clearance, const Visit& visit)
    {
        std::vector<Vec2> own;
        (body.rings ? visitRings : visitLattice)(body.region, {scene_.spacing, lower_, upper_}, [&](Vec2 place) {
            if (isFree(place, clearance)) {
                visit(place);
                own.push_back(place);
            }
        });
        taken_regions_.emplace_back(body.region);
        take(own);
    }

private:
    FreePlaces(const FluidScene& scene, const Kernel& kernel, double time)
        : scene_(scene),
          walls_(WallSampler(scene, kernel).at(time)),
          lower_(Vec2{-scene.margin, -scene.margin}),
          upper_(scene.size + Vec2{scene.margin, scene.size.y + scene.margin}),
          cells_(lower_, upper_, kernel.support()),
          order_(cells_.sort(walls_.position)),
          taken_(lower_, upper_, kernel.support())
    {
        for (const Wall& wall : scene.walls) {
            taken_regions_.emplace_back(wallAt(wall, time));
        }
    }

    [[nodiscard]] bool isFree(Vec2 place, double clearance) const
    {
        const auto holds = [place](const Interior& region) { return region.contains(place); };
        return std::none_of(taken_regions_.begin(), taken_regions_.end(), holds) && !isAtWall(place) &&
               !isAtParticle(place, clearance);
    }

    /// Calls meets(index) for what a grid has around a place, until it returns true.
    template <typename Meets>
    static bool anyAround(Vec2 place, const CellGrid& cells, const std::vector<std::uint32_t>& order,
                          const Meets& meets)
    {
        const int column = cells.column(place.x);
        const int row = cells.row(place.y);
        for (int r = row - 1; r <= row + 1; ++r) {
            const auto [first, last] = cells.range(r, column - 1, column + 1);
            for (std::uint32_t k = first; k < last; ++k) {
                if (meets(order[k])) {
                    return true;
                }
            }
        }
        return false;
    }

    [[nodiscard]] bool isAtWall(Vec2 place) const
    {
        const double clearance = 0.4 * scene_.spacing;
        return anyAround(place, cells_, order_, [&](std::uint32_t k) {
            const Vec2 arm = place - walls_.position[k];
            const Vec2 normal = walls_.normal[k];
            return std::abs(cross(normal, arm)) < scene_.spacing && dot(arm, normal) > 0.0 &&
                   dot(arm, normal) < walls_.depth + clearance;
        });
    }

    [[nodiscard]] bool isAtParticle(Vec2 place, double clearance) const
    {
        return !places_.empty() && anyAround(place, taken_, taken_order_, [&](std::uint32_t k) {
            return length(place - places_[k]) < clearance * scene_.spacing;
        });
    }

    const FluidScene& scene_;
    WallSamples walls_;
    std::vector<Interior> taken_regions_;  ///< of the walls, and of the bodies so far
    Vec2 lower_;                           ///< beyond these corners particles are removed
    Vec2 upper_;
    CellGrid cells_;  ///< of the walls' samples
    std::vector<std::uint32_t> order_;
    std::vector<Vec2> places_;  ///< of the bodies' particles so far
    CellGrid taken_;
    std::vector<std::uint32_t> taken_order_;
};

}  // namespace droplet
