// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "droplet/liquid2d/particle_frame.h"

namespace droplet {

/// Cells along a side of a tile. Cells have the side of a particle's spacing; lengths are in spacings.
inline constexpr int kTileSide = 8;
inline constexpr int kTileCells = kTileSide * kTileSide;

/// Index in an array.
/// @param k  ≥ 0
inline std::size_t indexOf(int k)
{
    return static_cast<std::size_t>(k);
}

/// Place of a tile in the plane.
struct TilePlace {
    std::int32_t x = 0;
    std::int32_t y = 0;
};

/// Numbers of tiles by their places.
class TileNumbers {
public:
    [[nodiscard]] std::optional<std::uint32_t> find(TilePlace place) const
    {
        const auto found = numbers_.find(key(place));
        return found == numbers_.end() ? std::nullopt : std::optional(found->second);
    }
    /// Number of the place; a new place gets the next one.
    std::uint32_t insert(TilePlace place)
    {
        return numbers_.try_emplace(key(place), static_cast<std::uint32_t>(numbers_.size())).first->second;
    }
    [[nodiscard]] std::size_t size() const { return numbers_.size(); }

private:
    static std::uint64_t key(TilePlace p)
    {
        return static_cast<std::uint64_t>(static_cast<std::uint32_t>(p.y)) << 32U | static_cast<std::uint32_t>(p.x);
    }
    std::unordered_map<std::uint64_t, std::uint32_t> numbers_;
};

/// Particles sorted into the cells of tiles. Tiles: those with particles and their eight neighbours.
struct ParticleCells {
    static constexpr std::int32_t kNone = -1;
    std::vector<TilePlace> tiles;
    std::vector<std::array<std::int32_t, 9>> around;  ///< neighbours row by row from below, the tile itself at 4
    std::vector<std::uint32_t> begin;                 ///< of each cell of each tile among the sorted particles
    std::vector<std::uint32_t> particle;              ///< sorted: index in the frame
    std::vector<std::uint32_t> place;                 ///< sorted: tile·kTileCells + cell
    std::vector<float> x, y;                          ///< sorted: from the tile's lower left corner

    /// Calls visit(begin, end, dx, dy) for the rows of cells [x0, x1]×[y0, y1] of a tile, which may reach into its
    /// neighbours; dx, dy is to be added to the places of the particles.
    template <typename Visit>
    void rows(std::size_t tile, int x0, int x1, int y0, int y1, const Visit& visit) const
    {
        for (int cell_y = y0; cell_y <= y1; ++cell_y) {
            const int ty = cell_y < 0 ? 0 : (cell_y < kTileSide ? 1 : 2);
            const int row = (cell_y - (ty - 1) * kTileSide) * kTileSide;
            for (int tx = x0 < 0 ? 0 : (x0 < kTileSide ? 1 : 2); tx <= 2; ++tx) {
                const int left = (tx - 1) * kTileSide;
                const int from = std::max(x0 - left, 0);
                const int to = std::min(x1 - left, kTileSide - 1);
                if (from > to) {
                    break;
                }
                const std::int32_t other = around[tile][indexOf(ty * 3 + tx)];
                if (other == kNone) {
                    continue;
                }
                const std::size_t base = static_cast<std::size_t>(other) * kTileCells + static_cast<std::size_t>(row);
                const std::uint32_t first = begin[base + static_cast<std::size_t>(from)];
                const std::uint32_t last = begin[base + static_cast<std::size_t>(to) + 1];
                if (first < last) {
                    visit(first, last, static_cast<float>(left), static_cast<float>((ty - 1) * kTileSide));
                }
            }
        }
    }
};

/// Sorts the particles of a frame.
/// @throws Error InvalidInput for a particle too far from the origin
ParticleCells sortIntoCells(const ParticleFrame& frame);

}  // namespace droplet
