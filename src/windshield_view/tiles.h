// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "windshield_view/eye.h"
#include "windshield_view/glass_frame.h"
#include "windshield_view/still_map.h"

namespace droplet {

/// Side of a tile [px]. A thread works on one tile at a time; its light fits into the first cache.
inline constexpr int kTile = 16;
inline constexpr std::size_t kTilePixels = std::size_t{kTile} * kTile;
static_assert(kTilePixels == 256, "the index of a pixel in its tile must fit into a byte");

/// Index of a pixel in its tile.
inline std::uint8_t pixelInTile(int x, int y)
{
    return static_cast<std::uint8_t>((y % kTile) * kTile + x % kTile);
}

/// Square part of the frame, and the glass that is seen through it.
struct ViewTile {
    bool on_glass = false;
    GlassFrame frame;    ///< axes of the glass in the tile's middle
    Vec2f right;         ///< step on the glass of a pixel to the right [m]
    Vec2f down;          ///< step on the glass of a pixel down [m]
    float pixel = 0.0F;  ///< side of a square with the area of a pixel's image on the glass [m]
    Vec2f low;           ///< lower left corner of the visible part of the glass [m]
    Vec2f high;          ///< upper right corner of the visible part of the glass [m]
};

/// Tiles of the frame, row by row.
class Tiles {
public:
    /// @throws Error InvalidArgument if the eye sees nothing of the glass
    Tiles(const Eye& eye, const Glass& glass, const ViewOptions& options);

    [[nodiscard]] int columns() const { return columns_; }
    [[nodiscard]] int rows() const { return rows_; }
    [[nodiscard]] std::size_t count() const { return tiles_.size(); }
    [[nodiscard]] std::size_t number(int column, int row) const
    {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column);
    }
    [[nodiscard]] const ViewTile& operator[](std::size_t number) const { return tiles_[number]; }

    /// Visible part of the glass, with the size of its texels.
    [[nodiscard]] const MapWindow& window() const { return window_; }

private:
    int columns_;
    int rows_;
    std::vector<ViewTile> tiles_;
    MapWindow window_;
};

}  // namespace droplet
