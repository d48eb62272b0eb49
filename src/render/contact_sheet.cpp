// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/render/contact_sheet.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "drawing/lettering.h"
#include "drawing/tone.h"
#include "droplet/error.h"
#include "require.h"

namespace droplet {
namespace {

constexpr int kMinTile = 16;  // [px]
constexpr std::array<std::uint8_t, 3> kPaper = {244, 243, 240};

struct Grid {
    int columns = 1;
    int rows = 1;
    int tile_width = 0;
    int tile_height = 0;
    int gap = 0;
    int caption = 0;  // height of a caption, with its gap

    [[nodiscard]] int width() const { return columns * (tile_width + gap) + gap; }
    [[nodiscard]] int height() const { return rows * (tile_height + caption + gap) + gap; }
};

Grid gridOf(std::size_t tiles, const ContactSheetOptions& options)
{
    const auto scaled = [&](int columns, double scale) {
        Grid grid;
        grid.columns = columns;
        grid.rows =
            static_cast<int>((tiles + static_cast<std::size_t>(columns) - 1) / static_cast<std::size_t>(columns));
        grid.tile_width = static_cast<int>(scale * options.tile_width);
        grid.tile_height = static_cast<int>(scale * options.tile_height);
        grid.gap = std::max(2, grid.tile_width / 24);
        grid.caption = grid.tile_width < 64 ? 0 : std::max(12, grid.tile_width / 12);
        return grid;
    };
    // With more columns the sheet would be wider than 4 : 3.
    int columns = 1;
    const int max = static_cast<int>(std::min<std::size_t>(tiles, 4096));
    while (!options.columns && columns < max &&
           3 * scaled(columns + 1, 1.0).width() <= 4 * scaled(columns, 1.0).height()) {
        ++columns;
    }
    double scale = 1.0;
    Grid grid = scaled(options.columns ? std::min(*options.columns, max) : columns, scale);
    while (std::max(grid.width(), grid.height()) > options.max_side) {
        scale *= 0.97;
        grid = scaled(grid.columns, scale);
        if (std::min(grid.tile_width, grid.tile_height) < kMinTile) {
            throw Error(ErrorCode::InvalidArgument,
                        std::to_string(tiles) +
                            " tiles do not fit on a sheet of options.max_side = " + std::to_string(options.max_side) +
                            " pixels: they would be smaller than " + std::to_string(kMinTile));
        }
    }
    return grid;
}

/// Shrinks a picture: every new pixel is the mean of the area it covers, in linear light.
Picture shrunk(const Picture& picture, int width, int height)
{
    if (width == picture.width && height == picture.height) {
        return picture;
    }
    const std::array<float, 256>& linear = displayLevels();
    struct Share {
        std::size_t at;
        float weight;
    };
    const auto shares = [](int pixel, int count, int of) {
        const double from = static_cast<double>(pixel) * of / count;
        const double to = static_cast<double>(pixel + 1) * of / count;
        std::vector<Share> found;
        for (int k = static_cast<int>(from); k < of && k < to; ++k) {
            const double part = std::min<double>(to, k + 1) - std::max<double>(from, k);
            found.push_back({static_cast<std::size_t>(k), static_cast<float>(part / (to - from))});
        }
        return found;
    };
    std::vector<std::vector<Share>> across;
    across.reserve(static_cast<std::size_t>(width));
    for (int x = 0; x < width; ++x) {
        across.push_back(shares(x, width, picture.width));
    }
    Picture small{width, height,
                  std::vector<std::uint8_t>(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height))};
    tbb::parallel_for(0, height, [&](int y) {
        const std::vector<Share> down = shares(y, height, picture.height);
        for (int x = 0; x < width; ++x) {
            std::array<float, 3> sum{};
            for (const Share& row : down) {
                for (const Share& column : across[static_cast<std::size_t>(x)]) {
                    const std::uint8_t* from =
                        picture.rgb.data() + 3 * (row.at * static_cast<std::size_t>(picture.width) + column.at);
                    for (std::size_t c = 0; c < 3; ++c) {
                        sum[c] += row.weight * column.weight * linear[from[c]];
                    }
                }
            }
            std::uint8_t* to = small.rgb.data() + 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                                                       static_cast<std::size_t>(x));
            for (std::size_t c = 0; c < 3; ++c) {
                to[c] = static_cast<std::uint8_t>(std::lrint(255.0F * std::min(toDisplay(sum[c]), 1.0F)));
            }
        }
    });
    return small;
}

