// SPDX-License-Identifier: GPL-3.0-or-later
#include "windshield/tracks.h"

#include <numeric>

namespace droplet {
namespace {

/// Few droplets in a cell, few cells to a track [m].
constexpr double kContactCell = 8e-3;

}  // namespace

void Tracks::resize(std::size_t count)
{
    from.resize(count);
    to.resize(count);
    reach.resize(count);
}

void Tracks::add(Vec2 a, Vec2 b, double its_reach)
{
    from.push_back(a);
    to.push_back(b);
    reach.push_back(its_reach);
}

TrackCells::TrackCells(const Tracks& tracks, Vec2 size, double margin)
    : tracks_(tracks), cells_(Cells::over(size, kContactCell)), first_(cells_.count() + 1, 0)
{
    std::vector<std::pair<std::uint32_t, std::uint32_t>> comes;  // a cell and what comes through it
    comes.reserve(2 * tracks.count());
    for (std::uint32_t i = 0; i < tracks.count(); ++i) {
        cells_.visitAround(tracks.from[i], tracks.to[i], tracks.reach[i] + margin,
                           [&](std::size_t first, std::size_t last) {
                               for (std::size_t cell = first; cell <= last; ++cell) {
                                   comes.emplace_back(static_cast<std::uint32_t>(cell), i);
                                   ++first_[cell];
                               }
                           });
    }
    std::inclusive_scan(first_.begin(), first_.end(), first_.begin());
    numbers_.resize(comes.size());
    // Filled from behind, each cell's end comes to be its beginning.
    for (std::size_t k = comes.size(); k-- > 0;) {
        numbers_[--first_[comes[k].first]] = comes[k].second;
    }
}

std::optional<std::uint32_t> TrackCells::touchedBy(Vec2 place, double reach) const
{
    const std::size_t cell = cells_.number(place);
    for (std::uint32_t k = first_[cell]; k < first_[cell + 1]; ++k) {
        const std::uint32_t i = numbers_[k];
        const double touching = reach + tracks_.reach[i];
        if (Way(tracks_.from[i], tracks_.to[i]).squaredDistance(place) <= touching * touching) {
            return i;
        }
    }
    return std::nullopt;
}

std::vector<std::pair<std::uint32_t, std::uint32_t>> TrackCells::meeting() const
{
    // The distance of two that move evenly from their beginnings to their ends falls to where they touch.
    const auto meet = [this](std::uint32_t a, std::uint32_t b) {
        const double touching = tracks_.reach[a] + tracks_.reach[b];
        return Way(tracks_.from[a] - tracks_.from[b], tracks_.to[a] - tracks_.to[b]).squaredDistance({}) <=
               touching * touching;
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
