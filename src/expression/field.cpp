// SPDX-License-Identifier: GPL-3.0-or-later
#include "field.h"

#include <cmath>
#include <numbers>

#include "blocks.h"
#include "surface_kernel.h"

namespace droplet {
namespace {

constexpr std::size_t kTilesPerBlock = 16;
constexpr double kClusterMass = 0.12;
constexpr int kRows = 3 * kTileSide;
/// Cells of a tile and its eight neighbours, as rows of bits.
using Rows = std::array<std::uint32_t, kRows>;

std::uint32_t byteOf(std::uint64_t bits, int row)
{
    return static_cast<std::uint32_t>(bits >> static_cast<unsigned>(8 * row)) & 0xFFU;
}

Rows rowsAround(const ParticleCells& cells, std::size_t tile, const std::vector<std::uint64_t>& bits)
{
    Rows rows{};
    for (int k = 0; k < 9; ++k) {
        if (const std::int32_t t = cells.around[tile][static_cast<std::size_t>(k)]; t >= 0) {
            for (int y = 0; y < kTileSide; ++y) {
                rows[static_cast<std::size_t>(k / 3 * kTileSide + y)] |= byteOf(bits[static_cast<std::size_t>(t)], y)
                                                                         << static_cast<unsigned>(k % 3 * kTileSide);
            }
        }
    }
    return rows;
}

/// Cells of the middle tile that have a set cell at most `reach` ≤ 8 away in both directions.
std::uint64_t dilated(const Rows& rows, int reach)
{
    Rows wide = rows;
    for (std::uint32_t& row : wide) {
        std::uint32_t r = row;
        for (int k = 1; k <= reach; ++k) {
            r |= row << static_cast<unsigned>(k) | row >> static_cast<unsigned>(k);
        }
        row = r;
    }
    std::uint64_t result = 0;
    for (int y = 0; y < kTileSide; ++y) {
        std::uint32_t r = 0;
        for (int k = -reach; k <= reach; ++k) {
            r |= wide[static_cast<std::size_t>(kTileSide + y + k)];
        }
        result |= static_cast<std::uint64_t>(r >> 8U & 0xFFU) << static_cast<unsigned>(8 * y);
    }
    return result;
}

/// Cells that are surely liquid: all blocks of cells around them hold about as many particles as they should.
std::uint64_t fullCells(const ParticleCells& cells, std::size_t tile, const std::vector<std::uint64_t>& aired)
{
    constexpr int kMargin = 3;
    constexpr int kSide = kTileSide + 2 * kMargin;
    std::array<std::array<int, kSide>, kSide> counts{};
    for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
            const int cx = x - kMargin;
            const int cy = y - kMargin;
            const auto k = static_cast<std::size_t>((cy + kTileSide) / kTileSide * 3 + (cx + kTileSide) / kTileSide);
            const std::int32_t t = cells.around[tile][k];
            if (t < 0) {
                continue;
            }
            const auto cell = static_cast<std::size_t>((cy & 7) * kTileSide + (cx & 7));
            const std::size_t at = static_cast<std::size_t>(t) * kTileCells + cell;
            const bool has_air = (aired[static_cast<std::size_t>(t)] >> cell & 1U) != 0;
            counts[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)] =
                has_air ? -100 : std::min(4, static_cast<int>(cells.begin[at + 1] - cells.begin[at]));
        }
    }
    const auto count = [&](int x, int y) { return counts[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)]; };
    std::array<std::uint32_t, kSide> dense{};
    for (int y = 1; y + 1 < kSide; ++y) {
        for (int x = 1; x + 1 < kSide; ++x) {
            const int below = count(x - 1, y - 1) + count(x, y - 1);
            const int below_right = count(x, y - 1) + count(x + 1, y - 1);
            const int left = count(x - 1, y) + count(x, y);
            const int right = count(x, y) + count(x + 1, y);
            const int above = count(x - 1, y + 1) + count(x, y + 1);
            const int above_right = count(x, y + 1) + count(x + 1, y + 1);
            const int all = below + count(x + 1, y - 1) + left + count(x + 1, y) + above + count(x + 1, y + 1);
            if (all >= 7 && std::min({below + left, below_right + right, above + left, above_right + right}) >= 2) {
                dense[static_cast<std::size_t>(y)] |= 1U << static_cast<unsigned>(x);
            }
        }
    }
    std::uint64_t full = 0;
    for (int y = 0; y < kTileSide; ++y) {
        std::uint32_t row = ~0U;
        for (int k = -1; k <= 1; ++k) {
            const std::uint32_t d = dense[static_cast<std::size_t>(y + kMargin + k)];
            row &= d & d << 1U & d >> 1U;
        }
        full |= static_cast<std::uint64_t>(row >> static_cast<unsigned>(kMargin) & 0xFFU)
                << static_cast<unsigned>(8 * y);
    }
    return full;
}

