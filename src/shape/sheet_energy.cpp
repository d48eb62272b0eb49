// SPDX-License-Identifier: GPL-3.0-or-later
// K. A. Brakke, "The Surface Evolver", Experimental Mathematics 1 (1992): area, gravity and volume of facets as sums
// over triangles, with exact derivatives. Departure: gravity as the flux of a field that vanishes in z = 0, so that the
// base adds nothing; and second derivatives along one direction for every vertex.
#include "shape/sheet_energy.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace droplet {
namespace {

/// Pairs of corners: each with itself, then each with the next one.
constexpr std::array<std::array<std::size_t, 2>, 6> kPairs{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}}};

/// A triangle and its area vector N.
struct Facet {
    std::array<Vec3, 3> x;
    Vec3 normal;  ///< N, as long as the area

    Facet(const SheetMesh& sheet, const Triangle& t)
        : x{sheet.places[t[0]], sheet.places[t[1]], sheet.places[t[2]]}, normal(areaVector(sheet.places, t))
    {
    }
};

}  // namespace

SheetIntegrals integrate(const SheetMesh& sheet, Vec3 weight)
{
    SheetIntegrals sum;
    for (const Triangle& t : sheet.triangles) {
        const Facet f(sheet, t);
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
    return sum;
}

SheetGradients gradientsOf(const SheetMesh& sheet, Vec3 weight)
{
    SheetGradients result{std::vector<Vec3>(sheet.places.size()), std::vector<Vec3>(sheet.places.size())};
    for (const Triangle& t : sheet.triangles) {
        const Facet f(sheet, t);
        const double area = length(f.normal);
        const Vec3 n = area > 0.0 ? (1.0 / area) * f.normal : Vec3{};
        const std::array<double, 3> phi{dot(weight, f.x[0]), dot(weight, f.x[1]), dot(weight, f.x[2])};
        const double sum = phi[0] + phi[1] + phi[2];
        for (std::size_t a = 0; a < 3; ++a) {
            const Vec3 side = f.x[(a + 1) % 3] - f.x[(a + 2) % 3];
            Vec3& energy = result.energy[t[a]];
            energy = energy + 0.5 * cross(side, n) + ((phi[a] + sum) / 12.0) * f.normal;
            result.volume[t[a]] = result.volume[t[a]] + (1.0 / 3.0) * f.normal;
        }
    }
    return result;
}

SheetPattern::SheetPattern(const SheetMesh& sheet)
{
    const auto unknowns = static_cast<Eigen::Index>(sheet.places.size() - sheet.rim);
    const auto row_of = [&](std::uint32_t v) {
        return static_cast<std::int32_t>(v) - static_cast<std::int32_t>(sheet.rim);
    };
    std::vector<Eigen::Triplet<double>> triplets;
    triplets.reserve(6 * sheet.triangles.size());
    for (const Triangle& t : sheet.triangles) {
        for (const auto& [a, b] : kPairs) {
            const std::int32_t i = row_of(t[a]);
            const std::int32_t j = row_of(t[b]);
            if (i >= 0 && j >= 0) {
                triplets.emplace_back(std::max(i, j), std::min(i, j), 0.0);
            }
        }
    }
    empty_.resize(unknowns, unknowns);
    empty_.setFromTriplets(triplets.begin(), triplets.end());
    entries_.reserve(sheet.triangles.size());
    const int* outer = empty_.outerIndexPtr();
    const int* inner = empty_.innerIndexPtr();
    for (const Triangle& t : sheet.triangles) {
        std::array<std::int32_t, 6>& places = entries_.emplace_back();
        for (std::size_t k = 0; k < kPairs.size(); ++k) {
            const std::int32_t i = row_of(t[kPairs[k][0]]);
            const std::int32_t j = row_of(t[kPairs[k][1]]);
            places[k] = -1;
            if (i >= 0 && j >= 0) {
                const int column = std::min(i, j);
                places[k] = static_cast<std::int32_t>(
                    std::lower_bound(inner + outer[column], inner + outer[column + 1], std::max(i, j)) - inner);
            }
        }
    }
}

Eigen::SparseMatrix<double> SheetPattern::hessian(const SheetMesh& sheet, const std::vector<Vec3>& directions,
                                                  Vec3 weight, double pressure) const
{
    Eigen::SparseMatrix<double> matrix = empty_;
    double* values = matrix.valuePtr();
    for (std::size_t k = 0; k < sheet.triangles.size(); ++k) {
        const Triangle& t = sheet.triangles[k];
        const Facet f(sheet, t);
        const double area = length(f.normal);
        const Vec3 n = (1.0 / area) * f.normal;
        const std::array<Vec3, 3> d{directions[t[0]], directions[t[1]], directions[t[2]]};
        const std::array<double, 3> phi{dot(weight, f.x[0]), dot(weight, f.x[1]), dot(weight, f.x[2])};
        const double sum = phi[0] + phi[1] + phi[2];
        std::array<Vec3, 3> g;  // ∂N along the directions
        std::array<double, 3> ng{};
        for (std::size_t a = 0; a < 3; ++a) {
            g[a] = 0.5 * cross(d[a], f.x[(a + 1) % 3] - f.x[(a + 2) % 3]);
            ng[a] = dot(n, g[a]);
        }
        for (std::size_t a = 0; a < 3; ++a) {
            if (const std::int32_t at = entries_[k][a]; at >= 0) {
                values[at] += (dot(g[a], g[a]) - ng[a] * ng[a]) / area + dot(d[a], f.normal) * dot(weight, d[a]) / 6.0;
            }
            const std::size_t b = (a + 1) % 3;
            const std::size_t c = (a + 2) % 3;
            if (const std::int32_t at = entries_[k][3 + a]; at >= 0) {
                const double bent = (dot(g[a], g[b]) - ng[a] * ng[b]) / area + 0.5 * dot(n, cross(d[a], d[b]));
                const double heavy =
                    0.5 * (dot(d[a], g[b]) * (phi[a] + sum) / 12.0 + dot(d[a], f.normal) * dot(weight, d[b]) / 12.0 +
                           dot(d[b], g[a]) * (phi[b] + sum) / 12.0 + dot(d[b], f.normal) * dot(weight, d[a]) / 12.0);
                const double full = dot(d[a], cross(d[b], 2.0 * f.x[c] - f.x[a] - f.x[b])) / 12.0;
                values[at] += bent + heavy - pressure * full;
            }
        }
    }
    return matrix;
}

}  // namespace droplet
