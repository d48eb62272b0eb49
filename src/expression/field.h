// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "droplet/expression/expression.h"
#include "surroundings.h"

namespace droplet {

/// Value of the field on the liquid's surface.
inline constexpr double kIso = 0.5;

/// Fall of a field from 1 at 0 to 0 at 1, with zero slopes: ½ at ½.
constexpr double fall(double t)
{
    return t < 1.0 ? 1.0 - t * t * (3.0 - 2.0 * t) : 0.0;
}

/// Field of a particle that holds air: below zero in the middle, and just below the surface's value on a ring.
/// @param distance   [m]
/// @param inner      radius of the air [m], > 0
/// @param outer      radius of air and water [m], > inner
double eraser(double distance, double inner, double outer);

/// Field around particles, on the nodes of a square grid of which only the tiles near the surface are computed.
struct Field {
    double step = 0.0;               ///< distance of nodes [m]
    Vec2 origin;                     ///< of node (0, 0) [m]
    int side = 0;                    ///< nodes along a tile
    int columns = 0;                 ///< of tiles
    int rows = 0;                    ///< of tiles
    std::vector<std::int32_t> tile;  ///< index of the tile's values; kOutside or kInside without any
    std::vector<float> values;       ///< of the computed tiles, row by row

    static constexpr std::int32_t kOutside = -1;  ///< all zero
    static constexpr std::int32_t kInside = -2;   ///< all liquid

    [[nodiscard]] std::int32_t tileAt(int column, int row) const
    {
        return column < 0 || row < 0 || column >= columns || row >= rows
                   ? kOutside
                   : tile[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                          static_cast<std::size_t>(column)];
    }
    /// Value at a node.
    [[nodiscard]] float at(int x, int y) const
    {
        const std::int32_t index = tileAt(x / side, y / side);
        if (index < 0) {
            return index == kInside ? 1.0F : 0.0F;
        }
        const auto n = static_cast<std::size_t>(side);
        return values[(static_cast<std::size_t>(index) * n + static_cast<std::size_t>(y % side)) * n +
                      static_cast<std::size_t>(x % side)];
    }
};

/// Field around the particles of a frame.
Field fieldOf(const ExpressionState& state, const ParticleFrame& frame, const ExpressionOptions& options);

}  // namespace droplet
