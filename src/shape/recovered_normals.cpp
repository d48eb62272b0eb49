// SPDX-License-Identifier: GPL-3.0-or-later
//
// Of a height field, means of area vectors are those of gradients: O. C. Zienkiewicz and J. Z. Zhu, "A simple error
// estimator and adaptive procedure for practical engineering analysis" (1987). On the rim a mean is one-sided and less
// accurate by one order; the contact angle comes from the force along the rim, and is not.
#include "shape/recovered_normals.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

#include "blocks.h"
#include "mesh/lattice.h"
#include "mesh/rim_normals.h"
#include "shape/area_vector.h"
#include "shape/sheet_base.h"

namespace droplet {
namespace {

/// Adds normals at the vertices of a height field that have only equilateral triangles around them.
void addRegular(const CapillarySurface& surface, std::vector<Vec3>& normals)
{
    const std::vector<GridRun> runs = regularRuns(surface.lattice.get());
    tbb::parallel_for(std::size_t{0}, runs.size(), [&](std::size_t k) {
        // Around six equilateral triangles the mean gradient is Σ u·(direction to the neighbour) / (3·edge).
        const double along = 1.0 / (3.0 * surface.lattice->edge);
        const GridRun& run = runs[k];
        const auto height = [&](std::size_t v) { return surface.vertices[v].z; };
        for (std::size_t i = 0; i < run.count; ++i) {
            const std::size_t v = run.first + i;
            const std::size_t below = run.below + i;
            const std::size_t above = run.above + i;
            const double across = (height(above + 1) - height(above)) + (height(below + 1) - height(below));
            const double up = (height(above) + height(above + 1)) - (height(below) + height(below + 1));
            const Vec2 gradient =
                along * Vec2{(height(v + 1) - height(v - 1)) + 0.5 * across, 0.5 * std::numbers::sqrt3 * up};
            normals[v] = {-gradient.x, -gradient.y, 1.0};
        }
    });
}

/// @param outward  rimNormals()
std::vector<Vec3> rimNormalsOf(const CapillarySurface& surface, const BaseSurface& ground,
                               const std::vector<Vec2>& outward)
{
    std::vector<Vec3> normals;
    for (std::uint32_t v = 0; v < surface.rimVertexCount(); ++v) {
        const GroundPoint under = ground.at({surface.vertices[v].x, surface.vertices[v].y});
        const Vec2 along{-outward[v].y, outward[v].x};
        const Vec3 up = normalOf(under);
        const Vec3 side = cross({along.x, along.y, dot(under.gradient, along)}, up);
        const double size = length(side);  // 0 at the tip of a slit
        const double angle = size > 0.0 ? surface.contact_angle[v] : 0.0;
        normals.push_back(angle == 0.0 ? up : std::sin(angle) / size * side + std::cos(angle) * up);
    }
    return normals;
}

}  // namespace

std::vector<Vec3> recoveredNormals(const CapillarySurface& surface, const BaseSurface& ground)
{
    std::vector<Vec3> normals(surface.vertices.size());
    const std::size_t irregular = surface.lattice ? surface.lattice->first_regular_triangle : surface.triangles.size();
    for (std::size_t i = 0; i < irregular; ++i) {
        const Triangle& t = surface.triangles[i];
        const Vec3 normal = areaVector(surface.vertices, t);
        for (const std::uint32_t v : t) {
            normals[v] = normals[v] + normal;
        }
    }
    addRegular(surface, normals);
    const std::vector<Vec3> on_rim = rimNormalsOf(surface, ground, rimNormals(rimOf(surface)));
    std::copy(on_rim.begin(), on_rim.end(), normals.begin());
    forBlocks(normals.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t v = begin; v < end; ++v) {
            normals[v] = (1.0 / length(normals[v])) * normals[v];
        }
    });
    return normals;
}

std::vector<double> rimSlopes(const CapillarySurface& surface, const BaseSurface& ground)
{
    const std::vector<Vec2> outward = rimNormals(rimOf(surface));
    const std::vector<Vec3> normals = rimNormalsOf(surface, ground, outward);
    std::vector<double> slopes;
    for (std::size_t v = 0; v < normals.size(); ++v) {
        slopes.push_back(dot(Vec2{normals[v].x, normals[v].y}, outward[v]) / normals[v].z);
    }
    return slopes;
}

}  // namespace droplet
