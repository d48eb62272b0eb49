// SPDX-License-Identifier: GPL-3.0-or-later
#include "field.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "blocks.h"
#include "claws.h"
#include "holes.h"
#include "plain_length.h"
#include "surface_kernel.h"

namespace droplet {
namespace {

constexpr std::size_t kTilesPerBlock = 16;
/// Margin of an eraser's ring below the surface's value.
constexpr double kBelow = 0.02;
/// Narrower kernels show gaps between single particles, so no cell is surely liquid.
constexpr double kSmooth = 0.95;
constexpr double kClusterMass = 0.12;
/// Half of the width of the band around a droplet's rim in which its field falls, in spacings; less on thin parts.
constexpr double kDropBand = 0.8;
/// Depth of the dent that keeps a hole open, over the value of full liquid, its reach over the hole's radius, and the
/// least such radius in spacings: where the kernel is a third, 0.6 of the way, the surface's value is left.
constexpr float kDent = 1.5F;
constexpr double kDentReach = 1.4;
constexpr double kLeastDent = 0.8;
/// Nodes that get a particle's field at a time.
constexpr int kLanes = 4;
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
                rows[indexOf(k / 3 * kTileSide + y)] |= byteOf(bits[static_cast<std::size_t>(t)], y)
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
            r |= wide[indexOf(kTileSide + y + k)];
        }
        result |= static_cast<std::uint64_t>(r >> 8U & 0xFFU) << static_cast<unsigned>(8 * y);
    }
    return result;
}

/// Cells that are surely liquid: all blocks of cells around them hold about as many particles as they should.
std::uint64_t fullCells(const ParticleCells& cells, std::size_t tile, const std::vector<std::uint64_t>& opened)
{
    constexpr int kMargin = 3;
    constexpr int kSide = kTileSide + 2 * kMargin;
    std::array<std::array<int, kSide>, kSide> counts{};
    for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
            const int cx = x - kMargin;
            const int cy = y - kMargin;
            const auto k = indexOf((cy + kTileSide) / kTileSide * 3 + (cx + kTileSide) / kTileSide);
            const std::int32_t t = cells.around[tile][k];
            if (t < 0) {
                continue;
            }
            const auto cell = indexOf((cy & 7) * kTileSide + (cx & 7));
            const std::size_t at = static_cast<std::size_t>(t) * kTileCells + cell;
            const bool is_open = (opened[static_cast<std::size_t>(t)] >> cell & 1U) != 0;
            counts[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)] =
                is_open ? -100 : std::min(4, static_cast<int>(cells.begin[at + 1] - cells.begin[at]));
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
            const std::uint32_t d = dense[indexOf(y + kMargin + k)];
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

/// Field of a particle's water, ready to be added to nodes.
struct Stamp {
    float x, y;
    float support, weight;
};

/// Field of a droplet near liquid, of a hole that stays open, or of a particle that holds air. In spacings, absolute.
struct LongStamp {
    const Drop* drop = nullptr;  ///< or none for the others
    bool is_dent = false;        ///< whether it is a hole's
    double scale = 1.0;          ///< spacings per metre, for a droplet
    Vec2 place{};
    double support = 0.0;
    double weight = 0.0;
    double inner = 0.0;  ///< of an eraser
    double outer = 0.0;  ///< of an eraser
    double share = 0.0;  ///< of the droplet or the eraser; the rest is water of particles
    Vec2 lower{};        ///< bounds
    Vec2 upper{};
};

