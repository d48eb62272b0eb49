// SPDX-License-Identifier: GPL-3.0-or-later
//
// Normals from the recovered gradient: O. C. Zienkiewicz and J. Z. Zhu, "A simple error estimator and adaptive
// procedure for practical engineering analysis" (1987), area-weighted means; on the rim, where a mean is one-sided and
// a whole order worse, from the slope that balances the rim's force (see solve).

#include "droplet/surface/loft.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "blocks.h"
#include "droplet/error.h"
#include "droplet/mesh/triangulate.h"
#include "mesh/regular_runs.h"
#include "shape/gradient.h"

namespace droplet {
namespace {

constexpr double kRoot3 = std::numbers::sqrt3;

/// Unit normals of the rim's two edges at every rim vertex, outward from the liquid, averaged by length.
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
        const double size = length(n);
        n = size > 0.0 ? (1.0 / size) * n : Vec2{};
    }
    return normals;
}

/// Area-weighted means of the gradients on the triangles around every vertex; on the rim from the slope.
std::vector<Vec2> recoveredGradients(const PlanarMesh& mesh, const HeightField& field)
{
    std::vector<Vec2> gradients(mesh.vertices.size());
    const std::size_t irregular = irregularTriangleCount(mesh);
    std::vector<double> weights(mesh.vertices.size(), 0.0);
    for (std::size_t i = 0; i < irregular; ++i) {
        const Triangle& t = mesh.triangles[i];
        const double twice = doubleArea(mesh, t);
        const Vec2 g = gradient(mesh, t, field.height);
        for (const std::uint32_t v : t) {
            gradients[v] = gradients[v] + twice * g;
            weights[v] += twice;
        }
    }
    for (std::size_t v = 0; v < gradients.size(); ++v) {
        if (weights[v] > 0.0) {
            gradients[v] = (1.0 / weights[v]) * gradients[v];
        }
    }
    // Around six equilateral triangles the mean is Σ u·(direction to the neighbour) / (3·edge).
    const double along = 1.0 / (3.0 * mesh.lattice.edge);
    const std::vector<RegularRun> runs = regularRuns(mesh.lattice);
    tbb::parallel_for(std::size_t{0}, runs.size(), [&](std::size_t k) {
        const RegularRun& run = runs[k];
        const double* centre = field.height.data() + run.first;
        const double* below = field.height.data() + run.below;
        const double* above = field.height.data() + run.above;
        const double* left = centre - 1;
        for (std::uint32_t i = 0; i < run.count; ++i) {
            const double across = (above[i + 1] - above[i]) + (below[i + 1] - below[i]);
            const double up = (above[i] + above[i + 1]) - (below[i] + below[i + 1]);
            gradients[run.first + i] = along * Vec2{(centre[i + 1] - left[i]) + 0.5 * across, 0.5 * kRoot3 * up};
        }
    });
    const std::vector<Vec2> outward = rimNormals(mesh);
    for (std::uint32_t v = 0; v < mesh.rimVertexCount(); ++v) {
        gradients[v] = -field.rim_slope[v] * outward[v];
    }
    return gradients;
}

Vec3 normalOf(Vec2 g)
{
    const double size = std::sqrt(1.0 + dot(g, g));
    return {-g.x / size, -g.y / size, 1.0 / size};
}

/// Vertices and triangles of a surface to be made.
struct Counts {
    std::size_t vertices = 0;
    std::size_t triangles = 0;
};

/// Where a droplet's part of the surface begins.
struct Part {
    Counts liquid;
    Counts ground;
};

Vec2 textureAt(Vec2 p, const LoftOptions& options)
{
    return {0.5 + p.x / options.extent.x, 0.5 - p.y / options.extent.y};
}

void fillLiquid(const PlanarMesh& mesh, const HeightField& field, const LoftOptions& options, const Counts& begin,
                Surface& surface)
{
    const std::vector<Vec2> gradients = recoveredGradients(mesh, field);
    const auto first = static_cast<std::uint32_t>(begin.vertices);
    forBlocks(mesh.vertices.size(), [&](std::size_t from, std::size_t to) {
        for (std::size_t v = from; v < to; ++v) {
            const Vec2 p = mesh.vertices[v];
            surface.positions[first + v] = {p.x, p.y, field.height[v]};
            surface.normals[first + v] = normalOf(gradients[v]);
            surface.uvs[first + v] = textureAt(p, options);
            surface.weld[first + v] = first + static_cast<std::uint32_t>(v);
        }
    });
    forBlocks(mesh.triangles.size(), [&](std::size_t from, std::size_t to) {
        for (std::size_t i = from; i < to; ++i) {
            const Triangle& t = mesh.triangles[i];
            surface.triangles[begin.triangles + i] = {first + t[0], first + t[1], first + t[2]};
        }
    });
}

