// SPDX-License-Identifier: GPL-3.0-or-later
#include "windshield_view/backdrop.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <numbers>

#include "drawing/tone.h"
#include "render/panorama.h"

namespace droplet {
namespace {

/// Sums of four levels. Pixels of the first level are means of four neighbours, which differ little, so their levels
/// may be averaged instead of their light.
constexpr std::size_t kSums = 4 * 255 + 1;
using Sums = std::array<float, kSums>;

const Sums& lightOfSums()
{
    static const Sums light = [] {
        Sums made{};
        for (std::size_t i = 0; i < made.size(); ++i) {
            made[i] = toLinear(static_cast<float>(i) / static_cast<float>(kSums - 1));
        }
        return made;
    }();
    return light;
}

/// Share of the boost at a level: it begins at four fifths, by eye.
float highlight(float level)
{
    return smoothstep(0.8F, 1.0F, level);
}

/// Boost for a picture: lamps are few; a picture with much brightness shows daylight, without boost.
float boostFor(const Picture& picture)
{
    constexpr std::size_t kEvery = 8;
    const auto width = static_cast<std::size_t>(picture.width);
    double bright = 0.0;
    std::size_t count = 0;
    for (std::size_t y = kEvery / 2; y < static_cast<std::size_t>(picture.height); y += kEvery) {
        for (std::size_t x = kEvery / 2; x < width; x += kEvery, ++count) {
            const std::uint8_t* const at = picture.rgb.data() + 3 * (y * width + x);
            bright += static_cast<double>(highlight(static_cast<float>(std::max({at[0], at[1], at[2]})) / 255.0F));
        }
    }
    return 3.0F * (1.0F - smoothstep(0.04F, 0.2F, static_cast<float>(bright / static_cast<double>(count))));
}

template <typename Work>
void forRows(int rows, const Work& work)
{
    constexpr int kRowsPerBlock = 16;
    tbb::parallel_for(tbb::blocked_range<int>(0, rows, kRowsPerBlock), [&](const auto& range) {
        for (int y = range.begin(); y < range.end(); ++y) {
            work(static_cast<std::size_t>(y));
        }
    });
}

}  // namespace

Highlights::Highlights(const Picture& picture, float exposure, std::optional<double> boost)
    : exposure_(exposure), boost_(boost ? static_cast<float>(*boost) : boostFor(picture))
{
}

float Highlights::factor(float level) const
{
    return exposure_ * (1.0F + boost_ * highlight(level));
}

Backdrop::Backdrop(int width, int height, float half_width, float half_height)
    : half_width_(half_width), half_height_(half_height)
{
    float pixel = 1.0F;
    int w = width;
    int h = height;
    do {
        w = (w + 1) / 2;
        h = (h + 1) / 2;
        pixel *= 2.0F;
        addLevel(w, h, static_cast<float>(width) / pixel, static_cast<float>(height) / pixel);
    } while (w > 1 || h > 1);
    picture_levels_ = levels_.size();
}

Backdrop::Level& Backdrop::addLevel(int width, int height, float across, float down)
{
    levels_.push_back({width, height, across / 65536.0F, down / 65536.0F, light_.size()});
    light_.resize(light_.size() + static_cast<std::size_t>(width) * static_cast<std::size_t>(height), float4(0.0F));
    return levels_.back();
}

void Backdrop::setEnvironment(const Environment& environment, const PictureFrame& frame, float exposure, bool is_all)
{
    frame_ = frame;
    is_all_around_ = is_all;
    light_.resize(levels_[picture_levels_ - 1].first + 1);
    levels_.resize(picture_levels_);
    // Limit of the resolution: droplets do not show more.
    constexpr int kWidest = 4096;
    int every = 1;
    while (environment.width / every > kWidest) {
        every *= 2;
    }
    int w = (environment.width + every - 1) / every;
    int h = (environment.height + every - 1) / every;
    float pixel = static_cast<float>(every);
    const std::size_t first = levels_.size();
    for (bool is_first = true; is_first || w > 1 || h > 1; is_first = false) {
        if (!is_first) {
            w = (w + 1) / 2;
            h = (h + 1) / 2;
            pixel *= 2.0F;
        }
        addLevel(w, h, static_cast<float>(environment.width) / pixel, static_cast<float>(environment.height) / pixel);
        if (!is_first) {
            halve(levels_.size() - 1);
            continue;
        }
        Float4* const to = light_.data() + levels_.back().first;
        tbb::parallel_for(0, h, [&](int y) {
            for (int x = 0; x < w; ++x) {
                Vec3f sum;
                float count = 0.0F;
                for (int j = y * every; j < std::min((y + 1) * every, environment.height); ++j) {
                    for (int i = x * every; i < std::min((x + 1) * every, environment.width); ++i, ++count) {
                        sum = sum + radianceAt(environment, i, j);
                    }
                }
                const float share = exposure / count;
                to[static_cast<std::ptrdiff_t>(y) * w + x] = Float4{share * sum.x, share * sum.y, share * sum.z, 1.0F};
            }
        });
    }
    // Levels of the panorama whose pixels have about the angle of the picture's.
    constexpr float kRound = 2.0F * std::numbers::pi_v<float>;
    around_.clear();
    for (std::size_t k = 0; k < picture_levels_; ++k) {
        const float angle = 2.0F * half_width_ / (65536.0F * levels_[k].across);
        std::size_t level = first;
        while (level + 1 < levels_.size() && 1.41F * kRound / (65536.0F * levels_[level].across) < angle) {
            ++level;
        }
        around_.push_back(static_cast<std::uint8_t>(level));
    }
}

PlaceInPicture Backdrop::placeAround(Vec3f direction, std::uint8_t level) const
{
    const PanoramaPlace place = placeOnPanorama(unit(frame_.toCar(direction)));
    return {level16(static_cast<float>(place.across)), level16(static_cast<float>(place.down)), around_[level]};
}

void Backdrop::setPicture(const Picture& picture, const Highlights& highlights)
{
    const float* const light = lightOfSums().data();
    // Factor of a pixel's light by its brightest channel.
    Sums factors{};
    for (std::size_t i = 0; i < factors.size(); ++i) {
        factors[i] = highlights.factor(static_cast<float>(i) / static_cast<float>(kSums - 1));
    }
    const auto width = static_cast<std::size_t>(picture.width);
    const auto height = static_cast<std::size_t>(picture.height);
    const Level& first = levels_.front();
    forRows(first.height, [&](std::size_t y) {
        const std::uint8_t* const upper = picture.rgb.data() + 3 * width * (2 * y);
        const std::uint8_t* const lower = 2 * y + 1 < height ? upper + 3 * width : upper;
        Float4* const to = light_.data() + y * static_cast<std::size_t>(first.width);
        for (std::size_t x = 0; x < static_cast<std::size_t>(first.width); ++x) {
            const std::size_t a = 6 * x;
            const std::size_t b = 2 * x + 1 < width ? a + 3 : a;
            const auto sum = [&](std::size_t c) {
                return std::size_t{upper[a + c]} + upper[b + c] + lower[a + c] + lower[b + c];
            };
            const std::size_t red = sum(0);
            const std::size_t green = sum(1);
            const std::size_t blue = sum(2);
            const float share = factors[std::max({red, green, blue})];
            to[x] = Float4{share * light[red], share * light[green], share * light[blue], 1.0F};
        }
    });
    for (std::size_t k = 1; k < picture_levels_; ++k) {
        halve(k);
    }
}

void Backdrop::halve(std::size_t number)
{
    const Level& from = levels_[number - 1];
    const Level& level = levels_[number];
    forRows(level.height, [&](std::size_t y) {
        const Float4* const upper = light_.data() + from.first + 2 * y * static_cast<std::size_t>(from.width);
        const Float4* const lower = 2 * y + 1 < static_cast<std::size_t>(from.height) ? upper + from.width : upper;
        Float4* const to = light_.data() + level.first + y * static_cast<std::size_t>(level.width);
        for (std::size_t x = 0; x < static_cast<std::size_t>(level.width); ++x) {
            const std::size_t a = 2 * x;
            const std::size_t b = a + 1 < static_cast<std::size_t>(from.width) ? a + 1 : a;
            to[x] = float4(0.25F) * ((upper[a] + upper[b]) + (lower[a] + lower[b]));
        }
    });
}

}  // namespace droplet
