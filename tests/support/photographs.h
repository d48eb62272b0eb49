// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "droplet/vector.h"
#include "torture/random.h"

namespace droplet::testing {

/// Synthetic photograph with a known mask.
struct Photograph {
    int width = 0;
    int height = 0;
    std::vector<std::array<double, 3>> rgb;  ///< levels in [0, 1], row by row from the top left
    double area = 0.0;                       ///< area of the liquid [px²]
    std::size_t droplets = 0;
    std::size_t holes = 0;
};

/// Liquid on a sheet of paper.
struct Scene {
    int width = 0;
    int height = 0;
    /// Signed distance of a point from the liquid [px], negative inside; y down.
    std::function<double(Vec2)> outside;
    /// Light from the liquid over light from dry paper, by the point and its distance from the rim.
    std::function<std::array<double, 3>(Vec2, double)> look;
    std::size_t droplets = 0;
    std::size_t holes = 0;
};

/// Light on the scene, per channel, at a point from (0, 0) to (1, 1).
using Light = std::function<std::array<double, 3>(Vec2)>;

/// A blob whose radius varies around it.
inline double blob(Vec2 p, Vec2 centre, double radius, double waves, int lobes)
{
    const Vec2 d = p - centre;
    const double angle = std::atan2(d.y, d.x);
    return length(d) - radius * (1.0 + waves * std::sin(lobes * angle) + 0.4 * waves * std::cos(2 * angle + 1.0));
}

/// An ink spill with a ring and four splashes: 6 droplets, 1 hole.
inline Scene inkSpill(double size = 640.0)
{
    Scene scene;
    const double s = size / 640.0;
    scene.width = static_cast<int>(size);
    scene.height = static_cast<int>(0.75 * size);
    scene.outside = [s](Vec2 p) {
        const Vec2 q = (1.0 / s) * p;
        double d = blob(q, {250, 230}, 105, 0.16, 5);
        const double ring = length(q - Vec2{505, 330}) - 50;
        d = std::min(d, std::max(ring, 24 - length(q - Vec2{505, 330})));
        for (const auto& [x, y, r] :
             {std::array{450.0, 110.0, 34.0}, {560.0, 180.0, 16.0}, {110.0, 400.0, 22.0}, {80.0, 90.0, 12.0}}) {
            d = std::min(d, blob(q, {x, y}, r, 0.08, 3));
        }
        return s * d;
    };
    scene.look = [](Vec2, double) { return std::array{0.10, 0.11, 0.16}; };
    scene.droplets = 6;
    scene.holes = 1;
    return scene;
}

/// Clear droplets on paper, darker than it, mostly at the rim, each with the reflection of a lamp: 5 droplets, no hole.
inline Scene clearDroplets(double size = 640.0)
{
    Scene scene;
    scene.width = static_cast<int>(size);
    scene.height = static_cast<int>(0.75 * size);
    const double s = size / 640.0;
    static constexpr std::array<std::array<double, 3>, 5> kDiscs{
        {{170, 170, 80}, {400, 130, 55}, {520, 300, 70}, {300, 350, 60}, {100, 380, 35}}};
    scene.outside = [s](Vec2 p) {
        double d = 1e9;
        for (const auto& [x, y, r] : kDiscs) {
            d = std::min(d, s * blob((1.0 / s) * p, {x, y}, r, 0.04, 3));
        }
        return d;
    };
    scene.look = [s](Vec2 p, double depth) {
        double level = 0.62 - 0.22 * std::exp(-depth / (6.0 * s));
        for (const auto& [x, y, r] : kDiscs) {
            const Vec2 from = (1.0 / s) * p - Vec2{x - 0.4 * r, y - 0.4 * r};
            level = length(from) < 0.16 * r ? 1.6 : level;
        }
        return std::array{level, level, 1.05 * level};
    };
    scene.droplets = 5;
    return scene;
}

inline Light evenLight()
{
    return [](Vec2) { return std::array{0.95, 0.95, 0.95}; };
}

/// Light that falls from full to a quarter.
inline Light gradientLight()
{
    return [](Vec2 p) {
        const double level = 1.0 - 0.75 * std::clamp(0.6 * p.x + 0.4 * p.y, 0.0, 1.0);
        return std::array{level, level, level};
    };
}

inline Light vignette()
{
    return [](Vec2 p) {
        const double r2 = dot(p - Vec2{0.5, 0.5}, p - Vec2{0.5, 0.5}) / 0.5;
        const double level = 1.0 - 0.65 * r2;
        return std::array{level, level, level};
    };
}

/// Light with half of the picture in shadow, with a soft edge.
inline Light shadowLight()
{
    return [](Vec2 p) {
        const double t = std::clamp((p.x + 0.35 * p.y - 0.55) / 0.16, 0.0, 1.0);
        const double level = 0.97 - 0.62 * t * t * (3 - 2 * t);
        return std::array{level, level, level};
    };
}

inline Light lampLight()
{
    return [](Vec2 p) {
        const double level = 0.45 + 0.55 * std::exp(-4.0 * dot(p - Vec2{0.2, 0.3}, p - Vec2{0.2, 0.3}));
        return std::array{level, 0.82 * level, 0.55 * level};
    };
}

/// Takes the photograph, slightly out of focus, on grainy paper.
/// @param noise  standard deviation of every pixel's level
/// @param salt   share of pixels that are randomly white or black
inline Photograph photograph(const Scene& scene, const Light& light, double noise = 0.004, double salt = 0.0)
{
    constexpr double kBlur = 1.6;  // width of an edge [px]
    torture::Random random(7);
    Photograph picture{scene.width, scene.height, {}, 0.0, scene.droplets, scene.holes};
    for (int y = 0; y < scene.height; ++y) {
        for (int x = 0; x < scene.width; ++x) {
            const Vec2 p{x + 0.5, y + 0.5};
            const double d = scene.outside(p);
            const double covered = std::clamp(0.5 - d / kBlur, 0.0, 1.0);
            const auto lit = light({p.x / scene.width, p.y / scene.height});
            const auto liquid = scene.look(p, std::max(0.0, -d));
            const double paper = 0.92 + 0.012 * std::sin(0.9 * x) * std::sin(1.1 * y);
            // The sum of twelve uniform numbers is nearly normal.
            double sum = -6.0;
            for (int k = 0; k < 12; ++k) {
                sum += random.real();
            }
            const double hit = random.real();
            std::array<double, 3> pixel{};
            for (std::size_t c = 0; c < 3; ++c) {
                const double level = paper * lit[c] * (1.0 - covered + covered * liquid[c]) + noise * sum;
                pixel[c] = hit < 0.5 * salt ? 0.0 : hit < salt ? 1.0 : std::clamp(level, 0.0, 1.0);
            }
            picture.rgb.push_back(pixel);
            picture.area += covered;
        }
    }
    return picture;
}

}  // namespace droplet::testing
