// SPDX-License-Identifier: GPL-3.0-or-later
//
// Hanging droplets: Bessel functions for the linear model, Bashforth and Adams' equation for the exact one
// (support/young_laplace.h). At fixed volume a droplet on a disc falls sideways at J₁(k) = 0, k = 3.8317; at fixed
// pressure it would fall at J₀(k) = 0, k = 2.4048.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "droplet/mesh/triangulate.h"
#include "droplet/shape/figures.h"
#include "droplet/shape/solve.h"
#include "droplet/units.h"
#include "support/domains.h"
#include "support/equilibrium.h"
#include "support/young_laplace.h"

namespace droplet {
namespace {

using testing::discMeshes;
using testing::domainOf;
using testing::dropletOfVolume;
using testing::ellipseLoop;
using testing::equilibrium;
using testing::l2Error;
using testing::meanOrder;
using testing::polygonLoop;
using testing::Revolution;
using testing::unitOptions;

constexpr double kPi = std::numbers::pi;
constexpr double kCritical = 3.8317059702075123;  ///< first zero of J₁

/// Linear model under the disc of radius 1: σ = ρ = 1, gravity −k² into the ground and `along` in it.
struct HangingDisc {
    double k;
    double volume;
    double along = 0.0;

    [[nodiscard]] double scale() const
    {
        return volume / (2 * kPi * (0.5 - std::cyl_bessel_j(1, k) / (k * std::cyl_bessel_j(0, k))));
    }
    [[nodiscard]] double pressure() const { return -k * k * scale(); }
    [[nodiscard]] double slope() const { return -scale() * k * std::cyl_bessel_j(1, k) / std::cyl_bessel_j(0, k); }
    [[nodiscard]] double at(Vec2 p, Vec2 down = {1.0, 0.0}) const
    {
        const double r = length(p);
        const double cosine = r > 0.0 ? dot(p, down) / r : 0.0;
        return scale() * (1.0 - std::cyl_bessel_j(0, k * r) / std::cyl_bessel_j(0, k)) +
               along / (k * k) * (std::cyl_bessel_j(1, k * r) / std::cyl_bessel_j(1, k) - r) * cosine;
    }
};

TEST(Hanging, LinearModelConvergesWithOrderTwo)
{
    constexpr double kVolume = 0.4;
    for (const Solver solver : {Solver::Auto, Solver::Llt, Solver::Multigrid}) {
        for (const double k : {1.0, 2.0, 2.6, 3.5}) {
            const HangingDisc exact{k, kVolume};
            std::vector<double> l2;
            std::vector<double> pressure;
            std::vector<double> angle;
            for (const double edge : {0.1, 0.05, 0.025}) {
                const std::vector<PlanarMesh> meshes = discMeshes(edge);
                SolveOptions options = unitOptions(Model::Linear, -k * k, kVolume);
                options.solver = solver;
                const Solution solution = solve(meshes, options);
                ASSERT_TRUE(solution.report.usable()) << k;
                const CapillarySurface& field = solution.droplets[0];
                l2.push_back(l2Error(meshes[0], field, [&](Vec2 p) { return exact.at(p); }));
                pressure.push_back(std::abs(field.pressure - exact.pressure()));
                angle.push_back(std::abs(measure(field, options).contact_angle.mean - std::atan(exact.slope())));
                const testing::Equilibrium found = equilibrium(meshes[0], field, options);
                EXPECT_LT(found.free_force, 1e-8) << k;
                EXPECT_NEAR(found.volume / kVolume, 1.0, 1e-10) << k;
            }
            EXPECT_GE(meanOrder(l2), 1.9) << k;
            EXPECT_GE(meanOrder(pressure), 1.9) << k;
            EXPECT_GE(meanOrder(angle), 1.8) << k;
        }
    }
}

TEST(Hanging, ExactModelConvergesWithOrderTwo)
{
    struct Row {
        double k;
        double volume;
    };
    for (const Row row : {Row{1.0, 0.5}, Row{1.0, 1.0}, Row{2.0, 0.4}, Row{2.6, 0.1}}) {
        const Revolution exact = dropletOfVolume(-row.k * row.k, row.volume);
        ASSERT_LT(exact.rim_angle, 80 * kDegree);
        std::vector<double> l2;
        std::vector<double> pressure;
        std::vector<double> energy;
        for (const double edge : {0.1, 0.05, 0.025}) {
            const std::vector<PlanarMesh> meshes = discMeshes(edge);
            const SolveOptions options = unitOptions(Model::Exact, -row.k * row.k, row.volume);
            const Solution solution = solve(meshes, options);
            ASSERT_TRUE(solution.report.usable()) << row.k << " " << row.volume;
            const CapillarySurface& field = solution.droplets[0];
            l2.push_back(l2Error(meshes[0], field, [&](Vec2 p) { return exact.at(length(p)); }));
            pressure.push_back(std::abs(field.pressure - exact.pressure));
            const ShapeFigures figures = measure(field, options);
            energy.push_back(std::abs(figures.surface_energy + figures.gravity_energy - exact.energy()));
            EXPECT_LT(equilibrium(meshes[0], field, options).free_force, 1e-8);
        }
        EXPECT_GE(meanOrder(l2), 1.8) << row.k << " " << row.volume;
        EXPECT_GE(meanOrder(pressure), 1.8) << row.k << " " << row.volume;
        EXPECT_GE(meanOrder(energy), 1.8) << row.k << " " << row.volume;
    }
}

// A plane turned over is a ceiling.
TEST(Hanging, TiltOfPiReversesGravity)
{
    const std::vector<PlanarMesh> meshes = triangulate(domainOf(ellipseLoop(1, 0.7)), {.edge = 0.05});
    for (const Model model : {Model::Linear, Model::Exact}) {
        const SolveOptions negative = unitOptions(model, -3.0, 0.2);
        SolveOptions over = unitOptions(model, 3.0, 0.2);
        over.tilt = kPi;
        const Solution one = solve(meshes, negative);
        const Solution other = solve(meshes, over);
        ASSERT_TRUE(one.report.usable() && other.report.usable());
        EXPECT_NEAR(other.droplets[0].pressure, one.droplets[0].pressure, 1e-9);
        for (std::size_t v = 0; v < meshes[0].vertices.size(); ++v) {
            EXPECT_NEAR(other.droplets[0].vertices[v].z, one.droplets[0].vertices[v].z, 1e-9);
        }
    }
}

// Overhangs, up to the limit where the sideways part, ~ 1/J₁(k), becomes infinite.
TEST(Hanging, OverhangsConvergeWithOrderTwo)
{
    constexpr double kVolume = 0.4;
    constexpr double kGravity = 4.0;
    for (const double degrees : {100.0, 135.0, 170.0}) {
        const double tilt = degrees * kDegree;
        const HangingDisc exact{std::sqrt(-kGravity * std::cos(tilt)), kVolume, kGravity * std::sin(tilt)};
        std::vector<double> l2;
        std::vector<double> pressure;
        for (const double edge : {0.1, 0.05, 0.025}) {
            const std::vector<PlanarMesh> meshes = discMeshes(edge);
            SolveOptions options = unitOptions(Model::Linear, kGravity, kVolume);
            options.tilt = tilt;
            options.tilt_direction = 1.0;
            const Solution solution = solve(meshes, options);
            ASSERT_TRUE(solution.report.usable()) << degrees;
            l2.push_back(l2Error(meshes[0], solution.droplets[0], [&](Vec2 p) {
                return exact.at(p, {std::cos(1.0), std::sin(1.0)});
            }));
            pressure.push_back(std::abs(solution.droplets[0].pressure - exact.pressure()));
        }
        EXPECT_GE(meanOrder(l2), 1.9) << degrees;
        EXPECT_GE(meanOrder(pressure), 1.9) << degrees;
    }
}

TEST(Hanging, FallsBeyondTheCriticalBondNumber)
{
    for (const double edge : {0.05, 0.02}) {
        const std::vector<PlanarMesh> meshes = discMeshes(edge);
        for (const Solver solver : {Solver::Auto, Solver::Llt, Solver::Multigrid}) {
            for (const double k : {0.99 * kCritical, 1.01 * kCritical, 4.5, 5.5, 9.0}) {
                SolveOptions options = unitOptions(Model::Linear, -k * k, 0.1);
                options.solver = solver;
                const Solution solution = solve(meshes, options);
                if (k < kCritical) {
                    EXPECT_TRUE(solution.report.usable()) << k;
                    continue;
                }
                EXPECT_EQ(solution.report.termination, Termination::Unstable) << k;
                EXPECT_TRUE(solution.droplets.empty());
                EXPECT_NEAR(solution.report.bond_number / (k * k), 1.0, 1e-3) << k;
                EXPECT_NEAR(solution.report.critical_bond_number / (kCritical * kCritical), 1.0, 0.01) << k;
            }
        }
    }
}

// For small slopes both models have the same limit.
TEST(Hanging, ExactModelFallsAtTheSameLimit)
{
    const std::vector<PlanarMesh> meshes = discMeshes(0.04);
    for (const double k : {4.0, 6.0}) {
        const Solution solution = solve(meshes, unitOptions(Model::Exact, -k * k, 0.01));
        EXPECT_EQ(solution.report.termination, Termination::Unstable) << k;
        EXPECT_NEAR(solution.report.bond_number / (k * k), 1.0, 2e-3) << k;
        EXPECT_NEAR(solution.report.critical_bond_number / (kCritical * kCritical), 1.0, 0.01) << k;
    }
}

// On an overhang only g⊥ pulls the liquid off.
TEST(Hanging, OverhangsFallByTheirNormalGravity)
{
    const std::vector<PlanarMesh> meshes = discMeshes(0.04);
    const double tilt = 135 * kDegree;
    for (const double factor : {0.97, 1.03}) {
        const double gravity = factor * kCritical * kCritical / std::abs(std::cos(tilt));
        SolveOptions options = unitOptions(Model::Linear, gravity, 0.1);
        options.tilt = tilt;
        const Solution solution = solve(meshes, options);
        if (factor < 1.0) {
            EXPECT_TRUE(solution.report.usable());
            continue;
        }
        EXPECT_EQ(solution.report.termination, Termination::Unstable);
        EXPECT_NEAR(solution.report.bond_number / (factor * kCritical * kCritical), 1.0, 2e-3);
        EXPECT_NEAR(solution.report.bond_number / solution.report.critical_bond_number, factor, 0.01);
    }
}

TEST(Hanging, NamesTheDropletThatFalls)
{
    Domain domain = domainOf(ellipseLoop(1e-3, 1e-3));
    Loop large = ellipseLoop(12e-3, 12e-3);
    for (Vec2& p : large.points) {
        p.x += 20e-3;
    }
    domain.droplets.push_back({large, {}});
    const std::vector<PlanarMesh> meshes = triangulate(domain, {.triangles = 8000, .edge = {}});
    SolveOptions options;
    options.fill = {FillBy::Volume, 0.1 * kMicrolitre, FillSharing::Each};
    options.tilt = kPi;
    const Solution solution = solve(meshes, options);
    EXPECT_EQ(solution.report.termination, Termination::Unstable);
    EXPECT_EQ(solution.report.failed_droplet, 1U);
    const double bond = 998.2 * 9.81 * 144e-6 / 0.0728;
    EXPECT_NEAR(solution.report.bond_number / bond, 1.0, 1e-2);
    EXPECT_NEAR(solution.report.critical_bond_number / (kCritical * kCritical), 1.0, 0.02);
    const Solution alone = solve({meshes[0]}, options);
    EXPECT_TRUE(alone.report.usable());
}

// Droplets at one pressure drain into each other at J₀(k) = 0 if they are equal. A smaller one steadies a larger one.
TEST(Hanging, EqualDropletsAtOnePressureDrainIntoEachOther)
{
    const double drains = 2.404825557695773;
    const PlanarMesh one = discMeshes(0.05)[0];
    for (const Model model : {Model::Linear, Model::Exact}) {
        SolveOptions options = unitOptions(model, -0.98 * drains * drains, 0.05);
        options.fill.sharing = FillSharing::Total;
        EXPECT_TRUE(solve({one, one}, options).report.usable());
        options.gravity = -1.5 * drains * drains;
        const Solution above = solve({one, one}, options);
        ASSERT_EQ(above.report.termination, Termination::Unstable);
        EXPECT_NEAR(above.report.bond_number / (1.5 * drains * drains), 1.0, 2e-3);
        EXPECT_NEAR(above.report.critical_bond_number / (drains * drains), 1.0, 0.01);
        EXPECT_TRUE(solve({one}, options).report.usable());
    }
}

// On the unit square the mode sin 2πx sin πy has no volume and falls first, at k² = 5π².
TEST(Hanging, SquareFallsAtItsOwnBondNumber)
{
    const std::vector<PlanarMesh> meshes =
        triangulate(domainOf(polygonLoop({{0, 0}, {1, 0}, {1, 1}, {0, 1}})), {.edge = 0.025});
    const double critical = 5.0 * kPi * kPi;
    const Solution below = solve(meshes, unitOptions(Model::Linear, -0.98 * critical, 0.01));
    EXPECT_TRUE(below.report.usable());
    const Solution above = solve(meshes, unitOptions(Model::Linear, -1.02 * critical, 0.01));
    ASSERT_EQ(above.report.termination, Termination::Unstable);
    // ρ|g|A/(πσ) with A = 1.
    EXPECT_NEAR(above.report.bond_number / (1.02 * critical / kPi), 1.0, 1e-9);
    EXPECT_NEAR(above.report.critical_bond_number / (critical / kPi), 1.0, 0.01);
}

// Fill by height and angle works under a ceiling, too.
TEST(Hanging, HeightAndMeanAngleAreMet)
{
    const std::vector<PlanarMesh> meshes = discMeshes(0.05);
    for (const Model model : {Model::Linear, Model::Exact}) {
        SolveOptions options = unitOptions(model, -2.0, 1.0);
        options.fill = {FillBy::Height, 0.3, FillSharing::Each};
        const Solution by_height = solve(meshes, options);
        ASSERT_TRUE(by_height.report.usable());
        EXPECT_NEAR(measure(by_height.droplets[0], options).height_max / 0.3, 1.0, 1e-8);
        options.fill = {FillBy::ContactAngle, 30 * kDegree, FillSharing::Each};
        const Solution by_angle = solve(meshes, options);
        ASSERT_TRUE(by_angle.report.usable());
        EXPECT_NEAR(measure(by_angle.droplets[0], options).contact_angle.mean / (30 * kDegree), 1.0, 1e-8);
    }
}

}  // namespace
}  // namespace droplet
