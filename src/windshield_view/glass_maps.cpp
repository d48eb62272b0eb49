// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/windshield_view/glass_maps.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "blocks.h"
#include "require.h"
#include "windshield_view/body_relief.h"
#include "windshield_view/water_raster.h"

namespace droplet {
namespace {

std::uint16_t unsignedLevel(double share)
{
    return static_cast<std::uint16_t>(std::lround(65535.0 * std::clamp(share, 0.0, 1.0)));
}

std::uint16_t signedLevel(double value)
{
    return unsignedLevel(0.5 * (value + 1.0));
}

/// All that is drawn.
struct MapWater {
    std::vector<WaterDrop> drops;
    std::vector<WaterStamp> rims;  ///< of splashes
};

MapWater waterOf(const WaterRaster& raster, const Glass& glass, const WindshieldState& state,
                 const GlassMapOptions& options)
{
    const Reliefs reliefs(glass, options.body, options.forces);
    std::vector<WaterDrop> drops;
    for (const StillDroplet& still : state.still.all()) {
        drops.push_back({still.position, {}, still.volume, runningShape(still.volume, 0.0, options.shape), false});
    }
    for (const RunningDroplet& running : state.droplets) {
        const auto relief = reliefs.of(running);
        drops.push_back({running.position, running.velocity, running.volume,
                         runningShape(running.volume, length(running.velocity), options.shape), true,
                         relief ? std::make_shared<const BodyRelief>(*relief) : nullptr});
    }
    return {std::move(drops), raster.rimsOf(state.splashes, state.time)};
}

/// A pixel of the maps.
struct MapPixel {
    WaterPixel water;
    WaterMotion motion;
};

/// Sums up the pixels and calls take(row, its pixels), in parallel, once for each row.
template <typename Take>
void forRows(const WaterRaster& raster, const MapWater& water, const Take& take)
{
    const std::vector<WaterDrop>& drops = water.drops;
    const auto width = static_cast<std::size_t>(raster.width());
    const auto height = static_cast<std::size_t>(raster.height());
    constexpr std::size_t kDropsPerBlock = 1024;
    const auto blocks = mapBlocks<std::vector<WaterStamp>>(
        drops.size(),
        [&](std::size_t first, std::size_t last) {
            std::vector<WaterStamp> stamps;
            for (std::size_t k = first; k < last; ++k) {
                raster.draw(drops[k], stamps);
            }
            return stamps;
        },
        kDropsPerBlock);
    std::vector<MapPixel> sums(width * height);
    for (const std::vector<WaterStamp>& block : blocks) {
        for (const WaterStamp& stamp : block) {
            sums[stamp.pixel].water.add(stamp.water, 1);
            sums[stamp.pixel].motion.add(stamp.motion);
        }
    }
    for (const WaterStamp& stamp : water.rims) {
        sums[stamp.pixel].water.add(stamp.water, 1);
    }
    tbb::parallel_for(std::size_t{0}, height, [&](std::size_t row) {
        take(static_cast<int>(row), std::span(std::as_const(sums)).subspan(row * width, width));
    });
}

WaterRaster rasterFor(const Glass& glass, const GlassMapOptions& options)
{
    options.validate();
    const WaterRaster raster(glass, options.width);
    require(raster.height() <= 8192, "height", raster.height(), "at most 8192: use a smaller width");
    return raster;
}

Vec2 velocityOf(const MapPixel& pixel)
{
    return pixel.motion.cover > 0 ? (1.0 / pixel.motion.cover) * Vec2{static_cast<double>(pixel.motion.velocity[0]),
                                                                      static_cast<double>(pixel.motion.velocity[1])}
                                  : Vec2{};
}

double thicknessOf(const MapPixel& pixel)
{
    return static_cast<double>(pixel.water.thickness) * WaterPixel::kThickness;
}

/// Share of a pixel that running droplets cover.
double runsOf(const MapPixel& pixel)
{
    return pixel.motion.cover * WaterPixel::kShare;
}

// Levels of bare glass.
constexpr std::array<std::uint16_t, 3> kBare{32768, 32768, 65535};
constexpr std::array<std::uint16_t, 3> kStill{32768, 32768, 0};

}  // namespace

void GlassMapOptions::validate() const
{
    requireWithin("width", width, 16, 8192);
    checkBody(body);
    shape.validate();
    forces.validate();
    require(full_thickness > 0.0 && std::isfinite(full_thickness), "full_thickness", full_thickness, "positive");
    require(full_speed > 0.0 && std::isfinite(full_speed), "full_speed", full_speed, "positive");
}

GlassMaps glassMaps(const Glass& glass, const WindshieldState& state, const GlassMapOptions& options)
{
    const WaterRaster raster = rasterFor(glass, options);
    const int width = raster.width();
    const int height = raster.height();
    const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    GlassMaps maps{{width, height, 3, {}}, {width, height, 1, {}}, {width, height, 3, {}}};
    maps.normal.levels.resize(3 * pixels);
    maps.thickness.levels.resize(pixels);
    maps.velocity.levels.resize(3 * pixels);
    forRows(raster, waterOf(raster, glass, state, options), [&](int row, std::span<const MapPixel> held) {
        // The rounding error goes to the next wet pixel of the row; else thin water would vanish.
        double left_over = 0.0;
        std::size_t at = static_cast<std::size_t>(row) * static_cast<std::size_t>(width);
        for (const MapPixel& pixel : held) {
            std::uint16_t* const facing = &maps.normal.levels[3 * at];
            std::uint16_t* const motion = &maps.velocity.levels[3 * at];
            if (pixel.water.cover == 0) {
                std::copy(kBare.begin(), kBare.end(), facing);
                std::copy(kStill.begin(), kStill.end(), motion);
                ++at;
                continue;
            }
            const Vec3f normal = pixel.water.normal();
            facing[0] = signedLevel(static_cast<double>(normal.x));
            facing[1] = signedLevel(static_cast<double>(normal.y));
            facing[2] = signedLevel(static_cast<double>(normal.z));
            if (pixel.water.thickness > 0) {
                const double wanted = thicknessOf(pixel) + left_over;
                maps.thickness.levels[at] = unsignedLevel(wanted / options.full_thickness);
                const double in_map = maps.thickness.levels[at] / 65535.0 * options.full_thickness;
                left_over =
                    std::clamp(wanted - in_map, -options.full_thickness / 65535.0, options.full_thickness / 65535.0);
            }
            const Vec2 velocity = velocityOf(pixel);
            motion[0] = signedLevel(velocity.x / options.full_speed);
            motion[1] = signedLevel(velocity.y / options.full_speed);
            motion[2] = unsignedLevel(runsOf(pixel));
            ++at;
        }
    });
    return maps;
}

GlassFloatMaps glassFloatMaps(const Glass& glass, const WindshieldState& state, const GlassMapOptions& options)
{
    const WaterRaster raster = rasterFor(glass, options);
    const int width = raster.width();
    const int height = raster.height();
    const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    GlassFloatMaps maps{{width, height, 3, {}}, {width, height, 1, {}}, {width, height, 3, {}}};
    maps.normal.values.resize(3 * pixels);
    maps.thickness.values.resize(pixels);
    maps.velocity.values.resize(3 * pixels);
    forRows(raster, waterOf(raster, glass, state, options), [&](int row, std::span<const MapPixel> held) {
        std::size_t at = static_cast<std::size_t>(row) * static_cast<std::size_t>(width);
        for (const MapPixel& pixel : held) {
            const Vec3f normal = pixel.water.normal();
            const Vec2 velocity = velocityOf(pixel);
            const std::array<double, 3> motion{velocity.x, velocity.y, std::min(runsOf(pixel), 1.0)};
            const auto narrow = [](double value) { return static_cast<float>(value); };
            const std::array facing{normal.x, normal.y, normal.z};
            std::copy(facing.begin(), facing.end(), maps.normal.values.data() + 3 * at);
            std::transform(motion.begin(), motion.end(), maps.velocity.values.data() + 3 * at, narrow);
            maps.thickness.values[at] = narrow(thicknessOf(pixel));
            ++at;
        }
    });
    return maps;
}

}  // namespace droplet
