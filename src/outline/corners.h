// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "outline/slot.h"

namespace droplet {

/// Place on a loop where the curve turns sharply: between the slots `first` and `last`. Slots between those two, if
/// any, lie on neither side and are replaced by the corner.
struct Turn {
    std::size_t first = 0;
    std::size_t last = 0;

    friend constexpr bool operator==(const Turn&, const Turn&) = default;
};

/// Chords between which a turn is measured, one on either side of it [px].
struct Chord {
    double length = 0.0;
    double gap = 0.0;  ///< distance of the chord from the turn
};

/// Turns of a roughly faired loop that are sharp enough to try a corner; in order, not overlapping.
/// @param known  turns already known to be corners; they are returned, too, and others only away from them
std::vector<Turn> sharpTurns(const SlotLoop& loop, const Chord& chord, const std::vector<Turn>& known);

/// Moves turns by a slot or a few to the place that the sides of a faired loop indicate.
std::vector<Turn> relocated(const SlotLoop& loop, std::vector<Turn> turns);

/// One flag per slot: 1 if a turn lies between this slot and the next.
std::vector<std::uint8_t> breaksAt(const std::vector<Turn>& turns, std::size_t slots);

/// Corner of the rim. It replaces the slots between the ends of a turn, or one of those ends.
struct Corner {
    Turn turn;
    Vec2 tip;                     ///< [px]
    bool replaces_first = false;  ///< the tip is so near to the vertex before it that it replaces that vertex
    bool replaces_last = false;   ///< likewise for the vertex after it
};

/// Coverage of a pixel by liquid, in [0, 1]; 0 outside the mask. Empty for a hard mask, whose levels carry no sub-pixel
/// place.
using Coverage = std::function<double(int x, int y)>;

/// Extends the two sides of a loop into a turn to find the corner where they meet.
/// @param loop      faired with a break at every turn
/// @param breaks    all breaks of the loop; a side ends at the next one
/// @param turn      turn to examine
/// @param coverage  of the mask
/// @return          the corner; none if the sides do not meet sharply, if the corner would put a pixel centre on the
///                  other side of the rim (except the centre of the one pixel it stands in), or if it contradicts the
///                  grey levels
std::optional<Corner> findCorner(const SlotLoop& loop, const std::vector<std::uint8_t>& breaks, const Turn& turn,
                                 const Coverage& coverage);

/// Faired loop and its corners, in order along it.
struct CorneredLoop {
    SlotLoop slots;
    std::vector<Corner> corners;
    std::optional<std::array<Vec2, 2>> ends = {};  ///< of a loop that is open: the points before its first and after
                                                   ///< its last slot
};

/// Removes every corner that touches another piece of rim, of its own loop or of another one. Without corners, no two
/// pieces touch. Linear in the number of slots.
void removeTouchingCorners(std::vector<CorneredLoop>& loops);

}  // namespace droplet
