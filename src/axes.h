// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "droplet/vector.h"

namespace droplet {

/// Turns a vector from z up to y up. It is a rotation about x, so winding stays outward. The zero keeps −0 out of
/// files.
constexpr Vec3 yUp(Vec3 a)
{
    return {a.x, a.z, 0.0 - a.y};
}

/// Turns a vector from y up to z up.
constexpr Vec3 zUp(Vec3 a)
{
    return {a.x, 0.0 - a.z, a.y};
}

}  // namespace droplet
