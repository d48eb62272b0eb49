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

#include "require.h"
#include "windshield_view/body_relief.h"

namespace droplet {
namespace {

/// Droplet of either kind, as drawn in the maps.
struct Drop {
    Vec2 position;
    Vec2 along{1.0, 0.0};  ///< unit
    Vec2 velocity;
    double volume = 0.0;
    RunningShape shape;
    bool may_run = false;
    std::shared_ptr<const BodyRelief> relief = {};  ///< in place of the shape

    /// Radius of a circle around the position, with the whole outline in it.
    [[nodiscard]] double reach() const
    {
        return relief ? std::hypot(std::max(-relief->low.x, relief->high.x), std::max(-relief->low.y, relief->high.y))
                      : shape.half_length + shape.silhouette();
    }
    [[nodiscard]] double halfWidth() const
    {
        return relief ? static_cast<double>(relief->half_width) : shape.silhouette();
    }
};

/// Water at a place.
struct Water {
    double thickness = 0.0;
    Vec2 slope;       ///< components of the outward unit normal along the glass
    double up = 0.0;  ///< component of the normal out of the glass
};

/// Sums over a pixel, each weighted by its share of the pixel's area.
struct Pixel {
    double thickness = 0.0;
    double cover = 0.0;
    Vec2 slope;
    double up = 0.0;
    double runs = 0.0;  ///< cover of running droplets
    Vec2 velocity;      ///< sum of their velocities

    void add(const Water& water, double share)
    {
        cover += share;
        slope = slope + share * water.slope;
        up += share * water.up;
    }
};

std::uint16_t unsignedLevel(double share)
{
    return static_cast<std::uint16_t>(std::lround(65535.0 * std::clamp(share, 0.0, 1.0)));
}

std::uint16_t signedLevel(double value)
{
    return unsignedLevel(0.5 * (value + 1.0));
}

/// Nearly square pixels of the glass, and the sample places in them.
class Raster {
public:
    Raster(const Glass& glass, int width)
        : width_(width),
          pixel_(glass.width() / width),
          height_(std::max(static_cast<int>(std::lround(glass.height() / pixel_)), 1)),
          top_(glass.height()),
          down_(top_ / height_)
    {
    }

    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }

    /// First and last row that a droplet reaches; last < first if there is none.
    [[nodiscard]] std::pair<int, int> rowsOf(const Drop& drop) const
    {
        const auto row = [&](double y) { return std::floor((top_ - y) / down_); };
        return {static_cast<int>(std::max(row(drop.position.y + drop.reach()), 0.0)),
                static_cast<int>(std::clamp(row(drop.position.y - drop.reach()), -1.0, height_ - 1.0))};
    }

    /// Number of sample places across a pixel, so that at least seven lie across the droplet.
    [[nodiscard]] double placesAcross(const Drop& drop) const
    {
        return std::max(std::ceil(3.5 * std::max(pixel_, down_) / drop.halfWidth()), 2.0);
    }

    /// Calls take(column, row, water) for all sample places on the droplet.
    template <typename Take>
    void forPlaces(const Drop& drop, std::pair<int, int> rows, const Take& take) const
    {
        const RunningShape& shape = drop.shape;
        const double wide = shape.silhouette();
        const double n = placesAcross(drop);
        const double apart = pixel_ / n;
        const double rows_apart = down_ / n;
        const auto first = [](double at, double pitch) {
            return static_cast<std::int64_t>(std::ceil(at / pitch - 0.5));
        };
        const auto columns = static_cast<std::int64_t>(n) * width_;
        const std::int64_t left = std::max<std::int64_t>(first(drop.position.x - drop.reach(), apart), 0);
        const std::int64_t right = std::min(first(drop.position.x + drop.reach(), apart), columns);
        const std::int64_t top = std::max(first(top_ - drop.position.y - drop.reach(), rows_apart),
                                          static_cast<std::int64_t>(n) * rows.first);
        const std::int64_t bottom = std::min(first(top_ - drop.position.y + drop.reach(), rows_apart),
                                             static_cast<std::int64_t>(n) * (rows.second + 1));
        const double r2 = shape.radius * shape.radius;
        for (std::int64_t j = top; j < bottom; ++j) {
            for (std::int64_t i = left; i < right; ++i) {
                const Vec2 from{(static_cast<double>(i) + 0.5) * apart - drop.position.x,
                                top_ - (static_cast<double>(j) + 0.5) * rows_apart - drop.position.y};
                const double a = dot(drop.along, from);
                const double b = cross(drop.along, from);
                const auto take_water = [&](const Water& water) {
                    take(static_cast<int>(i / static_cast<std::int64_t>(n)),
                         static_cast<int>(j / static_cast<std::int64_t>(n)), water);
                };
                const Vec2 left_along{-drop.along.y, drop.along.x};
                if (drop.relief) {
                    const Vec2f place{static_cast<float>(a), static_cast<float>(b)};
                    if (drop.relief->inside(place) > 0.0F) {
                        const BodyRelief::Point point = drop.relief->at(place);
                        take_water({static_cast<double>(point.height),
                                    static_cast<double>(point.normal.x) * drop.along +
                                        static_cast<double>(point.normal.y) * left_along,
                                    static_cast<double>(point.normal.z)});
                    }
                    continue;
                }
                const double end = std::copysign(std::max(std::abs(a) - shape.half_length, 0.0), a);
                const double far2 = end * end + b * b;
                if (far2 >= wide * wide) {
                    continue;
                }
                const double up = std::sqrt(r2 - far2);
                const Vec2 slope = end * drop.along + b * left_along;
                // Where the droplet overhangs its contact, there is air below it.
                take_water(
                    {std::min(up + shape.centre_height, 2.0 * up), (1.0 / shape.radius) * slope, up / shape.radius});
            }
        }
    }

