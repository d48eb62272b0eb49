// SPDX-License-Identifier: GPL-3.0-or-later
#include "wind/still_droplets.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace droplet {
namespace {

StillDroplet joined(const StillDroplet& a, const StillDroplet& b)
{
    const double volume = a.volume + b.volume;
    return {(1.0 / volume) * (a.volume * a.position + b.volume * b.position), volume};
}

StillDroplet removed(StillDroplets& still, StillSlot place)
{
    StillDroplet* first = still.slots.data() + place.cell * StillDroplets::kMost;
    const StillDroplet gone = first[place.slot];
    const std::uint8_t left = --still.counts[place.cell];
    std::move(first + place.slot + 1, first + left + 1, first + place.slot);
    first[left] = {};
    ++still.revisions[place.cell];
    return gone;
}

std::optional<StillSlot> nearestTouched(const StillDroplets& still, const StillDroplet& droplet,
                                        const StillRules& rules)
{
    const double reach = rules.reachOf(droplet.volume);
    const double most = reach + rules.greatestReach();
    double nearest = most * most;
    std::optional<StillSlot> found;
    cellsOf(still).visitAround(droplet.position, droplet.position, most, [&](std::size_t first, std::size_t last) {
        for (std::size_t cell = first; cell <= last; ++cell) {
            const auto here = still.droplets(cell);
            for (std::size_t k = 0; k < here.size(); ++k) {
                const Vec2 apart = here[k].position - droplet.position;
                const double squared = dot(apart, apart);
                // The root, which costs most, only where it can matter.
                if (squared < nearest) {
                    const double touching = reach + rules.reachOf(here[k].volume);
                    if (squared <= touching * touching) {
                        nearest = squared;
                        found = StillSlot{cell, static_cast<std::uint8_t>(k)};
                    }
                }
            }
        }
    });
    return found;
}

StillSlot nearestIn(const StillDroplets& still, std::size_t cell, Vec2 p)
{
    const auto here = still.droplets(cell);
    const auto nearest = std::min_element(here.begin(), here.end(), [p](const StillDroplet& a, const StillDroplet& b) {
        return dot(a.position - p, a.position - p) < dot(b.position - p, b.position - p);
    });
    return {cell, static_cast<std::uint8_t>(nearest - here.begin())};
}

}  // namespace

StillDroplets noStillDroplets(Vec2 size)
{
    const Cells cells = Cells::over(size, kStillCell);
    StillDroplets still;
    still.cell = cells.width;
    still.columns = cells.columns;
    still.rows = cells.rows;
    still.slots.resize(cells.count() * StillDroplets::kMost);
    still.counts.resize(cells.count());
    still.revisions.resize(cells.count());
    return still;
}

double StillRules::reachOf(double volume) const
{
    return reach * std::cbrt(volume);
}

std::optional<StillDroplet> settle(StillDroplets& still, const StillDroplet& droplet, const StillRules& rules)
{
    std::optional<StillSlot> other = nearestTouched(still, droplet, rules);
    if (!other) {
        const std::size_t cell = cellsOf(still).number(droplet.position);
        if (still.counts[cell] < StillDroplets::kMost) {
            still.slots[cell * StillDroplets::kMost + still.counts[cell]++] = droplet;
            ++still.revisions[cell];
            return std::nullopt;
        }
        other = nearestIn(still, cell, droplet.position);
    }
    return joined(droplet, removed(still, *other));
}

void Taking::close()
{
    for (const std::size_t cell : touched_) {
        StillDroplet* first = still_->slots.data() + cell * StillDroplets::kMost;
        StillDroplet* end = first + still_->counts[cell];
        StillDroplet* kept = std::remove_if(first, end, [](const StillDroplet& d) { return d.volume == 0.0; });
        std::fill(kept, end, StillDroplet{});
        still_->counts[cell] = static_cast<std::uint8_t>(kept - first);
        ++still_->revisions[cell];
    }
    touched_.clear();
}

}  // namespace droplet
