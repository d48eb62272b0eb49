// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "droplet/picture/picture.h"

namespace droplet {

/// A picture of a contact sheet and the words below it.
struct Tile {
    Picture picture;
    std::string
        caption;  ///< one line; shortened by an ellipsis where too long, `?` for characters that cannot be drawn
};

/// How tiles are put on a sheet.
struct ContactSheetOptions {
    std::optional<int> columns = {};  ///< ≥ 1; empty: as many as make the sheet about 4 : 3
    int tile_width = 320;   ///< of the pictures, shrunk into it; smaller where max_side asks it [px] 16 … 4096
    int tile_height = 240;  ///< [px] 16 … 4096
    int max_side = 8192;    ///< neither side of the sheet is longer [px] 256 … 16384

    /// @throws Error InvalidArgument
    void validate() const;
};

/// The size at which that many tiles are shown on a sheet: tile_width and tile_height, or less where max_side asks it.
/// Pictures drawn at that size are not shrunk.
struct TileSize {
    int width = 0;   ///< [px]
    int height = 0;  ///< [px]
};

/// @param tiles   at least one
/// @throws Error  InvalidArgument; also where so many tiles would be smaller than 16 pixels
TileSize tileSize(std::size_t tiles, const ContactSheetOptions& options = {});

/// Pictures in a grid, row by row in the order given, each with its caption.
///
/// Guarantees: the same tiles give the same picture. Pictures keep their aspect and are never enlarged.
/// @param tiles    at least one
/// @param options  columns, sizes
/// @throws Error   InvalidArgument; also where so many tiles would be smaller than 16 pixels
Picture contactSheet(const std::vector<Tile>& tiles, const ContactSheetOptions& options = {});

}  // namespace droplet
