// SPDX-License-Identifier: GPL-3.0-or-later
#include "windshield/still_droplets.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <utility>

namespace droplet {
namespace {

StillDroplet joined(const StillDroplet& a, const StillDroplet& b)
{
    const double volume = a.volume + b.volume;
    return {(1.0 / volume) * (a.volume * a.position + b.volume * b.position), volume};
}

/// Place in its cell, in the format of StillCells::places.
std::uint16_t placeOf(const StillCells& still, std::size_t cell, Vec2 position)
{
    const auto part = [&](double v, std::size_t number) {
        const double places = kPlaces * (v / still.cell - static_cast<double>(number));
        return static_cast<std::uint32_t>(std::clamp(places, 0.0, kPlaces - 1.0));
    };
    const std::size_t row = cell / still.columns;
    return static_cast<std::uint16_t>(part(position.x, cell - row * still.columns) + kPlaces * part(position.y, row));
}

/// Closes the gaps that droplets without volume leave in a cell; the others keep their order.
void closeGaps(StillCells& still, std::size_t cell)
{
    const std::size_t begin = cell * StillCells::kMax;
    const std::size_t end = begin + still.counts[cell];
    std::size_t kept = begin;
    for (std::size_t slot = begin; slot < end; ++slot) {
        if (still.slots[slot].volume > 0.0) {
            still.slots[kept] = still.slots[slot];
            still.places[kept++] = still.places[slot];
        }
    }
    still.counts[cell] = static_cast<std::uint8_t>(kept - begin);
    for (; kept < end; ++kept) {
        still.slots[kept] = {};
        still.places[kept] = 0;
    }
    ++still.revisions[cell];
}

StillDroplet removed(StillCells& still, StillSlot place)
{
    const StillDroplet taken = std::exchange(still.slots[place.cell * StillCells::kMax + place.slot], {});
    closeGaps(still, place.cell);
    return taken;
}

std::optional<StillSlot> nearestTouched(const StillCells& still, const StillDroplet& droplet, const StillRules& rules)
{
    const double reach = rules.reachOf(droplet.volume);
    const double max = reach + rules.maxReach();
    double nearest = max * max;
    std::optional<StillSlot> found;
    visitNear(still, droplet.position, droplet.position, max, [&](StillSlot slot) {
        const StillDroplet& other = at(still, slot);
        const Vec2 apart = other.position - droplet.position;
        const double squared = dot(apart, apart);
        // The cube root costs most; it is computed only where needed.
        if (squared < nearest) {
            const double touching = reach + rules.reachOf(other.volume);
            if (squared <= touching * touching) {
                nearest = squared;
                found = slot;
            }
        }
    });
    return found;
}

StillSlot nearestIn(const StillCells& still, std::size_t cell, Vec2 p)
{
    const auto here = still.droplets(cell);
    const auto nearest = std::min_element(here.begin(), here.end(), [p](const StillDroplet& a, const StillDroplet& b) {
        return dot(a.position - p, a.position - p) < dot(b.position - p, b.position - p);
    });
    return {cell, static_cast<std::uint8_t>(nearest - here.begin())};
}

}  // namespace

void StillCells::put(std::size_t number, const StillDroplet& droplet)
{
    const std::size_t slot = number * kMax + counts[number]++;
    slots[slot] = droplet;
    places[slot] = placeOf(*this, number, droplet.position);
    ++revisions[number];
}

StillCells StillCells::over(Vec2 size)
{
    const Cells cells = Cells::over(size, kStillCell);
    StillCells still;
    still.cell = cells.width;
    still.columns = cells.columns;
    still.rows = cells.rows;
    still.slots.resize(cells.count() * kMax);
    still.places.resize(still.slots.size());
    still.counts.resize(cells.count());
    still.revisions.resize(cells.count());
    return still;
}

const StillCells& StillCells::of(const StillDroplets& still)
{
    static const StillCells none;
    return still.cells_ ? *still.cells_ : none;
}

StillCells& StillCells::of(StillDroplets& still)
{
    if (!still.cells_) {
        still.cells_ = std::make_unique<StillCells>();
    }
    return *still.cells_;
}

StillDroplets::StillDroplets() = default;
StillDroplets::~StillDroplets() = default;
StillDroplets::StillDroplets(StillDroplets&& other) noexcept = default;
StillDroplets& StillDroplets::operator=(StillDroplets&& other) noexcept = default;

StillDroplets::StillDroplets(const StillDroplets& other)
    : cells_(other.cells_ ? std::make_unique<StillCells>(*other.cells_) : nullptr)
{
}

StillDroplets& StillDroplets::operator=(const StillDroplets& other)
{
    return *this = StillDroplets(other);
}

std::size_t StillDroplets::count() const
{
    const std::vector<std::uint8_t>& counts = StillCells::of(*this).counts;
    return std::accumulate(counts.begin(), counts.end(), std::size_t{0});
}

std::vector<StillDroplet> StillDroplets::all() const
{
    const StillCells& still = StillCells::of(*this);
    std::vector<StillDroplet> droplets;
    droplets.reserve(count());
    for (std::size_t cell = 0; cell < still.counts.size(); ++cell) {
        const auto here = still.droplets(cell);
        droplets.insert(droplets.end(), here.begin(), here.end());
    }
    return droplets;
}

bool operator==(const StillDroplets& a, const StillDroplets& b)
{
    return StillCells::of(a) == StillCells::of(b);
}

double StillRules::reachOf(double volume) const
{
    return reach * std::cbrt(volume);
}

std::optional<StillDroplet> placeOrJoin(StillCells& still, const StillDroplet& droplet, const StillRules& rules)
{
    std::optional<StillSlot> other = nearestTouched(still, droplet, rules);
    if (!other) {
        const std::size_t cell = still.grid().number(droplet.position);
        if (still.counts[cell] < StillCells::kMax) {
            still.put(cell, droplet);
            return std::nullopt;
        }
        other = nearestIn(still, cell, droplet.position);
    }
    return joined(droplet, removed(still, *other));
}

void StillRemoval::close()
{
    for (const std::size_t cell : touched_) {
        closeGaps(*still_, cell);
    }
    touched_.clear();
}

}  // namespace droplet
