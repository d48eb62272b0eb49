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

    /// Pairs of tracks whose droplets touch at some time, if they move at constant speed; some pairs appear repeatedly.
    [[nodiscard]] std::vector<std::pair<std::uint32_t, std::uint32_t>> touchingPairs() const;

private:
    const Tracks& tracks_;
    Cells cells_;
    std::vector<std::uint32_t> first_;    // index of each cell's first number in numbers_, and the end
    std::vector<std::uint32_t> numbers_;  // numbers of tracks, cell by cell, in order
};

}  // namespace droplet
