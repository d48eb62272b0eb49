// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/shape/capillary_surface.h"

#include <fmt/core.h>

#include <algorithm>
#include <string>

#include "droplet/error.h"
#include "shape/sheet_remesh.h"

namespace droplet {
namespace {

void require(bool is_right, const char* what)
{
    if (!is_right) {
        throw Error(ErrorCode::InvalidArgument, std::string("the surface must have ") + what);
    }
}

PlanarMesh seenFromAbove(const CapillarySurface& surface, std::size_t vertices)
{
    PlanarMesh mesh;
    mesh.loop_starts = surface.loop_starts;
    mesh.vertices.reserve(vertices);
    for (std::size_t v = 0; v < vertices; ++v) {
        mesh.vertices.push_back({surface.vertices[v].x, surface.vertices[v].y});
    }
    return mesh;
}

}  // namespace

void CapillarySurface::validate() const
{
    const std::size_t count = vertices.size();
    require(rimVertexCount() > 0 && rimVertexCount() < count, "a rim, and vertices inside of it");
    require(contact_angle.size() == rimVertexCount(), "a contact angle for every rim vertex");
    require(dry.empty() || dry.size() == count, "as many marks of dry ground as vertices, or none");
    require(std::all_of(triangles.begin(), triangles.end(),
                        [&](const Triangle& t) { return *std::max_element(t.begin(), t.end()) < count; }),
            "triangles of its own vertices");
    require(!footprint || footprint->loop_starts == loop_starts, "the rim of its footprint");
}

PlanarMesh footprintOf(const CapillarySurface& surface)
{
    if (surface.footprint) {
        return *surface.footprint;
    }
    PlanarMesh mesh = seenFromAbove(surface, surface.vertices.size());
    mesh.triangles = surface.triangles;
    mesh.lattice = surface.lattice;
    return mesh;
}

PlanarMesh rimOf(const CapillarySurface& surface)
{
    return seenFromAbove(surface, surface.rimVertexCount());
}

double minAngle(const CapillarySurface& surface)
{
    const std::vector<double> angles = minAngles(surface);
    return *std::min_element(angles.begin(), angles.end());
}

}  // namespace droplet
