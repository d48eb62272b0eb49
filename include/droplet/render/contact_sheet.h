// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "droplet/drawing/picture.h"

namespace droplet {

/// Picture with a caption.
struct Tile {
    Picture picture;      ///< valid
    std::string caption;  ///< one line; shortened with an ellipsis if too long; `?` replaces unknown characters
};

/// Layout of a contact sheet.
struct ContactSheetOptions {
    std::optional<int> columns = {};  ///< ≥ 1; empty: chosen for a sheet of about 4 : 3
    int tile_width = 320;             ///< pictures shrink to fit; smaller if max_side requires it [px] 16 … 4096
    int tile_height = 240;            ///< likewise [px] 16 … 4096
    int max_side = 8192;              ///< maximum width and height of the sheet [px] 256 … 16384

    /// @throws Error InvalidArgument
    void validate() const;
};

/// Size of a tile's picture on the sheet.
struct TileSize {
    int width = 0;   ///< [px]
    int height = 0;  ///< [px]
};

/// Tile size on a sheet: tile_width and tile_height, or less if max_side requires it. Pictures of this size are not
/// shrunk.
/// @param tiles    number of tiles, at least 1
/// @param options  layout
/// @throws Error   InvalidArgument; also if tiles would be smaller than 16 pixels
TileSize tileSize(std::size_t tiles, const ContactSheetOptions& options = {});

/// Draws pictures in a grid, row by row in the order given, each with its caption.
///
/// Guarantees: the same tiles give the same picture. Pictures keep their aspect and are never enlarged.
/// @param tiles    at least one
/// @param options  layout
/// @throws Error   InvalidArgument; also if tiles would be smaller than 16 pixels
Picture contactSheet(const std::vector<Tile>& tiles, const ContactSheetOptions& options = {});

}  // namespace droplet
