// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

#include "droplet/vector.h"

namespace droplet {

/// Where textures lie over texture coordinates: these are scaled, turned and moved before they name a place in the
/// picture (glTF's KHR_texture_transform).
struct TexturePlace {
    Vec2 offset;              ///< added last, (0,0) is the picture's top left
    double turn = 0.0;        ///< about the origin [rad]
    Vec2 scale = {1.0, 1.0};  ///< more than 1 repeats the picture

    /// Place in the picture.
    [[nodiscard]] Vec2 at(Vec2 uv) const
    {
        const Vec2 scaled{scale.x * uv.x, scale.y * uv.y};
        const double cosine = std::cos(turn);
        const double sine = std::sin(turn);
        return {offset.x + cosine * scaled.x + sine * scaled.y, offset.y - sine * scaled.x + cosine * scaled.y};
    }

    /// Whether all numbers are equal.
    friend bool operator==(const TexturePlace&, const TexturePlace&) = default;
};

}  // namespace droplet
