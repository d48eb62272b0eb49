// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow_io/object_faces.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace droplet {

std::array<double, 3> weightsAt(const FlowObject& object, const Triangle& triangle, Vec3 place)
{
    const Vec3 a = object.vertices[triangle[0]];
    const Vec3 p = object.vertices[triangle[1]] - a;
    const Vec3 q = object.vertices[triangle[2]] - a;
    const Vec3 across = cross(p, q);
    const Vec3 d = place - a;
    const double v = dot(cross(d, q), across) / dot(across, across);
    const double w = dot(cross(p, d), across) / dot(across, across);
    return {1.0 - v - w, v, w};
}

std::array<std::array<double, 3>, 3> cornerWeights(const FlowObject& object, const FlowSurface::Face& face)
{
    std::array<std::array<double, 3>, 3> weights{};
    for (std::size_t k = 0; k < 3; ++k) {
        weights[k] = weightsAt(object, object.triangles[face.source], face.corners[k]);
    }
    return weights;
}

FlowObject onFaces(const FlowObject& object, const FlowSurface& surface)
{
    FlowObject result;
    result.material_names = object.material_names;
    for (const FlowSurface::Face& face : surface.faces) {
        const Triangle& triangle = object.triangles[face.source];
        const auto weights = cornerWeights(object, face);
        const auto first = static_cast<std::uint32_t>(result.vertices.size());
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 mean = mixed(object.normals, triangle, weights[k]);
            const Vec3 normal = dot(mean, face.normal) < 0.0 ? -1.0 * mean : mean;
            result.vertices.push_back(face.corners[k]);
            result.normals.push_back(length(normal) > 0.0 ? (1.0 / length(normal)) * normal : face.normal);
            if (!object.uvs.empty()) {
                result.uvs.push_back(mixed(object.uvs, triangle, weights[k]));
            }
            if (!object.colours.empty()) {
                // Weights add up to 1 but for the last bit.
                const Vec3 colour = mixed(object.colours, triangle, weights[k]);
                result.colours.push_back(
                    {std::clamp(colour.x, 0.0, 1.0), std::clamp(colour.y, 0.0, 1.0), std::clamp(colour.z, 0.0, 1.0)});
            }
        }
        result.triangles.push_back({first, first + 1, first + 2});
        if (!object.materials.empty()) {
            result.materials.push_back(object.materials[face.source]);
        }
    }
    return result;
}

}  // namespace droplet
