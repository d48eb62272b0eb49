// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/windshield_view/windshield_maps.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "require.h"
#include "windshield/still_droplets.h"
#include "windshield_view/water_raster.h"

namespace droplet {

void WindshieldMapOptions::validate() const
{
    requireWithin("width", width, 16, 8192);
    shape.validate();
}

struct WindshieldMaps::Content {
    /// Running droplet as it is drawn.
    struct Drawn {
        RunningDroplet droplet;
        std::vector<WaterStamp> water;
    };

    WaterRaster raster;
    ShapeOptions shape;
    std::vector<WaterPixel> sums = {};  ///< of every pixel
    StillCells still = {};              ///< as drawn
    std::vector<Drawn> running = {};
    std::vector<WaterStamp> rims = {};        ///< of splashes
    std::vector<std::uint32_t> changed = {};  ///< pixels since the last update
    std::vector<std::uint8_t> is_changed = {};
    std::vector<std::uint8_t> is_stale = {};  ///< for every tile
    std::vector<MapTile> tiles = {};
    std::vector<WaterStamp> stamps = {};

    [[nodiscard]] std::size_t columns() const { return static_cast<std::size_t>((raster.width() + kTile - 1) / kTile); }

    void add(std::span<const WaterStamp> some, int sign)
    {
        for (const WaterStamp& stamp : some) {
            sums[stamp.pixel].add(stamp.water, sign);
            if (is_changed[stamp.pixel] == 0) {
                is_changed[stamp.pixel] = 1;
                changed.push_back(stamp.pixel);
            }
        }
    }

    void draw(const StillDroplet& droplet, int sign)
    {
        stamps.clear();
        raster.draw({droplet.position, {}, droplet.volume, runningShape(droplet.volume, 0.0, shape), false}, stamps);
        add(stamps, sign);
    }

    /// Draws what one span of droplets has and the other has not.
    void exchange(std::span<const StillDroplet> before, std::span<const StillDroplet> after)
    {
        const auto only_in = [&](std::span<const StillDroplet> some, std::span<const StillDroplet> others, int sign) {
            for (const StillDroplet& droplet : some) {
                if (std::find(others.begin(), others.end(), droplet) == others.end()) {
                    draw(droplet, sign);
                }
            }
        };
        only_in(before, after, -1);
        only_in(after, before, 1);
    }

    void update(const StillCells& now)
    {
        if (still.revisions.size() != now.revisions.size()) {
            still = StillCells();
            still.slots.resize(now.slots.size());
            still.counts.resize(now.counts.size());
            still.revisions.resize(now.revisions.size());
        }
        for (std::size_t cell = 0; cell < now.revisions.size(); ++cell) {
            if (still.revisions[cell] == now.revisions[cell]) {
                continue;
            }
            const auto droplets = now.droplets(cell);
            exchange(still.droplets(cell), droplets);
            std::copy(droplets.begin(), droplets.end(),
                      still.slots.begin() + static_cast<std::ptrdiff_t>(cell * StillCells::kMax));
            still.counts[cell] = now.counts[cell];
            still.revisions[cell] = now.revisions[cell];
        }
    }

    /// Both lists are in the order of ids. What has not changed keeps its water where it is.
    void update(const std::vector<RunningDroplet>& now)
    {
        std::vector<Drawn> drawn;
        drawn.reserve(now.size());
        auto old = running.begin();
        for (const RunningDroplet& droplet : now) {
            for (; old != running.end() && old->droplet.id < droplet.id; ++old) {
                add(old->water, -1);
            }
            const bool was_there = old != running.end() && old->droplet.id == droplet.id;
            if (was_there && looksAs(old->droplet, droplet)) {
                drawn.push_back(std::move(*old));
            } else {
                Drawn& fresh = drawn.emplace_back(Drawn{droplet, {}});
                if (was_there) {
                    add(old->water, -1);
                    fresh.water = std::move(old->water);
                    fresh.water.clear();
                }
                const RunningShape shaped = runningShape(droplet.volume, length(droplet.velocity), shape);
                raster.draw({droplet.position, droplet.velocity, droplet.volume, shaped, true}, fresh.water);
                add(fresh.water, 1);
            }
            old += was_there ? 1 : 0;
        }
        for (; old != running.end(); ++old) {
            add(old->water, -1);
        }
        running = std::move(drawn);
    }

