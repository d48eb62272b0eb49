// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/facets.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "droplet/error.h"
#include "droplet/surface/onto.h"

namespace droplet {

std::vector<Facet> facetsOf(const TexturedMesh& object, Vec2 extent)
{
    std::vector<Facet> facets;
    for (std::uint32_t source = 0; source < object.triangles.size(); ++source) {
        const Triangle& t = object.triangles[source];
        Facet facet;
        facet.source = source;
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec2 uv = object.uvs[t[k]];
            facet.flat[k] = {(uv.x - 0.5) * extent.x, (0.5 - uv.y) * extent.y};
            facet.corners[k] = t[k];
        }
        facet.twice_flat = cross(facet.flat[1] - facet.flat[0], facet.flat[2] - facet.flat[0]);
        const Vec3 a = object.vertices[t[0]];
        const double twice = length(cross(object.vertices[t[1]] - a, object.vertices[t[2]] - a));
        if (std::isnormal(facet.twice_flat) && std::isnormal(twice) && std::isnormal(1.0 / facet.twice_flat)) {
            facets.push_back(facet);
        }
    }
    if (facets.empty()) {
        throw Error(ErrorCode::InvalidInput, "the object has no triangle with an area both in space and in uv");
    }
    return facets;
}

double metresPerUv(const TexturedMesh& object)
{
    object.validate();
    struct Stretch {
        double length;
        double area;
    };
    std::vector<Stretch> stretches;
    double whole = 0.0;
    for (const Facet& facet : facetsOf(object, {1.0, 1.0})) {
        const auto [i, j, k] = facet.corners;
        const Vec3 a = object.vertices[i];
        const double area = length(cross(object.vertices[j] - a, object.vertices[k] - a));
        stretches.push_back({std::sqrt(area / std::abs(facet.twice_flat)), area});
        whole += area;
    }
    std::sort(stretches.begin(), stretches.end(), [](const Stretch& a, const Stretch& b) {
        return std::pair(a.length, a.area) < std::pair(b.length, b.area);
    });
    double below = 0.0;
    for (const Stretch& stretch : stretches) {
        below += stretch.area;
        if (below >= 0.5 * whole) {
            return stretch.length;
        }
    }
    return stretches.back().length;
}

}  // namespace droplet