    /// Scale of a droplet's thickness: its volume over the sum of its samples. So the map has exactly the water of the
    /// glass, also for droplets between sample places or beyond the edge.
    [[nodiscard]] double shareOf(const Drop& drop) const
    {
        double sum = 0.0;
        forPlaces(drop, rowsOf(drop), [&](int, int, const Water& water) { sum += water.thickness; });
        return sum > 0.0 ? drop.volume / (pixel_ * down_ * sum) : 0.0;
    }

private:
    int width_;
    double pixel_;
    int height_;
    double top_;
    double down_;  ///< height of a pixel [m]
};

std::vector<Drop> dropsOf(const Glass& glass, const WindshieldState& state, const GlassMapOptions& options)
{
    const Reliefs reliefs(glass, options.body, options.forces);
    std::vector<Drop> drops;
    for (const StillDroplet& still : state.still.all()) {
        drops.push_back(
            {still.position, {1.0, 0.0}, {}, still.volume, runningShape(still.volume, 0.0, options.shape), false});
    }
    for (const RunningDroplet& running : state.droplets) {
        const double speed = length(running.velocity);
        const auto relief = reliefs.of(running);
        drops.push_back({running.position, speed > 0.0 ? (1.0 / speed) * running.velocity : Vec2{1.0, 0.0},
                         running.velocity, running.volume, runningShape(running.volume, speed, options.shape), true,
                         relief ? std::make_shared<const BodyRelief>(*relief) : nullptr});
    }
    return drops;
}

/// Sums up the pixels and calls take(row, its pixels), in parallel, once for each row.
template <typename Take>
void forRows(const Raster& raster, const std::vector<Drop>& drops, const Take& take)
{
    const int width = raster.width();
    const int height = raster.height();
    std::vector<double> shares(drops.size());
    tbb::parallel_for(std::size_t{0}, drops.size(), [&](std::size_t k) { shares[k] = raster.shareOf(drops[k]); });
    // Bands of rows, each with the droplets that reach it.
    constexpr int kBand = 32;
    const int bands = (height + kBand - 1) / kBand;
    std::vector<std::vector<std::uint32_t>> in_band(static_cast<std::size_t>(bands));
    for (std::size_t k = 0; k < drops.size(); ++k) {
        const auto [first, last] = raster.rowsOf(drops[k]);
        for (int band = first / kBand; first <= last && band <= last / kBand; ++band) {
            in_band[static_cast<std::size_t>(band)].push_back(static_cast<std::uint32_t>(k));
        }
    }
    tbb::parallel_for(0, bands, [&](int band) {
        const int top = band * kBand;
        const int bottom = std::min(top + kBand, height) - 1;
        std::vector<Pixel> sums(static_cast<std::size_t>(width) * kBand);
        for (const std::uint32_t k : in_band[static_cast<std::size_t>(band)]) {
            const Drop& drop = drops[k];
            const auto [first, last] = raster.rowsOf(drop);
            const double place = 1.0 / std::pow(raster.placesAcross(drop), 2);
            raster.forPlaces(
                drop, {std::max(first, top), std::min(last, bottom)}, [&](int column, int row, const Water& water) {
                    Pixel& pixel = sums[static_cast<std::size_t>(row - top) * static_cast<std::size_t>(width) +
                                        static_cast<std::size_t>(column)];
                    pixel.thickness += shares[k] * water.thickness;
                    pixel.add(water, place);
                    if (drop.may_run) {
                        pixel.runs += place;
                        pixel.velocity = pixel.velocity + place * drop.velocity;
                    }
                });
        }
        for (int row = top; row <= bottom; ++row) {
            take(row, std::span(sums).subspan(static_cast<std::size_t>(row - top) * static_cast<std::size_t>(width),
                                              static_cast<std::size_t>(width)));
        }
    });
}

Raster rasterFor(const Glass& glass, const GlassMapOptions& options)
{
    options.validate();
    Raster raster(glass, options.width);
    require(raster.height() <= 8192, "height", raster.height(), "at most 8192: use a smaller width");
    return raster;
}

/// Mean unit normal of a pixel.
std::array<double, 3> normalOf(const Pixel& pixel)
{
    const double up = pixel.up + std::max(1.0 - pixel.cover, 0.0);
    const double size = std::sqrt(dot(pixel.slope, pixel.slope) + up * up);
    return {pixel.slope.x / size, pixel.slope.y / size, up / size};
}

Vec2 velocityOf(const Pixel& pixel)
{
    return pixel.runs > 0.0 ? (1.0 / pixel.runs) * pixel.velocity : Vec2{};
}

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
    const Raster raster = rasterFor(glass, options);
    const int width = raster.width();
    const int height = raster.height();
    const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    GlassMaps maps{{width, height, 3, {}}, {width, height, 1, {}}, {width, height, 3, {}}};
    maps.normal.levels.resize(3 * pixels);
    maps.thickness.levels.resize(pixels);
    maps.velocity.levels.resize(3 * pixels);
    forRows(raster, dropsOf(glass, state, options), [&](int row, std::span<const Pixel> held) {
        // The rounding error goes to the next wet pixel of the row; else thin water would vanish.
        double left_over = 0.0;
        std::size_t at = static_cast<std::size_t>(row) * static_cast<std::size_t>(width);
        for (const Pixel& pixel : held) {
            const std::array<double, 3> normal = normalOf(pixel);
            std::transform(normal.begin(), normal.end(), maps.normal.levels.data() + 3 * at, signedLevel);
            if (pixel.thickness > 0.0) {
                const double wanted = pixel.thickness + left_over;
                maps.thickness.levels[at] = unsignedLevel(wanted / options.full_thickness);
                const double in_map = maps.thickness.levels[at] / 65535.0 * options.full_thickness;
                left_over =
                    std::clamp(wanted - in_map, -options.full_thickness / 65535.0, options.full_thickness / 65535.0);
            }
            const Vec2 velocity = velocityOf(pixel);
            std::uint16_t* const motion = &maps.velocity.levels[3 * at];
            motion[0] = signedLevel(velocity.x / options.full_speed);
            motion[1] = signedLevel(velocity.y / options.full_speed);
            motion[2] = unsignedLevel(pixel.runs);
            ++at;
        }
    });
    return maps;
}

