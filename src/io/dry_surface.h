// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "droplet/surface/surface.h"

namespace droplet {

/// Whether a surface is empty, as in a frame without liquid.
inline bool isDry(const Surface& surface)
{
    return surface.triangles.empty() && surface.vertices.empty();
}

/// Guarantees: returns only if a surface is valid or empty.
/// @throws Error InvalidArgument
inline void validateUnlessDry(const Surface& surface)
{
    if (!isDry(surface)) {
        surface.validate();
    }
}

}  // namespace droplet
