// SPDX-License-Identifier: GPL-3.0-or-later
#include "windshield_view/tiles.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "droplet/error.h"
#include "number_text.h"

namespace droplet {
namespace {

ViewTile tileAt(const Eye& eye, const Glass& glass, int column, int row)
{
    ViewTile tile;
    const int x0 = column * kTile;
    const int y0 = row * kTile;
    const int x1 = std::min(x0 + kTile, eye.width());
    const int y1 = std::min(y0 + kTile, eye.height());
    tile.low = {1e9F, 1e9F};
    tile.high = {-1e9F, -1e9F};
    int nearest = std::numeric_limits<int>::max();
    Vec2f middle;
    bool has_steps = false;
    for (int y = y0; y < y1; ++y) {
        for (int x = x0; x < x1; ++x) {
            const Vec2f here = eye.place(x, y);
            if (std::isnan(here.x)) {
                continue;
            }
            tile.on_glass = true;
            tile.low = {std::min(tile.low.x, here.x), std::min(tile.low.y, here.y)};
            tile.high = {std::max(tile.high.x, here.x), std::max(tile.high.y, here.y)};
            const int far = std::abs(2 * x - x0 - x1) + std::abs(2 * y - y0 - y1);
            const Vec2f right = eye.place(std::min(x + 1, eye.width() - 1), y);
            const Vec2f left = eye.place(std::max(x - 1, 0), y);
            const Vec2f above = eye.place(x, std::max(y - 1, 0));
            const Vec2f below = eye.place(x, std::min(y + 1, eye.height() - 1));
            const bool whole = !std::isnan(right.x + left.x + above.x + below.x);
            if ((whole && !has_steps) || (whole == has_steps && far < nearest)) {
                nearest = far;
                middle = here;
                has_steps = whole;
                if (whole) {
                    const auto columns_apart =
                        static_cast<float>(std::min(x + 1, eye.width() - 1) - std::max(x - 1, 0));
                    const auto rows_apart = static_cast<float>(std::min(y + 1, eye.height() - 1) - std::max(y - 1, 0));
                    tile.right = {(right.x - left.x) / columns_apart, (right.y - left.y) / columns_apart};
                    tile.down = {(below.x - above.x) / rows_apart, (below.y - above.y) / rows_apart};
                }
            }
        }
    }
    if (!tile.on_glass) {
        return tile;
    }
    const auto place = glass.place({static_cast<double>(middle.x), static_cast<double>(middle.y)});
    tile.pixel = std::sqrt(std::abs(tile.right.x * tile.down.y - tile.right.y * tile.down.x));
    if (!place || !(tile.pixel > 0.0F)) {
        tile.on_glass = false;  // a sliver at the glass's edge
        return tile;
    }
    tile.frame = frameOf(eye.seen(*place));
    const float reach = std::abs(tile.right.x) + std::abs(tile.right.y) + std::abs(tile.down.x) + std::abs(tile.down.y);
    tile.low = {tile.low.x - reach, tile.low.y - reach};
    tile.high = {tile.high.x + reach, tile.high.y + reach};
    return tile;
}

}  // namespace

Tiles::Tiles(const Eye& eye, const Glass& glass, const ViewOptions& options)
    : columns_((eye.width() + kTile - 1) / kTile),
      rows_((eye.height() + kTile - 1) / kTile),
      window_{{1e9, 1e9}, {-1e9, -1e9}, 0.0}
{
    tiles_.reserve(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
    float finest = std::numeric_limits<float>::infinity();
    for (int r = 0; r < rows_; ++r) {
        for (int c = 0; c < columns_; ++c) {
            const ViewTile& tile = tiles_.emplace_back(tileAt(eye, glass, c, r));
            if (tile.on_glass) {
                window_.low = {std::min<double>(window_.low.x, tile.low.x),
                               std::min<double>(window_.low.y, tile.low.y)};
                window_.high = {std::max<double>(window_.high.x, tile.high.x),
                                std::max<double>(window_.high.y, tile.high.y)};
                finest = std::min(finest, tile.pixel);
            }
        }
    }
    if (!(finest < std::numeric_limits<float>::infinity())) {
        throw Error(ErrorCode::InvalidArgument,
                    (options.eye ? std::string("eye") : "eye_distance " + numberText(options.eye_distance) + " m") +
                        ": the eye sees nothing of the glass; it must be nearer or look at the glass");
    }
    // One texel for each ray, but at most 128 MiB of texels, and none finer than the detail of droplets.
    constexpr double kMaxTexels = 16e6;
    constexpr double kFinest = 2e-5;
    const double area = (window_.high.x - window_.low.x) * (window_.high.y - window_.low.y);
    window_.texel = std::max({static_cast<double>(finest) / options.samples, std::sqrt(area / kMaxTexels), kFinest});
}

}  // namespace droplet
