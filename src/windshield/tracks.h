// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "droplet/vector.h"
#include "windshield/cells.h"
#include "windshield/way.h"

namespace droplet {

/// Droplets, or pieces of their tracks, that a thread takes at a time.
inline constexpr std::size_t kWorthAThread = 128;

/// The straight ways of running droplets in one step, in the droplets' order.
struct Tracks {
    std::vector<Vec2> from;     ///< [m]
    std::vector<Vec2> to;       ///< [m]
    std::vector<double> reach;  ///< half the droplet's width, seen from above [m]

    [[nodiscard]] std::size_t count() const { return from.size(); }
    void resize(std::size_t count);
    void add(Vec2 a, Vec2 b, double its_reach);
};

/// Which tracks come through which cells, so that few have to be looked at to find those that touch.
class TrackCells {
public:
    /// Tracks that are added later are not in it.
    /// @param tracks  must outlive this
    /// @param size    of the glass [m]
    /// @param margin  how far beyond its reach a track may touch a droplet [m]
    TrackCells(const Tracks& tracks, Vec2 size, double margin);

    /// The first track that a droplet at that place touches.
    [[nodiscard]] std::optional<std::uint32_t> touchedBy(Vec2 place, double reach) const;

    /// Pairs of tracks whose droplets, which move evenly, come to touch; some pairs more than once.
    [[nodiscard]] std::vector<std::pair<std::uint32_t, std::uint32_t>> meeting() const;

private:
    const Tracks& tracks_;
    Cells cells_;
    std::vector<std::uint32_t> first_;    // of numbers_, for each cell, and the end
    std::vector<std::uint32_t> numbers_;  // of tracks; those of a cell in their order
};

}  // namespace droplet
