// SPDX-License-Identifier: GPL-3.0-or-later
// L. Williams, "Pyramidal Parametrics" (1983).
#include "render/table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "drawing/tone.h"

namespace droplet {
namespace {

// Mirrors a coordinate repeatedly into 0 … 1.
double folded(double a)
{
    const double phase = std::abs(a - 2.0 * std::floor(0.5 * a));
    return phase > 1.0 ? 2.0 - phase : phase;
}

/// Place between two pixels.
struct Between {
    std::int64_t first = 0;
    float share = 0.0F;  ///< of the second
};

Between between(double place)
{
    const double floor = std::floor(place);
    return {static_cast<std::int64_t>(floor), static_cast<float>(place - floor)};
}

}  // namespace

PicturePyramid::PicturePyramid(const Picture& picture, Levels levels)
{
    Level first{picture.width, picture.height, {}};
    first.texels.reserve(picture.rgb.size() / 3);
    std::array<float, 256> shares = displayLevels();
    for (std::size_t level = 0; levels == Levels::Numbers && level < shares.size(); ++level) {
        shares[level] = static_cast<float>(level) / 255.0F;
    }
    for (std::size_t i = 0; i + 2 < picture.rgb.size(); i += 3) {
        first.texels.push_back({shares[picture.rgb[i]], shares[picture.rgb[i + 1]], shares[picture.rgb[i + 2]]});
    }
    levels_.push_back(std::move(first));
    while (levels_.back().width > 1 || levels_.back().height > 1) {
        const Level& fine = levels_.back();
        Level coarse{(fine.width + 1) / 2, (fine.height + 1) / 2, {}};
        coarse.texels.reserve(static_cast<std::size_t>(coarse.width) * static_cast<std::size_t>(coarse.height));
        for (int y = 0; y < coarse.height; ++y) {
            for (int x = 0; x < coarse.width; ++x) {
                Vec3f sum;
                for (int k = 0; k < 4; ++k) {
                    const auto column = static_cast<std::size_t>(std::min(2 * x + k % 2, fine.width - 1));
                    const auto row = static_cast<std::size_t>(std::min(2 * y + k / 2, fine.height - 1));
                    sum = sum + fine.texels[row * static_cast<std::size_t>(fine.width) + column];
                }
                coarse.texels.push_back(0.25F * sum);
            }
        }
        levels_.push_back(std::move(coarse));
    }
}

Vec3f PicturePyramid::Level::mixed(std::array<std::int64_t, 2> columns, std::array<std::int64_t, 2> rows, float right,
                                   float down) const
{
    const auto texel = [&](std::int64_t row, std::int64_t column) {
        return texels[static_cast<std::size_t>(row * width + column)];
    };
    return mix(mix(texel(rows[0], columns[0]), texel(rows[0], columns[1]), right),
               mix(texel(rows[1], columns[0]), texel(rows[1], columns[1]), right), down);
}

const PicturePyramid::Level& PicturePyramid::levelFor(double width) const
{
    const double texels = width * std::max(levels_.front().width, levels_.front().height);
    const auto level = static_cast<std::size_t>(
        std::clamp(std::floor(std::log2(std::max(texels, 1.0)) + 0.25), 0.0, static_cast<double>(levels_.size() - 1)));
    return levels_[level];
}

Vec3f PicturePyramid::at(Vec2 uv, double width) const
{
    const Level& from = levelFor(width);
    const Between column = between(std::clamp(folded(uv.x) * from.width - 0.5, 0.0, from.width - 1.0));
    const Between row = between(std::clamp(folded(uv.y) * from.height - 0.5, 0.0, from.height - 1.0));
    const auto last = [](std::int64_t index, int count) { return std::min<std::int64_t>(index, count - 1); };
    return from.mixed({column.first, last(column.first + 1, from.width)}, {row.first, last(row.first + 1, from.height)},
                      column.share, row.share);
}

Vec3f PicturePyramid::repeatedAt(Vec2 uv, double width) const
{
    const Level& from = levelFor(width);
    const Between column = between((uv.x - std::floor(uv.x)) * from.width - 0.5);
    const Between row = between((uv.y - std::floor(uv.y)) * from.height - 0.5);
    const auto around = [](std::int64_t index, int count) { return (index + count) % count; };
    return from.mixed({around(column.first, from.width), around(column.first + 1, from.width)},
                      {around(row.first, from.height), around(row.first + 1, from.height)}, column.share, row.share);
}

Table::Table(float span, float area, Vec3f light, bool light_grey) : span_(span), light_(light), light_grey_(light_grey)
{
    const float rough = std::sqrt(std::max(area, 1e-6F)) / 18.0F;
    pitch_ = rough;
}

Vec3f Table::at(Vec3f place, float width) const
{
    // The dark table is cool, and warmer toward the key light.
    const float warm = smoothstep(-1.1F, 0.8F, dot(light_, place) / span_);
    const Vec3f base = light_grey_ ? grey(0.94F) : mix({0.055F, 0.118F, 0.168F}, {0.150F, 0.272F, 0.325F}, warm);
    float ruling = 0.0F;
    for (const float along : {place.x, place.y}) {
        const float phase = along / pitch_;
        const float away = std::abs(phase - std::round(phase));
        const float soft = std::max(0.012F, width / pitch_);
        ruling = std::max(ruling, (1.0F - smoothstep(0.012F, 0.020F + soft, away)));
    }
    return mix(base, (light_grey_ ? 0.9F : 1.14F) * base, ruling);
}

}  // namespace droplet
