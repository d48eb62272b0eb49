// SPDX-License-Identifier: GPL-3.0-or-later
#include "isoline.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "blocks.h"
#include "plain_length.h"
#include "surface_kernel.h"

namespace droplet {
namespace {

constexpr std::uint32_t kNoVertex = 0xFFFFFFFFU;
/// Vertices keep this distance from nodes, so that loops do not touch.
constexpr double kMargin = 0.001;
/// Loops with half this width are thin: tails, for which the grid is coarse [spacings].
constexpr double kThin = 0.35;

/// Vertex of a loop on an edge between two nodes. In cells.
struct Cut {
    Vec2 corner{};    ///< the left or lower node
    double at = 0.0;  ///< along the edge
    bool up = false;  ///< whether the edge is upright
    [[nodiscard]] Vec2 place() const { return up ? Vec2{corner.x, corner.y + at} : Vec2{corner.x + at, corner.y}; }
};

/// Points of a loop with the area of the curve through its vertices: chords cut off a part of it. Vertices move along
/// their edges alone, so that loops still do not cross.
/// @param thin  twice the area over the length of loops, in cells, that are too thin for that
std::vector<Vec2> withoutChordLoss(const std::vector<Cut>& cuts, double scale, double thin)
{
    double area = 0.0;
    double around = 0.0;
    for (std::size_t k = 0; k < cuts.size(); ++k) {
        const Vec2 a = cuts[k].place();
        const Vec2 b = cuts[k + 1 == cuts.size() ? 0 : k + 1].place();
        area += 0.5 * cross(a - cuts[0].place(), b - cuts[0].place());
        around += plainLength(b - a);
    }
    const double share = smoothRamp(2.0 * std::abs(area) / around, thin, 1.5 * thin);
    std::vector<Vec2> points(cuts.size());
    for (std::size_t k = 0; k < cuts.size(); ++k) {
        const Vec2 before = cuts[k == 0 ? cuts.size() - 1 : k - 1].place();
        const Vec2 after = cuts[k + 1 == cuts.size() ? 0 : k + 1].place();
        Cut cut = cuts[k];
        const Vec2 chord = after - before;
        const double size = plainLength(chord);
        const Vec2 outwards = size > 0.0 ? Vec2{chord.y / size, -chord.x / size} : Vec2{};
        const double along = cut.up ? outwards.y : outwards.x;
        // At a sharp turn, of more than 45°, no arc fits.
        const Vec2 in = cut.place() - before;
        const Vec2 out = after - cut.place();
        if (std::abs(along) > 0.3 && dot(in, out) > std::abs(cross(in, out))) {
            // Two thirds of the height of the arcs beside the vertex, by the arc through three points.
            const Vec2 p = cut.place();
            const double a = plainLength(p - before);
            const double b = plainLength(after - p);
            const double height = dot(p - before, outwards);
            const double mean = a * b > 0.0 ? (a * a + b * b) / (12.0 * a * b) * height : 0.0;
            cut.at = std::clamp(cut.at + share * mean / along, kMargin, 1.0 - kMargin);
        }
        points[k] = scale * cut.place();
    }
    return points;
}

/// Values of a tile's nodes with a row of the next tiles above and to the right.
class Patch {
public:
    Patch(const Field& field, std::size_t tile) : side_(field.side()), stride_(side_ + 1)
    {
        values_.resize(static_cast<std::size_t>(stride_) * static_cast<std::size_t>(stride_));
        for (int j = 0; j <= side_; ++j) {
            for (int i = 0; i <= side_; ++i) {
                const int k = 4 + (i == side_ ? 1 : 0) + (j == side_ ? 3 : 0);
                const std::int32_t t = field.around[tile][static_cast<std::size_t>(k)];
                float value = t == Field::kLiquid ? 1.0F : 0.0F;
                if (t >= 0) {
                    value = field.values[static_cast<std::size_t>(t) * field.nodes() +
                                         indexOf((j == side_ ? 0 : j) * side_ + (i == side_ ? 0 : i))];
                }
                values_[indexOf(j * stride_ + i)] = value;
            }
        }
    }
    [[nodiscard]] float at(int i, int j) const { return values_[indexOf(j * stride_ + i)]; }
    [[nodiscard]] bool inside(int i, int j) const { return at(i, j) > kIsoValue; }

private:
    int side_, stride_;
    std::vector<float> values_;
};

}  // namespace

std::vector<Loop> isolines(const Field& field)
{
    const std::size_t tiles = field.tiles.size();
    const int side = field.side();
    const std::size_t edges = 2 * field.nodes();
    std::vector<std::uint32_t> vertex_of(tiles * edges, kNoVertex);
    std::vector<std::uint32_t> first(tiles + 1, 0);
    std::vector<std::vector<Cut>> points(tiles);
    forBlocks(
        tiles,
        [&](std::size_t b, std::size_t e) {
            for (std::size_t t = b; t < e; ++t) {
                const Patch patch(field, t);
                const auto cut = [](float a, float c) {
                    return std::clamp(static_cast<double>((kIsoValue - a) / (c - a)), kMargin, 1.0 - kMargin);
                };
                for (int j = 0; j < side; ++j) {
                    for (int i = 0; i < side; ++i) {
                        const bool in = patch.inside(i, j);
                        const Vec2 corner{static_cast<double>(i), static_cast<double>(j)};
                        const std::size_t node = t * edges + 2 * indexOf(j * side + i);
                        if (in != patch.inside(i + 1, j)) {
                            vertex_of[node] = static_cast<std::uint32_t>(points[t].size());
                            points[t].push_back({corner, cut(patch.at(i, j), patch.at(i + 1, j)), false});
                        }
                        if (in != patch.inside(i, j + 1)) {
                            vertex_of[node + 1] = static_cast<std::uint32_t>(points[t].size());
                            points[t].push_back({corner, cut(patch.at(i, j), patch.at(i, j + 1)), true});
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
    std::vector<Cut> place(first.back());
    std::vector<std::uint32_t> next(first.back(), kNoVertex);
    forBlocks(
        tiles,
        [&](std::size_t b, std::size_t e) {
            for (std::size_t t = b; t < e; ++t) {
                for (std::size_t k = 0; k < points[t].size(); ++k) {
                    Cut cut = points[t][k];
                    cut.corner = cut.corner + Vec2{static_cast<double>(side) * field.tiles[t].x,
                                                   static_cast<double>(side) * field.tiles[t].y};
                    place[first[t] + k] = cut;
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
                            const auto k = indexOf(4 + (x == side ? 1 : 0) + (y == side ? 3 : 0));
                            const std::int32_t owner = field.around[t][k];
                            const std::size_t node =
                                static_cast<std::size_t>(owner) * edges + 2 * indexOf(y % side * side + x % side);
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

    const double cell = field.spacing / field.nodes_per_cell;
    std::vector<Loop> loops;
    std::vector<Cut> cuts;
    for (std::uint32_t start = 0; start < next.size(); ++start) {
        cuts.clear();
        std::uint32_t at = start;
        while (at != kNoVertex && next[at] != kNoVertex) {
            cuts.push_back(place[at]);
            at = std::exchange(next[at], kNoVertex);
        }
        if (at == start && cuts.size() >= 3) {
            loops.push_back({withoutChordLoss(cuts, cell, kThin * field.nodes_per_cell),
                             std::vector<std::uint8_t>(cuts.size(), 0)});
        }
    }
    return loops;
}

}  // namespace droplet
