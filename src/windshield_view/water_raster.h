// SPDX-License-Identifier: GPL-3.0-or-later
// Water of droplets on a raster of the glass, as whole numbers: sums do not depend on the order of droplets, and what
// was added can be taken away again without a rest.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "droplet/body/running_shape.h"
#include "droplet/vector.h"
#include "droplet/windshield/glass.h"
#include "windshield_view/body_relief.h"
#include "windshield_view/splash_rim.h"

namespace droplet {

/// Droplet of either kind, as drawn in maps.
struct WaterDrop {
    Vec2 position;
    Vec2 velocity;
    double volume = 0.0;
    RunningShape shape;
    bool may_run = false;
    std::shared_ptr<const BodyRelief> relief = {};  ///< in place of the shape
};

/// Sums over a pixel, weighted by shares of it.
struct WaterPixel {
    std::int64_t thickness = 0;              ///< in 1e-15 m
    std::int32_t cover = 0;                  ///< in 2^-18 of one, as all that follow
    std::array<std::int32_t, 2> slope = {};  ///< components of the outward unit normal along the glass
    std::int32_t up = 0;                     ///< component of the normal out of the glass

    static constexpr double kThickness = 1e-15;      ///< [m]
    static constexpr double kShare = 1.0 / 262'144;  ///< of one

    /// Adds another one, or with sign −1 takes it away.
    void add(const WaterPixel& other, int sign)
    {
        thickness += sign * other.thickness;
        cover += sign * other.cover;
        slope[0] += sign * other.slope[0];
        slope[1] += sign * other.slope[1];
        up += sign * other.up;
    }
    friend bool operator==(const WaterPixel&, const WaterPixel&) = default;
    /// Mean outward unit normal.
    [[nodiscard]] Vec3f normal() const
    {
        constexpr std::int32_t kWhole = 262'144;
        const auto x = static_cast<float>(slope[0]);
        const auto y = static_cast<float>(slope[1]);
        const auto z = static_cast<float>(up + std::max(kWhole - cover, 0));
        const float scale = 1.0F / std::sqrt(x * x + y * y + z * z);
        return {scale * x, scale * y, scale * z};
    }
};

/// The same of running droplets alone.
struct WaterMotion {
    std::int32_t cover = 0;
    std::array<std::int32_t, 2> velocity = {};  ///< in 2^-18 m/s

    /// Adds another one, or with sign −1 takes it away.
    void add(const WaterMotion& other, int sign)
    {
        cover += sign * other.cover;
        velocity[0] += sign * other.velocity[0];
        velocity[1] += sign * other.velocity[1];
    }
    friend bool operator==(const WaterMotion&, const WaterMotion&) = default;
};

/// Water of one droplet in a pixel.
struct WaterStamp {
    std::uint32_t pixel = 0;  ///< row by row from the upper left
    WaterPixel water;
    WaterMotion motion;

    friend bool operator==(const WaterStamp&, const WaterStamp&) = default;
};

/// Nearly square pixels of a glass, upper edge up.
class WaterRaster {
public:
    /// @param width  [px], > 0
    WaterRaster(const Glass& glass, int width);

    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }
    [[nodiscard]] Vec2 pixel() const { return {pixel_, down_}; }  ///< sides of a pixel [m]

    /// Appends the pixels that a droplet covers, by rows. At least seven sample places lie across it. Their thickness
    /// adds up to its volume, also beyond the edge and between sample places.
    void draw(const WaterDrop& drop, std::vector<WaterStamp>& stamps) const;
    /// Appends the pixels that a splash's rim covers, without thickness: its water is in a droplet already. In a pixel
    /// the rim is taken as straight.
    void draw(const SplashRim& rim, std::vector<WaterStamp>& stamps) const;
    /// Rims of all splashes at a time [s].
    [[nodiscard]] std::vector<WaterStamp> rimsOf(const std::vector<Splash>& splashes, double time) const;

private:
    struct Samples;
    struct Body;

    int width_;
    double pixel_;  ///< width of a pixel [m]
    int height_;
    double top_;   ///< of the glass [m]
    double down_;  ///< height of a pixel [m]
};

}  // namespace droplet
