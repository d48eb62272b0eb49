// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/mesh/planar_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "blocks.h"
#include "droplet/error.h"
#include "mesh/lattice.h"
#include "number_text.h"

namespace droplet {
namespace {

[[noreturn]] void fail(const std::string& message)
{
    throw Error(ErrorCode::InvalidArgument, message);
}

}  // namespace

void PlanarMesh::validate() const
{
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
        if (onRim(std::max({t[0], t[1], t[2]}))) {
            fail("triangles of the mesh must not have all three vertices on the rim");
        }
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t v = t[k];
            const std::uint32_t w = t[(k + 1) % 3];
            if (onRim(v) && onRim(w) && next[v] != w) {
                fail(fmt::format(
                    "vertices {} and {} of the mesh are joined by an inner edge though both are on the rim", v, w));
            }
        }
    }
    validateLattice(*this);
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
