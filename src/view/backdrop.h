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

#include "droplet/picture/environment.h"
#include "droplet/picture/picture.h"
#include "picture/optics.h"

namespace droplet {

/// Red, green, blue and one more, dealt with at once.
using Four = float __attribute__((vector_size(16)));

constexpr Four four(float value)
{
    return Four{value, value, value, value};
}

/// A place in the picture, or in what is around it, in 65536ths of its sides from the top left.
struct PlaceInPicture {
    std::uint16_t x = 0;
    std::uint16_t y = 0;
    std::uint8_t level = 0;  ///< of the backdrop
};

/// How the picture lies in the car's frame: x right, y ahead, z up.
struct PictureFrame {
    Vec3f right{1.0F, 0.0F, 0.0F};
    Vec3f ahead{0.0F, 1.0F, 0.0F};
    Vec3f up{0.0F, 0.0F, 1.0F};

    [[nodiscard]] Vec3f toCar(Vec3f v) const { return v.x * right + v.y * ahead + v.z * up; }
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

    /// What directions beyond the picture meet instead of the picture mirrored, until the next time.
    /// @param environment  valid; as bright as it is
    /// @param frame        of the picture
    /// @param is_all       directions within the picture meet it, too
    void surround(const Environment& environment, const PictureFrame& frame, float exposure, bool is_all);

    /// Where a direction ends: x right, y ahead, z up.
    /// @param level  of the picture
    [[nodiscard]] PlaceInPicture placeOf(Vec3f direction, std::uint8_t level) const
    {
        const auto ahead = std::max(direction.y, 0.0F);
        if (!around_.empty() && (is_all_around_ || std::abs(direction.x) > half_width_ * ahead ||
                                 std::abs(direction.z) > half_height_ * ahead)) {
            return placeAround(direction, level);
        }
        const auto across = [&](float side, float half) {
            // Within the picture the tangent, beyond it its inverse.
            const float tangent =
                std::abs(side) <= half * ahead ? side / std::max(ahead, 1e-20F) : half * half * ahead / side;
            return 0.5F + 0.5F * tangent / half;
        };
        return {level16(across(direction.x, half_width_)), level16(1.0F - across(direction.z, half_height_)), level};
    }

    /// The level whose pixels are so many of the picture's wide.
    [[nodiscard]] std::uint8_t levelOf(float pixels) const
    {
        const float level = std::round(std::log2(std::max(pixels, 1.0F)));
        return static_cast<std::uint8_t>(std::clamp(level, 1.0F, static_cast<float>(picture_levels_)) - 1.0F);
    }

    /// Light from a place, linear between pixels; what is as bright as a picture can be is taken to be brighter.
    [[nodiscard]] Four at(PlaceInPicture place) const
    {
        const Level& own = levels_[place.level];
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

    /// The pixel of its level that a place lies in, among those of all levels.
    [[nodiscard]] std::uint32_t pixelAt(PlaceInPicture place) const
    {
        const Level& own = levels_[place.level];
        const int column = std::min(static_cast<int>(own.across * static_cast<float>(place.x)), own.width - 1);
        const int row = std::min(static_cast<int>(own.down * static_cast<float>(place.y)), own.height - 1);
        return static_cast<std::uint32_t>(own.first) + static_cast<std::uint32_t>(row * own.width + column);
    }

    [[nodiscard]] Four at(std::uint32_t pixel) const { return light_[pixel]; }

    /// Mean of all of the picture.
    [[nodiscard]] Four mean() const { return light_[levels_[picture_levels_ - 1].first]; }

private:
    struct Level {
        int width = 0;
        int height = 0;
        float across = 0.0F;  ///< pixels in a 65536th of the picture
        float down = 0.0F;
        std::size_t first = 0;  ///< of its pixels
    };

    static std::uint16_t level16(float share)
    {
        return static_cast<std::uint16_t>(std::clamp(65536.0F * share, 0.0F, 65535.0F));
    }
    [[nodiscard]] PlaceInPicture placeAround(Vec3f direction, std::uint8_t level) const;
    /// Adds a level of so many pixels, black.
    Level& addLevel(int width, int height, float across, float down);
    /// Makes a level from the one before it.
    void halve(std::size_t level);

    float half_width_;
    float half_height_;
    std::vector<Level> levels_;  ///< the first is half the picture; then those of what is around it
    std::vector<Four> light_;    ///< of all levels
    std::size_t picture_levels_ = 0;
    std::vector<std::uint8_t> around_;  ///< for each level of the picture one with pixels about as large; empty: none
    PictureFrame frame_;
    bool is_all_around_ = false;
};

}  // namespace droplet