/// Value of a droplet at a point: that of the surface at its rim, and within a band around it as steep as a particle's.
double dropAt(const LongStamp& s, Vec2 point)
{
    const Drop& drop = *s.drop;
    const Vec2 x = drop.ellipse.compressed((1.0 / s.scale) * point - drop.ellipse.centre);
    const auto inwards = [&](double off, double width) {
        const double band = std::min(width, kDropBand / s.scale);
        return band > 0.0 ? (width - off) / band : -1.0;
    };
    double best = inwards(plainLength(x), drop.shape.head);
    // The nearest place on the spine, and the width there.
    const double step = drop.shape.length / static_cast<double>(std::max<std::size_t>(drop.spine.size(), 2) - 1);
    double nearest = std::numeric_limits<double>::max();
    double place = 0.0;
    for (std::size_t k = 0; k + 1 < drop.spine.size(); ++k) {
        const Vec2 side = drop.spine[k + 1] - drop.spine[k];
        const Vec2 arm = x - drop.spine[k];
        const double square = dot(side, side);
        const double along = square > 0.0 ? std::clamp(dot(arm, side) / square, 0.0, 1.0) : 0.0;
        const double off = plainLength(arm - along * side);
        if (off < nearest) {
            nearest = off;
            place = step * (static_cast<double>(k) + along);
        }
    }
    if (place > 0.0) {
        best = std::max(best, inwards(nearest, drop.shape.halfWidth(place)));
    }
    return s.share * static_cast<double>(surfaceKernel(static_cast<float>(std::clamp(0.5 - 0.5 * best, 0.0, 1.0))));
}

void setBounds(LongStamp& s)
{
    const auto include = [&](Vec2 x, double reach) {
        s.lower = {std::min(s.lower.x, x.x - reach), std::min(s.lower.y, x.y - reach)};
        s.upper = {std::max(s.upper.x, x.x + reach), std::max(s.upper.y, x.y + reach)};
    };
    s.lower = s.upper = s.place;
    if (s.drop == nullptr) {
        include(s.place, std::max(s.support, s.outer));
        return;
    }
    for (const Vec2 x : s.drop->spine) {
        include(s.scale * (s.drop->ellipse.centre + s.drop->ellipse.stretched(x)),
                2.0 * s.scale * s.drop->shape.head * s.drop->ellipse.stretch);
    }
}

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
        // Whole blocks of nodes: the kernel is 0 at those beyond its support.
        using Lanes = Eigen::Array<float, kLanes, 1>;
        static_assert(kTileSide % kLanes == 0);
        const float per_support = 1.0F / s.support;
        const float n = 1.0F / step_;
        const int left = std::max(0, static_cast<int>(std::floor((s.x - s.support) * n))) / kLanes * kLanes;
        const int right = std::min(side_ - 1, static_cast<int>(std::floor((s.x + s.support) * n)));
        const int lower = std::max(0, static_cast<int>(std::ceil((s.y - s.support) * n)));
        const int upper = std::min(side_ - 1, static_cast<int>(std::floor((s.y + s.support) * n)));
        const Lanes numbers = Lanes::LinSpaced(0.0F, kLanes - 1.0F);
        for (int j = lower; j <= upper; ++j) {
            float* row = values_ + static_cast<std::ptrdiff_t>(j) * side_;
            const float up = step_ * static_cast<float>(j) - s.y;
            for (int i = left; i <= right; i += kLanes) {
                const Lanes across = step_ * (static_cast<float>(i) + numbers) - s.x;
                const Lanes t = ((across * across + up * up).sqrt() * per_support).min(1.0F);
                Eigen::Map<Lanes> values(row + i);
                values += s.weight * surfaceKernelWithin(t);
            }
        }
    }

    /// @param corner  of the tile
    void add(const LongStamp& s, Vec2 corner)
    {
        const Vec2 lower = s.lower - corner;
        const Vec2 upper = s.upper - corner;
        const auto f = [](double value) { return static_cast<float>(value); };
        box(f(lower.x) - 1e-3F, f(upper.x) + 1e-3F, f(lower.y) - 1e-3F, f(upper.y) + 1e-3F,
            [&](float& value, float x, float y) {
                const Vec2 point = corner + Vec2{static_cast<double>(x), static_cast<double>(y)};
                if (s.drop != nullptr) {
                    value += f(dropAt(s, point));
                    return;
                }
                const double d = plainLength(point - s.place);
                if (s.is_dent) {
                    value -= kDent * surfaceKernel(f(d / s.outer));
                    return;
                }
                value += f((1.0 - s.share) * s.weight) * surfaceKernel(f(d / s.support)) +
                         f(s.share * eraser(d, s.inner, s.outer));
            });
    }

