// SPDX-License-Identifier: GPL-3.0-or-later
#include "particle_cells.h"

#include <cmath>

#include "blocks.h"
#include "droplet/error.h"

namespace droplet {

ParticleCells sortIntoCells(const ParticleFrame& frame)
{
    const std::size_t count = frame.position.size();
    const double scale = 1.0 / frame.spacing;
    ParticleCells cells;
    TileNumbers numbers;
    std::vector<std::uint32_t> place(count);
    std::optional<TilePlace> last;
    std::uint32_t number = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const double x = std::floor(scale * frame.position[i].x);
        const double y = std::floor(scale * frame.position[i].y);
        constexpr double kFar = 1e9;
        if (std::abs(x) > kFar || std::abs(y) > kFar) {
            throw Error(ErrorCode::InvalidInput, "the particles are spread too far for their spacing");
        }
        const auto cx = static_cast<std::int32_t>(x);
        const auto cy = static_cast<std::int32_t>(y);
        const TilePlace tile{cx >> 3, cy >> 3};
        if (!last || last->x != tile.x || last->y != tile.y) {
            number = numbers.insert(tile);
            last = tile;
            if (number == cells.tiles.size()) {
                cells.tiles.push_back(tile);
            }
        }
        place[i] = number * kTileCells + static_cast<std::uint32_t>((cy & 7) * kTileSide + (cx & 7));
    }
    const std::size_t occupied = cells.tiles.size();
    for (std::size_t t = 0; t < occupied; ++t) {
        for (int k = 0; k < 9; ++k) {
            const TilePlace p{cells.tiles[t].x + k % 3 - 1, cells.tiles[t].y + k / 3 - 1};
            if (numbers.insert(p) == cells.tiles.size()) {
                cells.tiles.push_back(p);
            }
        }
    }
    cells.around.resize(cells.tiles.size());
    forBlocks(
        cells.tiles.size(),
        [&](std::size_t b, std::size_t e) {
            for (std::size_t t = b; t < e; ++t) {
                for (int k = 0; k < 9; ++k) {
                    const auto other = numbers.find({cells.tiles[t].x + k % 3 - 1, cells.tiles[t].y + k / 3 - 1});
                    cells.around[t][static_cast<std::size_t>(k)] =
                        other ? static_cast<std::int32_t>(*other) : ParticleCells::kNone;
                }
            }
        },
        512);

    cells.begin.assign(cells.tiles.size() * kTileCells + 1, 0);
    for (const std::uint32_t p : place) {
        ++cells.begin[p + 1];
    }
    for (std::size_t k = 1; k < cells.begin.size(); ++k) {
        cells.begin[k] += cells.begin[k - 1];
    }
    std::vector<std::uint32_t> next(cells.begin.begin(), cells.begin.end() - 1);
    cells.particle.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        cells.particle[next[place[i]]++] = static_cast<std::uint32_t>(i);
    }
    cells.place.resize(count);
    cells.x.resize(count);
    cells.y.resize(count);
    forBlocks(count, [&](std::size_t b, std::size_t e) {
        for (std::size_t k = b; k < e; ++k) {
            const std::uint32_t i = cells.particle[k];
            cells.place[k] = place[i];
            const TilePlace tile = cells.tiles[place[i] / kTileCells];
            cells.x[k] = static_cast<float>(scale * frame.position[i].x - 8.0 * tile.x);
            cells.y[k] = static_cast<float>(scale * frame.position[i].y - 8.0 * tile.y);
        }
    });
    return cells;
}

}  // namespace droplet
