// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <optional>

#include "droplet/drawing/picture.h"
#include "droplet/surface/material.h"
#include "droplet/surface/texture_place.h"
#include "droplet/vector.h"

namespace droplet {

/// Look of triangles of a stand.
struct StandLook {
    /// What is transmitted passes a thin wall straight, as through a pane, tinted by the colour; a droplet on it
    /// refracts.
    Look look;
    double opacity = 1.0;  ///< share that hides what is behind, 0 … 1
    /// What is transmitted enters matter of the look's index of refraction instead, and leaves it where it meets the
    /// closed surface from inside. The value is the matter's usual thickness for viewers that do not follow light [m],
    /// > 0. Empty: a thin wall
    std::optional<double> thickness = {};
    std::optional<Attenuation> absorption = {};  ///< in that matter
    std::optional<Picture> colours = {};         ///< over the stand's uv, which repeats; multiplies the colour
    /// Directions over the same uv: red and green are parts along uv's x and against its y, blue is outward, from -1 to
    /// 1 (glTF 2.0, section 3.9.3).
    std::optional<Picture> normals = {};
    double relief = 1.0;                 ///< factor on those parts along the surface, finite
    std::optional<Picture> finish = {};  ///< over the same uv: green multiplies the roughness, blue the metal
    Vec3 glow = {};  ///< light of its own, linear red, green, blue; 1 is as bright as white ground in open light, >= 0
    std::optional<Picture> glows = {};  ///< over the same uv: its colours multiply the glow
    /// Over the same uv: red is the share of the surface that is there, linear. Where nothing is, rays pass as through
    /// a hole, without a reflection.
    std::optional<Picture> coverage = {};
    std::optional<double> cutoff = {};  ///< below this share there is nothing, else all, 0 … 1; empty: shares mix
    TexturePlace place = {};            ///< of these pictures over uv, finite

    /// Whether something is there at a pixel of `coverage`; a share that mixes is something unless it is 0.
    [[nodiscard]] bool isThere(int x, int y) const;

    /// The same at a uv of the stand.
    [[nodiscard]] bool isThere(Vec2 uv) const;

    /// Share of the light that passes where it is not mirrored, 0 … 1.
    [[nodiscard]] double clearness() const { return std::min(look.transmission + (1.0 - opacity), 1.0); }
};

}  // namespace droplet
