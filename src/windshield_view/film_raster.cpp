// SPDX-License-Identifier: GPL-3.0-or-later
#include "windshield_view/film_raster.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "windshield/runoff_cells.h"

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

}  // namespace

struct FilmRaster::Axis {
    std::size_t cells = 0;
    std::size_t pixels = 0;
    double wide = 0.0;  ///< width of a pixel over that of a cell
    double cell = 0.0;  ///< [m]
};

FilmRaster::Taps FilmRaster::tapsOf(const Axis& axis)
{
    struct Span {
        double from = 0.0;  // of the pixel, in cells; pixels at the edges have all beyond them
        double to = 0.0;
        std::size_t first = 0;
        std::size_t end = 0;
    };
    std::vector<Span> spans(axis.pixels);
    Taps taps;
    for (std::size_t k = 0; k < axis.pixels; ++k) {
        constexpr double kFar = 1e9;
        const double low = static_cast<double>(k) * axis.wide;
        const double last = static_cast<double>(axis.cells) - 1.0;
        Span& span = spans[k];
        span.from = k == 0 ? -kFar : low;
        span.to = k + 1 == axis.pixels ? kFar : low + axis.wide;
        span.first = static_cast<std::size_t>(std::clamp(std::floor(span.from - 1.0), 0.0, last));
        span.end = static_cast<std::size_t>(std::clamp(std::ceil(span.to + 1.0), 1.0, last + 1.0));
        taps.count = std::max(taps.count, span.end - span.first);
    }
    taps.first.reserve(axis.pixels);
    taps.shares.reserve(axis.pixels * taps.count);
    for (std::size_t k = 0; k < axis.pixels; ++k) {
        const Span& span = spans[k];
        const double low = static_cast<double>(k) * axis.wide;
        taps.first.push_back(std::min(span.first, axis.cells - taps.count));
        for (std::size_t c = taps.first[k]; c < taps.first[k] + taps.count; ++c) {
            const double middle = static_cast<double>(c) + 0.5;
            const bool reaches = c >= span.first && c < span.end;
            const auto mean = static_cast<float>((upTo(span.to - middle) - upTo(span.from - middle)) / axis.wide);
            const auto slope = static_cast<float>((splineAt(low + axis.wide - middle) - splineAt(low - middle)) /
                                                  (axis.wide * axis.cell));
            taps.shares.push_back(reaches ? Float4{mean, slope, mean, 0.0F} : float4(0.0F));
        }
    }
    return taps;
}

FilmRaster::FilmRaster(const WaterRaster& raster, const Runoff& film)
    : raster_(raster),
      film_(film),
      relief_(film.drift),
      across_(
          tapsOf({film.columns, static_cast<std::size_t>(raster.width()), raster.pixel().x / film.cell, film.cell})),
      up_(tapsOf({film.rows, static_cast<std::size_t>(raster.height()), raster.pixel().y / film.cell, film.cell}))
{
    columns_.reserve(static_cast<std::size_t>(raster.width()));
    for (int column = 0; column < raster.width(); ++column) {
        columns_.push_back(relief_.columnOf(static_cast<float>((column + 0.5) * raster.pixel().x)));
    }
}

void FilmRaster::row(std::size_t row, std::span<WaterPixel> to) const
{
    constexpr auto kUnit = static_cast<float>(Runoff::kThickness);
    const std::size_t from_below = static_cast<std::size_t>(raster_.height()) - 1 - row;
    // Means over the row's height in each column of cells: thickness, thickness again, its slope up the glass.
    std::vector<Float4> means(film_.columns, float4(0.0F));
    for (std::size_t j = 0; j < up_.count; ++j) {
        const std::int32_t* const cells = film_.thickness.data() + (up_.first[from_below] + j) * film_.columns;
        const Float4 share = float4(kUnit) * up_.shares[from_below * up_.count + j];
        const Float4 share_of{share[0], share[0], share[1], 0.0F};
        for (std::size_t c = 0; c < film_.columns; ++c) {
            means[c] += share_of * float4(static_cast<float>(cells[c]));
        }
    }
    const RunoffRelief::Row relief(relief_,
                                   static_cast<float>((static_cast<double>(from_below) + 0.5) * raster_.pixel().y));
    const auto wide = static_cast<float>(raster_.pixel().x);
    const Float4* share = across_.shares.data();
    for (std::size_t k = 0; k < to.size(); ++k) {
        const Float4* reached = means.data() + across_.first[k];
        Float4 mean = float4(0.0F);
        for (const Float4* const end = share + across_.count; share != end; ++share, ++reached) {
            mean += *share * *reached;
        }
        if (mean[0] <= 0.0F) {
            to[k] = {};
            continue;
        }
        const RunoffRelief::Surface surface = relief.at(columns_[k], mean, wide);
        const Float4 facing =
            float4(-std::max(surface.cover, 0.0F)) * surface.relief;  // beside its rim the mean is flat
        constexpr auto kWhole = static_cast<float>(1.0 / WaterPixel::kShare);
        const float cover = std::min(mean[0] * (kWhole / static_cast<float>(kWetFilm)), kWhole);
        const float scale = cover / std::sqrt(1.0F + facing[1] * facing[1] + facing[2] * facing[2]);
        to[k] = {static_cast<std::int64_t>(static_cast<double>(mean[0]) * (1.0 / WaterPixel::kThickness)),
                 static_cast<std::int32_t>(cover),
                 {static_cast<std::int32_t>(scale * facing[1]), static_cast<std::int32_t>(scale * facing[2])},
                 static_cast<std::int32_t>(scale)};
    }
}

}  // namespace droplet
