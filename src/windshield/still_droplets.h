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
#include "windshield/segment.h"

namespace droplet {

/// Width of the still droplets' cells [m].
inline constexpr double kStillCell = 4e-3;

/// Storage of StillDroplets: square cells of the unrolled glass. Cell (column, row) has the number row · columns +
/// column and at most kMax droplets; their order depends on history.
struct StillCells {
    static constexpr std::size_t kMax = 8;  ///< a droplet that lands in a full cell joins the nearest one there

    double cell = 0.0;  ///< width of a cell [m]
    std::uint32_t columns = 0;
    std::uint32_t rows = 0;
    std::vector<StillDroplet> slots;       ///< kMax for each cell, used slots first
    std::vector<std::uint16_t> places;     ///< for each used slot: place in its cell in 256ths, column + 256 · row
    std::vector<std::uint8_t> counts;      ///< number of used slots, for each cell
    std::vector<std::uint32_t> revisions;  ///< for each cell: incremented with every change

    /// Empty cells for a glass of a given size.
    static StillCells over(Vec2 size);
    static const StillCells& of(const StillDroplets& still);
    static StillCells& of(StillDroplets& still);

    [[nodiscard]] Cells grid() const { return {cell, columns, rows}; }
    [[nodiscard]] std::span<const StillDroplet> droplets(std::size_t number) const
    {
        return {slots.data() + number * kMax, counts[number]};
    }
    /// Puts a droplet into the cell of its position, which must have room.
    void put(std::size_t number, const StillDroplet& droplet);

    friend bool operator==(const StillCells&, const StillCells&) = default;
};

/// Reach of still droplets, and the volume at which they begin to run.
struct StillRules {
    double reach = 0.0;  ///< half the width of a droplet of 1 m³, seen from above [m]
    double max = 0.0;    ///< volume from which a droplet runs [m³]

    [[nodiscard]] double reachOf(double volume) const;
    /// Reach of the largest still droplet.
    [[nodiscard]] double maxReach() const { return reachOf(max); }
};

/// Places a droplet on the glass. If it touches others or its cell is full, removes the nearest one instead and joins
/// the two at their centre of mass.
/// @return  empty if the droplet was placed; else the joined droplet, which is not on the glass
std::optional<StillDroplet> placeOrJoin(StillCells& still, const StillDroplet& droplet, const StillRules& rules);

/// Slot of a still droplet.
struct StillSlot {
    std::size_t cell = 0;
    std::uint8_t slot = 0;
};

inline const StillDroplet& at(const StillCells& still, StillSlot place)
{
    return still.slots[place.cell * StillCells::kMax + place.slot];
}

/// Resolution of StillCells::places: parts of a cell, across and up.
inline constexpr std::uint32_t kPlaces = 256;

/// Calls visit(StillSlot) for all droplets within `radius` of the segment from a to b, and a few more. It reads only
/// their places: those of a cell are a quarter of a cache line, while the droplets themselves do not fit into the
/// cache.
template <class Visit>
void visitNear(const StillCells& still, Vec2 a, Vec2 b, double radius, const Visit& visit)
{
    // In units of places, from the corner of the glass.
    const Cells grid = still.grid();
    const double scale = kPlaces * grid.per_metre;
    const Segment segment(scale * a, scale * b);
    constexpr double kHalfDiagonal = 0.7072;
    const double near = scale * radius * (1.0 + 1e-9) + kHalfDiagonal;
    grid.visitAround(a, b, radius, [&](std::size_t first, std::size_t last) {
        // Signed numbers of 32 bits are converted fastest.
        const auto row = static_cast<std::uint32_t>(first) / still.columns;
        const auto column = static_cast<std::int32_t>(static_cast<std::uint32_t>(first) - row * still.columns);
        const double up = kPlaces * static_cast<double>(row) + 0.5;
        double across = kPlaces * static_cast<double>(column) + 0.5;
        for (std::size_t cell = first; cell <= last; ++cell, across += kPlaces) {
            const std::uint8_t count = still.counts[cell];
            const std::uint16_t* places = still.places.data() + cell * StillCells::kMax;
            for (std::uint8_t k = 0; k < count; ++k) {
                const auto part_across = static_cast<std::int32_t>(places[k] % kPlaces);
                const auto part_up = static_cast<std::int32_t>(places[k] / kPlaces);
                if (segment.squaredDistance({across + part_across, up + part_up}) <= near * near) {
                    visit(StillSlot{cell, k});
                }
            }
        }
    });
}

/// Removes still droplets one by one. close() closes the gaps; until then slots stay valid.
class StillRemoval {
public:
    explicit StillRemoval(StillCells& still) : still_(&still) {}

    /// Removes a droplet.
    /// @return  its volume; 0 if it was removed before
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
