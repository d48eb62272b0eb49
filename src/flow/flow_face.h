// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>

#include "droplet/flow/flow_surface.h"
#include "droplet/vector.h"

namespace droplet {

/// Gives a face other corners; its normal and the directions inward follow.
/// @param corners  of a triangle with an area
inline void setCorners(FlowSurface::Face& face, const std::array<Vec3, 3>& corners)
{
    face.corners = corners;
    const auto& [a, b, c] = face.corners;
    const Vec3 facet = cross(b - a, c - a);
    face.normal = (1.0 / length(facet)) * facet;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 inward = cross(face.normal, face.corners[(k + 1) % 3] - face.corners[k]);
        face.inward[k] = (1.0 / length(inward)) * inward;
    }
}

}  // namespace droplet
