// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "view/eye.h"
#include "view/glass_frame.h"
#include "view/still_map.h"

namespace droplet {

/// [px] a side: what a thread works on at a time; its light stays in the first cache.
inline constexpr int kTile = 16;
inline constexpr std::size_t kTilePixels = std::size_t{kTile} * kTile;
static_assert(kTilePixels == 256, "a pixel's number in its tile is a byte");

/// A pixel's number in its tile.
inline std::uint8_t pixelInTile(int x, int y)
{
    return static_cast<std::uint8_t>((y % kTile) * kTile + x % kTile);
}

/// A square of the frame, and the glass that is seen through it.
struct ViewTile {
    bool on_glass = false;
    GlassFrame frame;    ///< of the glass in its middle
    Vec2f right;         ///< on the glass, a pixel to the right [m]
    Vec2f down;          ///< and one down
    float pixel = 0.0F;  ///< side of a square as large as a pixel's image on the glass [m]
    Vec2f low;           ///< box of what is seen of the glass [m]
    Vec2f high;
};

/// The frame's tiles, row by row.
class Tiles {
public:
    /// @throws Error InvalidArgument: nothing of the glass is seen
    Tiles(const Eye& eye, const Glass& glass, const ViewOptions& options);

    [[nodiscard]] int columns() const { return columns_; }
    [[nodiscard]] int rows() const { return rows_; }
    [[nodiscard]] std::size_t count() const { return tiles_.size(); }
    [[nodiscard]] std::size_t number(int column, int row) const
    {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column);
    }
    [[nodiscard]] const ViewTile& operator[](std::size_t number) const { return tiles_[number]; }

    /// The part of the glass that is seen, and texels for it.
    [[nodiscard]] const MapWindow& window() const { return window_; }

private:
    int columns_;
    int rows_;
    std::vector<ViewTile> tiles_;
    MapWindow window_;
};

}  // namespace droplet
