// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "droplet/surface/textured_mesh.h"
#include "droplet/vector.h"

namespace droplet {

/// A triangle of the object, in the picture's plane and in space.
struct Facet {
    std::array<Vec2, 3> flat;                ///< in the picture's plane [m]
    std::array<std::uint32_t, 3> corners{};  ///< of its chart
    std::uint32_t chart = 0;
    double twice_flat = 0.0;  ///< signed doubled area in the plane
};

/// Facets with areas in space and in the plane, charts not yet known. A facet's corners are the object's vertices.
/// @param extent  of the picture [m]
/// @throws Error  InvalidInput where there is none
std::vector<Facet> facetsOf(const TexturedMesh& object, Vec2 extent);

/// Joins facets across edges that are one in space and in uv, where both face the same way. From then on a facet's
/// corners are those of its chart: one for every place in space and uv.
/// @return  every chart's facing: 1, or −1 where it shows the picture mirrored
std::vector<double> joinCharts(const TexturedMesh& object, std::vector<Facet>& facets);

}  // namespace droplet
