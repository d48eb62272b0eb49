// SPDX-License-Identifier: GPL-3.0-or-later
// Picture behind the glass for refracted rays: a pyramid of linear light (L. Williams, "Pyramidal Parametrics",
// SIGGRAPH 1983), as a droplet shows much of the picture on few pixels.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "droplet/drawing/picture.h"
#include "droplet/render/environment.h"
#include "render/optics.h"

namespace droplet {

/// Four floats in one register: red, green, blue and another.
using Float4 = float __attribute__((vector_size(16)));

constexpr Float4 float4(float value)
{
    return Float4{value, value, value, value};
}

/// Place in the picture or in the panorama around it, in 65536ths of its sides from the top left.
struct PlaceInPicture {
    std::uint16_t x = 0;
    std::uint16_t y = 0;
    std::uint8_t level = 0;  ///< level of the backdrop
};

/// Axes of the picture in the car's frame: x right, y ahead, z up.
struct PictureFrame {
    Vec3f right{1.0F, 0.0F, 0.0F};
    Vec3f ahead{0.0F, 1.0F, 0.0F};
    Vec3f up{0.0F, 0.0F, 1.0F};

    [[nodiscard]] Vec3f toCar(Vec3f v) const { return v.x * right + v.y * ahead + v.z * up; }
};

/// Factor from a picture's levels to light. Lamps saturate a picture, and their true brightness is lost; spread by blur
/// or water they would look dull. So they count as brighter, in their own hue.
class Highlights {
public:
    /// @param exposure  factor of all light, > 0
    /// @param boost     ViewOptions::highlight_boost
    Highlights(const Picture& picture, float exposure, std::optional<double> boost);

    /// Factor for a pixel whose brightest channel has a level, from 0 to 1.
    [[nodiscard]] float factor(float level) const;

private:
    float exposure_;
    float boost_;
};

/// Pyramid of the picture behind the glass, and of the panorama around it.
class Backdrop {
public:
    /// @param half_width, half_height  tangents of half the picture's angles
    Backdrop(int width, int height, float half_width, float half_height);

    /// Sets the picture.
    /// @param highlights  factors of this picture
    void setPicture(const Picture& picture, const Highlights& highlights);

    /// Sets the panorama, which directions beyond the picture show instead of the mirrored picture.
    /// @param environment  valid
    /// @param frame        axes of the picture
    /// @param exposure     factor of all light
    /// @param is_all       true: directions within the picture show it, too
    void setEnvironment(const Environment& environment, const PictureFrame& frame, float exposure, bool is_all);

    /// Place that a direction shows: x right, y ahead, z up.
    /// @param level  level of the picture
    [[nodiscard]] PlaceInPicture placeOf(Vec3f direction, std::uint8_t level) const
    {
        const auto ahead = std::max(direction.y, 0.0F);
        if (!around_.empty() && (is_all_around_ || std::abs(direction.x) > half_width_ * ahead ||
                                 std::abs(direction.z) > half_height_ * ahead)) {
            return placeAround(direction, level);
        }
        const auto across = [&](float side, float half) {
            // Within the picture linear in the tangent, beyond it in the inverse.
            const float tangent =
                std::abs(side) <= half * ahead ? side / std::max(ahead, 1e-20F) : half * half * ahead / side;
            return 0.5F + 0.5F * tangent / half;
        };
        return {level16(across(direction.x, half_width_)), level16(1.0F - across(direction.z, half_height_)), level};
    }

    /// Level whose pixels are as wide as a number of the picture's pixels.
    [[nodiscard]] std::uint8_t levelOf(float pixels) const
    {
        const float level = std::round(std::log2(std::max(pixels, 1.0F)));
        return static_cast<std::uint8_t>(std::clamp(level, 1.0F, static_cast<float>(picture_levels_)) - 1.0F);
    }

    /// Light from a place, linear between pixels.
    [[nodiscard]] Float4 at(PlaceInPicture place) const
    {
        const Level& own = levels_[place.level];
        const Float4* const light = light_.data() + own.first;
        const float x = std::max(own.across * static_cast<float>(place.x) - 0.5F, 0.0F);
        const float y = std::max(own.down * static_cast<float>(place.y) - 0.5F, 0.0F);
        const int column = std::min(static_cast<int>(x), own.width - 1);
        const int row = std::min(static_cast<int>(y), own.height - 1);
        const float right = x - static_cast<float>(column);
        const float below = y - static_cast<float>(row);
        const std::size_t next = column + 1 < own.width ? 1 : 0;
        const Float4* const upper = light + static_cast<std::ptrdiff_t>(row) * own.width + column;
        const Float4* const lower = row + 1 < own.height ? upper + own.width : upper;
        const Float4 above = upper[0] + float4(right) * (upper[next] - upper[0]);
        const Float4 under = lower[0] + float4(right) * (lower[next] - lower[0]);
        return above + float4(below) * (under - above);
    }

    /// Index of the pixel that contains a place, among the pixels of all levels.
    [[nodiscard]] std::uint32_t pixelAt(PlaceInPicture place) const
    {
        const Level& own = levels_[place.level];
        const int column = std::min(static_cast<int>(own.across * static_cast<float>(place.x)), own.width - 1);
        const int row = std::min(static_cast<int>(own.down * static_cast<float>(place.y)), own.height - 1);
        return static_cast<std::uint32_t>(own.first) + static_cast<std::uint32_t>(row * own.width + column);
    }

    [[nodiscard]] Float4 at(std::uint32_t pixel) const { return light_[pixel]; }

    /// Mean light of the picture.
    [[nodiscard]] Float4 mean() const { return light_[levels_[picture_levels_ - 1].first]; }

private:
    struct Level {
        int width = 0;
        int height = 0;
        float across = 0.0F;    ///< pixels per 65536th of the picture's width
        float down = 0.0F;      ///< pixels per 65536th of its height
        std::size_t first = 0;  ///< index of its first pixel
    };

    static std::uint16_t level16(float share)
    {
        return static_cast<std::uint16_t>(std::clamp(65536.0F * share, 0.0F, 65535.0F));
    }
    [[nodiscard]] PlaceInPicture placeAround(Vec3f direction, std::uint8_t level) const;
    /// Adds a black level.
    Level& addLevel(int width, int height, float across, float down);
    /// Computes a level from the one before it.
    void halve(std::size_t level);

    float half_width_;
    float half_height_;
    std::vector<Level> levels_;  ///< the first has half the picture's size; then those of the panorama
    std::vector<Float4> light_;  ///< pixels of all levels
    std::size_t picture_levels_ = 0;
    std::vector<std::uint8_t> around_;  ///< for each level of the picture, a similar one of the panorama; empty: none
    PictureFrame frame_;
    bool is_all_around_ = false;
};

}  // namespace droplet
