// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "droplet/vector.h"

namespace droplet {

/// Vector of length 1 in the direction of another; `otherwise` if that has no length.
inline Vec2 unit(Vec2 a, Vec2 otherwise = {})
{
    const double size = length(a);
    return size > 0.0 ? (1.0 / size) * a : otherwise;
}

/// The same in space.
inline Vec3 unit(Vec3 a, Vec3 otherwise = {})
{
    const double size = length(a);
    return size > 0.0 ? (1.0 / size) * a : otherwise;
}

}  // namespace droplet
