// SPDX-License-Identifier: GPL-3.0-or-later
// The picture behind the glass as refracted rays meet it: linear light, halved again and again (L. Williams, "Pyramidal
// Parametrics", SIGGRAPH 1983), for a droplet shows much of it on few pixels.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "droplet/picture/picture.h"
#include "picture/optics.h"

namespace droplet {

/// Red, green, blue and one more, dealt with at once.
using Four = float __attribute__((vector_size(16)));

constexpr Four four(float value)
{
    return Four{value, value, value, value};
}

/// A place in the picture, in 65536ths of its sides from the top left.
struct PlaceInPicture {
    std::uint16_t x = 0;
    std::uint16_t y = 0;
};

/// Linear light of a picture's pixels by their levels. Lamps saturate a picture; how bright they are is lost. Where
/// light is gathered anew, they would look dull: they are taken for brighter, in their own hue.
class Highlights {
public:
    /// @param exposure  times which all light is taken, > 0
    /// @param boost     as ViewOptions::highlight_boost
    Highlights(const Picture& picture, float exposure, std::optional<double> boost);

    /// Times which light is taken where its brightest channel has a level, of 1.
    [[nodiscard]] float times(float level) const;

private:
    float exposure_;
    float boost_;
};

class Backdrop {
public:
    /// @param half_width, half_height  of the picture: tangents
    Backdrop(int width, int height, float half_width, float half_height);

    /// @param highlights  of the picture
    void take(const Picture& picture, const Highlights& highlights);

    /// Where a direction ends: x right, y ahead, z up.
    [[nodiscard]] PlaceInPicture placeOf(Vec3f direction) const
    {
        const auto ahead = std::max(direction.y, 0.0F);
        const auto across = [&](float side, float half) {
            // Within the picture the tangent, beyond it its inverse.
            const float tangent =
                std::abs(side) <= half * ahead ? side / std::max(ahead, 1e-20F) : half * half * ahead / side;
            return 0.5F + 0.5F * tangent / half;
        };
        const auto level = [](float share) {
            return static_cast<std::uint16_t>(std::clamp(65536.0F * share, 0.0F, 65535.0F));
        };
        return {level(across(direction.x, half_width_)), level(1.0F - across(direction.z, half_height_))};
    }

    /// The level whose pixels are so many of the picture's wide.
    [[nodiscard]] std::uint8_t levelOf(float pixels) const
    {
        const float level = std::round(std::log2(std::max(pixels, 1.0F)));
        return static_cast<std::uint8_t>(std::clamp(level, 1.0F, static_cast<float>(levels_.size())) - 1.0F);
    }

    /// Light from a place, linear between pixels; what is as bright as a picture can be is taken to be brighter.
    [[nodiscard]] Four at(PlaceInPicture place, std::uint8_t level) const
    {
        const Level& own = levels_[level];
        const Four* const light = light_.data() + own.first;
        const float x = std::max(own.across * static_cast<float>(place.x) - 0.5F, 0.0F);
        const float y = std::max(own.down * static_cast<float>(place.y) - 0.5F, 0.0F);
        const int column = std::min(static_cast<int>(x), own.width - 1);
        const int row = std::min(static_cast<int>(y), own.height - 1);
        const float right = x - static_cast<float>(column);
        const float below = y - static_cast<float>(row);
        const std::size_t next = column + 1 < own.width ? 1 : 0;
        const Four* const upper = light + static_cast<std::ptrdiff_t>(row) * own.width + column;
        const Four* const lower = row + 1 < own.height ? upper + own.width : upper;
        const Four above = upper[0] + four(right) * (upper[next] - upper[0]);
        const Four under = lower[0] + four(right) * (lower[next] - lower[0]);
        return above + four(below) * (under - above);
    }

    /// The pixel of a level that a place lies in, among those of all levels.
    [[nodiscard]] std::uint32_t pixelAt(PlaceInPicture place, std::uint8_t level) const
    {
        const Level& own = levels_[level];
        const int column = std::min(static_cast<int>(own.across * static_cast<float>(place.x)), own.width - 1);
        const int row = std::min(static_cast<int>(own.down * static_cast<float>(place.y)), own.height - 1);
        return static_cast<std::uint32_t>(own.first) + static_cast<std::uint32_t>(row * own.width + column);
    }

    [[nodiscard]] Four at(std::uint32_t pixel) const { return light_[pixel]; }

    /// Mean of all of it.
    [[nodiscard]] Four mean() const { return light_.back(); }

private:
    struct Level {
        int width = 0;
        int height = 0;
        float across = 0.0F;  ///< pixels in a 65536th of the picture
        float down = 0.0F;
        std::size_t first = 0;  ///< of its pixels
    };

    float half_width_;
    float half_height_;
    std::vector<Level> levels_;  ///< the first is half the picture
    std::vector<Four> light_;    ///< of all levels
};

}  // namespace droplet