void put(Picture& sheet, const Picture& picture, int left, int top)
{
    for (int y = 0; y < picture.height; ++y) {
        const auto from = static_cast<std::ptrdiff_t>(3) * y * picture.width;
        const auto to = 3 * (static_cast<std::ptrdiff_t>(top + y) * sheet.width + left);
        std::copy_n(picture.rgb.begin() + from, 3 * picture.width, sheet.rgb.begin() + to);
    }
}

}  // namespace

void ContactSheetOptions::validate() const
{
    constexpr int kMaxColumns = 4096;
    constexpr int kMaxTile = 4096;
    constexpr int kMaxSheet = 16384;
    constexpr int kMinSheet = 256;
    if (columns) {
        requireWithin("options.columns", *columns, 1, kMaxColumns);
    }
    requireWithin("options.tile_width", tile_width, kMinTile, kMaxTile);
    requireWithin("options.tile_height", tile_height, kMinTile, kMaxTile);
    requireWithin("options.max_side", max_side, kMinSheet, kMaxSheet);
}

TileSize tileSize(std::size_t tiles, const ContactSheetOptions& options)
{
    options.validate();
    if (tiles == 0) {
        throw Error(ErrorCode::InvalidArgument, "tiles must be at least 1");
    }
    const Grid grid = gridOf(tiles, options);
    return {grid.tile_width, grid.tile_height};
}

Picture contactSheet(const std::vector<Tile>& tiles, const ContactSheetOptions& options)
{
    options.validate();
    if (tiles.empty()) {
        throw Error(ErrorCode::InvalidArgument, "tiles must not be empty");
    }
    for (const Tile& tile : tiles) {
        tile.picture.validate();
    }
    const Grid grid = gridOf(tiles.size(), options);
    Picture sheet{grid.width(), grid.height(), {}};
    sheet.rgb.resize(3 * static_cast<std::size_t>(sheet.width) * static_cast<std::size_t>(sheet.height));
    for (std::size_t i = 0; i < sheet.rgb.size(); i += kPaper.size()) {
        std::copy(kPaper.begin(), kPaper.end(), sheet.rgb.begin() + static_cast<std::ptrdiff_t>(i));
    }
    const double size = 0.45 * grid.caption;
    const Pen pen{size, std::max(1.0, 0.13 * size), {60, 64, 70}};
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        const Picture& picture = tiles[i].picture;
        const int left =
            grid.gap + static_cast<int>(i % static_cast<std::size_t>(grid.columns)) * (grid.tile_width + grid.gap);
        const int top = grid.gap + static_cast<int>(i / static_cast<std::size_t>(grid.columns)) *
                                       (grid.tile_height + grid.caption + grid.gap);
        const double scale = std::min({1.0, static_cast<double>(grid.tile_width) / picture.width,
                                       static_cast<double>(grid.tile_height) / picture.height});
        const int width = std::max(1, static_cast<int>(std::lround(scale * picture.width)));
        const int height = std::max(1, static_cast<int>(std::lround(scale * picture.height)));
        put(sheet, shrunk(picture, width, height), left + (grid.tile_width - width) / 2,
            top + (grid.tile_height - height) / 2);
        if (grid.caption > 0) {
            const std::string words = fitted(tiles[i].caption, size, grid.tile_width);
            const double indent = 0.5 * (grid.tile_width - textWidth(words, size));
            drawText(sheet, words, {left + indent, top + grid.tile_height + 0.78 * grid.caption}, pen);
        }
    }
    return sheet;
}

}  // namespace droplet
