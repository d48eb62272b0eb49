// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/rim_normals.h"

#include <cstddef>
#include <cstdint>

#include "unit_vector.h"

namespace droplet {

std::vector<Vec2> rimNormals(const PlanarMesh& mesh)
{
    std::vector<Vec2> normals(mesh.rimVertexCount());
    for (std::size_t loop = 0; loop < mesh.loopCount(); ++loop) {
        for (std::uint32_t v = mesh.loop_starts[loop]; v < mesh.loop_starts[loop + 1]; ++v) {
            const std::uint32_t next = nextOnRim(mesh, loop, v);
            const Vec2 edge = mesh.vertices[next] - mesh.vertices[v];
            const Vec2 outward{edge.y, -edge.x};
            normals[v] = normals[v] + outward;
            normals[next] = normals[next] + outward;
        }
    }
    for (Vec2& n : normals) {
        n = unit(n);
    }
    return normals;
}

}  // namespace droplet
