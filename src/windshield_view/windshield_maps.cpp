// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/windshield_view/windshield_maps.h"

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <utility>

#include "require.h"
#include "windshield_view/water_sums.h"

namespace droplet {

void WindshieldMapOptions::validate() const
{
    requireWithin("width", width, 16, 8192);
    shape.validate();
}

struct WindshieldMaps::Content {
    WaterSums sums;
    std::vector<std::uint8_t> is_stale = {};  ///< for every tile
    std::vector<MapTile> tiles = {};

    [[nodiscard]] const WaterRaster& raster() const { return sums.raster(); }
    [[nodiscard]] std::size_t columns() const
    {
        return static_cast<std::size_t>((raster().width() + kTile - 1) / kTile);
    }

    static std::uint16_t put(float value) { return Eigen::half(value).x; }

    void write(std::span<std::uint16_t> pixels)
    {
        const auto width = static_cast<std::size_t>(raster().width());
        const auto put_pixel = [&](std::size_t pixel) {
            const WaterPixel& water = sums.water()[pixel];
            const std::size_t at = 4 * pixel;
            const auto share = [](std::int32_t sum) { return put(static_cast<float>(sum * WaterPixel::kShare)); };
            pixels[at] = share(water.slope[0]);
            pixels[at + 1] = share(water.slope[1]);
            constexpr double kMillimetre = 1e-3;
            pixels[at + 2] =
                put(static_cast<float>(static_cast<double>(water.thickness) * (WaterPixel::kThickness / kMillimetre)));
            pixels[at + 3] = share(water.cover);
            is_stale[pixel / width / kTile * columns() + pixel % width / kTile] = 1;
        };
        for (std::size_t row = 0; row < static_cast<std::size_t>(raster().height()); ++row) {
            sums.takeChanged(row, put_pixel);
        }
        tiles.clear();
        for (std::size_t k = 0; k < is_stale.size(); ++k) {
            if (std::exchange(is_stale[k], std::uint8_t{0}) != 0) {
                const int x = static_cast<int>(k % columns()) * kTile;
                const int y = static_cast<int>(k / columns()) * kTile;
                tiles.push_back({x, y, std::min(kTile, raster().width() - x), std::min(kTile, raster().height() - y)});
            }
        }
    }
};

WindshieldMaps::WindshieldMaps(const Glass& glass, const WindshieldMapOptions& options)
{
    options.validate();
    const WaterRaster raster(glass, options.width);
    require(raster.height() <= 8192, "the maps' height", raster.height(), "at most 8192: use a smaller width");
    content_ = std::make_unique<Content>(Content{WaterSums(raster, options.shape)});
    content_->is_stale.resize(content_->columns() * static_cast<std::size_t>((raster.height() + kTile - 1) / kTile));
}

WindshieldMaps::~WindshieldMaps() = default;
WindshieldMaps::WindshieldMaps(WindshieldMaps&& other) noexcept = default;
WindshieldMaps& WindshieldMaps::operator=(WindshieldMaps&& other) noexcept = default;

int WindshieldMaps::width() const
{
    return content_->raster().width();
}

int WindshieldMaps::height() const
{
    return content_->raster().height();
}

const std::vector<MapTile>& WindshieldMaps::update(const WindshieldState& state, std::span<std::uint16_t> pixels)
{
    const std::size_t wanted = 4 * content_->sums.water().size();
    require(pixels.size() == wanted, "pixels.size", pixels.size(), "width x height x 4");
    content_->sums.update(state);
    content_->write(pixels);
    return content_->tiles;
}

}  // namespace droplet
