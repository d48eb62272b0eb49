// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "droplet/mesh/planar_mesh.h"
#include "droplet/shape/base_surface.h"
#include "support/heights.h"

namespace droplet::testing {

/// Field made without solving: liquid of a given thickness on the ground, except on the rim.
inline CapillarySurface liquidOn(const PlanarMesh& mesh, const BaseSurface& ground,
                                 const std::function<double(Vec2)>& thickness)
{
    std::vector<double> heights;
    for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
        const double h = ground.at(mesh.vertices[v]).height;
        heights.push_back(mesh.onRim(v) ? h : h + thickness(mesh.vertices[v]));
    }
    CapillarySurface field = fieldOn(mesh, heights);
    field.pressure = 1.0;
    field.contact_angle.assign(mesh.rimVertexCount(), 0.5);
    return field;
}

/// ∫(u − h).
inline double volumeOf(const CapillarySurface& field, const BaseSurface& ground)
{
    double volume = 0.0;
    for (const Triangle& t : field.triangles) {
        const Vec3 along = field.vertices[t[1]] - field.vertices[t[0]];
        const Vec3 across = field.vertices[t[2]] - field.vertices[t[0]];
        double sum = 0.0;
        for (const std::uint32_t v : t) {
            sum += thicknessAt(field, v, ground);
        }
        volume += cross(along, across).z / 6.0 * sum;
    }
    return volume;
}

}  // namespace droplet::testing
