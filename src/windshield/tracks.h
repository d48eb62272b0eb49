// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "droplet/vector.h"
#include "windshield/cells.h"
#include "windshield/segment.h"

namespace droplet {

/// Number of droplets, or pieces of tracks, in a block of work for one thread.
inline constexpr std::size_t kDropletsPerBlock = 128;

/// Straight paths of running droplets in one step, in the droplets' order.
struct Tracks {
    std::vector<Vec2> from;     ///< [m]
    std::vector<Vec2> to;       ///< [m]
    std::vector<double> reach;  ///< half the droplet's width, seen from above [m]

    [[nodiscard]] std::size_t count() const { return from.size(); }
    void resize(std::size_t count);
    void add(Vec2 a, Vec2 b, double reach_of_track);
};

/// Grid for neighbour search: the tracks whose droplets pass through each cell.
class TrackCells {
public:
    /// Sorts the present tracks into cells; later ones are not included.
    /// @param tracks  must outlive this
    /// @param size    of the glass [m]
    TrackCells(const Tracks& tracks, Vec2 size);

    /// First track that a droplet at a place touches.
    [[nodiscard]] std::optional<std::uint32_t> touchedBy(Vec2 place, double reach) const;

    /// Whether test(track) holds for a track whose droplet may touch one at a place.
    template <typename Test>
    [[nodiscard]] bool hasNear(Vec2 place, double reach, const Test& test) const
    {
        bool found = false;
        cells_.visitAround(place, place, roundedUp(reach), [&](std::size_t first, std::size_t last) {
            for (std::uint32_t k = first_[first]; !found && k < first_[last + 1]; ++k) {
                found = test(entries_[k].number);
            }
        });
        return found;
    }

    /// Pairs of tracks whose droplets touch at some time, if they move at constant speed; some pairs appear repeatedly.
    [[nodiscard]] std::vector<std::pair<std::uint32_t, std::uint32_t>> touchingPairs() const;

private:
    /// Track in a cell, with a circle around all that its droplet sweeps: most pairs are told apart by it alone.
    struct Entry {
        float x = 0.0F;
        float y = 0.0F;
        float radius = 0.0F;  ///< rounded up
        std::uint32_t number = 0;
    };
    /// Reach in the grid: droplets that just touch share a cell in spite of rounding.
    static double roundedUp(double reach) { return reach * (1.0 + 1e-9); }
    [[nodiscard]] Entry entryOf(std::uint32_t track) const;

    const Tracks& tracks_;
    Cells cells_;
    std::vector<std::uint32_t> first_;  // index of each cell's first entry, and the end
    std::vector<Entry> entries_;        // cell by cell, in the order of tracks
};

}  // namespace droplet
