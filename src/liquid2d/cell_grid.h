// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "droplet/vector.h"

namespace droplet {

/// Places sorted by the cells of a grid, row by row. The grid is sparse: a row is cut into chunks of 32 cells, and only
/// chunks that hold a place store their cells, so that wide empty space costs a quarter of a byte a cell.
class CellGrid {
public:
    /// @param lower,upper  bounds of all places that count [m]; others are left out
    /// @param cell         side of a cell [m]
    CellGrid(Vec2 lower, Vec2 upper, double cell);

    /// Order of places by cells, those of a cell in their order, without those outside of the bounds.
    std::vector<std::uint32_t> sort(std::span<const Vec2> places);

    /// Range, in the sorted order, of the places in the cells from `first` to `last` column of a row, clipped.
    [[nodiscard]] std::pair<std::uint32_t, std::uint32_t> range(int row, int first, int last) const;
    /// Column of an abscissa, row of an ordinate; may be outside.
    [[nodiscard]] int column(double x) const { return static_cast<int>(std::floor((x - lower_.x) * inverse_)); }
    [[nodiscard]] int row(double y) const { return static_cast<int>(std::floor((y - lower_.y) * inverse_)); }

private:
    static constexpr std::size_t kChunk = 32;  ///< cells in a chunk
    static constexpr std::uint32_t kEmpty = std::numeric_limits<std::uint32_t>::max();

    struct Chunk {
        std::uint32_t before = 0;      ///< number of places in earlier chunks
        std::uint32_t cells = kEmpty;  ///< its first cell in `begin_`; empty: it holds no place
    };

    [[nodiscard]] std::size_t chunkOf(int row, int column) const
    {
        return static_cast<std::size_t>(row) * chunks_in_row_ + static_cast<std::size_t>(column) / kChunk;
    }
    /// Number of places before a cell; the column may be one beyond the last.
    [[nodiscard]] std::uint32_t placesBefore(int row, int column) const
    {
        const Chunk chunk = chunks_[chunkOf(row, column)];
        return chunk.cells == kEmpty ? chunk.before : begin_[chunk.cells + static_cast<std::size_t>(column) % kChunk];
    }

    Vec2 lower_;
    double inverse_;
    int columns_;
    int rows_;
    std::size_t chunks_in_row_;
    std::vector<Chunk> chunks_;         ///< row by row
    std::vector<std::uint32_t> begin_;  ///< of each stored cell in the sorted order
};

}  // namespace droplet