/// The ground's rim vertices are those of the liquid once more, with a normal of their own.
void fillGround(const PlanarMesh& ground, const LoftOptions& options, const Part& part, Surface& surface)
{
    const auto first = static_cast<std::uint32_t>(part.ground.vertices);
    const auto liquid = static_cast<std::uint32_t>(part.liquid.vertices);
    for (std::uint32_t v = 0; v < ground.vertices.size(); ++v) {
        const Vec2 p = ground.vertices[v];
        surface.positions[first + v] = {p.x, p.y, 0.0};
        surface.normals[first + v] = {0.0, 0.0, -1.0};
        surface.uvs[first + v] = textureAt(p, options);
        surface.weld[first + v] = ground.onRim(v) ? liquid + v : first + v;
    }
    for (std::size_t i = 0; i < ground.triangles.size(); ++i) {
        const Triangle& t = ground.triangles[i];
        surface.triangles[part.ground.triangles + i] = {first + t[0], first + t[2], first + t[1]};
    }
}

/// Volume and area of a droplet, for the mean height.
struct Extent {
    double volume = 0.0;
    double area = 0.0;
};

Extent extentOf(const PlanarMesh& mesh, const HeightField& field)
{
    Extent total;
    for (const Extent& block : mapBlocks<Extent>(mesh.triangles.size(), [&](std::size_t begin, std::size_t end) {
             Extent sum;
             for (std::size_t i = begin; i < end; ++i) {
                 const Triangle& t = mesh.triangles[i];
                 const double area = 0.5 * doubleArea(mesh, t);
                 sum.area += area;
                 sum.volume += area * (field.height[t[0]] + field.height[t[1]] + field.height[t[2]]) / 3.0;
             }
             return sum;
         })) {
        total.volume += block.volume;
        total.area += block.area;
    }
    return total;
}

}  // namespace

void LoftOptions::validate() const
{
    if (!(extent.x > 0.0 && extent.y > 0.0 && std::isfinite(extent.x) && std::isfinite(extent.y))) {
        throw Error(ErrorCode::InvalidArgument,
                    "extent " + std::to_string(extent.x) + " m × " + std::to_string(extent.y) + " m must be positive");
    }
}

Surface loft(const std::vector<PlanarMesh>& meshes, const std::vector<HeightField>& fields, const LoftOptions& options)
{
    options.validate();
    if (meshes.size() != fields.size()) {
        throw Error(ErrorCode::InvalidArgument, "fields must be as many as meshes: " + std::to_string(fields.size()) +
                                                    " against " + std::to_string(meshes.size()));
    }
    for (std::size_t k = 0; k < meshes.size(); ++k) {
        if (fields[k].height.size() != meshes[k].vertices.size() ||
            fields[k].rim_slope.size() != meshes[k].rimVertexCount()) {
            throw Error(ErrorCode::InvalidArgument, "field " + std::to_string(k) + " does not belong to its mesh");
        }
    }
    std::vector<PlanarMesh> grounds(options.open ? 0 : meshes.size());
    tbb::parallel_for(std::size_t{0}, grounds.size(), [&](std::size_t k) { grounds[k] = cover(meshes[k]); });

    std::vector<Part> parts(meshes.size());
    Counts total;
    const auto take = [&total](Counts& begin, const PlanarMesh& mesh) {
        begin = total;
        total.vertices += mesh.vertices.size();
        total.triangles += mesh.triangles.size();
    };
    for (std::size_t k = 0; k < meshes.size(); ++k) {
        take(parts[k].liquid, meshes[k]);
        if (!options.open) {
            take(parts[k].ground, grounds[k]);
        }
    }
    Surface surface;
    surface.positions.resize(total.vertices);
    surface.normals.resize(total.vertices);
    surface.uvs.resize(total.vertices);
    surface.weld.resize(total.vertices);
    surface.triangles.resize(total.triangles);
    std::vector<Extent> extents(meshes.size());
    tbb::parallel_for(std::size_t{0}, meshes.size(), [&](std::size_t k) {
        fillLiquid(meshes[k], fields[k], options, parts[k].liquid, surface);
        if (!options.open) {
            fillGround(grounds[k], options, parts[k], surface);
        }
        extents[k] = extentOf(meshes[k], fields[k]);
    });
    Extent whole;
    for (const Extent& extent : extents) {
        whole.volume += extent.volume;
        whole.area += extent.area;
    }
    surface.mean_height = whole.volume / whole.area;
    return surface;
}

}  // namespace droplet
