// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "footprint/slot.h"

namespace droplet {

/// A place on a loop where the curve turns sharply: between slot `first` and slot `last`; slots between those two, if
/// any, lie on neither side and give way to the corner.
struct Turn {
    std::size_t first = 0;
    std::size_t last = 0;

    friend constexpr bool operator==(const Turn&, const Turn&) = default;
};

/// How a turn is measured: between chords of some length on either side of it, some way from it [px].
struct Chord {
    double length = 0.0;
    double gap = 0.0;
};

/// The turns of a roughly faired loop that are sharp enough for a corner to be tried, in order, apart from one another.
/// @param known  turns already found to be corners: they are returned too, and others only away from them
std::vector<Turn> sharpTurns(const SlotLoop& loop, const Chord& chord, const std::vector<Turn>& known);

/// The turns moved, by a slot or a few, to where the sides of a faired loop say they are.
std::vector<Turn> relocated(const SlotLoop& loop, std::vector<Turn> turns);

/// One flag per slot: 1 where a turn lies between this slot and the next.
std::vector<std::uint8_t> breaksAt(const std::vector<Turn>& turns, std::size_t slots);

/// A corner of the rim, in place of the slots between the ends of a turn, or of one of those ends.
struct Corner {
    Turn turn;
    Vec2 tip;                     ///< [px]
    bool replaces_first = false;  ///< the tip lies so near to the vertex before it that it takes that one's place
    bool replaces_last = false;   ///< likewise the vertex after it
};

/// Coverage of a pixel by liquid, in [0, 1]; 0 outside the mask. Empty for a hard mask, whose levels say nothing.
using Coverage = std::function<double(int x, int y)>;

/// Where the two sides of a loop meet when extended into a turn.
/// @param loop      faired with a break at every turn
/// @param breaks    all breaks of the loop: a side ends at the next one
/// @param turn      where
/// @param coverage  of the mask
/// @return          the corner, or none if the sides do not meet sharply, or a corner there would put a pixel centre on
///                  the other side of the rim (other than that of the one pixel it stands in), or contradict grey
///                  levels
std::optional<Corner> findCorner(const SlotLoop& loop, const std::vector<std::uint8_t>& breaks, const Turn& turn,
                                 const Coverage& coverage);

/// A faired loop and its corners, in order along it.
struct CorneredLoop {
    SlotLoop slots;
    std::vector<Corner> corners;
};

/// Takes back every corner that touches another piece of rim, its own loop's or another's: without corners, no two
/// pieces touch. Linear in the number of slots.
void removeTouchingCorners(std::vector<CorneredLoop>& loops);

}  // namespace droplet
