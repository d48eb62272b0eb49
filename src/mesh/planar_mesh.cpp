// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/mesh/planar_mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "droplet/error.h"

namespace droplet {

void PlanarMesh::validate() const
{
    const auto fail = [](const std::string& message) { throw Error(ErrorCode::InvalidArgument, message); };
    if (loop_starts.size() < 2 || loop_starts.front() != 0 || loop_starts.back() > vertices.size()) {
        fail("loop_starts of the mesh must run from 0 to the number of rim vertices");
    }
    for (std::size_t k = 0; k < loopCount(); ++k) {
        if (loop_starts[k] + 3 > loop_starts[k + 1]) {
            fail("loop " + std::to_string(k) + " of the mesh must have at least three vertices");
        }
    }
    for (const Vec2 v : vertices) {
        if (!std::isfinite(v.x) || !std::isfinite(v.y)) {
            fail("vertices of the mesh must be finite");
        }
    }
    std::vector<std::uint32_t> next(rimVertexCount());
    for (std::size_t k = 0; k < loopCount(); ++k) {
        for (std::uint32_t v = loop_starts[k]; v < loop_starts[k + 1]; ++v) {
            next[v] = nextOnRim(*this, k, v);
        }
    }
    for (const Triangle& t : triangles) {
        if (std::max({t[0], t[1], t[2]}) >= vertices.size()) {
            fail("triangles of the mesh must index its " + std::to_string(vertices.size()) + " vertices");
        }
        if (!(doubleArea(*this, t) > 0)) {
            fail("triangles of the mesh must be counter-clockwise with positive area");
        }
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t v = t[k];
            const std::uint32_t w = t[(k + 1) % 3];
            if (onRim(v) && onRim(w) && next[v] != w) {
                fail("vertices " + std::to_string(v) + " and " + std::to_string(w) +
                     " of the mesh are joined by an inner edge though both are on the rim");
            }
        }
    }
}

std::uint32_t nextOnRim(const PlanarMesh& mesh, std::size_t loop, std::uint32_t vertex)
{
    return vertex + 1 < mesh.loop_starts[loop + 1] ? vertex + 1 : mesh.loop_starts[loop];
}

double doubleArea(const PlanarMesh& mesh, const Triangle& triangle)
{
    const Vec2 a = mesh.vertices[triangle[0]];
    return cross(mesh.vertices[triangle[1]] - a, mesh.vertices[triangle[2]] - a);
}

double area(const PlanarMesh& mesh)
{
    double sum = 0.0;
    for (const Triangle& t : mesh.triangles) {
        sum += doubleArea(mesh, t);
    }
    return 0.5 * sum;
}

double rimLength(const PlanarMesh& mesh)
{
    double sum = 0.0;
    for (std::size_t loop = 0; loop < mesh.loopCount(); ++loop) {
        for (std::uint32_t v = mesh.loop_starts[loop]; v < mesh.loop_starts[loop + 1]; ++v) {
            sum += length(mesh.vertices[nextOnRim(mesh, loop, v)] - mesh.vertices[v]);
        }
    }
    return sum;
}

double minAngle(const PlanarMesh& mesh)
{
    double smallest = std::numbers::pi;
    for (const Triangle& t : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec2 corner = mesh.vertices[t[k]];
            const Vec2 u = mesh.vertices[t[(k + 1) % 3]] - corner;
            const Vec2 v = mesh.vertices[t[(k + 2) % 3]] - corner;
            smallest = std::min(smallest, std::atan2(std::abs(cross(u, v)), dot(u, v)));
        }
    }
    return smallest;
}

}  // namespace droplet