int reachOf(double smoothing)
{
    return static_cast<int>(std::ceil(std::max(bulkSupport(smoothing), 2.0 * kParticleRadius)));
}

/// A disc of liquid or eraser, ready to be added to nodes.
struct Stamp {
    float x, y;
    float support, weight;
    float inner, outer, air;  ///< of the eraser; air = 0: none
};

class Tile {
public:
    Tile(float* values, int nodes_per_cell)
        : values_(values), side_(kTileSide * nodes_per_cell), step_(1.0F / static_cast<float>(nodes_per_cell))
    {
    }

    /// Calls set(value, x, y) for the nodes of a box.
    template <typename Set>
    void box(float x0, float x1, float y0, float y1, const Set& set)
    {
        const float n = 1.0F / step_;
        const int left = std::max(0, static_cast<int>(std::ceil(x0 * n)));
        const int right = std::min(side_ - 1, static_cast<int>(std::floor(x1 * n)));
        const int lower = std::max(0, static_cast<int>(std::ceil(y0 * n)));
        const int upper = std::min(side_ - 1, static_cast<int>(std::floor(y1 * n)));
        for (int j = lower; j <= upper; ++j) {
            float* row = values_ + static_cast<std::ptrdiff_t>(j) * side_;
            for (int i = left; i <= right; ++i) {
                set(row[i], step_ * static_cast<float>(i), step_ * static_cast<float>(j));
            }
        }
    }

    void add(const Stamp& s)
    {
        const float r = std::max(s.support, s.air > 0.0F ? s.outer : 0.0F);
        const float per_support = 1.0F / s.support;
        if (s.air == 0.0F) {
            box(s.x - r, s.x + r, s.y - r, s.y + r, [&](float& value, float x, float y) {
                const float d2 = (x - s.x) * (x - s.x) + (y - s.y) * (y - s.y);
                value += s.weight * surfaceKernel(std::sqrt(d2) * per_support);
            });
            return;
        }
        box(s.x - r, s.x + r, s.y - r, s.y + r, [&](float& value, float x, float y) {
            const float d = std::sqrt((x - s.x) * (x - s.x) + (y - s.y) * (y - s.y));
            value +=
                (1.0F - s.air) * s.weight * surfaceKernel(d * per_support) + s.air * eraserKernel(d, s.inner, s.outer);
        });
    }

    /// Joins the discs of a piece of a tail.
    void join(Vec2 from, const TailPiece& piece)
    {
        const Vec2 along = piece.to - piece.from;
        const auto length = static_cast<float>(droplet::length(along));
        const auto ra = static_cast<float>(piece.from_radius);
        const auto rb = static_cast<float>(piece.to_radius);
        const float ux = length > 0.0F ? static_cast<float>(along.x) / length : 1.0F;
        const float uy = length > 0.0F ? static_cast<float>(along.y) / length : 0.0F;
        const auto ax = static_cast<float>(from.x);
        const auto ay = static_cast<float>(from.y);
        const float slope = length > 0.0F ? (rb - ra) / length : 0.0F;
        const float margin = 2.0F * std::max(ra, rb);
        box(std::min(ax, ax + ux * length) - margin, std::max(ax, ax + ux * length) + margin,
            std::min(ay, ay + uy * length) - margin, std::max(ay, ay + uy * length) + margin,
            [&](float& value, float x, float y) {
                const float px = (x - ax) * ux + (y - ay) * uy;
                const float py = (y - ay) * ux - (x - ax) * uy;
                // The disc that covers the point best: extreme of distance over radius.
                const float radius_here = ra + slope * px;
                float s = px;
                if (radius_here > 1e-6F) {
                    s += slope * py * py / radius_here;
                }
                s = std::clamp(s, 0.0F, length);
                const float radius = std::max(ra + slope * s, 1e-4F);
                const float d = std::sqrt((px - s) * (px - s) + py * py);
                value = std::max(value, surfaceKernel(d / (2.0F * radius)));
            });
    }

private:
    float* values_;
    int side_;
    float step_;
};

