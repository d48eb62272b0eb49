// SPDX-License-Identifier: GPL-3.0-or-later
#include "windshield/tracks.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace droplet {
namespace {

/// Width of a cell [m]; a cell has few droplets, and a track few cells.
constexpr double kContactCell = 8e-3;

/// Reach in the grid: droplets that just touch share a cell in spite of rounding.
double roundedUp(double reach)
{
    return reach * (1.0 + 1e-9);
}

}  // namespace

void Tracks::resize(std::size_t count)
{
    from.resize(count);
    to.resize(count);
    reach.resize(count);
}

void Tracks::add(Vec2 a, Vec2 b, double reach_of_track)
{
    from.push_back(a);
    to.push_back(b);
    reach.push_back(reach_of_track);
}

TrackCells::TrackCells(const Tracks& tracks, Vec2 size)
    : tracks_(tracks), cells_(Cells::over(size, kContactCell)), first_(cells_.count() + 1, 0)
{
    std::vector<std::pair<std::uint32_t, std::uint32_t>> entries;  // cell, and track that passes through it
    entries.reserve(2 * tracks.count());
    for (std::uint32_t i = 0; i < tracks.count(); ++i) {
        cells_.visitAround(tracks.from[i], tracks.to[i], roundedUp(tracks.reach[i]),
                           [&](std::size_t first, std::size_t last) {
                               for (std::size_t cell = first; cell <= last; ++cell) {
                                   entries.emplace_back(static_cast<std::uint32_t>(cell), i);
                                   ++first_[cell];
                               }
                           });
    }
    std::inclusive_scan(first_.begin(), first_.end(), first_.begin());
    numbers_.resize(entries.size());
    // Filled backward: the end of each cell becomes its beginning.
    for (std::size_t k = entries.size(); k-- > 0;) {
        numbers_[--first_[entries[k].first]] = entries[k].second;
    }
}

std::optional<std::uint32_t> TrackCells::touchedBy(Vec2 place, double reach) const
{
    // Where the two touch, they share a cell.
    constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
    std::uint32_t least = kNone;
    cells_.visitAround(place, place, roundedUp(reach), [&](std::size_t first, std::size_t last) {
        for (std::size_t cell = first; cell <= last; ++cell) {
            for (std::uint32_t k = first_[cell]; k < first_[cell + 1] && numbers_[k] < least; ++k) {
                const std::uint32_t i = numbers_[k];
                const double touching = reach + tracks_.reach[i];
                if (Segment(tracks_.from[i], tracks_.to[i]).squaredDistance(place) <= touching * touching) {
                    least = i;
                }
            }
        }
    });
    return least != kNone ? std::optional(least) : std::nullopt;
}

std::vector<std::pair<std::uint32_t, std::uint32_t>> TrackCells::touchingPairs() const
{
    // The difference of two uniform motions is a segment; its distance from the origin is the smallest distance.
    const auto meet = [this](std::uint32_t a, std::uint32_t b) {
        const double touching = tracks_.reach[a] + tracks_.reach[b];
        const Vec2 from = tracks_.from[a] - tracks_.from[b];
        const Vec2 to = tracks_.to[a] - tracks_.to[b];
        // Most pairs are apart along an axis all the time.
        if (std::min(from.x, to.x) > touching || std::max(from.x, to.x) < -touching ||
            std::min(from.y, to.y) > touching || std::max(from.y, to.y) < -touching) {
            return false;
        }
        return Segment(from, to).squaredDistance({}) <= touching * touching;
    };
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
    for (std::size_t cell = 0; cell < cells_.count(); ++cell) {
        for (std::uint32_t a = first_[cell]; a + 1 < first_[cell + 1]; ++a) {
            for (std::uint32_t b = a + 1; b < first_[cell + 1]; ++b) {
                if (meet(numbers_[a], numbers_[b])) {
                    pairs.emplace_back(numbers_[a], numbers_[b]);
                }
            }
        }
    }
    return pairs;
}

}  // namespace droplet
