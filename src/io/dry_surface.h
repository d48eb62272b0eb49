// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "droplet/surface/surface.h"

namespace droplet {

/// Whether a surface holds nothing at all, as that of a frame without liquid.
inline bool isDry(const Surface& surface)
{
    return surface.triangles.empty() && surface.positions.empty();
}

/// Guarantees: returns only when a surface is valid, or holds nothing at all.
/// @throws Error InvalidArgument
inline void validateUnlessDry(const Surface& surface)
{
    if (!isDry(surface)) {
        surface.validate();
    }
}

}  // namespace droplet