GlassFloatMaps glassFloatMaps(const Glass& glass, const WindshieldState& state, const GlassMapOptions& options)
{
    const Raster raster = rasterFor(glass, options);
    const int width = raster.width();
    const int height = raster.height();
    const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    GlassFloatMaps maps{{width, height, 3, {}}, {width, height, 1, {}}, {width, height, 3, {}}};
    maps.normal.values.resize(3 * pixels);
    maps.thickness.values.resize(pixels);
    maps.velocity.values.resize(3 * pixels);
    forRows(raster, dropsOf(glass, state, options), [&](int row, std::span<const Pixel> held) {
        std::size_t at = static_cast<std::size_t>(row) * static_cast<std::size_t>(width);
        for (const Pixel& pixel : held) {
            const std::array<double, 3> normal = normalOf(pixel);
            const Vec2 velocity = velocityOf(pixel);
            const std::array<double, 3> motion{velocity.x, velocity.y, std::min(pixel.runs, 1.0)};
            const auto narrow = [](double value) { return static_cast<float>(value); };
            std::transform(normal.begin(), normal.end(), maps.normal.values.data() + 3 * at, narrow);
            std::transform(motion.begin(), motion.end(), maps.velocity.values.data() + 3 * at, narrow);
            maps.thickness.values[at] = narrow(pixel.thickness);
            ++at;
        }
    });
    return maps;
}

}  // namespace droplet
