// SPDX-License-Identifier: GPL-3.0-or-later
#include "windshield/tracks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace droplet {
namespace {

/// Width of a cell [m]; a cell has few droplets, and a track few cells.
constexpr double kContactCell = 8e-3;

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
    const auto visit = [&](std::uint32_t track, const auto& work) {
        cells_.visitAround(tracks.from[track], tracks.to[track], roundedUp(tracks.reach[track]),
                           [&](std::size_t first, std::size_t last) {
                               for (std::size_t cell = first; cell <= last; ++cell) {
                                   work(cell);
                               }
                           });
    };
    const auto count = static_cast<std::uint32_t>(tracks.count());
    for (std::uint32_t i = 0; i < count; ++i) {
        visit(i, [this](std::size_t cell) { ++first_[cell]; });
    }
    std::inclusive_scan(first_.begin(), first_.end(), first_.begin());
    entries_.resize(first_.back());
    // Filled backward: the end of each cell becomes its beginning.
    for (std::uint32_t i = count; i-- > 0;) {
        visit(i, [this, entry = entryOf(i)](std::size_t cell) { entries_[--first_[cell]] = entry; });
    }
}

TrackCells::Entry TrackCells::entryOf(std::uint32_t track) const
{
    const Vec2 from = tracks_.from[track];
    const Vec2 to = tracks_.to[track];
    const Vec2 middle = 0.5 * (from + to);
    // Half the way, at most.
    double radius = tracks_.reach[track] + 0.5 * (std::abs(to.x - from.x) + std::abs(to.y - from.y));
    // More than what rounding to floats may take from the distance of two places.
    constexpr double kMore = 1e-6;
    radius += kMore * (1.0 + radius + std::abs(middle.x) + std::abs(middle.y));
    return {static_cast<float>(middle.x), static_cast<float>(middle.y), static_cast<float>(radius), track};
}

std::optional<std::uint32_t> TrackCells::touchedBy(Vec2 place, double reach) const
{
    // Where the two touch, they share a cell.
    constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
    std::uint32_t least = kNone;
    cells_.visitAround(place, place, roundedUp(reach), [&](std::size_t first, std::size_t last) {
        for (std::size_t cell = first; cell <= last; ++cell) {
            for (std::uint32_t k = first_[cell]; k < first_[cell + 1] && entries_[k].number < least; ++k) {
                const std::uint32_t i = entries_[k].number;
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
        for (std::uint32_t k = first_[cell]; k + 1 < first_[cell + 1]; ++k) {
            const Entry a = entries_[k];
            for (std::uint32_t other = k + 1; other < first_[cell + 1]; ++other) {
                const Entry& b = entries_[other];
                const float x = a.x - b.x;
                const float y = a.y - b.y;
                const float reach = a.radius + b.radius;
                if (x * x + y * y <= reach * reach && meet(a.number, b.number)) {
                    pairs.emplace_back(a.number, b.number);
                }
            }
        }
    }
    return pairs;
}

}  // namespace droplet
