// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "droplet/drawing/picture.h"
#include "droplet/surface/material.h"

namespace droplet {

/// Look of triangles of a stand.
struct StandLook {
    /// What is transmitted passes a thin wall straight, as through a pane, tinted by the colour; a droplet on it
    /// refracts.
    Look look;
    double opacity = 1.0;                 ///< share that hides what is behind, 0 … 1
    std::optional<Picture> colours = {};  ///< over the stand's uv, which repeats; multiplies the colour
};

}  // namespace droplet
