// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "droplet/vector.h"
#include "droplet/windshield/droplets.h"
#include "windshield/cells.h"
#include "windshield/way.h"

namespace droplet {

/// Width of the still droplets' cells [m].
inline constexpr double kStillCell = 4e-3;

/// How StillDroplets are kept: in square cells of the rolled out glass. Cell (column, row) is number row · columns +
/// column and holds at most kMax of them, in an order that is a matter of history.
struct StillCells {
    static constexpr std::size_t kMax = 8;  ///< what lands in a full cell joins the nearest there

    double cell = 0.0;  ///< their width [m]
    std::uint32_t columns = 0;
    std::uint32_t rows = 0;
    std::vector<StillDroplet> slots;       ///< kMax for each cell, those in use first
    std::vector<std::uint16_t> places;     ///< for each slot in use: where in its cell, in 256ths: column + 256 · row
    std::vector<std::uint8_t> counts;      ///< of those in use, for each cell
    std::vector<std::uint32_t> revisions;  ///< for each cell: raised with everything that changes in it

    /// Without droplets, for a glass of that size.
    static StillCells over(Vec2 size);
    static const StillCells& of(const StillDroplets& still);
    static StillCells& of(StillDroplets& still);

    [[nodiscard]] Cells grid() const { return {cell, columns, rows}; }
    [[nodiscard]] std::span<const StillDroplet> droplets(std::size_t number) const
    {
        return {slots.data() + number * kMax, counts[number]};
    }
    /// Puts one into a cell that has room and holds its position.
    void put(std::size_t number, const StillDroplet& droplet);

    friend bool operator==(const StillCells&, const StillCells&) = default;
};

/// When still droplets touch and what becomes of them.
struct StillRules {
    double reach = 0.0;  ///< half the width of a droplet of 1 m³, seen from above [m]
    double max = 0.0;    ///< from this volume on a droplet runs [m³]

    [[nodiscard]] double reachOf(double volume) const;
    /// Of the largest one.
    [[nodiscard]] double maxReach() const { return reachOf(max); }
};

/// Puts a droplet on the glass, or joins it with the nearest one that it touches, at the centre of their masses; in a
/// full cell with the nearest there.
/// @return  empty where it now stands; else what the two make, which is off the glass
std::optional<StillDroplet> settle(StillCells& still, const StillDroplet& droplet, const StillRules& rules);

/// Where a still droplet stands.
struct StillSlot {
    std::size_t cell = 0;
    std::uint8_t slot = 0;
};

inline const StillDroplet& at(const StillCells& still, StillSlot place)
{
    return still.slots[place.cell * StillCells::kMax + place.slot];
}

/// Parts of a cell, across and up, that StillCells::places tells apart.
inline constexpr std::uint32_t kPlaces = 256;

/// Calls visit(StillSlot) for all within `radius` of the straight way from a to b, and a few more. It goes by their
/// places, of which a cell's are a quarter of a cache line: droplets themselves are too many for the cache.
template <class Visit>
void visitNear(const StillCells& still, Vec2 a, Vec2 b, double radius, const Visit& visit)
{
    // In places, from the glass's corner on.
    const double scale = kPlaces / still.cell;
    const Way way(scale * a, scale * b);
    constexpr double kHalfDiagonal = 0.7072;
    const double near = scale * radius * (1.0 + 1e-9) + kHalfDiagonal;
    still.grid().visitAround(a, b, radius, [&](std::size_t first, std::size_t last) {
        const std::size_t row = first / still.columns;
        const double up = kPlaces * static_cast<double>(row) + 0.5;
        for (std::size_t cell = first; cell <= last; ++cell) {
            const double across = kPlaces * static_cast<double>(cell - row * still.columns) + 0.5;
            const std::uint16_t* places = still.places.data() + cell * StillCells::kMax;
            for (std::uint8_t k = 0; k < still.counts[cell]; ++k) {
                const std::uint32_t part_across = places[k] % kPlaces;
                const std::uint32_t part_up = places[k] / kPlaces;
                if (way.squaredDistance({across + part_across, up + part_up}) <= near * near) {
                    visit(StillSlot{cell, k});
                }
            }
        }
    });
}

/// Takes still droplets away one by one; gaps are closed at the end, so that slots stay what they are until then.
class Taking {
public:
    explicit Taking(StillCells& still) : still_(&still) {}

    /// @return  its volume; 0 if it is gone already
    double take(StillSlot place)
    {
        double& volume = still_->slots[place.cell * StillCells::kMax + place.slot].volume;
        if (volume > 0.0) {
            touched_.push_back(place.cell);
        }
        return std::exchange(volume, 0.0);
    }
    void close();

private:
    StillCells* still_;
    std::vector<std::size_t> touched_;
};

}  // namespace droplet
