// SPDX-License-Identifier: GPL-3.0-or-later
#include "picture/sky.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace droplet {
namespace {

constexpr int kColumns = 64;
constexpr int kRows = 32;
constexpr double kPi = std::numbers::pi;

Vec3f radianceAt(const Environment& environment, int column, int row)
{
    const auto& [x, y, z] =
        environment.radiance[static_cast<std::size_t>(row) * static_cast<std::size_t>(environment.width) +
                             static_cast<std::size_t>(column)];
    return {x, y, z};
}

/// The direction of a place on the picture, both from 0 to 1.
Vec3f directionOf(double across, double down)
{
    const double longitude = 2.0 * kPi * (across - 0.5);
    const double latitude = kPi * (0.5 - down);
    return toFloats(
        {std::cos(latitude) * std::sin(longitude), std::cos(latitude) * std::cos(longitude), std::sin(latitude)});
}

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
            const Vec3f toward = directionOf(across, down);
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
    const double across =
        std::atan2(static_cast<double>(direction.x), static_cast<double>(direction.y)) / (2.0 * kPi) + 0.5;
    const double down = 0.5 - std::asin(std::clamp(static_cast<double>(direction.z), -1.0, 1.0)) / kPi;
    const double x = across * environment_.width - 0.5;
    const double y = std::clamp(down * environment_.height - 0.5, 0.0, environment_.height - 1.0);
    const int left = static_cast<int>(std::floor(x));
    const int top = static_cast<int>(y);
    const int below = std::min(top + 1, environment_.height - 1);
    const auto wrapped = [&](int column) { return (column + environment_.width) % environment_.width; };
    const auto fx = static_cast<float>(x - left);
    const auto fy = static_cast<float>(y - top);
    const auto row = [&](int r) {
        return mix(radianceAt(environment_, wrapped(left), r), radianceAt(environment_, wrapped(left + 1), r), fx);
    };
    return mix(row(top), row(below), fy);
}

}  // namespace droplet
