// SPDX-License-Identifier: GPL-3.0-or-later
//
// Normals from the recovered gradient: O. C. Zienkiewicz and J. Z. Zhu, "A simple error estimator and adaptive
// procedure for practical engineering analysis" (1987), area-weighted means; on the rim, where a mean is one-sided and
// a whole order worse, from the slope that balances the rim's force (see solve).

#include "droplet/surface/loft.h"

#include <cmath>
#include <string>

#include "droplet/error.h"
#include "shape/gradient.h"

namespace droplet {
namespace {

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

std::vector<Vec2> recoveredGradients(const PlanarMesh& mesh, const HeightField& field)
{
    std::vector<Vec2> gradients(mesh.vertices.size());
    std::vector<double> weights(mesh.vertices.size(), 0.0);
    for (const Triangle& t : mesh.triangles) {
        const double twice = doubleArea(mesh, t);
        const Vec2 g = gradient(mesh, t, field.height);
        for (const std::uint32_t v : t) {
            gradients[v] = gradients[v] + twice * g;
            weights[v] += twice;
        }
    }
    for (std::size_t v = 0; v < gradients.size(); ++v) {
        gradients[v] = (1.0 / weights[v]) * gradients[v];
    }
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

void addDroplet(const PlanarMesh& mesh, const HeightField& field, const LoftOptions& options, Surface& surface)
{
    const auto first = static_cast<std::uint32_t>(surface.positions.size());
    const auto count = static_cast<std::uint32_t>(mesh.vertices.size());
    const auto add = [&](std::uint32_t v, double height, Vec3 normal, std::uint32_t weld) {
        const Vec2 p = mesh.vertices[v];
        surface.positions.push_back({p.x, p.y, height});
        surface.normals.push_back(normal);
        surface.uvs.push_back({0.5 + p.x / options.extent.x, 0.5 - p.y / options.extent.y});
        surface.weld.push_back(weld);
    };
    const std::vector<Vec2> gradients = recoveredGradients(mesh, field);
    for (std::uint32_t v = 0; v < count; ++v) {
        add(v, field.height[v], normalOf(gradients[v]), first + v);
    }
    for (const Triangle& t : mesh.triangles) {
        surface.triangles.push_back({first + t[0], first + t[1], first + t[2]});
    }
    if (options.open) {
        return;
    }
    const std::uint32_t base = first + count;
    for (std::uint32_t v = 0; v < count; ++v) {
        add(v, 0.0, {0.0, 0.0, -1.0}, mesh.onRim(v) ? first + v : base + v);
    }
    for (const Triangle& t : mesh.triangles) {
        surface.triangles.push_back({base + t[0], base + t[2], base + t[1]});
    }
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
    Surface surface;
    double ground = 0.0;
    double volume = 0.0;
    for (std::size_t k = 0; k < meshes.size(); ++k) {
        if (fields[k].height.size() != meshes[k].vertices.size() ||
            fields[k].rim_slope.size() != meshes[k].rimVertexCount()) {
            throw Error(ErrorCode::InvalidArgument, "field " + std::to_string(k) + " does not belong to its mesh");
        }
        addDroplet(meshes[k], fields[k], options, surface);
        for (const Triangle& t : meshes[k].triangles) {
            const double twice = doubleArea(meshes[k], t);
            ground += twice;
            volume += twice * (fields[k].height[t[0]] + fields[k].height[t[1]] + fields[k].height[t[2]]) / 3.0;
        }
    }
    surface.mean_height = volume / ground;
    return surface;
}

}  // namespace droplet
