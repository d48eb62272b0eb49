// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>

#include "shape/sheet_energy.h"
#include "shape/sheet_path.h"
#include "shape/symmetric_factor.h"
#include "support/domains.h"
#include "support/equilibrium.h"

namespace droplet {
namespace {

using Matrix = Eigen::SparseMatrix<double>;

/// Hessian of a cap of 130°, and the places of its unknowns.
struct Problem {
    Matrix matrix;
    std::vector<Vec3> places;
};

/// @param pressure  over that of the cap: beyond 1, more eigenvalues become negative
Problem capProblem(double edge, double pressure)
{
    const PlanarMesh mesh = testing::discMeshes(edge).front();
    const FilledSheet cap = fillSheet(mesh, {FillBy::ContactAngle, 130.0 * std::numbers::pi / 180.0}, {{}, edge, 0.0});
    EXPECT_EQ(cap.end, SheetEnd::Reached);
    std::vector<Vec3> directions;
    for (const Vec3& force : gradientsOf(cap.mesh, {}).volume) {
        directions.push_back((1.0 / length(force)) * force);
    }
    return {hessianOf(cap.mesh, directions, {}, pressure * cap.pressure,
                      {cap.mesh.triangles, cap.mesh.vertices.size(), cap.mesh.rimVertexCount()}),
            {cap.mesh.vertices.begin() + cap.mesh.rimVertexCount(), cap.mesh.vertices.end()}};
}

TEST(MultifrontalFactor, CountsNegativeEigenvaluesAndSolves)
{
    for (const double pressure : {0.5, 1.0, 2.5}) {
        SCOPED_TRACE(pressure);
        const Problem problem = capProblem(0.3, pressure);
        const Matrix full = problem.matrix.selfadjointView<Eigen::Lower>();
        const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(full).eigenvalues();
        const auto negative = static_cast<std::size_t>((values.array() < 0.0).count());
        if (pressure == 0.5) {
            EXPECT_EQ(negative, 0U);
        } else if (pressure == 1.0) {
            EXPECT_EQ(negative, 1U) << "beyond 90°";
        } else {
            EXPECT_GT(negative, 3U);
        }
        const auto factor = multifrontalFactor(problem.matrix, problem.places);
        ASSERT_TRUE(factor->factorize(problem.matrix));
        EXPECT_EQ(factor->negatives(), negative);
        const Eigen::VectorXd exact = Eigen::VectorXd::LinSpaced(full.cols(), -1.0, 2.0).array().sin();
        EXPECT_LT((factor->solve(full * exact) - exact).norm(), 1e-9 * exact.norm());
    }
}

/// On some thousand unknowns, with fronts of many columns and parts in threads of their own.
TEST(MultifrontalFactor, EqualsSimplicialFactorisation)
{
    const Problem problem = capProblem(0.08, 2.5);
    Eigen::SimplicialLDLT<Matrix> simplicial(problem.matrix);
    ASSERT_EQ(simplicial.info(), Eigen::Success);
    const auto factor = multifrontalFactor(problem.matrix, problem.places);
    ASSERT_TRUE(factor->factorize(problem.matrix));
    const auto negative = static_cast<std::size_t>((simplicial.vectorD().array() < 0.0).count());
    EXPECT_GT(negative, 3U);
    EXPECT_EQ(factor->negatives(), negative);
    const Eigen::VectorXd right = Eigen::VectorXd::LinSpaced(problem.matrix.cols(), -1.0, 2.0).array().cos();
    const Eigen::VectorXd expected = simplicial.solve(right);
    EXPECT_LT((factor->solve(right) - expected).norm(), 1e-8 * expected.norm());
    EXPECT_GT(problem.matrix.cols(), 2000);
}

/// Places of noise, the longest way through which separates nothing.
TEST(MultifrontalFactor, EqualsSimplicialFactorisationOverRoughGround)
{
    Problem problem = capProblem(0.08, 2.5);
    for (std::size_t i = 0; i < problem.places.size(); ++i) {
        problem.places[i].z = 20.0 * std::fmod(0.6180339887 * static_cast<double>(i), 1.0);
    }
    const Eigen::SimplicialLDLT<Matrix> simplicial(problem.matrix);
    const auto factor = multifrontalFactor(problem.matrix, problem.places);
    ASSERT_TRUE(factor->factorize(problem.matrix));
    EXPECT_EQ(factor->negatives(), static_cast<std::size_t>((simplicial.vectorD().array() < 0.0).count()));
    const Eigen::VectorXd right = Eigen::VectorXd::LinSpaced(problem.matrix.cols(), -1.0, 2.0).array().cos();
    const Eigen::VectorXd expected = simplicial.solve(right);
    EXPECT_LT((factor->solve(right) - expected).norm(), 1e-8 * expected.norm());
}

TEST(MultifrontalFactor, GivesTheSameBytesAtAnyNumberOfThreads)
{
    const Problem problem = capProblem(0.08, 1.0);
    const Eigen::VectorXd right = Eigen::VectorXd::LinSpaced(problem.matrix.cols(), -1.0, 2.0);
    std::vector<Eigen::VectorXd> results;
    for (const std::size_t threads : {1U, 2U, 5U}) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        const auto factor = multifrontalFactor(problem.matrix, problem.places);
        ASSERT_TRUE(factor->factorize(problem.matrix));
        results.push_back(factor->solve(right));
    }
    EXPECT_TRUE(results[1] == results[0]);
    EXPECT_TRUE(results[2] == results[0]);
}

/// Two chains far apart, each coupled to a hub: nothing separates them but what is eliminated after both.
TEST(MultifrontalFactor, TakesPartsInSeveralPieces)
{
    constexpr int kShort = 20;
    constexpr int kLong = 40;
    constexpr int kHub = 2 * kShort + kLong;
    std::vector<Vec3> places;
    std::vector<Eigen::Triplet<double>> entries;
    for (int i = 0; i < kHub; ++i) {
        const double along = 0.01 * i;
        places.push_back(i < kShort       ? Vec3{0.0, along, 0.0}
                         : i < 2 * kShort ? Vec3{0.0, 50.0 + along, 0.0}
                                          : Vec3{100.0, 20.0 + along, 0.0});
        entries.emplace_back(i, i, i % 3 == 0 ? -2.0 : 3.0);
        if (i + 1 != kShort && i + 1 != 2 * kShort && i + 1 != kHub) {
            entries.emplace_back(i + 1, i, 1.0);
        }
    }
    places.push_back({90.0, 25.0, 0.0});
    for (const int end : {kShort - 1, 2 * kShort - 1, 2 * kShort}) {
        entries.emplace_back(kHub, end, 0.5);
    }
    entries.emplace_back(kHub, kHub, 1.5);
    Matrix matrix(kHub + 1, kHub + 1);
    matrix.setFromTriplets(entries.begin(), entries.end());
    const auto factor = multifrontalFactor(matrix, places);
    ASSERT_TRUE(factor->factorize(matrix));
    const Matrix full = matrix.selfadjointView<Eigen::Lower>();
    const Eigen::VectorXd exact = Eigen::VectorXd::LinSpaced(full.cols(), -1.0, 2.0).array().sin();
    EXPECT_LT((factor->solve(full * exact) - exact).norm(), 1e-12 * exact.norm());
    const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(full).eigenvalues();
    EXPECT_EQ(factor->negatives(), static_cast<std::size_t>((values.array() < 0.0).count()));
}

/// A matrix may follow one that failed.
TEST(MultifrontalFactor, RefusesPivotsOfNoUse)
{
    const Problem problem = capProblem(0.3, 1.0);
    const auto factor = multifrontalFactor(problem.matrix, problem.places);
    for (const double wrong : {0.0, std::numeric_limits<double>::quiet_NaN()}) {
        Matrix matrix = wrong * problem.matrix;
        EXPECT_FALSE(factor->factorize(matrix));
    }
    ASSERT_TRUE(factor->factorize(problem.matrix));
    EXPECT_EQ(factor->negatives(), 1U);
}

TEST(MultifrontalFactor, TakesNoUnknownsAndOne)
{
    const auto none = multifrontalFactor(Matrix(0, 0), {});
    EXPECT_TRUE(none->factorize(Matrix(0, 0)));
    EXPECT_EQ(none->negatives(), 0U);
    EXPECT_EQ(none->solve(Eigen::VectorXd(0)).size(), 0);

    Matrix single(1, 1);
    single.insert(0, 0) = -4.0;
    single.makeCompressed();
    const auto one = multifrontalFactor(single, {{1.0, 2.0, 3.0}});
    ASSERT_TRUE(one->factorize(single));
    EXPECT_EQ(one->negatives(), 1U);
    EXPECT_DOUBLE_EQ(one->solve(Eigen::VectorXd::Constant(1, 2.0))[0], -0.5);
}

}  // namespace
}  // namespace droplet
