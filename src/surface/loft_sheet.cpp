// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <utility>

#include "droplet/error.h"
#include "droplet/mesh/triangulate.h"
#include "droplet/surface/loft.h"
#include "number_text.h"
#include "surface/rim_normals.h"

namespace droplet {

Surface loft(const PlanarMesh& footprint, const ParametricSheet& sheet, const LoftOptions& options)
{
    options.validate();
    if (sheet.rim != footprint.rimVertexCount() || sheet.contact_angle.size() != sheet.rim) {
        throw Error(ErrorCode::InvalidArgument, "the sheet's rim must be that of its footprint");
    }
    const auto texture_at = [&](double x, double y) {
        return Vec2{0.5 + x / options.extent.x, 0.5 - y / options.extent.y};
    };
    Surface surface;
    surface.positions = sheet.places;
    surface.triangles = sheet.triangles;
    surface.normals.resize(sheet.places.size());
    for (const Triangle& t : sheet.triangles) {
        const Vec3 normal = cross(sheet.places[t[1]] - sheet.places[t[0]], sheet.places[t[2]] - sheet.places[t[0]]);
        for (const std::uint32_t v : t) {
            surface.normals[v] = surface.normals[v] + normal;
        }
    }
    // On the rim the mean is one-sided; there the contact angle is exact.
    const std::vector<Vec2> outward = rimNormals(footprint);
    for (std::uint32_t v = 0; v < sheet.rim; ++v) {
        const Vec2 side = std::sin(sheet.contact_angle[v]) * outward[v];
        surface.normals[v] = {side.x, side.y, std::cos(sheet.contact_angle[v])};
    }
    for (std::uint32_t v = 0; v < sheet.places.size(); ++v) {
        surface.normals[v] = (1.0 / length(surface.normals[v])) * surface.normals[v];
        surface.uvs.push_back(texture_at(sheet.places[v].x, sheet.places[v].y));
        surface.contact_angle.push_back(v < sheet.rim ? static_cast<float>(sheet.contact_angle[v]) : 0.0F);
        surface.weld.push_back(v);
    }
    if (options.open) {
        return surface;
    }
    const PlanarMesh base = options.bases.empty() ? cover(footprint) : options.bases.front();
    const auto first = static_cast<std::uint32_t>(surface.positions.size());
    for (std::uint32_t v = 0; v < base.vertices.size(); ++v) {
        const Vec2 p = base.vertices[v];
        surface.positions.push_back({p.x, p.y, 0.0});
        surface.normals.push_back({0.0, 0.0, -1.0});
        surface.uvs.push_back(texture_at(p.x, p.y));
        surface.contact_angle.push_back(0.0F);
        surface.weld.push_back(base.onRim(v) ? v : first + v);
    }
    for (const Triangle& t : base.triangles) {
        surface.triangles.push_back({first + t[0], first + t[2], first + t[1]});
    }
    return surface;
}

void append(Surface& surface, const Surface& more)
{
    const auto first = static_cast<std::uint32_t>(surface.positions.size());
    const auto add = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
    add(surface.positions, more.positions);
    add(surface.normals, more.normals);
    add(surface.uvs, more.uvs);
    add(surface.contact_angle, more.contact_angle);
    for (const std::uint32_t v : more.weld) {
        surface.weld.push_back(first + v);
    }
    for (const Triangle& t : more.triangles) {
        surface.triangles.push_back({first + t[0], first + t[1], first + t[2]});
    }
}

}  // namespace droplet
