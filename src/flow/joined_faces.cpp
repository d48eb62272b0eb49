// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/joined_faces.h"

#include <algorithm>
#include <functional>

#include "rays/nearest.h"

namespace droplet {

JoinedFaces::JoinedFaces(const FlowSurface& surface, std::uint32_t from, Vec3 place) : surface_(surface), place_(place)
{
    open_.emplace_back(0.0, from);
    reach_.emplace(from, 0.0);
}

bool JoinedFaces::has(std::uint32_t to, double reach)
{
    auto found = reach_.find(to);
    while (found == reach_.end() && !open_.empty() && open_.front().first <= reach) {
        std::pop_heap(open_.begin(), open_.end(), std::greater<>());
        const auto [so_far, face] = open_.back();
        open_.pop_back();
        for (const std::uint32_t next : surface_.faces[face].neighbour) {
            if (next == FlowSurface::kNone || reach_.contains(next)) {
                continue;
            }
            // The face before has the least reach of all from which this one can still be found.
            const double joins = std::max(so_far, distance(place_, surface_.faces[next].corners));
            const auto added = reach_.emplace(next, joins).first;
            open_.emplace_back(joins, next);
            std::push_heap(open_.begin(), open_.end(), std::greater<>());
            found = next == to ? added : found;
        }
    }
    return found != reach_.end() && found->second <= reach;
}

}  // namespace droplet
