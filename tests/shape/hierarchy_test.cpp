// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape/hierarchy.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <string>
#include <vector>

#include "droplet/mesh/triangulate.h"
#include "support/domains.h"
#include "support/masks.h"
#include "support/operators.h"
#include "support/zoo.h"

namespace droplet {
namespace {

using testing::domainOf;
using testing::ellipseLoop;
using testing::reversed;

using Vector = std::vector<double>;

double dotProduct(const Vector& a, const Vector& b)
{
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        sum += a[i] * b[i];
    }
    return sum;
}

/// Calls visit(unknown) for every unknown of a level.
template <typename Visit>
void forEachUnknown(const Level& level, const Visit& visit)
{
    for (const GridRun& run : level.regular) {
        for (std::uint32_t k = 0; k < run.count; ++k) {
            visit(run.first + k);
        }
    }
    for (const std::uint32_t i : level.irregular.unknowns) {
        visit(i);
    }
}

Vector randomVector(const Level& level, std::mt19937& random)
{
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    Vector x(level.size, 0.0);
    forEachUnknown(level, [&](std::uint32_t i) { x[i] = uniform(random); });
    return x;
}

Vector applied(const Level& level, const Vector& x)
{
    Vector result(level.size, 0.0);
    for (const GridRun& run : level.regular) {
        for (std::uint32_t k = 0; k < run.count; ++k) {
            const std::uint32_t i = run.first + k;
            const RegularRow row = regularRow(level, i, run.below + k);
            const std::array<double, 6> neighbours{
                x[i - 1], x[i + 1], x[run.below + k], x[run.below + k + 1], x[run.above + k], x[run.above + k + 1]};
            result[i] = row.diagonal * x[i];
            for (std::size_t n = 0; n < neighbours.size(); ++n) {
                result[i] += row.neighbours[n] * neighbours[n];
            }
        }
    }
    const SparseRows& rows = level.irregular;
    for (std::size_t k = 0; k < rows.unknowns.size(); ++k) {
        for (std::uint32_t e = rows.starts[k]; e < rows.starts[k + 1]; ++e) {
            result[rows.unknowns[k]] += rows.values[e] * x[rows.columns[e]];
        }
    }
    return result;
}

/// P: prolongation from the coarser level.
Vector prolonged(const Level& fine, const Vector& coarse)
{
    Vector result(fine.size, 0.0);
    for (const ProlongationRun& run : fine.prolongation) {
        for (std::uint32_t k = 0; k < run.count; ++k) {
            result[run.first + k] = 0.5 * (coarse[run.early + (k + 1) / 2] + coarse[run.late + k / 2]);
        }
    }
    for (std::size_t i = 0; i < fine.inside.size(); ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
            result[i] += fine.inside[i].weights[k] * coarse[fine.inside[i].corners[k]];
        }
    }
    return result;
}

/// Pᵀ: restriction to the coarser level.
Vector restricted(const Level& fine, std::size_t coarse_size, const Vector& x)
{
    Vector result(coarse_size, 0.0);
    for (const RestrictionRun& run : fine.restriction) {
        for (std::uint32_t k = 0; k < run.count; ++k) {
            const std::uint32_t centre = run.fine + 2 * k;
            const std::uint32_t below = run.below + 2 * k;
            const std::uint32_t above = run.above + 2 * k;
            result[run.first + k] =
                x[centre] + 0.5 * (x[centre - 1] + x[centre + 1] + x[below] + x[below + 1] + x[above] + x[above + 1]);
        }
    }
    const SparseRows& rows = fine.outside;
    for (std::size_t k = 0; k < rows.unknowns.size(); ++k) {
        for (std::uint32_t e = rows.starts[k]; e < rows.starts[k + 1]; ++e) {
            result[rows.unknowns[k]] += rows.values[e] * x[rows.columns[e]];
        }
    }
    return result;
}

struct Case {
    std::string name;
    PlanarMesh mesh;
};

/// Meshes with lattices, without, and with lattices on patches only.
std::vector<Case> cases()
{
    std::vector<Case> result;
    const auto add = [&](const std::string& name, const Domain& domain, const TriangulateOptions& options) {
        result.push_back({name, triangulate(domain, options)[0]});
    };
    const Domain ring = domainOf(ellipseLoop(1, 1), {reversed(ellipseLoop(0.3, 0.6))});
    add("disc", domainOf(ellipseLoop(1, 1)), {.triangles = 12000, .edge = {}});
    add("ring", ring, {.triangles = 12000, .edge = {}});
    add("star", split(trace(testing::smoothMask(400, 400, testing::star(0.1)))), {.triangles = 9000, .edge = {}});
    add("letter", split(trace(testing::smoothMask(300, 400, testing::insideLetter))), {.triangles = 9000, .edge = {}});
    add("graded ring", ring, {.triangles = 12000, .edge = {}, .grading = 8});
    add("disc without its lattice", domainOf(ellipseLoop(1, 1)), {.triangles = 6000, .edge = {}});
    result.back().mesh.lattice = {};
    return result;
}

