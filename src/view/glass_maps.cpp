// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/view/glass_maps.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "require.h"

namespace droplet {
namespace {

/// A droplet of either kind as the maps have it.
struct Drop {
    Vec2 position;
    Vec2 along{1.0, 0.0};  ///< unit
    Vec2 velocity;
    RunningShape shape;
    bool may_run = false;
};

std::uint16_t unsignedLevel(double share)
{
    return static_cast<std::uint16_t>(std::lround(65535.0 * std::clamp(share, 0.0, 1.0)));
}

std::uint16_t signedLevel(double value)
{
    return unsignedLevel(0.5 * (value + 1.0));
}

}  // namespace

void GlassMapOptions::validate() const
{
    requireWithin("width", width, 16, 8192);
    shape.validate();
    require(full_thickness > 0.0 && std::isfinite(full_thickness), "full_thickness", full_thickness, "positive");
    require(full_speed > 0.0 && std::isfinite(full_speed), "full_speed", full_speed, "positive");
}

GlassMaps glassMaps(const Glass& glass, const WindshieldState& state, const GlassMapOptions& options)
{
    options.validate();
    const int width = options.width;
    const double pixel = glass.width() / width;
    const int height = std::max(static_cast<int>(std::lround(glass.height() / pixel)), 1);
    const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    require(height <= 8192, "height", height, "at most 8192: ask for less width");

    std::vector<Drop> drops;
    for (const StillDroplet& still : state.still.all()) {
        drops.push_back({still.position, {1.0, 0.0}, {}, runningShape(still.volume, 0.0, options.shape), false});
    }
    for (const RunningDroplet& running : state.droplets) {
        const double speed = length(running.velocity);
        drops.push_back({running.position, speed > 0.0 ? (1.0 / speed) * running.velocity : Vec2{1.0, 0.0},
                         running.velocity, runningShape(running.volume, speed, options.shape), true});
    }
    // Bands of rows, each with the droplets that reach into it.
    constexpr int kBand = 32;
    const int bands = (height + kBand - 1) / kBand;
    std::vector<std::vector<std::uint32_t>> in_band(static_cast<std::size_t>(bands));
    const auto row_of = [&](double y) { return (glass.height() - y) / pixel - 0.5; };
    for (std::size_t k = 0; k < drops.size(); ++k) {
        const double reach = drops[k].shape.half_length + drops[k].shape.silhouette();
        const double top = row_of(drops[k].position.y + reach);
        const double bottom = row_of(drops[k].position.y - reach);
        if (bottom < 0.0 || top > height - 1) {
            continue;
        }
        for (int band = static_cast<int>(std::max(top, 0.0)) / kBand;
             band <= static_cast<int>(std::min<double>(bottom, height - 1)) / kBand; ++band) {
            in_band[static_cast<std::size_t>(band)].push_back(static_cast<std::uint32_t>(k));
        }
    }

    constexpr std::uint16_t kMiddle = 32768;
    GlassMaps maps{{width, height, 3, {}}, {width, height, 1, {}}, {width, height, 3, {}}};
    maps.normal.levels.assign(3 * pixels, kMiddle);
    maps.thickness.levels.assign(pixels, 0);
    maps.velocity.levels.assign(3 * pixels, kMiddle);
    for (std::size_t i = 2; i < 3 * pixels; i += 3) {
        maps.normal.levels[i] = 65535;
        maps.velocity.levels[i] = 0;
    }
    tbb::parallel_for(0, bands, [&](int band) {
        std::vector<double> thickest(static_cast<std::size_t>(width) * kBand, 0.0);
        for (const std::uint32_t k : in_band[static_cast<std::size_t>(band)]) {
            const Drop& drop = drops[k];
            const RunningShape& shape = drop.shape;
            const double reach = shape.half_length + shape.silhouette();
            const int left = std::max(static_cast<int>(std::ceil((drop.position.x - reach) / pixel - 0.5)), 0);
            const int right =
                std::min(static_cast<int>(std::floor((drop.position.x + reach) / pixel - 0.5)), width - 1);
            const int top = std::max(static_cast<int>(std::ceil(row_of(drop.position.y + reach))), band * kBand);
            const int bottom = std::min(static_cast<int>(std::floor(row_of(drop.position.y - reach))),
                                        std::min((band + 1) * kBand, height) - 1);
            for (int row = top; row <= bottom; ++row) {
                for (int column = left; column <= right; ++column) {
                    const Vec2 from{(column + 0.5) * pixel - drop.position.x,
                                    glass.height() - (row + 0.5) * pixel - drop.position.y};
                    const double a = dot(drop.along, from);
                    const double b = cross(drop.along, from);
                    const double end = std::copysign(std::max(std::abs(a) - shape.half_length, 0.0), a);
                    const double far2 = end * end + b * b;
                    if (far2 >= shape.silhouette() * shape.silhouette()) {
                        continue;
                    }
                    const double up = std::sqrt(shape.radius * shape.radius - far2);
                    // Where it overhangs its contact there is air below.
                    const double thickness = std::min(up + shape.centre_height, 2.0 * up);
                    double& most =
                        thickest[static_cast<std::size_t>(row - band * kBand) * static_cast<std::size_t>(width) +
                                 static_cast<std::size_t>(column)];
                    if (thickness <= most) {
                        continue;
                    }
                    most = thickness;
                    const std::size_t at = static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                                           static_cast<std::size_t>(column);
                    const Vec2 slope = end * drop.along + b * Vec2{-drop.along.y, drop.along.x};
                    maps.normal.levels[3 * at] = signedLevel(slope.x / shape.radius);
                    maps.normal.levels[3 * at + 1] = signedLevel(slope.y / shape.radius);
                    maps.normal.levels[3 * at + 2] = signedLevel(up / shape.radius);
                    maps.thickness.levels[at] = unsignedLevel(thickness / options.full_thickness);
                    maps.velocity.levels[3 * at] = signedLevel(drop.velocity.x / options.full_speed);
                    maps.velocity.levels[3 * at + 1] = signedLevel(drop.velocity.y / options.full_speed);
                    maps.velocity.levels[3 * at + 2] = drop.may_run ? 65535 : 0;
                }
            }
        }
    });
    return maps;
}

}  // namespace droplet