private:
    float* values_;
    int side_;
    float step_;
};

/// Gives nodes beside missing tiles the value of those, so that every loop closes.
void closeBorder(const Field& field, std::size_t tile, float* values)
{
    const int side = field.side();
    const auto set = [&](int k, int begin, int step) {
        const std::int32_t other = field.around[tile][static_cast<std::size_t>(k)];
        for (int i = 0; other < 0 && i < side; ++i) {
            float& value = values[begin + i * step];
            value = other == Field::kLiquid ? 1.0F : std::min(value, 0.0F);
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

Coverage coverageOf(const ParticleCells& cells, const std::vector<std::uint64_t>& opened, const FieldOptions& options)
{
    const std::size_t tiles = cells.tiles.size();
    Coverage result;
    result.full.assign(tiles, 0);
    result.occupied.assign(tiles, 0);
    result.near.assign(tiles, 0);
    result.coverage.assign(cells.particle.size(), 1.0F);
    forBlocks(
        tiles,
        [&](std::size_t b, std::size_t e) {
            for (std::size_t t = b; t < e; ++t) {
                for (std::size_t c = 0; c < kTileCells; ++c) {
                    const std::size_t at = t * kTileCells + c;
                    if (cells.begin[at] < cells.begin[at + 1]) {
                        result.occupied[t] |= std::uint64_t{1} << c;
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
                        result.full[t] = fullCells(cells, t, opened);
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

double eraser(double distance, double inner, double outer)
{
    const double ring = kIso - kBelow;
    const auto fall = [](double t) { return 1.0 - t * t * (3.0 - 2.0 * t); };
    if (distance < inner) {
        return ring - (1.0 + ring) * fall(distance / inner);
    }
    return distance < outer ? ring * fall((distance - inner) / (outer - inner)) : 0.0;
}

Field fieldOf(const std::vector<Drop>& drops, const ExpressionState& state, const ParticleFrame& frame,
              const ExpressionOptions& options, bool everywhere)
{
    const ParticleCells cells = sortIntoCells(frame);
    const FieldOptions field_options{options.smoothing,
                                     std::clamp(static_cast<int>(std::ceil(1.0 / options.resolution - 1e-9)), 1, 5),
                                     everywhere || options.smoothing < kSmooth};
    const int reach = reachOf(options.smoothing);
    const std::size_t tiles = cells.tiles.size();
    const double scale = 1.0 / frame.spacing;

    // Droplets and air. Droplets far from liquid have outlines of their own.
    std::vector<LongStamp> stamps;
    std::vector<std::optional<std::uint32_t>> owner;        // Sorted particle of each eraser.
    std::vector<float> water(frame.position.size(), 1.0F);  // Of each particle, as a part of the liquid.
    for (const Drop& drop : drops) {
        for (const std::uint32_t i : drop.members.indices) {
            water[i] = static_cast<float>(1.0 - drop.share);
        }
        if (drop.is_near) {
            LongStamp s;
            s.drop = &drop;
            s.scale = scale;
            s.share = drop.share;
            s.place = scale * drop.ellipse.centre;
            setBounds(s);
            stamps.push_back(s);
            owner.emplace_back();
        }
    }
    const std::vector<Claw> claws = clawsOf(state, frame, options);
    for (const Claw& claw : claws) {
        LongStamp finger;
        finger.drop = &claw.finger;
        finger.scale = scale;
        finger.share = 1.0;
        finger.place = scale * claw.finger.ellipse.centre;
        setBounds(finger);
        LongStamp hollow;
        hollow.is_dent = true;
        hollow.place = scale * claw.hollow;
        hollow.outer = kDentReach * scale * claw.hollow_radius;
        setBounds(hollow);
        for (const LongStamp& s : {finger, hollow}) {
            stamps.push_back(s);
            owner.emplace_back();
        }
    }
    for (const OpenHole& hole : openHoles(state, frame.spacing)) {
        LongStamp s;
        s.is_dent = true;
        s.place = scale * hole.centre;
        s.outer = kDentReach * std::max(scale * hole.radius, kLeastDent);
        setBounds(s);
        stamps.push_back(s);
        owner.emplace_back();
    }
    std::vector<char> is_long(cells.particle.size(), 0);
    std::vector<Vec2> without;  // Places of particles whose water is elsewhere, in spacings.
    for (std::uint32_t k = 0; k < cells.particle.size(); ++k) {
        const std::uint32_t i = cells.particle[k];
        if (water[i] < 1.0F) {
            is_long[k] = water[i] > 0.0F ? 0 : 1;
            without.push_back(scale * frame.position[i]);
            continue;
        }
        const double air = options.air > 0.0 ? state.air[frame.id[i]] : 0.0;
        if (!(air > 0.0)) {
            continue;
        }
        is_long[k] = 1;
        LongStamp s;
        s.place = scale * frame.position[i];
        s.support = std::max(bulkSupport(options.smoothing), 2.0 * kParticleRadius);
        s.inner = kParticleRadius * std::sqrt(air);
        s.outer = kParticleRadius * std::sqrt(air + 1.0);
        s.share = smoothRamp(air, 0.0, kEraserFade);
        setBounds(s);
        stamps.push_back(s);
        owner.emplace_back(k);
    }
    TileNumbers old_numbers;
    std::vector<std::uint64_t> opened(tiles, 0);
    if (!stamps.empty() || !without.empty()) {
        for (const TilePlace place : cells.tiles) {
            old_numbers.insert(place);
        }
    }
    const auto open = [&](Vec2 place, double r) {
        for (auto y = static_cast<std::int32_t>(std::floor(place.y - r)); y <= place.y + r; ++y) {
            for (auto x = static_cast<std::int32_t>(std::floor(place.x - r)); x <= place.x + r; ++x) {
                if (const auto t = old_numbers.find({x >> 3, y >> 3})) {
                    opened[*t] |= std::uint64_t{1} << static_cast<unsigned>((y & 7) * kTileSide + (x & 7));
                }
            }
        }
    };
    for (const LongStamp& s : stamps) {
        if (s.drop == nullptr) {
            open(s.place, std::max(s.outer, 0.5));
        }
    }
    for (const Vec2 place : without) {
        open(place, 0.5);
    }
    const Coverage coverage = coverageOf(cells, opened, field_options);
    for (std::size_t k = 0; k < stamps.size(); ++k) {
        if (owner[k]) {
            const KernelShape kernel =
                kernelShape(static_cast<double>(coverage.coverage[*owner[k]]), options.smoothing);
            stamps[k].support = kernel.support;
            stamps[k].weight = kernel.weight;
            setBounds(stamps[k]);
        }
    }

    std::vector<std::uint8_t> has_rim(tiles, 0);
    forBlocks(
        tiles,
        [&](std::size_t b, std::size_t e) {
            for (std::size_t t = b; t < e; ++t) {
                has_rim[t] = (~coverage.full[t] & dilated(rowsAround(cells, t, coverage.occupied), reach)) != 0;
            }
        },
        kTilesPerBlock);
    Field field;
    field.spacing = frame.spacing;
    field.nodes_per_cell = field_options.nodes_per_cell;
    TileNumbers numbers;
    std::vector<std::int32_t> source;  // Tile of particles, or kNone.
    for (std::size_t t = 0; t < tiles; ++t) {
        if (has_rim[t] != 0) {
            numbers.insert(cells.tiles[t]);
            field.tiles.push_back(cells.tiles[t]);
            source.push_back(static_cast<std::int32_t>(t));
        }
    }
    std::vector<Touching> touching;
    for (std::uint32_t k = 0; k < stamps.size(); ++k) {
        const TilePlace a = tileOf(stamps[k].lower - Vec2{1.0, 1.0});
        const TilePlace b = tileOf(stamps[k].upper + Vec2{1.0, 1.0});
        for (std::int32_t y = a.y; y <= b.y; ++y) {
            for (std::int32_t x = a.x; x <= b.x; ++x) {
                const std::uint32_t tile = numbers.insert({x, y});
                if (tile == field.tiles.size()) {
                    field.tiles.push_back({x, y});
                    const auto old = old_numbers.find({x, y});
                    source.push_back(old ? static_cast<std::int32_t>(*old) : ParticleCells::kNone);
                }
                touching.push_back({tile, k});
            }
        }
    }
    std::stable_sort(touching.begin(), touching.end(),
                     [](const Touching& a, const Touching& b) { return a.tile < b.tile; });

    const std::size_t count = field.tiles.size();
    field.around.resize(count);
    field.values.assign(count * field.nodes(), 0.0F);
    forBlocks(
        count,
        [&](std::size_t b, std::size_t e) {
            for (std::size_t t = b; t < e; ++t) {
                for (int k = 0; k < 9; ++k) {
                    const auto other = numbers.find({field.tiles[t].x + k % 3 - 1, field.tiles[t].y + k / 3 - 1});
                    std::int32_t value = Field::kDry;
                    if (other) {
                        value = static_cast<std::int32_t>(*other);
                    } else if (source[t] >= 0) {
                        const std::int32_t s =
                            cells.around[static_cast<std::size_t>(source[t])][static_cast<std::size_t>(k)];
                        if (s >= 0 && coverage.full[static_cast<std::size_t>(s)] == ~std::uint64_t{0}) {
                            value = Field::kLiquid;
                        }
                    }
                    field.around[t][static_cast<std::size_t>(k)] = value;
                }
                float* values = field.values.data() + t * field.nodes();
                Tile tile(values, field.nodes_per_cell);
                if (source[t] >= 0) {
                    const auto s = static_cast<std::size_t>(source[t]);
                    cells.rows(
                        s, -reach, kTileSide - 1 + reach, -reach, kTileSide - 1 + reach,
                        [&](std::uint32_t first, std::uint32_t last, float dx, float dy) {
                            for (std::uint32_t i = first; i < last; ++i) {
                                const std::uint32_t p = cells.place[i];
                                if ((coverage.near[p / kTileCells] >> (p % kTileCells) & 1U) == 0 || is_long[i] != 0) {
                                    continue;
                                }
                                const KernelShape kernel =
                                    kernelShape(static_cast<double>(coverage.coverage[i]), options.smoothing);
                                tile.add({cells.x[i] + dx, cells.y[i] + dy, static_cast<float>(kernel.support),
                                          water[cells.particle[i]] * static_cast<float>(kernel.weight)});
                            }
                        });
                }
                const Vec2 corner{static_cast<double>(kTileSide) * field.tiles[t].x,
                                  static_cast<double>(kTileSide) * field.tiles[t].y};
                for (auto at = std::lower_bound(touching.begin(), touching.end(), t,
                                                [](const Touching&a, std::size_t n) { return a.tile < n; });
                     at != touching.end() && at->tile == t; ++at) {
                    tile.add(stamps[at->thing], corner);
                }
                // Cells that are surely liquid got a part of their sum.
                const int n = field.nodes_per_cell;
                const std::uint64_t full = source[t] >= 0 ? coverage.full[static_cast<std::size_t>(source[t])] : 0;
                for (int j = 0; full != 0 && j < field.side(); ++j) {
                    for (int i = 0; i < field.side(); ++i) {
                        if ((full >> static_cast<unsigned>(j / n * kTileSide + i / n) & 1U) != 0) {
                            values[j * field.side() + i] = 1.0F;
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