    void update(const std::vector<Splash>& splashes, double time)
    {
        std::vector<WaterStamp> now = raster.rimsOf(splashes, time);
        if (now != rims) {
            add(rims, -1);
            rims = std::move(now);
            add(rims, 1);
        }
    }

    static bool looksAs(const RunningDroplet& a, const RunningDroplet& b)
    {
        return a.position == b.position && a.velocity == b.velocity && a.volume == b.volume;
    }

    static std::uint16_t put(float value) { return Eigen::half(value).x; }

    void write(std::span<std::uint16_t> pixels)
    {
        const auto width = static_cast<std::size_t>(raster.width());
        for (const std::uint32_t pixel : changed) {
            is_changed[pixel] = 0;
            const WaterPixel& water = sums[pixel];
            const std::size_t at = 4 * std::size_t{pixel};
            const auto share = [](std::int32_t sum) { return put(static_cast<float>(sum * WaterPixel::kShare)); };
            pixels[at] = share(water.slope[0]);
            pixels[at + 1] = share(water.slope[1]);
            constexpr double kMillimetre = 1e-3;
            pixels[at + 2] =
                put(static_cast<float>(static_cast<double>(water.thickness) * (WaterPixel::kThickness / kMillimetre)));
            pixels[at + 3] = share(water.cover);
            is_stale[pixel / width / kTile * columns() + pixel % width / kTile] = 1;
        }
        changed.clear();
        tiles.clear();
        for (std::size_t k = 0; k < is_stale.size(); ++k) {
            if (std::exchange(is_stale[k], std::uint8_t{0}) != 0) {
                const int x = static_cast<int>(k % columns()) * kTile;
                const int y = static_cast<int>(k / columns()) * kTile;
                tiles.push_back({x, y, std::min(kTile, raster.width() - x), std::min(kTile, raster.height() - y)});
            }
        }
    }
};

WindshieldMaps::WindshieldMaps(const Glass& glass, const WindshieldMapOptions& options)
{
    options.validate();
    const WaterRaster raster(glass, options.width);
    require(raster.height() <= 8192, "height", raster.height(), "at most 8192: use a smaller width");
    content_ = std::make_unique<Content>(Content{raster, options.shape});
    const auto pixels = static_cast<std::size_t>(raster.width()) * static_cast<std::size_t>(raster.height());
    content_->sums.resize(pixels);
    content_->is_changed.resize(pixels);
    content_->is_stale.resize(content_->columns() * static_cast<std::size_t>((raster.height() + kTile - 1) / kTile));
}

WindshieldMaps::~WindshieldMaps() = default;
WindshieldMaps::WindshieldMaps(WindshieldMaps&& other) noexcept = default;
WindshieldMaps& WindshieldMaps::operator=(WindshieldMaps&& other) noexcept = default;

int WindshieldMaps::width() const
{
    return content_->raster.width();
}

int WindshieldMaps::height() const
{
    return content_->raster.height();
}

const std::vector<MapTile>& WindshieldMaps::update(const WindshieldState& state, std::span<std::uint16_t> pixels)
{
    const std::size_t wanted = 4 * content_->sums.size();
    require(pixels.size() == wanted, "pixels.size", pixels.size(), "width x height x 4");
    content_->update(StillCells::of(state.still));
    content_->update(state.droplets);
    content_->update(state.splashes, state.time);
    content_->write(pixels);
    return content_->tiles;
}

}  // namespace droplet
