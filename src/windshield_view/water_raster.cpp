// SPDX-License-Identifier: GPL-3.0-or-later
#include "windshield_view/water_raster.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace droplet {
namespace {

std::int32_t share(double value)
{
    return static_cast<std::int32_t>(std::lround(value / WaterPixel::kShare));
}

/// Along the motion; at rest along the glass's x.
Vec2 alongOf(const WaterDrop& drop)
{
    const double speed = length(drop.velocity);
    return speed > 0.0 ? (1.0 / speed) * drop.velocity : Vec2{1.0, 0.0};
}

double halfWidthOf(const WaterDrop& drop)
{
    return drop.relief ? static_cast<double>(drop.relief->half_width) : drop.shape.silhouette();
}

/// Half the sides of a box around the droplet.
Vec2 reachOf(const WaterDrop& drop, Vec2 along)
{
    if (drop.relief) {
        const double reach = std::hypot(std::max(-drop.relief->low.x, drop.relief->high.x),
                                        std::max(-drop.relief->low.y, drop.relief->high.y));
        return {reach, reach};
    }
    const double wide = drop.shape.silhouette();
    return {wide + drop.shape.half_length * std::abs(along.x), wide + drop.shape.half_length * std::abs(along.y)};
}

}  // namespace

void WaterPixel::add(const WaterPixel& other, int sign)
{
    thickness += sign * other.thickness;
    cover += sign * other.cover;
    slope[0] += sign * other.slope[0];
    slope[1] += sign * other.slope[1];
    up += sign * other.up;
    runs += sign * other.runs;
    velocity[0] += sign * other.velocity[0];
    velocity[1] += sign * other.velocity[1];
}

Vec3f WaterPixel::normal() const
{
    constexpr std::int32_t kWhole = 262'144;
    const auto x = static_cast<float>(slope[0]);
    const auto y = static_cast<float>(slope[1]);
    const auto z = static_cast<float>(up + std::max(kWhole - cover, 0));
    const float scale = 1.0F / std::sqrt(x * x + y * y + z * z);
    return {scale * x, scale * y, scale * z};
}

/// Sums over the sample places in a pixel that lie on a droplet, in its frame.
struct WaterRaster::Samples {
    int count = 0;
    float ahead = 0.0F;  ///< of normals, times the radius
    float left = 0.0F;
    float up = 0.0F;
    float thickness = 0.0F;  ///< [m]
};

WaterRaster::WaterRaster(const Glass& glass, int width)
    : width_(width),
      pixel_(glass.width() / width),
      height_(std::max(static_cast<int>(std::lround(glass.height() / pixel_)), 1)),
      top_(glass.height()),
      down_(top_ / height_)
{
}

WaterRaster::Samples WaterRaster::sampled(const WaterDrop& drop, std::array<int, 2> pixel, int across) const
{
    const Vec2 along_exact = alongOf(drop);
    const auto f = [](double v) { return static_cast<float>(v); };
    const Vec2f along{f(along_exact.x), f(along_exact.y)};
    const float wide2 = f(drop.shape.silhouette() * drop.shape.silhouette());
    const float r2 = f(drop.shape.radius * drop.shape.radius);
    const float half = f(drop.shape.half_length);
    const float centre = f(drop.shape.centre_height);
    const float step_x = f(pixel_ / across);
    const float step_y = f(down_ / across);
    const float x0 = f(pixel[0] * pixel_ - drop.position.x) + 0.5F * step_x;
    const float y0 = f(top_ - pixel[1] * down_ - drop.position.y) - 0.5F * step_y;
    Samples sum;
    for (int j = 0; j < across; ++j) {
        const float y = y0 - static_cast<float>(j) * step_y;
        for (int i = 0; i < across; ++i) {
            const float x = x0 + static_cast<float>(i) * step_x;
            const float a = along.x * x + along.y * y;
            const float b = along.x * y - along.y * x;
            if (drop.relief) {
                if (drop.relief->inside({a, b}) > 0.0F) {
                    const BodyRelief::Point point = drop.relief->at({a, b});
                    ++sum.count;
                    sum.ahead += point.normal.x;
                    sum.left += point.normal.y;
                    sum.up += point.normal.z;
                    sum.thickness += point.height;
                }
                continue;
            }
            const float end = a - std::clamp(a, -half, half);
            const float far2 = end * end + b * b;
            if (far2 < wide2) {
                const float up = std::sqrt(std::max(r2 - far2, 0.0F));
                ++sum.count;
                sum.ahead += end;
                sum.left += b;
                sum.up += up;
                // Where the droplet overhangs its contact, there is air below it.
                sum.thickness += std::min(up + centre, 2.0F * up);
            }
        }
    }
    return sum;
}

void WaterRaster::draw(const WaterDrop& drop, std::vector<WaterStamp>& stamps) const
{
    const Vec2 along = alongOf(drop);
    const Vec2 reach = reachOf(drop, along);
    const auto limited = [](double value, int count) {
        return static_cast<int>(std::clamp(std::floor(value), -1.0, static_cast<double>(count)));
    };
    const int left = std::max(limited((drop.position.x - reach.x) / pixel_, width_), 0);
    const int right = std::min(limited((drop.position.x + reach.x) / pixel_, width_), width_ - 1);
    const int first = std::max(limited((top_ - drop.position.y - reach.y) / down_, height_), 0);
    const int last = std::min(limited((top_ - drop.position.y + reach.y) / down_, height_), height_ - 1);
    const int across = static_cast<int>(std::max(std::ceil(3.5 * std::max(pixel_, down_) / halfWidthOf(drop)), 2.0));
    const double place = 1.0 / (static_cast<double>(across) * across);
    const double unit = drop.relief ? place : place / drop.shape.radius;
    const std::size_t begin = stamps.size();
    std::vector<double> thickness;
    double sum = 0.0;
    for (int row = first; row <= last; ++row) {
        for (int column = left; column <= right; ++column) {
            const Samples samples = sampled(drop, {column, row}, across);
            if (samples.count == 0) {
                continue;
            }
            WaterStamp& stamp = stamps.emplace_back();
            stamp.pixel = static_cast<std::uint32_t>(row) * static_cast<std::uint32_t>(width_) +
                          static_cast<std::uint32_t>(column);
            const auto ahead = unit * static_cast<double>(samples.ahead);
            const auto aside = unit * static_cast<double>(samples.left);
            const double cover = samples.count * place;
            stamp.water.cover = share(cover);
            stamp.water.slope = {share(along.x * ahead - along.y * aside), share(along.y * ahead + along.x * aside)};
            stamp.water.up = share(unit * static_cast<double>(samples.up));
            if (drop.may_run) {
                stamp.water.runs = stamp.water.cover;
                stamp.water.velocity = {share(cover * drop.velocity.x), share(cover * drop.velocity.y)};
            }
            thickness.push_back(static_cast<double>(samples.thickness));
            sum += thickness.back();
        }
    }
    const double scale = sum > 0.0 ? drop.volume / (pixel_ * down_ * sum * WaterPixel::kThickness) : 0.0;
    for (std::size_t k = 0; k < thickness.size(); ++k) {
        stamps[begin + k].water.thickness = std::llround(scale * thickness[k]);
    }
}

}  // namespace droplet
