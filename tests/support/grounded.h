// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>

#include "droplet/mesh/planar_mesh.h"
#include "droplet/shape/base_surface.h"
#include "droplet/shape/solve.h"

namespace droplet::testing {

/// Field made without solving: liquid of a given thickness on the ground, except on the rim.
inline HeightField liquidOn(const PlanarMesh& mesh, const BaseSurface& ground,
                            const std::function<double(Vec2)>& thickness)
{
    HeightField field;
    field.pressure = 1.0;
    for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
        const double h = ground.at(mesh.vertices[v]).height;
        if (!ground.flat()) {
            field.ground.push_back(h);
        }
        field.height.push_back(mesh.onRim(v) ? h : h + thickness(mesh.vertices[v]));
    }
    field.rim_slope.assign(mesh.rimVertexCount(), 0.5);
    field.contact_angle.assign(mesh.rimVertexCount(), 0.5);
    return field;
}

/// ∫(u − h).
inline double volumeOf(const PlanarMesh& mesh, const HeightField& field)
{
    double volume = 0.0;
    for (const Triangle& t : mesh.triangles) {
        volume +=
            doubleArea(mesh, t) / 6.0 * (field.thicknessAt(t[0]) + field.thicknessAt(t[1]) + field.thicknessAt(t[2]));
    }
    return volume;
}

}  // namespace droplet::testing
