// SPDX-License-Identifier: GPL-3.0-or-later
#include "windshield_view/water_raster.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "wide_vectors.h"

namespace droplet {
namespace {

/// As std::llround(), without its check.
template <typename Integer>
Integer rounded(double value)
{
    return static_cast<Integer>(value + std::copysign(0.5, value));
}

std::int32_t share(double value)
{
    return rounded<std::int32_t>(value * (1.0 / WaterPixel::kShare));
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

/// Sums over the sample places in a pixel that lie on a droplet, in its frame.
struct WaterRaster::Samples {
    int count = 0;
    float ahead = 0.0F;  ///< of normals, times the radius of a capsule
    float left = 0.0F;
    float up = 0.0F;
    float thickness = 0.0F;  ///< [m]
};

/// A droplet in single precision, in its frame.
struct WaterRaster::Body {
    Vec2f along;
    float half = 0.0F;    ///< half the length of its axis [m]
    float wide = 0.0F;    ///< radius of its outline's ends [m]
    float square = 0.0F;  ///< of its radius [m²]
    float centre = 0.0F;  ///< height of its axis [m]
    const BodyRelief* relief = nullptr;

    /// Where its outline, or a box around a relief, begins and ends on a line across the glass; begins after its end if
    /// it does not meet it.
    [[nodiscard]] std::pair<float, float> widthAt(float y, float reach) const
    {
        if (relief != nullptr) {
            return {-reach, reach};
        }
        std::pair<float, float> ends{reach, -reach};
        const auto take = [&](float x) { ends = {std::min(ends.first, x), std::max(ends.second, x)}; };
        for (const float end : {-half, half}) {
            const float off = y - end * along.y;
            if (std::abs(off) < wide) {
                const float chord = std::sqrt(wide * wide - off * off);
                take(end * along.x - chord);
                take(end * along.x + chord);
            }
        }
        if (half == 0.0F) {
            return ends;
        }
        // On its straight flanks.
        for (const float side : {-wide, wide}) {
            const float place = (y - side * along.x) / along.y;
            if (std::abs(place) < half) {
                take(place * along.x - side * along.y);
            }
        }
        return ends;
    }

    /// Sample places on a line across the glass, each at x0 + i · step.
    struct Line {
        float x0 = 0.0F;
        float step = 0.0F;
        float y = 0.0F;
    };

    /// Calls add(i, ahead, left, up, thickness) for the places from `begin` to before `end` that lie on the droplet.
    template <typename Add>
    void sample(const Line& line, int begin, int end, const Add& add) const
    {
        if (relief != nullptr) {
            for (int i = begin; i < end; ++i) {
                const float x = line.x0 + static_cast<float>(i) * line.step;
                const Vec2f place{along.x * x + along.y * line.y, along.x * line.y - along.y * x};
                if (relief->inside(place) > 0.0F) {
                    const BodyRelief::Point point = relief->at(place);
                    add(i, point.normal.x, point.normal.y, point.normal.z, point.height);
                }
            }
            return;
        }
        // In blocks, whose first loop is vectorised.
        constexpr int kBlockLength = 32;
        std::array<float, kBlockLength> ahead;
        std::array<float, kBlockLength> left;
        std::array<float, kBlockLength> up;
        for (; begin < end; begin += kBlockLength) {
            const int count = std::min(end - begin, kBlockLength);
            for (int k = 0; k < count; ++k) {
                const auto at = static_cast<std::size_t>(k);
                const float x = line.x0 + static_cast<float>(begin + k) * line.step;
                const float a = along.x * x + along.y * line.y;
                const float b = along.x * line.y - along.y * x;
                const float beyond = a - std::min(std::max(a, -half), half);
                ahead[at] = beyond;
                left[at] = b;
                up[at] = std::sqrt(std::max(square - beyond * beyond - b * b, 0.0F));
            }
            for (int k = 0; k < count; ++k) {
                const auto at = static_cast<std::size_t>(k);
                // Where the droplet overhangs its contact, there is air below it.
                add(begin + k, ahead[at], left[at], up[at], std::min(up[at] + centre, 2.0F * up[at]));
            }
        }
    }
};

WaterRaster::WaterRaster(const Glass& glass, int width)
    : width_(width),
      pixel_(glass.width() / width),
      height_(std::max(static_cast<int>(std::lround(glass.height() / pixel_)), 1)),
      top_(glass.height()),
      down_(top_ / height_)
{
}

DROPLET_WIDE_VECTORS void WaterRaster::draw(const WaterDrop& drop, std::vector<WaterStamp>& stamps) const
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
    if (right < left || last < first) {
        return;
    }
    const auto f = [](double v) { return static_cast<float>(v); };
    const RunningShape& shape = drop.shape;
    const Body body{{f(along.x), f(along.y)},       f(shape.half_length),   f(shape.silhouette()),
                    f(shape.radius * shape.radius), f(shape.centre_height), drop.relief.get()};
    const int across = static_cast<int>(std::max(std::ceil(3.5 * std::max(pixel_, down_) / halfWidthOf(drop)), 2.0));
    const float step_x = f(pixel_ / across);
    const float step_y = f(down_ / across);
    const float x0 = f(left * pixel_ - drop.position.x) + 0.5F * step_x;
    const float y0 = f(top_ - first * down_ - drop.position.y) - 0.5F * step_y;
    const int columns = right - left + 1;
    const int rows = last - first + 1;
    std::vector<Samples> sums(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
    // Lines above and below the droplet have no sample places on it; one more, for rounding.
    const int above = std::max(static_cast<int>((y0 - f(reach.y)) / step_y) - 1, 0);
    const int below = std::min(static_cast<int>((y0 + f(reach.y)) / step_y) + 2, rows * across);
    for (int j = above; j < below; ++j) {
        const float y = y0 - static_cast<float>(j) * step_y;
        const auto [begin_x, end_x] = body.widthAt(y, f(reach.x));
        const int begin = std::max(static_cast<int>(std::ceil((begin_x - x0) / step_x)), 0);
        const int end = std::min(static_cast<int>(std::floor((end_x - x0) / step_x)) + 1, columns * across);
        if (begin >= end) {
            continue;
        }
        Samples* sum = sums.data() + static_cast<std::size_t>(j / across * columns + begin / across);
        int next = (begin / across + 1) * across;  // first place of the next pixel
        body.sample({x0, step_x, y}, begin, end, [&](int i, float ahead, float aside, float up, float thickness) {
            for (; next <= i; next += across) {
                ++sum;
            }
            ++sum->count;
            sum->ahead += ahead;
            sum->left += aside;
            sum->up += up;
            sum->thickness += thickness;
        });
    }

    const double place = 1.0 / (static_cast<double>(across) * across);
    const double unit = drop.relief ? place : place / shape.radius;
    double total = 0.0;
    for (const Samples& sum : sums) {
        total += static_cast<double>(sum.thickness);
    }
    const double scale = total > 0.0 ? drop.volume / (pixel_ * down_ * total * WaterPixel::kThickness) : 0.0;
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            const Samples& sum = sums[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                                      static_cast<std::size_t>(column)];
            if (sum.count == 0) {
                continue;
            }
            WaterStamp& stamp = stamps.emplace_back();
            stamp.pixel = static_cast<std::uint32_t>((first + row) * width_ + left + column);
            const double ahead = unit * static_cast<double>(sum.ahead);
            const double aside = unit * static_cast<double>(sum.left);
            const double cover = sum.count * place;
            stamp.water.thickness = rounded<std::int64_t>(scale * static_cast<double>(sum.thickness));
            stamp.water.cover = share(cover);
            stamp.water.slope = {share(along.x * ahead - along.y * aside), share(along.y * ahead + along.x * aside)};
            stamp.water.up = share(unit * static_cast<double>(sum.up));
            if (drop.may_run) {
                stamp.motion.cover = stamp.water.cover;
                stamp.motion.velocity = {share(cover * drop.velocity.x), share(cover * drop.velocity.y)};
            }
        }
    }
}

void WaterRaster::draw(const SplashRim& rim, std::vector<WaterStamp>& stamps) const
{
    const auto d = [](float v) { return static_cast<double>(v); };
    const double reach = d(rim.reach());
    const Vec2 middle{d(rim.middle.x), d(rim.middle.y)};
    const auto limited = [](double value, int count) {
        return static_cast<int>(std::clamp(std::floor(value), -1.0, static_cast<double>(count)));
    };
    const int left = std::max(limited((middle.x - reach) / pixel_, width_), 0);
    const int right = std::min(limited((middle.x + reach) / pixel_, width_), width_ - 1);
    const int first = std::max(limited((top_ - middle.y - reach) / down_, height_), 0);
    const int last = std::min(limited((top_ - middle.y + reach) / down_, height_), height_ - 1);
    const double least = std::max(d(rim.radius - 2.0F * rim.half_width) - pixel_, 0.0);
    const double most = reach + pixel_;
    for (int row = first; row <= last; ++row) {
        for (int column = left; column <= right; ++column) {
            const Vec2 from{(column + 0.5) * pixel_ - middle.x, top_ - (row + 0.5) * down_ - middle.y};
            const double squared = dot(from, from);
            if (!(squared > least * least && squared < most * most)) {
                continue;
            }
            const double far = std::sqrt(squared);
            const double off = far - d(rim.radius);
            const Vec2 outward = (1.0 / far) * from;
            const double half = d(rim.halfWidthTowards({static_cast<float>(outward.x), static_cast<float>(outward.y)}));
            // The part of the half disc in the pixel, over its radius.
            const double begin = std::clamp((off - 0.5 * pixel_) / half, -1.0, 1.0);
            const double end = std::clamp((off + 0.5 * pixel_) / half, -1.0, 1.0);
            if (!(end > begin)) {
                continue;
            }
            const double scale = d(rim.strength()) * half / pixel_;
            // The normal at x has the components x and √(1 − x²); these are their integrals.
            const auto integral = [](double x) { return 0.5 * (x * std::sqrt(1.0 - x * x) + std::asin(x)); };
            const double aside = scale * 0.5 * (end * end - begin * begin);
            WaterStamp& stamp = stamps.emplace_back();
            stamp.pixel = static_cast<std::uint32_t>(row * width_ + column);
            stamp.water.cover = share(scale * (end - begin));
            stamp.water.slope = {share(aside * outward.x), share(aside * outward.y)};
            stamp.water.up = share(scale * (integral(end) - integral(begin)));
        }
    }
}

std::vector<WaterStamp> WaterRaster::rimsOf(const std::vector<Splash>& splashes, double time) const
{
    std::vector<WaterStamp> stamps;
    for (const Splash& splash : splashes) {
        if (const std::optional<SplashRim> rim = SplashRim::of(splash, time)) {
            draw(*rim, stamps);
        }
    }
    return stamps;
}

}  // namespace droplet
