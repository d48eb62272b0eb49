// SPDX-License-Identifier: GPL-3.0-or-later
#include "view/backdrop.h"

#include <tbb/parallel_for.h>

#include <array>

#include "picture/tone.h"

namespace droplet {
namespace {

/// Lamps saturate a picture; how bright they are is lost. Through a droplet, which makes them small, they would look
/// dull: levels from four fifths up are taken for up to four times as bright, by eye. By the sum of four levels: pixels
/// of the first level are means of neighbours, which differ little, so their levels may be averaged in place of light.
constexpr std::size_t kSums = 4 * 255 + 1;

std::array<float, kSums> brightened()
{
    std::array<float, kSums> light{};
    for (std::size_t i = 0; i < light.size(); ++i) {
        const float level = static_cast<float>(i) / static_cast<float>(kSums - 1);
        light[i] = toLinear(level) * (1.0F + 3.0F * smoothstep(0.8F, 1.0F, level));
    }
    return light;
}

}  // namespace

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
        levels_.push_back({w, h, static_cast<float>(width) / pixel / 65536.0F,
                           static_cast<float>(height) / pixel / 65536.0F, light_.size()});
        light_.resize(light_.size() + static_cast<std::size_t>(w) * static_cast<std::size_t>(h), four(0.0F));
    } while (w > 1 || h > 1);
}

void Backdrop::take(const Picture& picture)
{
    static const std::array<float, kSums> sums = brightened();
    const float* const light = sums.data();
    const auto width = static_cast<std::size_t>(picture.width);
    const auto height = static_cast<std::size_t>(picture.height);
    const Level& first = levels_.front();
    const auto for_rows = [](const Level& level, const auto& work) {
        constexpr int kRowsWorthAThread = 16;
        tbb::parallel_for(tbb::blocked_range<int>(0, level.height, kRowsWorthAThread), [&](const auto& rows) {
            for (int y = rows.begin(); y < rows.end(); ++y) {
                work(static_cast<std::size_t>(y));
            }
        });
    };
    for_rows(first, [&](std::size_t y) {
        const std::uint8_t* const upper = picture.rgb.data() + 3 * width * (2 * y);
        const std::uint8_t* const lower = 2 * y + 1 < height ? upper + 3 * width : upper;
        Four* const to = light_.data() + y * static_cast<std::size_t>(first.width);
        for (std::size_t x = 0; x < static_cast<std::size_t>(first.width); ++x) {
            const std::size_t a = 6 * x;
            const std::size_t b = 2 * x + 1 < width ? a + 3 : a;
            const auto mean = [&](std::size_t c) {
                return light[std::size_t{upper[a + c]} + upper[b + c] + lower[a + c] + lower[b + c]];
            };
            to[x] = Four{mean(0), mean(1), mean(2), 1.0F};
        }
    });
    for (std::size_t k = 1; k < levels_.size(); ++k) {
        const Level& from = levels_[k - 1];
        const Level& level = levels_[k];
        for_rows(level, [&](std::size_t y) {
            const Four* const upper = light_.data() + from.first + 2 * y * static_cast<std::size_t>(from.width);
            const Four* const lower = 2 * y + 1 < static_cast<std::size_t>(from.height) ? upper + from.width : upper;
            Four* const to = light_.data() + level.first + y * static_cast<std::size_t>(level.width);
            for (std::size_t x = 0; x < static_cast<std::size_t>(level.width); ++x) {
                const std::size_t a = 2 * x;
                const std::size_t b = a + 1 < static_cast<std::size_t>(from.width) ? a + 1 : a;
                to[x] = four(0.25F) * ((upper[a] + upper[b]) + (lower[a] + lower[b]));
            }
        });
    }
}

}  // namespace droplet
