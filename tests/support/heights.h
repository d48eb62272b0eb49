// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "droplet/shape/base_surface.h"
#include "droplet/shape/capillary_surface.h"

namespace droplet::testing {

/// Heights u of all vertices of a surface [m].
inline std::vector<double> heightsOf(const CapillarySurface& surface)
{
    std::vector<double> heights;
    heights.reserve(surface.vertices.size());
    for (const Vec3& p : surface.vertices) {
        heights.push_back(p.z);
    }
    return heights;
}

/// Height h of the ground under a vertex [m].
inline double groundAt(const CapillarySurface& surface, std::uint32_t vertex, const BaseSurface& ground)
{
    const Vec3& p = surface.vertices[vertex];
    return ground.at({p.x, p.y}).height;
}

/// Thickness u − h of the liquid at a vertex [m].
inline double thicknessAt(const CapillarySurface& surface, std::uint32_t vertex, const BaseSurface& ground)
{
    return surface.vertices[vertex].z - groundAt(surface, vertex, ground);
}

/// A height field on a mesh, without contact angles and pressure.
inline CapillarySurface fieldOn(const PlanarMesh& mesh, const std::vector<double>& heights)
{
    CapillarySurface field{.triangles = mesh.triangles, .loop_starts = mesh.loop_starts, .lattice = mesh.lattice};
    for (std::size_t v = 0; v < heights.size(); ++v) {
        field.vertices.push_back({mesh.vertices[v].x, mesh.vertices[v].y, heights[v]});
    }
    field.contact_angle.assign(mesh.rimVertexCount(), 0.0);
    return field;
}

}  // namespace droplet::testing
