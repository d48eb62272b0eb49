// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "droplet/picture/picture.h"
#include "picture/optics.h"

namespace droplet {

/// Linear light of an sRGB level 0 … 1, and back.
float toLinear(float level);
float toDisplay(float light);

/// A picture as paint on ground: linear, halved again and again for looking at it from afar.
class GroundPicture {
public:
    explicit GroundPicture(const Picture& picture);

    /// @param uv     (0,0) its top left, (1,1) its bottom right; beyond it is mirrored again and again
    /// @param width  of what is looked at, in uv
    [[nodiscard]] Vec3f at(Vec2 uv, double width) const;

private:
    struct Level {
        int width = 0;
        int height = 0;
        std::vector<Vec3f> texels;
    };

    std::vector<Level> levels_;
};

/// A table with a fine ruling, whose bends show refraction.
class Table {
public:
    /// @param span   larger side of what stands on it, around the origin
    /// @param area   of the box around that
    /// @param light  toward the key light, on the table
    Table(float span, float area, Vec3f light);

    /// Share of red, green and blue light that it scatters.
    /// @param width  of what is looked at
    [[nodiscard]] Vec3f at(Vec3f place, float width) const;

private:
    float span_;
    float pitch_;
    Vec3f light_;
};

}  // namespace droplet