Stamp stampOf(Vec2 centre, float coverage, float air, double scale, double smoothing)
{
    const KernelShape kernel = kernelShape(coverage, smoothing);
    const double inner = std::sqrt(air / std::numbers::pi);
    return {static_cast<float>(centre.x),
            static_cast<float>(centre.y),
            static_cast<float>(scale * kernel.support),
            static_cast<float>(kernel.weight),
            static_cast<float>(inner),
            static_cast<float>(std::hypot(inner, kParticleRadius)),
            static_cast<float>(smoothRamp(air, 0.0, 0.15))};
}

/// Gives nodes beside missing tiles the value of those, so that every loop closes.
void closeBorder(const SurfaceField& field, std::size_t tile, float* values)
{
    const int side = field.side();
    const auto set = [&](int k, int begin, int step) {
        const std::int32_t other = field.around[tile][static_cast<std::size_t>(k)];
        for (int i = 0; other < 0 && i < side; ++i) {
            float& value = values[begin + i * step];
            value = other == SurfaceField::kLiquid ? 1.0F : std::min(value, 0.0F);
        }
    };
    set(1, 0, 1);
    set(3, 0, side);
    set(5, side - 1, side);
    set(7, side * (side - 1), 1);
}

/// Things by the tiles that they touch.
struct Touching {
    std::uint32_t tile = 0;
    std::uint32_t thing = 0;
};

TilePlace tileOf(Vec2 p)
{
    return {static_cast<std::int32_t>(std::floor(p.x / kTileSide)),
            static_cast<std::int32_t>(std::floor(p.y / kTileSide))};
}

}  // namespace

double bulkSupport(double smoothing)
{
    return 1.1 * (1.0 + smoothing);
}

KernelShape kernelShape(double coverage, double smoothing)
{
    const double bulk = bulkSupport(smoothing);
    const double bulk_weight = 1.0 / (kKernelIntegral * bulk * bulk);
    // 0 for an isolated particle, 1 at a straight rim.
    const double full = std::max(0.8, bulk_weight + 0.1);
    const double t = std::clamp((coverage - bulk_weight) / (full - bulk_weight), 0.0, 1.0);
    const double b = smoothRamp(t, 0.0, 1.0);
    const double support = (1.0 - b) * 2.0 * kParticleRadius + b * bulk;
    // An isolated disc of area 1 has weight 1: its kernel integrates to 1.2. Bodies of few particles are round, so
    // their kernels reach beyond the rim and need more weight; fitted to the areas of clusters.
    const double mass = (1.0 - b) * kKernelIntegral * 4.0 * kParticleRadius * kParticleRadius + b +
                        kClusterMass * smoothRamp(t, 0.15, 0.4) * smoothRamp(t, 0.9, 0.6);
    return {support, mass / (kKernelIntegral * support * support) / std::max(1.0, coverage)};
}