/// Weights of the mass term: none, small, and so large that it matters on the finest level.
constexpr double kMasses[] = {0.0, 0.01, 5.0};

Operator operatorFor(const PlanarMesh& mesh, double mass)
{
    return {mass * static_cast<double>(mesh.triangles.size()) / (2.0 * area(mesh)), {}, {}};
}

struct NamedOperator {
    std::string name;
    Operator op;
};

/// Operators with one tensor, different tensors and held vertices, each also under a ceiling.
std::vector<NamedOperator> operatorsFor(const PlanarMesh& mesh)
{
    std::mt19937 random(4);
    std::vector<NamedOperator> result;
    for (const double mass : kMasses) {
        result.push_back({"mass " + std::to_string(mass), operatorFor(mesh, mass)});
    }
    result.push_back({"held", operatorFor(mesh, 0.01)});
    result.back().op.held = testing::heldPatches(mesh);
    result.push_back({"tensors", operatorFor(mesh, 0.01)});
    result.back().op.tensors = testing::randomTensors(mesh, random);
    result.push_back({"tensors, held", operatorFor(mesh, 0.01)});
    result.back().op.tensors = testing::randomTensors(mesh, random);
    result.back().op.held = testing::heldPatches(mesh);
    return result;
}

/// Compares a level with the matrix assembled triangle by triangle, in every row of an unknown.
void expectMatrix(const PlanarMesh& mesh, const Operator& op, const Hierarchy& hierarchy, const Level& level)
{
    std::mt19937 random(1);
    const testing::Assembled system = testing::assembled(mesh, op);
    const std::vector<std::uint32_t>& index = hierarchy.index_of_vertex;
    ASSERT_EQ(index.size(), static_cast<std::size_t>(system.load.size()));
    const Vector x = randomVector(level, random);
    Eigen::VectorXd same = Eigen::VectorXd::Zero(system.load.size());
    std::size_t unknowns = 0;
    for (std::size_t v = 0; v < index.size(); ++v) {
        ASSERT_EQ(index[v] == kNoUnknown, !op.held.empty() && op.held[v] != 0);
        if (index[v] != kNoUnknown) {
            same[static_cast<Eigen::Index>(v)] = x[index[v]];
            ++unknowns;
        }
    }
    ASSERT_EQ(unknowns, level.unknowns);
    const Vector product = applied(level, x);
    const Eigen::VectorXd wanted = system.matrix * same;
    const double scale = wanted.lpNorm<Eigen::Infinity>();
    const double largest_load = system.load.lpNorm<Eigen::Infinity>();
    for (std::size_t v = 0; v < index.size(); ++v) {
        if (index[v] != kNoUnknown) {
            const auto row = static_cast<Eigen::Index>(v);
            ASSERT_NEAR(product[index[v]], wanted[row], 1e-11 * scale) << v;
            ASSERT_NEAR(hierarchy.load[index[v]] * hierarchy.edge * hierarchy.edge, system.load[row],
                        1e-11 * largest_load)
                << v;
        }
    }
}

TEST(Hierarchy, FinestLevelIsTheMatrix)
{
    for (const Case& c : cases()) {
        for (const auto& [name, op] : operatorsFor(c.mesh)) {
            SCOPED_TRACE(c.name + " " + name);
            const Hierarchy hierarchy = buildHierarchy(c.mesh, op);
            EXPECT_FALSE(hierarchy.indefinite);
            expectMatrix(c.mesh, op, hierarchy, hierarchy.levels.front());
        }
    }
}

// Under a ceiling the levels must be positive definite, and the matrix itself is stored separately.
TEST(Hierarchy, NegativeMassIsOnlyInTheMatrix)
{
    for (const Case& c : cases()) {
        for (auto [name, op] : operatorsFor(c.mesh)) {
            SCOPED_TRACE(c.name + " " + name);
            op.mass_weight = -0.1 - op.mass_weight;
            const Hierarchy hierarchy = buildHierarchy(c.mesh, op);
            ASSERT_TRUE(hierarchy.indefinite);
            expectMatrix(c.mesh, op, hierarchy, *hierarchy.indefinite);
            op.mass_weight = 0.0;
            expectMatrix(c.mesh, op, hierarchy, hierarchy.levels.front());
        }
    }
}

