// SPDX-License-Identifier: GPL-3.0-or-later
// "Expressive Rendering for 2D Animations of Liquids", sections 3 and 4. Departures: equation 5 in the usual order of
// Hermite's polynomials; the ring of an eraser stays below the surface's value, as the text says and the equation does
// not; fields of particles in bulk liquid are wider and lower than those of single droplets, so that the surface is
// smooth and both have the right area; the first air fades in.
#include "field.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "blocks.h"
#include "tails.h"

namespace droplet {
namespace {

/// Margin of an eraser's ring below the surface's value.
constexpr double kBelow = 0.02;

/// Air, in areas of a particle, over which a particle turns from water to an eraser.
constexpr double kFade = 0.25;

/// Integral of fall(r)·2πr over the disc, over the square of its radius: 2π(1/2 − 3/4 + 2/5).
constexpr double kDiscIntegral = 0.3 * std::numbers::pi;

/// Coverage from which a particle counts as bulk liquid: that on the flat surface of a lattice.
constexpr double kBulk = 0.82;

/// Part of the lattice's number of particles at which a tile without gaps is taken for full.
constexpr double kFull = 0.7;

/// Field of one particle.
struct Splat {
    Vec2 place;            ///< [m]
    double support = 0.0;  ///< [m]
    double weight = 0.0;
};

/// Part of a field that may be longer than a tile.
struct LongSplat {
    Tail tail;  ///< empty for an eraser
    Splat water;
    double inner = 0.0;  ///< of an eraser [m]
    double outer = 0.0;  ///< of an eraser [m]
    double share = 0.0;  ///< of the eraser; the rest is water
    Vec2 lower;          ///< bounds [m]
    Vec2 upper;          ///< [m]
};

/// Field of a single particle's water.
Splat splatOf(const ParticleFrame& frame, std::size_t i, double coverage, const ExpressionOptions& options)
{
    const double d = frame.spacing;
    const double alone = Surroundings::alone();
    const double t = std::clamp((coverage - alone) / (kBulk - alone), 0.0, 1.0);
    // The power gives clusters of 2 to 61 particles their areas within 8 %.
    const double bulk = t * t * t;
    // A disc of the support 2R has the area of radius R, where the field is one half.
    const double single = 2.0 * d / std::sqrt(std::numbers::pi);
    const double wide = (1.0 + options.smoothing) * single;
    Splat splat;
    splat.place = frame.position[i];
    splat.support = single + bulk * (wide - single);
    // In bulk, weights that sum to one; alone, a peak of one.
    const double summing = d * d / (kDiscIntegral * splat.support * splat.support);
    const double peak = kDiscIntegral * single * single / (d * d);
    splat.weight = summing * (peak + bulk * (1.0 - peak)) / std::max(coverage, 1.0);
    return splat;
}

/// Value of a tail at a point: that of its nearest part, relative to its width there.
double tailAt(const Tail& tail, const Splat& water, Vec2 point)
{
    double nearest = 1.0;
    for (std::size_t k = 0; k + 1 < tail.place.size(); ++k) {
        const Vec2 side = tail.place[k + 1] - tail.place[k];
        const Vec2 arm = point - tail.place[k];
        const double square = dot(side, side);
        const double along = square > 0.0 ? std::clamp(dot(arm, side) / square, 0.0, 1.0) : 0.0;
        const double width = water.support * (tail.width[k] + along * (tail.width[k + 1] - tail.width[k]));
        if (width > 0.0) {
            nearest = std::min(nearest, length(arm - along * side) / width);
        }
    }
    return water.weight * fall(nearest);
}

void setBounds(LongSplat& splat)
{
    const auto include = [&](Vec2 x, double reach) {
        splat.lower = {std::min(splat.lower.x, x.x - reach), std::min(splat.lower.y, x.y - reach)};
        splat.upper = {std::max(splat.upper.x, x.x + reach), std::max(splat.upper.y, x.y + reach)};
    };
    splat.lower = splat.upper = splat.water.place;
    include(splat.water.place, std::max(splat.water.support, splat.outer));
    for (std::size_t k = 0; k < splat.tail.place.size(); ++k) {
        include(splat.tail.place[k], splat.water.support * splat.tail.width[k]);
    }
}

}  // namespace

double eraser(double distance, double inner, double outer)
{
    const double ring = kIso - kBelow;
    if (distance < inner) {
        return ring - (1.0 + ring) * fall(distance / inner);
    }
    return ring * fall((distance - inner) / (outer - inner));
}

Field fieldOf(const ExpressionState& state, const ParticleFrame& frame, const ExpressionOptions& options)
{
    const std::size_t count = frame.position.size();
    Field field;
    if (count == 0) {
        return field;
    }
    const Surroundings around = surroundingsOf(frame);
    std::vector<Tail> tails = tailsOf(state, frame, options);
    const double radius = frame.spacing / std::sqrt(std::numbers::pi);

    std::vector<Splat> splats(count);
    std::vector<LongSplat> long_splats;
    double widest = 0.0;
    Vec2 lower = frame.position.front();
    Vec2 upper = lower;
    for (std::size_t i = 0; i < count; ++i) {
        splats[i] = splatOf(frame, i, around.coverage[i], options);
        const double air = options.air > 0.0 ? state.air[frame.id[i]] : 0.0;
        if (!tails[i].place.empty() || air > 0.0) {
            LongSplat splat;
            splat.tail = std::move(tails[i]);
            splat.water = splats[i];
            if (air > 0.0) {
                splat.tail = {};
                splat.inner = radius * std::sqrt(air);
                splat.outer = radius * std::sqrt(air + 1.0);
                const double t = std::min(air / kFade, 1.0);
                splat.share = t * t * (3.0 - 2.0 * t);
            }
            setBounds(splat);
            lower = {std::min(lower.x, splat.lower.x), std::min(lower.y, splat.lower.y)};
            upper = {std::max(upper.x, splat.upper.x), std::max(upper.y, splat.upper.y)};
            long_splats.push_back(std::move(splat));
            splats[i].weight = 0.0;
        }
        widest = std::max(widest, splats[i].support);
        lower = {std::min(lower.x, frame.position[i].x), std::min(lower.y, frame.position[i].y)};
        upper = {std::max(upper.x, frame.position[i].x), std::max(upper.y, frame.position[i].y)};
    }

    field.step = options.resolution * frame.spacing;
    field.side = static_cast<int>(std::ceil(widest / field.step)) + 1;
    const double tile = field.side * field.step;
    // A whole number of tiles from zero, so that nodes stay where they are from frame to frame.
    field.origin = {tile * (std::floor(lower.x / tile) - 1.0), tile * (std::floor(lower.y / tile) - 1.0)};
    field.columns = static_cast<int>(std::floor((upper.x - field.origin.x) / tile)) + 2;
    field.rows = static_cast<int>(std::floor((upper.y - field.origin.y) / tile)) + 2;
    // The upper corner of the grid lies half a tile inside of the last one, so that the number of tiles is certain.
    CellGrid cells(field.origin, field.origin + Vec2{tile * (field.columns - 0.5), tile * (field.rows - 0.5)}, tile);
    const std::vector<std::uint32_t> order = cells.sort(frame.position);
    std::vector<Splat> sorted(order.size());
    for (std::size_t k = 0; k < order.size(); ++k) {
        sorted[k] = splats[order[k]];
    }

    // Tiles that long splats touch, in order.
    std::vector<std::pair<std::size_t, std::uint32_t>> touched;
    const auto index_of = [&](int column, int row) {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(field.columns) +
               static_cast<std::size_t>(column);
    };
    for (std::uint32_t k = 0; k < long_splats.size(); ++k) {
        const LongSplat& splat = long_splats[k];
        for (int row = std::max(cells.row(splat.lower.y), 0); row <= std::min(cells.row(splat.upper.y), field.rows - 1);
             ++row) {
            for (int column = std::max(cells.column(splat.lower.x), 0);
                 column <= std::min(cells.column(splat.upper.x), field.columns - 1); ++column) {
                touched.emplace_back(index_of(column, row), k);
            }
        }
    }
    std::sort(touched.begin(), touched.end());

    const double full = kFull * tile * tile / (frame.spacing * frame.spacing);
    const auto occupancy = [&](int column, int row) {
        const auto [first, last] = cells.range(row, column, column);
        return last - first;
    };
    field.tile.assign(index_of(0, field.rows), Field::kOutside);
    std::vector<std::pair<int, int>> computed;
    for (int row = 0; row < field.rows; ++row) {
        for (int column = 0; column < field.columns; ++column) {
            bool is_near = false;
            bool is_deep = true;
            for (int r = row - 1; r <= row + 1; ++r) {
                for (int c = column - 1; c <= column + 1; ++c) {
                    const std::uint32_t particles = occupancy(c, r);
                    is_near = is_near || particles > 0;
                    is_deep = is_deep && particles >= full;
                }
            }
            const std::size_t index = index_of(column, row);
            const auto splat = std::lower_bound(touched.begin(), touched.end(), std::pair{index, std::uint32_t{0}});
            const bool is_touched = splat != touched.end() && splat->first == index;
            if (is_deep && !is_touched) {
                field.tile[index] = Field::kInside;
            } else if (is_near || is_touched) {
                field.tile[index] = static_cast<std::int32_t>(computed.size());
                computed.emplace_back(column, row);
            }
        }
    }

    const auto side = static_cast<std::size_t>(field.side);
    field.values.resize(computed.size() * side * side);
    forBlocks(
        computed.size(),
        [&](std::size_t begin, std::size_t end) {
            for (std::size_t t = begin; t < end; ++t) {
                const auto [column, row] = computed[t];
                float* const values = field.values.data() + t * side * side;
                const Vec2 corner = field.origin + Vec2{tile * column, tile * row};
                for (int r = row - 1; r <= row + 1; ++r) {
                    const auto [first, last] = cells.range(r, column - 1, column + 1);
                    for (std::uint32_t k = first; k < last; ++k) {
                        const Splat& splat = sorted[k];
                        const Vec2 at = splat.place - corner;
                        const double inverse = 1.0 / field.step;
                        const int x0 = std::max(static_cast<int>(std::ceil((at.x - splat.support) * inverse)), 0);
                        const int x1 =
                            std::min(static_cast<int>(std::floor((at.x + splat.support) * inverse)), field.side - 1);
                        const int y0 = std::max(static_cast<int>(std::ceil((at.y - splat.support) * inverse)), 0);
                        const int y1 =
                            std::min(static_cast<int>(std::floor((at.y + splat.support) * inverse)), field.side - 1);
                        const auto scale = static_cast<float>(1.0 / (splat.support * splat.support));
                        const auto weight = static_cast<float>(splat.weight);
                        for (int y = y0; y <= y1; ++y) {
                            const auto dy = static_cast<float>(y * field.step - at.y);
                            float* const line = values + static_cast<std::size_t>(y) * side;
                            for (int x = x0; x <= x1; ++x) {
                                const auto dx = static_cast<float>(x * field.step - at.x);
                                const float square = (dx * dx + dy * dy) * scale;
                                if (square < 1.0F) {
                                    line[x] += weight * (1.0F - square * (3.0F - 2.0F * std::sqrt(square)));
                                }
                            }
                        }
                    }
                }
                const std::size_t index = index_of(column, row);
                for (auto at = std::lower_bound(touched.begin(), touched.end(), std::pair{index, std::uint32_t{0}});
                     at != touched.end() && at->first == index; ++at) {
                    const LongSplat& splat = long_splats[at->second];
                    for (std::size_t n = 0; n < side * side; ++n) {
                        const Vec2 point = corner + Vec2{field.step * static_cast<double>(n % side),
                                                         field.step * static_cast<double>(n / side)};
                        double value = 0.0;
                        if (!splat.tail.place.empty()) {
                            value = tailAt(splat.tail, splat.water, point);
                        } else {
                            const double distance = length(point - splat.water.place);
                            value = (1.0 - splat.share) * splat.water.weight * fall(distance / splat.water.support) +
                                    splat.share * eraser(distance, splat.inner, splat.outer);
                        }
                        values[n] += static_cast<float>(value);
                    }
                }
            }
        },
        16);
    return field;
}

}  // namespace droplet