Coverage coverageOf(const ParticleCells& cells, const std::vector<float>& air, const FieldOptions& options)
{
    const std::size_t tiles = cells.tiles.size();
    Coverage result;
    result.full.assign(tiles, 0);
    result.occupied.assign(tiles, 0);
    result.near.assign(tiles, 0);
    result.coverage.assign(cells.particle.size(), 1.0F);
    std::vector<std::uint64_t> aired(tiles, 0);
    forBlocks(
        tiles,
        [&](std::size_t b, std::size_t e) {
            for (std::size_t t = b; t < e; ++t) {
                for (std::size_t c = 0; c < kTileCells; ++c) {
                    const std::size_t at = t * kTileCells + c;
                    if (cells.begin[at] < cells.begin[at + 1]) {
                        result.occupied[t] |= std::uint64_t{1} << c;
                    }
                    for (std::uint32_t k = cells.begin[at]; !air.empty() && k < cells.begin[at + 1]; ++k) {
                        if (air[k] > 0.0F) {
                            aired[t] |= std::uint64_t{1} << c;
                        }
                    }
                }
            }
        },
        kTilesPerBlock);
    if (!options.everywhere) {
        forBlocks(
            tiles,
            [&](std::size_t b, std::size_t e) {
                for (std::size_t t = b; t < e; ++t) {
                    if (result.occupied[t] != 0) {
                        result.full[t] = fullCells(cells, t, aired);
                    }
                }
            },
            kTilesPerBlock);
    }
    const double support = bulkSupport(options.smoothing);
    const int reach = reachOf(options.smoothing);
    const auto per_support = static_cast<float>(1.0 / support);
    const auto weight = static_cast<float>(1.0 / (kKernelIntegral * support * support));
    const auto reach2 = static_cast<float>(support * support);
    std::vector<std::uint64_t> open(tiles);
    for (std::size_t t = 0; t < tiles; ++t) {
        open[t] = ~result.full[t];
    }
    forBlocks(
        tiles,
        [&](std::size_t b, std::size_t e) {
            for (std::size_t t = b; t < e; ++t) {
                if (result.occupied[t] == 0) {
                    continue;
                }
                result.near[t] = result.occupied[t] & dilated(rowsAround(cells, t, open), reach);
                for (int c = 0; c < kTileCells; ++c) {
                    if ((result.near[t] >> static_cast<unsigned>(c) & 1U) == 0) {
                        continue;
                    }
                    const int cx = c % kTileSide;
                    const int cy = c / kTileSide;
                    const std::size_t at = t * kTileCells + static_cast<std::size_t>(c);
                    cells.rows(t, cx - reach, cx + reach, cy - reach, cy + reach,
                               [&](std::uint32_t first, std::uint32_t last, float dx, float dy) {
                                   for (std::uint32_t i = cells.begin[at]; i < cells.begin[at + 1]; ++i) {
                                       const float x = cells.x[i] - dx;
                                       const float y = cells.y[i] - dy;
                                       float sum = 0.0F;
                                       for (std::uint32_t j = first; j < last; ++j) {
                                           const float ex = cells.x[j] - x;
                                           const float ey = cells.y[j] - y;
                                           const float d2 = ex * ex + ey * ey;
                                           if (d2 < reach2) {
                                               sum += surfaceKernel(std::sqrt(d2) * per_support);
                                           }
                                       }
                                       result.coverage[i] += weight * sum;
                                   }
                               });
                    for (std::uint32_t i = cells.begin[at]; i < cells.begin[at + 1]; ++i) {
                        result.coverage[i] -= 1.0F;
                    }
                }
            }
        },
        kTilesPerBlock);
    return result;
}