TEST(Hierarchy, CoarserLevelsHaveFewerUnknowns)
{
    for (const Case& c : cases()) {
        for (const auto& [name, op] : operatorsFor(c.mesh)) {
            SCOPED_TRACE(c.name + " " + name);
            const Hierarchy hierarchy = buildHierarchy(c.mesh, op);
            EXPECT_GE(hierarchy.levels.size(), 3U);
            for (std::size_t l = 0; l < hierarchy.levels.size(); ++l) {
                const Level& level = hierarchy.levels[l];
                std::vector<int> met(level.size, 0);
                forEachUnknown(level, [&](std::uint32_t i) { ++met.at(i); });
                std::size_t count = 0;
                for (const int m : met) {
                    ASSERT_LE(m, 1);
                    count += static_cast<std::size_t>(m);
                }
                EXPECT_EQ(count, level.unknowns);
                if (l > 0) {
                    EXPECT_LT(1.5 * level.unknowns, hierarchy.levels[l - 1].unknowns);
                }
            }
            EXPECT_LE(hierarchy.levels.back().unknowns, 400U);
        }
    }
}

TEST(Hierarchy, RestrictionIsTheTransposeOfProlongation)
{
    std::mt19937 random(2);
    for (const Case& c : cases()) {
        for (const auto& [name, op] : operatorsFor(c.mesh)) {
            SCOPED_TRACE(c.name + " " + name);
            const Hierarchy hierarchy = buildHierarchy(c.mesh, op);
            for (std::size_t l = 0; l + 1 < hierarchy.levels.size(); ++l) {
                const Level& fine = hierarchy.levels[l];
                const Level& coarse = hierarchy.levels[l + 1];
                for (int k = 0; k < 3; ++k) {
                    const Vector x = randomVector(coarse, random);
                    const Vector y = randomVector(fine, random);
                    const double there = dotProduct(prolonged(fine, x), y);
                    const double back = dotProduct(x, restricted(fine, coarse.size, y));
                    EXPECT_NEAR(there, back, 1e-12 * std::sqrt(dotProduct(x, x) * dotProduct(y, y))) << l;
                }
            }
        }
    }
}

// (Px)ᵀA(Py) = xᵀA'y: the coarser matrix is the Galerkin product, also where it is stored as a stencil.
TEST(Hierarchy, CoarserLevelsAreGalerkinProducts)
{
    std::mt19937 random(3);
    for (const Case& c : cases()) {
        for (const auto& [name, op] : operatorsFor(c.mesh)) {
            SCOPED_TRACE(c.name + " " + name);
            const Hierarchy hierarchy = buildHierarchy(c.mesh, op);
            for (std::size_t l = 0; l + 1 < hierarchy.levels.size(); ++l) {
                const Level& fine = hierarchy.levels[l];
                const Level& coarse = hierarchy.levels[l + 1];
                const Vector x = randomVector(coarse, random);
                const Vector product = applied(coarse, x);
                const Vector wanted = restricted(fine, coarse.size, applied(fine, prolonged(fine, x)));
                double scale = 0.0;
                for (const double p : product) {
                    scale = std::max(scale, std::abs(p));
                }
                // Every row, not only the quadratic form. Vectors are 0 at indices without an unknown.
                forEachUnknown(coarse,
                               [&](std::uint32_t i) { EXPECT_NEAR(product[i], wanted[i], 1e-12 * scale) << l; });
                const Vector y = randomVector(coarse, random);
                EXPECT_NEAR(dotProduct(prolonged(fine, y), applied(fine, prolonged(fine, x))), dotProduct(y, product),
                            1e-12 * std::sqrt(dotProduct(y, y) * dotProduct(product, product)))
                    << l;
                EXPECT_NEAR(dotProduct(x, applied(coarse, y)), dotProduct(y, product),
                            1e-12 * std::sqrt(dotProduct(y, y) * dotProduct(product, product)))
                    << l;
            }
        }
    }
}

// Rows of the lattice are not stored: the share of stored rows falls in proportion to the edge.
TEST(Hierarchy, RegularRowsAreNotStored)
{
    double last = 1.0;
    for (const std::size_t triangles : {2000U, 8000U, 32000U}) {
        const PlanarMesh mesh = triangulate(domainOf(ellipseLoop(1, 1)), {.triangles = triangles, .edge = {}})[0];
        const Level finest = std::move(buildHierarchy(mesh, {}).levels.front());
        const double share = static_cast<double>(finest.irregular.unknowns.size()) / finest.unknowns;
        EXPECT_LT(share, 0.6 * last);
        last = share;
    }
}

}  // namespace
}  // namespace droplet
