// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/windshield_view/glass_maps.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "blocks.h"
#include "require.h"
#include "windshield_view/body_relief.h"
#include "windshield_view/water_sums.h"

namespace droplet {
namespace {

/// Nearest level; what is half way is rounded up.
std::uint16_t levelOf(double value)
{
    constexpr double kHalf = 0.5;  // a call of lround() for every value takes as long as the map
    return static_cast<std::uint16_t>(std::min(std::max(value, 0.0), 65535.0) + kHalf);
}

std::uint16_t unsignedLevel(double share)
{
    return levelOf(65535.0 * share);
}

std::uint16_t signedLevel(double value)
{
    return unsignedLevel(0.5 * (value + 1.0));
}

WaterRaster rasterFor(const Glass& glass, const GlassMapOptions& options)
{
    options.validate();
    const WaterRaster raster(glass, options.width);
    require(raster.height() <= 8192, "the maps' height", raster.height(), "at most 8192: use a smaller width");
    return raster;
}

WaterSums::ReliefOf reliefsOf(const Glass& glass, const GlassMapOptions& options)
{
    if (options.body == BodyShape::Capsule) {
        return {};
    }
    return [reliefs = std::make_shared<const Reliefs>(glass, options.body, options.forces)](
               const RunningDroplet& droplet) { return reliefs->of(droplet); };
}

Vec2 velocityOf(const WaterMotion& motion)
{
    return motion.cover > 0 ? (1.0 / motion.cover) *
                                  Vec2{static_cast<double>(motion.velocity[0]), static_cast<double>(motion.velocity[1])}
                            : Vec2{};
}

double thicknessOf(const WaterPixel& water)
{
    return static_cast<double>(water.thickness) * WaterPixel::kThickness;
}

/// Share of a pixel that running droplets cover.
double runsOf(const WaterMotion& motion)
{
    return motion.cover * WaterPixel::kShare;
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

struct GlassMapFrames::Content {
    GlassMapOptions options;
    WaterSums sums;
    GlassMaps maps;

    Content(const Glass& glass, const GlassMapOptions& its_options)
        : options(its_options), sums(rasterFor(glass, options), options.shape, reliefsOf(glass, options))
    {
    }

    [[nodiscard]] int width() const { return sums.raster().width(); }
    [[nodiscard]] int height() const { return sums.raster().height(); }

    /// Makes maps of bare glass, if there are none.
    void begin()
    {
        if (!maps.normal.levels.empty()) {
            return;
        }
        maps = {{width(), height(), 3, {}}, {width(), height(), 1, {}}, {width(), height(), 3, {}}};
        const std::size_t pixels = sums.water().size();
        maps.thickness.levels.resize(pixels);
        maps.normal.levels.resize(3 * pixels);
        maps.velocity.levels.resize(3 * pixels);
        for (std::size_t k = 0; k < pixels; ++k) {
            writeBare(k);
        }
    }

    void writeBare(std::size_t pixel)
    {
        std::copy(kBare.begin(), kBare.end(), &maps.normal.levels[3 * pixel]);
        std::copy(kStill.begin(), kStill.end(), &maps.velocity.levels[3 * pixel]);
    }

    /// Writes normal and velocity.
    void write(std::size_t pixel)
    {
        const WaterPixel& water = sums.water()[pixel];
        if (water.cover == 0) {
            writeBare(pixel);
            return;
        }
        std::uint16_t* const facing = &maps.normal.levels[3 * pixel];
        std::uint16_t* const moving = &maps.velocity.levels[3 * pixel];
        const Vec3f normal = water.normal();
        facing[0] = signedLevel(static_cast<double>(normal.x));
        facing[1] = signedLevel(static_cast<double>(normal.y));
        facing[2] = signedLevel(static_cast<double>(normal.z));
        const WaterMotion& motion = sums.motion()[pixel];
        if (motion.cover == 0) {
            std::copy(kStill.begin(), kStill.end(), moving);
            return;
        }
        const double scale = 1.0 / (motion.cover * options.full_speed);
        moving[0] = signedLevel(scale * motion.velocity[0]);
        moving[1] = signedLevel(scale * motion.velocity[1]);
        moving[2] = unsignedLevel(runsOf(motion));
    }

    /// Writes the thickness of a row. The rounding error goes to the next wet pixel; else thin water would vanish.
    void writeThickness(std::size_t row)
    {
        const auto columns = static_cast<std::size_t>(width());
        const double scale = 65535.0 * WaterPixel::kThickness / options.full_thickness;
        constexpr double kHalf = 0.5;  // as in levelOf()
        double wanted = 0.0;           // of all pixels up to here, in steps, as what follows
        std::int64_t written = 0;
        for (std::size_t at = row * columns; at < (row + 1) * columns; ++at) {
            const WaterPixel& water = sums.water()[at];
            const double thickness = water.cover != 0 ? static_cast<double>(water.thickness) : 0.0;
            wanted += std::min(std::max(scale * thickness, 0.0), 65535.0);
            const auto so_far = static_cast<std::int64_t>(wanted + kHalf);
            maps.thickness.levels[at] = static_cast<std::uint16_t>(so_far - written);
            written = so_far;
        }
    }
};

GlassMapFrames::GlassMapFrames(const Glass& glass, const GlassMapOptions& options)
    : content_(std::make_unique<Content>(glass, options))
{
}

GlassMapFrames::~GlassMapFrames() = default;
GlassMapFrames::GlassMapFrames(GlassMapFrames&& other) noexcept = default;
GlassMapFrames& GlassMapFrames::operator=(GlassMapFrames&& other) noexcept = default;

const GlassMaps& GlassMapFrames::maps(const WindshieldState& state)
{
    Content& content = *content_;
    content.begin();
    content.sums.update(state);
    content.sums.updateFilm(state.film);
    tbb::parallel_for(std::size_t{0}, static_cast<std::size_t>(content.height()), [&](std::size_t row) {
        if (content.sums.takeChanged(row, [&](std::size_t pixel) { content.write(pixel); })) {
            content.writeThickness(row);
        }
    });
    return content.maps;
}

GlassFloatMaps GlassMapFrames::floatMaps(const WindshieldState& state)
{
    Content& content = *content_;
    content.sums.update(state);
    content.sums.updateFilm(state.film);
    const WaterSums& sums = content.sums;
    const int width = content.width();
    const int height = content.height();
    GlassFloatMaps maps{{width, height, 3, {}}, {width, height, 1, {}}, {width, height, 3, {}}};
    const std::size_t pixels = sums.water().size();
    maps.normal.values.resize(3 * pixels);
    maps.thickness.values.resize(pixels);
    maps.velocity.values.resize(3 * pixels);
    forBlocks(pixels, [&](std::size_t first, std::size_t last) {
        for (std::size_t at = first; at < last; ++at) {
            const Vec3f normal = sums.water()[at].normal();
            const WaterMotion& moving = sums.motion()[at];
            const Vec2 velocity = velocityOf(moving);
            const std::array<double, 3> motion{velocity.x, velocity.y, std::min(runsOf(moving), 1.0)};
            const auto narrow = [](double value) { return static_cast<float>(value); };
            const std::array facing{normal.x, normal.y, normal.z};
            std::copy(facing.begin(), facing.end(), maps.normal.values.data() + 3 * at);
            std::transform(motion.begin(), motion.end(), maps.velocity.values.data() + 3 * at, narrow);
            maps.thickness.values[at] = narrow(thicknessOf(sums.water()[at]));
        }
    });
    return maps;
}

GlassMaps glassMaps(const Glass& glass, const WindshieldState& state, const GlassMapOptions& options)
{
    return GlassMapFrames(glass, options).maps(state);
}

GlassFloatMaps glassFloatMaps(const Glass& glass, const WindshieldState& state, const GlassMapOptions& options)
{
    return GlassMapFrames(glass, options).floatMaps(state);
}

}  // namespace droplet
