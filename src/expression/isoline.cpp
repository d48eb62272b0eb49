// SPDX-License-Identifier: GPL-3.0-or-later
#include "isoline.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "blocks.h"
#include "surface_kernel.h"

namespace droplet {
namespace {

constexpr std::uint32_t kNoVertex = 0xFFFFFFFFU;

/// Values of a tile's nodes with a row of the next tiles above and to the right.
class Patch {
public:
    Patch(const SurfaceField& field, std::size_t tile) : side_(field.side()), stride_(side_ + 1)
    {
        values_.resize(static_cast<std::size_t>(stride_) * static_cast<std::size_t>(stride_));
        for (int j = 0; j <= side_; ++j) {
            for (int i = 0; i <= side_; ++i) {
                const int k = 4 + (i == side_ ? 1 : 0) + (j == side_ ? 3 : 0);
                const std::int32_t t = field.around[tile][static_cast<std::size_t>(k)];
                float value = t == SurfaceField::kLiquid ? 1.0F : 0.0F;
                if (t >= 0) {
                    value = field.values[static_cast<std::size_t>(t) * field.nodes() +
                                         static_cast<std::size_t>(j % side_ * side_ + i % side_)];
                }
                values_[static_cast<std::size_t>(j * stride_ + i)] = value;
            }
        }
    }
    [[nodiscard]] float at(int i, int j) const { return values_[static_cast<std::size_t>(j * stride_ + i)]; }
    [[nodiscard]] bool inside(int i, int j) const { return at(i, j) > kIsoValue; }

private:
    int side_, stride_;
    std::vector<float> values_;
};

}  // namespace

std::vector<Loop> isolines(const SurfaceField& field, double spacing)
{
    const std::size_t tiles = field.tiles.size();
    const int side = field.side();
    const std::size_t edges = 2 * field.nodes();
    std::vector<std::uint32_t> vertex_of(tiles * edges, kNoVertex);
    std::vector<std::uint32_t> first(tiles + 1, 0);
    std::vector<std::vector<Vec2>> points(tiles);
    forBlocks(
        tiles,
        [&](std::size_t b, std::size_t e) {
            for (std::size_t t = b; t < e; ++t) {
                const Patch patch(field, t);
                const auto cut = [](float a, float c) {
                    return static_cast<double>(std::clamp((kIsoValue - a) / (c - a), 0.001F, 0.999F));
                };
                for (int j = 0; j < side; ++j) {
                    for (int i = 0; i < side; ++i) {
                        const bool in = patch.inside(i, j);
                        const std::size_t node = t * edges + 2 * static_cast<std::size_t>(j * side + i);
                        if (in != patch.inside(i + 1, j)) {
                            vertex_of[node] = static_cast<std::uint32_t>(points[t].size());
                            points[t].push_back({i + cut(patch.at(i, j), patch.at(i + 1, j)), static_cast<double>(j)});
                        }
                        if (in != patch.inside(i, j + 1)) {
                            vertex_of[node + 1] = static_cast<std::uint32_t>(points[t].size());
                            points[t].push_back({static_cast<double>(i), j + cut(patch.at(i, j), patch.at(i, j + 1))});
                        }
                    }
                }
                first[t + 1] = static_cast<std::uint32_t>(points[t].size());
            }
        },
        16);
    for (std::size_t t = 0; t < tiles; ++t) {
        first[t + 1] += first[t];
    }
    std::vector<Vec2> place(first.back());
    std::vector<std::uint32_t> next(first.back(), kNoVertex);
    forBlocks(
        tiles,
        [&](std::size_t b, std::size_t e) {
            for (std::size_t t = b; t < e; ++t) {
                for (std::size_t k = 0; k < points[t].size(); ++k) {
                    const double cell = spacing / field.nodes_per_cell;
                    place[first[t] + k] = {cell * (points[t][k].x + static_cast<double>(side) * field.tiles[t].x),
                                           cell * (points[t][k].y + static_cast<double>(side) * field.tiles[t].y)};
                }
                const Patch patch(field, t);
                for (int j = 0; j < side; ++j) {
                    for (int i = 0; i < side; ++i) {
                        const unsigned kind = (patch.inside(i, j) ? 1U : 0U) | (patch.inside(i + 1, j) ? 2U : 0U) |
                                              (patch.inside(i + 1, j + 1) ? 4U : 0U) |
                                              (patch.inside(i, j + 1) ? 8U : 0U);
                        if (kind == 0 || kind == 15) {
                            continue;
                        }
                        // Edges of the square: below, right, above, left.
                        const auto vertex = [&](unsigned edge) {
                            const int x = edge == 1 ? i + 1 : i;
                            const int y = edge == 2 ? j + 1 : j;
                            const auto k = static_cast<std::size_t>(4 + (x == side ? 1 : 0) + (y == side ? 3 : 0));
                            const std::int32_t owner = field.around[t][k];
                            const std::size_t node = static_cast<std::size_t>(owner) * edges +
                                                     2 * static_cast<std::size_t>(y % side * side + x % side);
                            return owner < 0 ? kNoVertex
                                             : first[static_cast<std::size_t>(owner)] + vertex_of[node + edge % 2];
                        };
                        const auto join = [&](unsigned from, unsigned to) {
                            const std::uint32_t a = vertex(from);
                            if (a != kNoVertex) {
                                next[a] = vertex(to);
                            }
                        };
                        const auto corner_in = [&](unsigned c) { return (kind >> (c % 4) & 1U) != 0; };
                        const float middle =
                            patch.at(i, j) + patch.at(i + 1, j) + patch.at(i, j + 1) + patch.at(i + 1, j + 1);
                        const bool joined = middle > 4.0F * kIsoValue;
                        for (unsigned from = 0; from < 4; ++from) {
                            if (!corner_in(from) || corner_in(from + 1)) {
                                continue;
                            }
                            // The line leaves where liquid lies before it, and ends at the next or the last such edge.
                            unsigned to = 0;
                            if (kind == 5 || kind == 10) {
                                to = joined ? from + 1 : from + 3;
                            } else {
                                to = from + 1;
                                while (corner_in(to) || !corner_in(to + 1)) {
                                    ++to;
                                }
                            }
                            join(from, to % 4);
                        }
                    }
                }
            }
        },
        16);

    std::vector<Loop> loops;
    for (std::uint32_t start = 0; start < next.size(); ++start) {
        if (next[start] == kNoVertex) {
            continue;
        }
        Loop loop;
        std::uint32_t at = start;
        while (at != kNoVertex && next[at] != kNoVertex) {
            loop.points.push_back(place[at]);
            at = std::exchange(next[at], kNoVertex);
        }
        if (at == start && loop.points.size() >= 3) {
            loop.corner.assign(loop.points.size(), 0);
            loops.push_back(std::move(loop));
        }
    }
    return loops;
}

}  // namespace droplet
