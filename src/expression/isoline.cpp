// SPDX-License-Identifier: GPL-3.0-or-later
// Lorensen, Cline: Marching cubes. SIGGRAPH 1987, in the plane.
#include "isoline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "blocks.h"

namespace droplet {
namespace {

/// Sides of a square.
enum Side : std::uint8_t { kBottom, kRight, kTop, kLeft };

/// Line through a square from one side to another, inside on its left.
struct Cut {
    Side from;
    Side to;
};

/// Cuts of a square by its corners inside: 1 lower left, 2 lower right, 4 upper right, 8 upper left. Diagonals are
/// connected.
constexpr std::array<std::array<Cut, 2>, 16> kCuts{{
    {{}},
    {{{kBottom, kLeft}}},
    {{{kRight, kBottom}}},
    {{{kRight, kLeft}}},
    {{{kTop, kRight}}},
    {{{kBottom, kRight}, {kTop, kLeft}}},
    {{{kTop, kBottom}}},
    {{{kTop, kLeft}}},
    {{{kLeft, kTop}}},
    {{{kBottom, kTop}}},
    {{{kLeft, kBottom}, {kRight, kTop}}},
    {{{kRight, kTop}}},
    {{{kLeft, kRight}}},
    {{{kBottom, kRight}}},
    {{{kLeft, kBottom}}},
    {{}},
}};
/// Cuts of diagonals that are not connected.
constexpr std::array<Cut, 2> kApartRising{{{kBottom, kLeft}, {kTop, kRight}}};
constexpr std::array<Cut, 2> kApartFalling{{{kRight, kBottom}, {kLeft, kTop}}};

constexpr int numberOfCuts(unsigned corners)
{
    return corners == 0 || corners == 15 ? 0 : (corners == 5 || corners == 10 ? 2 : 1);
}

/// Piece of a line between two sides of the grid's squares.
struct Piece {
    std::uint64_t from;
    std::uint64_t to;
    Vec2 point;  ///< on `from`
};

class Tracer {
public:
    explicit Tracer(const Field& field) : field_(field) {}

    /// Pieces in the squares whose lower left node is in a tile.
    void trace(int column, int row, std::vector<Piece>& pieces) const
    {
        const bool is_computed = field_.tileAt(column, row) >= 0;
        if (!is_computed && field_.tileAt(column + 1, row) < 0 && field_.tileAt(column, row + 1) < 0 &&
            field_.tileAt(column + 1, row + 1) < 0) {
            return;
        }
        for (int j = 0; j < field_.side; ++j) {
            for (int i = 0; i < field_.side; ++i) {
                // Without values of its own, a tile meets others in its last row and column alone.
                if (is_computed || i + 1 == field_.side || j + 1 == field_.side) {
                    traceSquare(column * field_.side + i, row * field_.side + j, pieces);
                }
            }
        }
    }

private:
    void traceSquare(int x, int y, std::vector<Piece>& pieces) const
    {
        const std::array<float, 4> value{field_.at(x, y), field_.at(x + 1, y), field_.at(x + 1, y + 1),
                                         field_.at(x, y + 1)};
        unsigned corners = 0;
        for (unsigned k = 0; k < 4; ++k) {
            corners |= value[k] >= static_cast<float>(kIso) ? 1U << k : 0U;
        }
        const int cuts = numberOfCuts(corners);
        if (cuts == 0) {
            return;
        }
        const bool is_connected = value[0] + value[1] + value[2] + value[3] >= static_cast<float>(4.0 * kIso);
        for (int k = 0; k < cuts; ++k) {
            const auto& all =
                cuts == 2 && !is_connected ? (corners == 5 ? kApartRising : kApartFalling) : kCuts[corners];
            const Cut cut = all[static_cast<std::size_t>(k)];
            pieces.push_back({key(x, y, cut.from), key(x, y, cut.to), point(x, y, cut.from, value)});
        }
    }

    [[nodiscard]] std::uint64_t key(int x, int y, Side side) const
    {
        const auto columns = static_cast<std::uint64_t>(field_.columns + 1) * static_cast<std::uint64_t>(field_.side);
        const auto node = [&](int i, int j) {
            return static_cast<std::uint64_t>(j) * columns + static_cast<std::uint64_t>(i);
        };
        switch (side) {
            case kBottom:
                return 2 * node(x, y);
            case kTop:
                return 2 * node(x, y + 1);
            case kLeft:
                return 2 * node(x, y) + 1;
            default:
                return 2 * node(x + 1, y) + 1;
        }
    }

    [[nodiscard]] Vec2 point(int x, int y, Side side, const std::array<float, 4>& value) const
    {
        // From the node with the smaller coordinates, so that both squares of a side get the same point.
        const auto crossing = [](float a, float b) {
            // Away from nodes, so that no two points are equal.
            return std::clamp((kIso - double{a}) / (double{b} - double{a}), 1e-3, 1.0 - 1e-3);
        };
        double u = 0.0;
        double v = 0.0;
        switch (side) {
            case kBottom:
                u = crossing(value[0], value[1]);
                break;
            case kTop:
                u = crossing(value[3], value[2]);
                v = 1.0;
                break;
            case kLeft:
                v = crossing(value[0], value[3]);
                break;
            default:
                v = crossing(value[1], value[2]);
                u = 1.0;
                break;
        }
        return field_.origin + field_.step * Vec2{x + u, y + v};
    }

    const Field& field_;
};

}  // namespace

std::vector<Loop> isolines(const Field& field)
{
    const Tracer tracer(field);
    const auto found = mapBlocks<std::vector<Piece>>(
        static_cast<std::size_t>(field.rows),
        [&](std::size_t begin, std::size_t end) {
            std::vector<Piece> pieces;
            for (std::size_t row = begin; row < end; ++row) {
                for (int column = 0; column < field.columns; ++column) {
                    tracer.trace(column, static_cast<int>(row), pieces);
                }
            }
            return pieces;
        },
        2);
    std::vector<Piece> pieces;
    for (const std::vector<Piece>& block : found) {
        pieces.insert(pieces.end(), block.begin(), block.end());
    }
    std::sort(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) { return a.from < b.from; });
    std::vector<std::uint8_t> is_used(pieces.size());
    std::vector<Loop> loops;
    for (std::size_t start = 0; start < pieces.size(); ++start) {
        if (is_used[start] != 0) {
            continue;
        }
        Loop loop;
        for (std::size_t k = start; is_used[k] == 0;) {
            is_used[k] = 1;
            loop.points.push_back(pieces[k].point);
            k = static_cast<std::size_t>(
                std::lower_bound(pieces.begin(), pieces.end(), pieces[k].to,
                                 [](const Piece& piece, std::uint64_t from) { return piece.from < from; }) -
                pieces.begin());
        }
        loop.corner.resize(loop.points.size());
        loops.push_back(std::move(loop));
    }
    return loops;
}

}  // namespace droplet
