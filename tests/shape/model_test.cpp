// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which model is solved.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "droplet/mesh/triangulate.h"
#include "droplet/shape/figures.h"
#include "droplet/shape/solve.h"
#include "droplet/units.h"
#include "support/domains.h"
#include "support/equilibrium.h"
#include "support/heights.h"

namespace droplet {
namespace {

using testing::domainOf;
using testing::ellipseLoop;
using testing::heightsOf;
using testing::polygonLoop;
using testing::reversed;

/// Star with five tips, half as deep as long.
Loop star()
{
    std::vector<Vec2> points;
    for (int k = 0; k < 10; ++k) {
        const double angle = 0.2 * k * std::numbers::pi;
        const double radius = k % 2 == 0 ? 1.0 : 0.5;
        points.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
    return polygonLoop(points);
}

std::vector<Domain> footprints()
{
    return {domainOf(ellipseLoop(1, 1)),
            domainOf(polygonLoop({{0, 0}, {1, 0}, {1, 1}, {0, 1}})),
            domainOf(ellipseLoop(2, 0.4)),
            domainOf(ellipseLoop(1, 1), {reversed(ellipseLoop(0.5, 0.5))}),
            domainOf(polygonLoop({{0, 0}, {2, 0}, {2, 0.5}, {0.5, 0.5}, {0.5, 2}, {0, 2}})),
            domainOf(star())};
}

/// Auto takes the linear model only where its height, volume and pressure are within 0.3 % of the exact model's.
TEST(Model, AutoIsLinearOnlyWhereItIsExact)
{
    std::size_t linear_runs = 0;
    for (const Domain& domain : footprints()) {
        const std::vector<PlanarMesh> meshes = triangulate(domain, {.edge = 0.08});
        for (const double gravity : {0.0, 3.0, 40.0}) {
            for (const double degrees : {1.0, 2.0, 2.5, 3.0, 3.5, 4.0, 4.5, 6.0, 20.0}) {
                SolveOptions options = testing::unitOptions(Model::Auto, gravity, 1.0);
                options.fill = {FillBy::ContactAngle, degrees * kDegree, FillSharing::Each};
                const Solution chosen = solve(meshes, options);
                ASSERT_TRUE(chosen.report.usable());
                options.model = chosen.report.model;
                ASSERT_NE(options.model, Model::Auto);
                EXPECT_EQ(heightsOf(chosen.droplets.front()), heightsOf(solve(meshes, options).droplets.front()));
                if (options.model == Model::Exact) {
                    EXPECT_GT(degrees, 2.0);
                    continue;
                }
                ++linear_runs;
                EXPECT_LT(degrees, 4.3);
                const ShapeFigures linear = measure(chosen.droplets.front(), options);
                options.model = Model::Exact;
                const Solution solution = solve(meshes, options);
                const ShapeFigures exact = measure(solution.droplets.front(), options);
                const double pressure = solution.droplets.front().pressure;
                const std::string at = std::to_string(gravity) + " " + std::to_string(degrees);
                EXPECT_NEAR(linear.height_max, exact.height_max, 0.003 * exact.height_max) << at;
                EXPECT_NEAR(linear.volume, exact.volume, 0.003 * exact.volume) << at;
                EXPECT_NEAR(chosen.droplets.front().pressure, pressure, 0.003 * pressure) << at;
            }
        }
    }
    EXPECT_GE(linear_runs, 30U);
}

/// A volume decides by the slopes that it gives.
TEST(Model, AutoLooksAtTheSlopesOfAVolume)
{
    const std::vector<PlanarMesh> meshes = testing::discMeshes(0.1);
    EXPECT_EQ(solve(meshes, testing::unitOptions(Model::Auto, 0.0, 0.05)).report.model, Model::Linear);
    EXPECT_EQ(solve(meshes, testing::unitOptions(Model::Auto, 0.0, 0.5)).report.model, Model::Exact);
}

}  // namespace
}  // namespace droplet
