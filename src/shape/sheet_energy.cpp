// SPDX-License-Identifier: GPL-3.0-or-later
// K. A. Brakke, "The Surface Evolver", Experimental Mathematics 1 (1992): area, gravity and volume of facets as sums
// over triangles, with exact derivatives. Departure: gravity as the flux of a field that vanishes in z = 0, so that the
// base adds nothing; and second derivatives along one direction for every vertex.
#include "shape/sheet_energy.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "blocks.h"

namespace droplet {
namespace {

/// A triangle and its area vector N.
struct Facet {
    std::array<Vec3, 3> x;
    Vec3 normal;  ///< N, as long as the area

    Facet(const CapillarySurface& sheet, const Triangle& t)
        : x{sheet.vertices[t[0]], sheet.vertices[t[1]], sheet.vertices[t[2]]}, normal(areaVector(sheet.vertices, t))
    {
    }
};

void add(const Facet& f, Vec3 weight, SheetIntegrals& sum)
{
    const Vec3 s = f.x[0] + f.x[1] + f.x[2];
    // Means over a triangle: of x z, (Σx Σz + Σ x z) / 12.
    double xz = s.x * s.z;
    double yz = s.y * s.z;
    double zz = s.z * s.z;
    for (const Vec3& p : f.x) {
        xz += p.x * p.z;
        yz += p.y * p.z;
        zz += p.z * p.z;
    }
    sum.area += length(f.normal);
    sum.volume += f.normal.z * s.z / 3.0;
    sum.gravity += f.normal.z * (0.5 * weight.z * zz + weight.x * xz + weight.y * yz) / 12.0;
}

/// Derivatives of a triangle's integrals by the places of its corners.
struct Forces {
    std::array<Vec3, 3> energy;
    Vec3 volume;        ///< the same at every corner
    double area = 0.0;  ///< a third of the triangle
};

Forces forcesOn(const Facet& f, Vec3 weight)
{
    const double area = length(f.normal);
    const Vec3 n = area > 0.0 ? (1.0 / area) * f.normal : Vec3{};
    const std::array<double, 3> phi{dot(weight, f.x[0]), dot(weight, f.x[1]), dot(weight, f.x[2])};
    const double sum = phi[0] + phi[1] + phi[2];
    Forces forces{{}, (1.0 / 3.0) * f.normal, area / 3.0};
    for (std::size_t a = 0; a < 3; ++a) {
        const Vec3 side = f.x[(a + 1) % 3] - f.x[(a + 2) % 3];
        forces.energy[a] = 0.5 * cross(side, n) + ((phi[a] + sum) / 12.0) * f.normal;
    }
    return forces;
}

/// Second derivatives along directions d.
MeshPattern::Element hessianOf(const Facet& f, const std::array<Vec3, 3>& d, Vec3 weight, double pressure)
{
    const double area = length(f.normal);
    const Vec3 n = (1.0 / area) * f.normal;
    const std::array<double, 3> phi{dot(weight, f.x[0]), dot(weight, f.x[1]), dot(weight, f.x[2])};
    const double sum = phi[0] + phi[1] + phi[2];
    std::array<Vec3, 3> g;  // ∂N along the directions
    std::array<double, 3> ng{};
    std::array<double, 3> lift{};
    for (std::size_t a = 0; a < 3; ++a) {
        g[a] = 0.5 * cross(d[a], f.x[(a + 1) % 3] - f.x[(a + 2) % 3]);
        ng[a] = dot(n, g[a]);
        lift[a] = dot(d[a], f.normal);
    }
    MeshPattern::Element result{};
    for (std::size_t a = 0; a < 3; ++a) {
        const std::size_t b = (a + 1) % 3;
        const std::size_t c = (a + 2) % 3;
        result[a] = (dot(g[a], g[a]) - ng[a] * ng[a]) / area + lift[a] * dot(weight, d[a]) / 6.0;
        const double bent = (dot(g[a], g[b]) - ng[a] * ng[b]) / area + 0.5 * dot(n, cross(d[a], d[b]));
        const double heavy = 0.5 *
                             (dot(d[a], g[b]) * (phi[a] + sum) + lift[a] * dot(weight, d[b]) +
                              dot(d[b], g[a]) * (phi[b] + sum) + lift[b] * dot(weight, d[a])) /
                             12.0;
        const double full = dot(d[a], cross(d[b], 2.0 * f.x[c] - f.x[a] - f.x[b])) / 12.0;
        result[3 + a] = bent + heavy - pressure * full;
    }
    return result;
}

}  // namespace

SheetIntegrals integrate(const CapillarySurface& sheet, Vec3 weight)
{
    SheetIntegrals total;
    for (const SheetIntegrals& part : mapBlocks<SheetIntegrals>(
             sheet.triangles.size(),
             [&](std::size_t begin, std::size_t end) {
                 SheetIntegrals sum;
                 for (std::size_t k = begin; k < end; ++k) {
                     add(Facet(sheet, sheet.triangles[k]), weight, sum);
                 }
                 return sum;
             },
             MeshPattern::kTriangles)) {
        total = total + part;
    }
    return total;
}

namespace {

/// @param count  of vertices from the first on, whose gradients are wanted
SheetGradients gradientsOfFirst(std::size_t count, const CapillarySurface& sheet, Vec3 weight)
{
    SheetGradients result{std::vector<Vec3>(count), std::vector<Vec3>(count), std::vector<double>(count, 0.0)};
    for (const Triangle& t : sheet.triangles) {
        if (std::min({t[0], t[1], t[2]}) >= count) {
            continue;
        }
        const Forces forces = forcesOn(Facet(sheet, t), weight);
        for (std::size_t a = 0; a < 3; ++a) {
            if (t[a] < count) {
                result.energy[t[a]] = result.energy[t[a]] + forces.energy[a];
                result.volume[t[a]] = result.volume[t[a]] + forces.volume;
                result.area[t[a]] += forces.area;
            }
        }
    }
    return result;
}

}  // namespace

SheetGradients gradientsOf(const CapillarySurface& sheet, Vec3 weight)
{
    return gradientsOfFirst(sheet.vertices.size(), sheet, weight);
}

SheetGradients rimGradientsOf(const CapillarySurface& sheet, Vec3 weight)
{
    return gradientsOfFirst(sheet.rimVertexCount(), sheet, weight);
}

SheetGradients gradientsOf(const CapillarySurface& sheet, Vec3 weight, const MeshPattern& pattern)
{
    std::vector<Forces> forces(sheet.triangles.size());
    forBlocks(
        forces.size(),
        [&](std::size_t begin, std::size_t end) {
            for (std::size_t k = begin; k < end; ++k) {
                forces[k] = forcesOn(Facet(sheet, sheet.triangles[k]), weight);
            }
        },
        MeshPattern::kTriangles);
    const std::size_t count = sheet.vertices.size();
    SheetGradients result{std::vector<Vec3>(count), std::vector<Vec3>(count), std::vector<double>(count, 0.0)};
    pattern.forEachCorner([&](std::size_t v, std::size_t triangle, std::size_t corner) {
        const Forces& f = forces[triangle];
        result.energy[v] = result.energy[v] + f.energy[corner];
        result.volume[v] = result.volume[v] + f.volume;
        result.area[v] += f.area;
    });
    return result;
}

Eigen::SparseMatrix<double> hessianOf(const CapillarySurface& sheet, const std::vector<Vec3>& directions, Vec3 weight,
                                      double pressure, const MeshPattern& pattern)
{
    return pattern.assemble([&](std::size_t k) {
        const Triangle& t = sheet.triangles[k];
        return hessianOf(Facet(sheet, t), {directions[t[0]], directions[t[1]], directions[t[2]]}, weight, pressure);
    });
}

}  // namespace droplet
