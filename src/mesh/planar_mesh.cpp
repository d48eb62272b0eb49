// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/mesh/planar_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "blocks.h"

namespace droplet {

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
    // The smallest angle has the largest cotangent.
    const std::vector<double> largest =
        mapBlocks<double>(mesh.triangles.size(), [&](std::size_t begin, std::size_t end) {
            double cotangent = 0.0;
            for (std::size_t i = begin; i < end; ++i) {
                const Triangle& t = mesh.triangles[i];
                const Vec2 a = mesh.vertices[t[0]];
                const Vec2 b = mesh.vertices[t[1]];
                const Vec2 c = mesh.vertices[t[2]];
                const double twice = std::abs(cross(b - a, c - a));
                const double cosine = std::max({dot(b - a, c - a), dot(c - b, a - b), dot(a - c, b - c)});
                cotangent = std::max(cotangent, cosine / twice);
            }
            return cotangent;
        });
    return std::atan2(1.0, *std::max_element(largest.begin(), largest.end()));
}

}  // namespace droplet
