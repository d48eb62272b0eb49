// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/surface/textured_mesh.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "droplet/error.h"

namespace droplet {

void TexturedMesh::validate() const
{
    constexpr double kUnitTolerance = 1e-6;  // as Surface
    const auto refuse = [](const std::string& what) { throw Error(ErrorCode::InvalidArgument, "object." + what); };
    const std::size_t count = vertices.size();
    if (triangles.empty()) {
        refuse("triangles is empty; there must be at least one");
    }
    if (normals.size() != count || uvs.size() != count) {
        refuse("vertices, normals and uvs must be equally many: " + std::to_string(count) + ", " +
               std::to_string(normals.size()) + ", " + std::to_string(uvs.size()));
    }
    for (std::size_t v = 0; v < count; ++v) {
        const Vec3 p = vertices[v];
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
            refuse("vertices[" + std::to_string(v) + "] must be finite");
        }
        if (!(std::abs(length(normals[v]) - 1.0) <= kUnitTolerance)) {
            refuse("normals[" + std::to_string(v) + "] must have length 1");
        }
        if (!std::isfinite(uvs[v].x) || !std::isfinite(uvs[v].y)) {
            refuse("uvs[" + std::to_string(v) + "] must be finite");
        }
    }
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        const std::uint32_t last = std::max({triangles[t][0], triangles[t][1], triangles[t][2]});
        if (last >= count) {
            refuse("triangles[" + std::to_string(t) + "] names vertex " + std::to_string(last) + " of " +
                   std::to_string(count));
        }
    }
}

}  // namespace droplet
