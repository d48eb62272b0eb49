// SPDX-License-Identifier: GPL-3.0-or-later
// P1 stiffness by cotangents: U. Pinkall, K. Polthier, "Computing discrete minimal surfaces and their conjugates"
// (1993); the library computes it from gradients.
#include "system.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace droplet::bench {

System assemble(const PlanarMesh& mesh, const SolveOptions& physics)
{
    const double tension = physics.liquid.surface_tension;
    const double weight = physics.liquid.density * physics.gravity;
    const auto rim = static_cast<Eigen::Index>(mesh.rimVertexCount());
    const auto inner = static_cast<Eigen::Index>(mesh.vertices.size()) - rim;
    System system;
    system.load = Eigen::VectorXd::Zero(inner);
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(6 * mesh.triangles.size());
    const auto add = [&](std::uint32_t a, std::uint32_t b, double value) {
        const Eigen::Index row = std::max(a, b) - rim;
        const Eigen::Index column = std::min(a, b) - rim;
        if (column >= 0) {
            entries.emplace_back(row, column, value);
        }
    };
    for (const Triangle& t : mesh.triangles) {
        const double area = 0.5 * doubleArea(mesh, t);
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = t[(k + 1) % 3];
            const std::uint32_t b = t[(k + 2) % 3];
            const Vec2 to_a = mesh.vertices[a] - mesh.vertices[t[k]];
            const Vec2 to_b = mesh.vertices[b] - mesh.vertices[t[k]];
            const double half_cotangent = dot(to_a, to_b) / (4.0 * area);
            add(a, b, weight * area / 12.0 - tension * half_cotangent);
            add(a, a, tension * half_cotangent);
            add(b, b, tension * half_cotangent);
            add(t[k], t[k], weight * area / 6.0);
            if (!mesh.onRim(t[k])) {
                system.load[t[k] - rim] += area / 3.0;
            }
        }
    }
    system.matrix.resize(inner, inner);
    system.matrix.setFromTriplets(entries.begin(), entries.end());
    return system;
}

double residual(const System& system, const CapillarySurface& field)
{
    Eigen::VectorXd height(system.load.size());
    for (Eigen::Index i = 0; i < height.size(); ++i) {
        height[i] = field.vertices[field.rimVertexCount() + static_cast<std::size_t>(i)].z;
    }
    const Eigen::VectorXd load = field.pressure * system.load;
    return (load - system.matrix.selfadjointView<Eigen::Lower>() * height).norm() / load.norm();
}

double volume(const CapillarySurface& field)
{
    double volume = 0.0;
    for (const Triangle& t : field.triangles) {
        const Vec3& a = field.vertices[t[0]];
        const Vec3& b = field.vertices[t[1]];
        const Vec3& c = field.vertices[t[2]];
        volume += cross(b - a, c - a).z * (a.z + b.z + c.z) / 6.0;
    }
    return volume;
}

double height(const CapillarySurface& field)
{
    double height = 0.0;
    for (const Vec3& p : field.vertices) {
        height = std::max(height, p.z);
    }
    return height;
}

}  // namespace droplet::bench
