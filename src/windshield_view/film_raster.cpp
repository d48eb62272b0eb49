// SPDX-License-Identifier: GPL-3.0-or-later
#include "windshield_view/film_raster.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "blocks.h"
#include "windshield/runoff_cells.h"
#include "windshield_view/runoff_relief.h"

namespace droplet {
namespace {

/// Integral of a quadratic B-spline, whose middle is at 0, up to t.
double upTo(double t)
{
    const double away = std::min(std::abs(t), 1.5);
    const double half =
        away < 0.5 ? 0.75 * away - away * away * away / 3.0 : 0.5 - (1.5 - away) * (1.5 - away) * (1.5 - away) / 6.0;
    return t < 0.0 ? 0.5 - half : 0.5 + half;
}

double splineAt(double t)
{
    const double away = std::abs(t);
    return away < 0.5 ? 0.75 - away * away : away < 1.5 ? 0.5 * (1.5 - away) * (1.5 - away) : 0.0;
}

/// Cells that reach a pixel along an axis.
struct Taps {
    std::size_t first = 0;
    std::vector<float> means;   ///< what each adds to the mean over the pixel
    std::vector<float> slopes;  ///< and to its mean slope [1/m]
};

/// Taps of all pixels, from the lower end of the axis.
/// @param cells   number of cells
/// @param pixels  number of pixels
/// @param wide    width of a pixel over that of a cell
std::vector<Taps> tapsOf(std::size_t cells, std::size_t pixels, double wide, double cell)
{
    std::vector<Taps> all(pixels);
    for (std::size_t k = 0; k < pixels; ++k) {
        const double low = static_cast<double>(k) * wide;
        const double high = low + wide;
        // Pixels at the edges have all beyond them.
        constexpr double kFar = 1e9;
        const double from = k == 0 ? -kFar : low;
        const double to = k + 1 == pixels ? kFar : high;
        const double last = static_cast<double>(cells) - 1.0;
        const auto first = static_cast<std::size_t>(std::clamp(std::floor(from - 1.0), 0.0, last));
        const auto end = static_cast<std::size_t>(std::clamp(std::ceil(to + 1.0), 1.0, last + 1.0));
        all[k].first = first;
        for (std::size_t c = first; c < end; ++c) {
            const double middle = static_cast<double>(c) + 0.5;
            all[k].means.push_back(static_cast<float>((upTo(to - middle) - upTo(from - middle)) / wide));
            all[k].slopes.push_back(
                static_cast<float>((splineAt(high - middle) - splineAt(low - middle)) / (wide * cell)));
        }
    }
    return all;
}

}  // namespace

std::vector<WaterPixel> filmOn(const WaterRaster& raster, const Runoff& film)
{
    const auto width = static_cast<std::size_t>(raster.width());
    const auto height = static_cast<std::size_t>(raster.height());
    const Vec2 pixel = raster.pixel();
    const std::vector<Taps> across = tapsOf(film.columns, width, pixel.x / film.cell, film.cell);
    const std::vector<Taps> up = tapsOf(film.rows, height, pixel.y / film.cell, film.cell);
    std::vector<WaterPixel> water(width * height);
    const RunoffRelief relief(film.drift);
    const auto wide = static_cast<float>(pixel.x);
    const auto high = static_cast<float>(pixel.y);
    constexpr std::size_t kRows = 16;  // that a thread takes
    forBlocks(
        height,
        [&](std::size_t begin, std::size_t end) {
            std::vector<float> means(film.columns);
            std::vector<float> rises(film.columns);
            for (std::size_t row = begin; row < end; ++row) {
                const Taps& rows = up[height - 1 - row];
                std::fill(means.begin(), means.end(), 0.0F);
                std::fill(rises.begin(), rises.end(), 0.0F);
                for (std::size_t j = 0; j < rows.means.size(); ++j) {
                    const std::int32_t* const from = film.thickness.data() + (rows.first + j) * film.columns;
                    for (std::size_t c = 0; c < film.columns; ++c) {
                        const auto thickness = static_cast<float>(from[c]);
                        means[c] += rows.means[j] * thickness;
                        rises[c] += rows.slopes[j] * thickness;
                    }
                }
                for (std::size_t column = 0; column < width; ++column) {
                    const Taps& taps = across[column];
                    float mean = 0.0F;
                    Vec2f slope;
                    for (std::size_t i = 0; i < taps.means.size(); ++i) {
                        mean += taps.means[i] * means[taps.first + i];
                        slope.x += taps.slopes[i] * means[taps.first + i];
                        slope.y += taps.means[i] * rises[taps.first + i];
                    }
                    if (mean <= 0.0F) {
                        continue;
                    }
                    WaterPixel& to = water[row * width + column];
                    constexpr auto kUnit = static_cast<float>(Runoff::kThickness);
                    constexpr auto kWhole = static_cast<float>(1.0 / WaterPixel::kShare);
                    constexpr double kUnits = Runoff::kThickness / WaterPixel::kThickness;
                    to.thickness = static_cast<std::int64_t>(kUnits * static_cast<double>(mean));
                    const Vec2f place{(static_cast<float>(column) + 0.5F) * wide,
                                      (static_cast<float>(height - 1 - row) + 0.5F) * high};
                    const RunoffRelief::Surface surface =
                        relief.at(place, {kUnit * mean, {kUnit * slope.x, kUnit * slope.y}}, wide);
                    const float steep = std::max(surface.cover, 0.0F);  // beside its rim the mean is flat
                    const float x = -steep * surface.slope.x;
                    const float y = -steep * surface.slope.y;
                    const float cover = kWhole * std::min(mean * kUnit / static_cast<float>(kWetFilm), 1.0F);
                    const float scale = cover / std::sqrt(1.0F + x * x + y * y);
                    to.cover = static_cast<std::int32_t>(cover);
                    to.slope = {static_cast<std::int32_t>(scale * x), static_cast<std::int32_t>(scale * y)};
                    to.up = static_cast<std::int32_t>(scale);
                }
            }
        },
        kRows);
    return water;
}

}  // namespace droplet
