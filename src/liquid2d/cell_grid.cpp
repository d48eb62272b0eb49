// SPDX-License-Identifier: GPL-3.0-or-later
#include "cell_grid.h"

#include <algorithm>

namespace droplet {

CellGrid::CellGrid(Vec2 lower, Vec2 upper, double cell)
    : lower_(lower),
      inverse_(1.0 / cell),
      columns_(static_cast<int>(std::floor((upper.x - lower.x) * inverse_)) + 1),
      rows_(static_cast<int>(std::floor((upper.y - lower.y) * inverse_)) + 1),
      // The column beyond the last is in the same row.
      chunks_in_row_(static_cast<std::size_t>(columns_) / kChunk + 1)
{
}

std::vector<std::uint32_t> CellGrid::sort(std::span<const Vec2> places)
{
    chunks_.assign(static_cast<std::size_t>(rows_) * chunks_in_row_, {});
    struct Cell {
        std::uint32_t chunk = kEmpty;  ///< empty: outside
        std::uint32_t inside = 0;
    };
    std::vector<Cell> cell_of(places.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
        const int c = column(places[i].x);
        const int r = row(places[i].y);
        if (c >= 0 && r >= 0 && c < columns_ && r < rows_) {
            cell_of[i] = {static_cast<std::uint32_t>(chunkOf(r, c)),
                          static_cast<std::uint32_t>(static_cast<std::size_t>(c) % kChunk)};
            ++chunks_[cell_of[i].chunk].before;
        }
    }
    std::uint32_t count = 0;
    std::uint32_t stored = 0;
    for (Chunk& chunk : chunks_) {
        const std::uint32_t here = chunk.before;
        chunk.before = count;
        count += here;
        if (here > 0) {
            chunk.cells = stored;
            stored += static_cast<std::uint32_t>(kChunk);
        }
    }
    begin_.assign(stored, 0);
    const auto cell_at = [&](const Cell& cell) -> std::uint32_t& {
        return begin_[chunks_[cell.chunk].cells + cell.inside];
    };
    for (const Cell& cell : cell_of) {
        if (cell.chunk != kEmpty) {
            ++cell_at(cell);
        }
    }
    std::uint32_t end = 0;
    for (std::uint32_t& begin : begin_) {
        end += begin;
        begin = end;
    }
    // Filled backward: the end of each cell becomes its beginning.
    std::vector<std::uint32_t> order(count);
    for (std::size_t i = places.size(); i-- > 0;) {
        if (cell_of[i].chunk != kEmpty) {
            order[--cell_at(cell_of[i])] = static_cast<std::uint32_t>(i);
        }
    }
    return order;
}

std::pair<std::uint32_t, std::uint32_t> CellGrid::range(int row, int first, int last) const
{
    first = std::max(first, 0);
    last = std::min(last, columns_ - 1);
    if (row < 0 || row >= rows_ || first > last) {
        return {0, 0};
    }
    return {placesBefore(row, first), placesBefore(row, last + 1)};
}

}  // namespace droplet