SurfaceField surfaceField(const ParticleCells& cells, const Coverage& coverage, const std::vector<float>& air,
                          const Tails& tails, const FieldOptions& options)
{
    const int reach = reachOf(options.smoothing);
    const std::size_t tiles = cells.tiles.size();
    std::vector<std::uint8_t> has_rim(tiles, 0);
    forBlocks(
        tiles,
        [&](std::size_t b, std::size_t e) {
            for (std::size_t t = b; t < e; ++t) {
                has_rim[t] = (~coverage.full[t] & dilated(rowsAround(cells, t, coverage.occupied), reach)) != 0;
            }
        },
        kTilesPerBlock);

    SurfaceField field;
    field.nodes_per_cell = options.nodes_per_cell;
    TileNumbers numbers;
    TileNumbers old_numbers;
    std::vector<std::int32_t> source;  // Tile of particles, or −1.
    for (std::size_t t = 0; t < tiles; ++t) {
        if (has_rim[t] != 0) {
            numbers.insert(cells.tiles[t]);
            field.tiles.push_back(cells.tiles[t]);
            source.push_back(static_cast<std::int32_t>(t));
        }
    }
    // Heads and tails lie where they want.
    std::vector<char> is_head(tails.heads.empty() ? 0 : cells.particle.size(), 0);
    std::vector<Touching> heads;
    std::vector<Touching> pieces;
    if (!tails.heads.empty()) {
        for (std::size_t t = 0; t < tiles; ++t) {
            old_numbers.insert(cells.tiles[t]);
        }
    }
    const auto touch = [&](Vec2 lower, Vec2 upper, std::uint32_t thing, std::vector<Touching>& list) {
        const TilePlace a = tileOf(lower - Vec2{1.0, 1.0});
        const TilePlace b = tileOf(upper + Vec2{1.0, 1.0});
        for (std::int32_t y = a.y; y <= b.y; ++y) {
            for (std::int32_t x = a.x; x <= b.x; ++x) {
                const std::uint32_t tile = numbers.insert({x, y});
                if (tile == field.tiles.size()) {
                    field.tiles.push_back({x, y});
                    const auto old = old_numbers.find({x, y});
                    source.push_back(old ? static_cast<std::int32_t>(*old) : -1);
                }
                list.push_back({tile, thing});
            }
        }
    };
    for (std::uint32_t h = 0; h < tails.heads.size(); ++h) {
        const TailHead& head = tails.heads[h];
        is_head[head.sorted] = 1;
        const double r = head.scale * std::max(bulkSupport(options.smoothing), 2.0 * kParticleRadius);
        touch(head.centre - Vec2{r, r}, head.centre + Vec2{r, r}, h, heads);
    }
    for (std::uint32_t p = 0; p < tails.pieces.size(); ++p) {
        const TailPiece& piece = tails.pieces[p];
        const double r = 2.0 * std::max(piece.from_radius, piece.to_radius);
        touch({std::min(piece.from.x, piece.to.x) - r, std::min(piece.from.y, piece.to.y) - r},
              {std::max(piece.from.x, piece.to.x) + r, std::max(piece.from.y, piece.to.y) + r}, p, pieces);
    }
    const auto in_order = [](const Touching& a, const Touching& b) {
        return a.tile != b.tile ? a.tile < b.tile : a.thing < b.thing;
    };
    std::sort(heads.begin(), heads.end(), in_order);
    std::sort(pieces.begin(), pieces.end(), in_order);

    const std::size_t count = field.tiles.size();
    field.around.resize(count);
    field.values.assign(count * field.nodes(), 0.0F);
    const auto local = [&](Vec2 p, std::size_t t) {
        return Vec2{p.x - static_cast<double>(kTileSide) * field.tiles[t].x,
                    p.y - static_cast<double>(kTileSide) * field.tiles[t].y};
    };
    const auto from_tile = [](const std::vector<Touching>& list, std::size_t t) {
        return std::lower_bound(list.begin(), list.end(), t,
                                [](const Touching& a, std::size_t tile) { return a.tile < tile; });
    };
    forBlocks(
        count,
        [&](std::size_t b, std::size_t e) {
            for (std::size_t t = b; t < e; ++t) {
                for (int k = 0; k < 9; ++k) {
                    const auto other = numbers.find({field.tiles[t].x + k % 3 - 1, field.tiles[t].y + k / 3 - 1});
                    std::int32_t value = SurfaceField::kDry;
                    if (other) {
                        value = static_cast<std::int32_t>(*other);
                    } else if (source[t] >= 0) {
                        const std::int32_t s =
                            cells.around[static_cast<std::size_t>(source[t])][static_cast<std::size_t>(k)];
                        if (s >= 0 && coverage.full[static_cast<std::size_t>(s)] == ~std::uint64_t{0}) {
                            value = SurfaceField::kLiquid;
                        }
                    }
                    field.around[t][static_cast<std::size_t>(k)] = value;
                }
                float* values = field.values.data() + t * field.nodes();
                Tile tile(values, options.nodes_per_cell);
                if (source[t] >= 0) {
                    const auto s = static_cast<std::size_t>(source[t]);
                    cells.rows(s, -reach, kTileSide - 1 + reach, -reach, kTileSide - 1 + reach,
                               [&](std::uint32_t first, std::uint32_t last, float dx, float dy) {
                                   for (std::uint32_t i = first; i < last; ++i) {
                                       const std::uint32_t p = cells.place[i];
                                       if ((coverage.near[p / kTileCells] >> (p % kTileCells) & 1U) == 0 ||
                                           (!is_head.empty() && is_head[i] != 0)) {
                                           continue;
                                       }
                                       tile.add(stampOf(
                                           {static_cast<double>(cells.x[i] + dx), static_cast<double>(cells.y[i] + dy)},
                                           coverage.coverage[i], air.empty() ? 0.0F : air[i], 1.0, options.smoothing));
                                   }
                               });
                }
                for (auto h = from_tile(heads, t); h != heads.end() && h->tile == t; ++h) {
                    const TailHead& head = tails.heads[h->thing];
                    tile.add(stampOf(local(head.centre, t), coverage.coverage[head.sorted],
                                     air.empty() ? 0.0F : air[head.sorted], head.scale, options.smoothing));
                }
                for (auto p = from_tile(pieces, t); p != pieces.end() && p->tile == t; ++p) {
                    tile.join(local(tails.pieces[p->thing].from, t), tails.pieces[p->thing]);
                }
                // Cells that are surely liquid got a part of their sum.
                const int n = options.nodes_per_cell;
                const std::uint64_t full = source[t] >= 0 ? coverage.full[static_cast<std::size_t>(source[t])] : 0;
                if (full != 0) {
                    for (int j = 0; j < field.side(); ++j) {
                        for (int i = 0; i < field.side(); ++i) {
                            if ((full >> static_cast<unsigned>(j / n * kTileSide + i / n) & 1U) != 0) {
                                values[j * field.side() + i] = 1.0F;
                            }
                        }
                    }
                }
                closeBorder(field, t, values);
            }
        },
        4);
    return field;
}

}  // namespace droplet
