// SPDX-License-Identifier: GPL-3.0-or-later
// L. Williams, "Pyramidal Parametrics" (1983).
#include "render/table.h"

#include <array>
#include <cmath>

#include "drawing/tone.h"

namespace droplet {
namespace {

// Mirrors a coordinate repeatedly into 0 … 1.
double folded(double a)
{
    const double phase = std::abs(a - 2.0 * std::floor(0.5 * a));
    return phase > 1.0 ? 2.0 - phase : phase;
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

Vec3f PicturePyramid::at(Vec2 uv, double width) const
{
    const double texels = width * std::max(levels_.front().width, levels_.front().height);
    const auto level = static_cast<std::size_t>(
        std::clamp(std::floor(std::log2(std::max(texels, 1.0)) + 0.25), 0.0, static_cast<double>(levels_.size() - 1)));
    const Level& from = levels_[level];
    const double x = std::clamp(folded(uv.x) * from.width - 0.5, 0.0, from.width - 1.0);
    const double y = std::clamp(folded(uv.y) * from.height - 0.5, 0.0, from.height - 1.0);
    const auto column = static_cast<std::size_t>(x);
    const auto row = static_cast<std::size_t>(y);
    const std::size_t next_column = std::min(column + 1, static_cast<std::size_t>(from.width) - 1);
    const std::size_t next_row = std::min(row + 1, static_cast<std::size_t>(from.height) - 1);
    const auto fx = static_cast<float>(x - static_cast<double>(column));
    const auto fy = static_cast<float>(y - static_cast<double>(row));
    const auto texel = [&](std::size_t r, std::size_t c) {
        return from.texels[r * static_cast<std::size_t>(from.width) + c];
    };
    return mix(mix(texel(row, column), texel(row, next_column), fx),
               mix(texel(next_row, column), texel(next_row, next_column), fx), fy);
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
