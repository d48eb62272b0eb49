// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "droplet/drawing/picture.h"
#include "render/optics.h"

namespace droplet {

/// Linear colours of a picture in a pyramid of halved sizes, for views from afar.
class PicturePyramid {
public:
    /// What the levels of a picture, 0 … 255, mean.
    enum class Levels {
        Colours,  ///< light, as on a display
        Numbers,  ///< shares of 1
    };

    explicit PicturePyramid(const Picture& picture, Levels levels = Levels::Colours);

    /// @param uv     (0,0) is the top left, (1,1) the bottom right; beyond, the picture is mirrored repeatedly
    /// @param width  width of the area to average, in uv
    [[nodiscard]] Vec3f at(Vec2 uv, double width) const;
    /// The same, but beyond, the picture is repeated.
    [[nodiscard]] Vec3f repeatedAt(Vec2 uv, double width) const;

private:
    struct Level {
        int width = 0;
        int height = 0;
        std::vector<Vec3f> texels;

        /// Mean of four pixels.
        /// @param right  share of the second column
        /// @param down   share of the second row
        [[nodiscard]] Vec3f mixed(std::array<std::int64_t, 2> columns, std::array<std::int64_t, 2> rows, float right,
                                  float down) const;
    };

    [[nodiscard]] const Level& levelFor(double width) const;

    std::vector<Level> levels_;
};

/// Table with a fine ruling, which makes refraction visible.
class Table {
public:
    /// @param span   larger side of the box around the liquid, which is centred at the origin
    /// @param area   area of that box
    /// @param light  direction toward the key light, on the table
    /// @param light_grey  light grey instead of dark blue
    Table(float span, float area, Vec3f light, bool light_grey);

    /// Share of red, green and blue light that the table scatters.
    /// @param width  width of the area to average
    [[nodiscard]] Vec3f at(Vec3f place, float width) const;

private:
    float span_;
    float pitch_;
    Vec3f light_;
    bool light_grey_;
};

}  // namespace droplet
