// SPDX-License-Identifier: GPL-3.0-or-later
#include "render/sky.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "render/panorama.h"

namespace droplet {
namespace {

constexpr int kColumns = 64;
constexpr int kRows = 32;
constexpr double kPi = std::numbers::pi;

}  // namespace

Sky::Sky(const Environment& environment, float irradiance) : environment_(environment)
{
    struct Sum {
        Vec3f light;
        Vec3f toward;
        double angle = 0.0;
    };
    std::vector<Sum> sums(static_cast<std::size_t>(kColumns) * kRows);
    double on_ground = 0.0;
    for (int y = 0; y < environment.height; ++y) {
        const double down = (y + 0.5) / environment.height;
        const double angle = 2.0 * kPi / environment.width * kPi / environment.height * std::sin(kPi * down);
        for (int x = 0; x < environment.width; ++x) {
            const double across = (x + 0.5) / environment.width;
            const Vec3f radiance = radianceAt(environment, x, y);
            const Vec3f toward = directionOf({across, down});
            Sum& sum =
                sums[static_cast<std::size_t>(down * kRows) * kColumns + static_cast<std::size_t>(across * kColumns)];
            const auto share = static_cast<float>(angle);
            sum.light = sum.light + share * radiance;
            sum.toward = sum.toward + share * (1e-6F + largest(radiance)) * toward;
            sum.angle += angle;
            on_ground += angle * static_cast<double>(std::max(toward.z, 0.0F) * radiance.y);
        }
    }
    const auto gain = static_cast<float>(irradiance / std::max(on_ground, 1e-20));
    for (std::array<float, 3>& pixel : environment_.radiance) {
        for (float& light : pixel) {
            light *= gain;
        }
    }
    for (const Sum& sum : sums) {
        if (sum.angle > 0.0) {
            const auto angle = static_cast<float>(sum.angle);
            cells_.push_back({unit(sum.toward), (gain / angle) * sum.light, angle});
        }
    }
}

Vec3f Sky::at(Vec3f direction) const
{
    return radianceFrom(environment_, direction);
}

}  // namespace droplet
