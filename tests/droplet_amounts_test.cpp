// SPDX-License-Identifier: GPL-3.0-or-later
// Amounts by default: a mean contact angle along the rim says little where thin fringes make up most of it, so no
// droplet is higher than a puddle of that angle.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>

#include "droplet/droplet.h"
#include "droplet/units.h"
#include "support/domains.h"

namespace droplet {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr double kAngle = 40.0 * kDegree;

/// Block of 8 mm with teeth of 0.2 mm along its upper side: most of its rim is that of the teeth.
Domain comb()
{
    std::vector<Vec2> points{{0.0, 0.0}, {8e-3, 0.0}};
    constexpr int kTeeth = 20;
    constexpr double kPitch = 8e-3 / kTeeth;
    for (int k = 0; k < kTeeth; ++k) {
        const double right = 8e-3 - k * kPitch;
        points.insert(points.end(), {{right, 1.2e-2}, {right - 0.5 * kPitch, 1.2e-2}, {right - 0.5 * kPitch, 8e-3}});
        if (k + 1 < kTeeth) {
            points.push_back({right - kPitch, 8e-3});
        }
    }
    points.back() = {0.0, 8e-3};
    return testing::domainOf(testing::polygonLoop(points));
}

DropletOptions byDefault(std::size_t triangles = 3000)
{
    DropletOptions options;
    options.allow_less = true;
    options.solve.fill.below_puddle = true;
    options.mesh.triangles = triangles;
    return options;
}

double puddle(const DropletOptions& options, double area)
{
    return puddleHeight(options.solve, kAngle, area);
}

TEST(PuddleHeight, IsThatOfAPuddleOrOfACap)
{
    SolveOptions options{.model = Model::Exact};
    const double length = *capillaryLength(options.liquid, options.gravity);
    constexpr double kArea = std::numbers::pi * 1e-6;  // radius 1 mm
    EXPECT_NEAR(puddleHeight(options, kAngle, kArea), 2.0 * length * std::sin(0.5 * kAngle), 1e-15);
    options.tilt = 60.0 * kDegree;
    EXPECT_NEAR(puddleHeight(options, kAngle, kArea), 2.0 * std::sqrt(2.0) * length * std::sin(0.5 * kAngle), 1e-15);
    for (const double tilt : {0.0, 0.5 * std::numbers::pi}) {
        options.tilt = tilt;
        options.gravity = tilt == 0.0 ? 0.0 : kStandardGravity;
        EXPECT_NEAR(puddleHeight(options, kAngle, kArea), 1e-3 * std::tan(0.5 * kAngle), 1e-15);
    }
    options.tilt = std::numbers::pi;
    EXPECT_EQ(puddleHeight(options, kAngle, kArea), std::numeric_limits<double>::infinity());
    options.liquid.density = 0.0;
    for (const double tilt : {0.0, std::numbers::pi}) {
        options.tilt = tilt;
        EXPECT_NEAR(puddleHeight(options, kAngle, kArea), 1e-3 * std::tan(0.5 * kAngle), 1e-15);
        EXPECT_FALSE(bendingLayer(options));
    }
    options = {.model = Model::Linear};
    EXPECT_NEAR(puddleHeight(options, kAngle, kArea), length * std::tan(kAngle), 1e-15);
}

/// The same comb with an amount that was asked for is higher, and one line says that it cannot be right.
TEST(Amounts, TowersByDefaultAreNoHigherThanAPuddle)
{
    for (const Model model : {Model::Auto, Model::Linear, Model::Exact}) {
        for (const double gravity : {0.0, kStandardGravity}) {
            SCOPED_TRACE(gravity);
            DropletOptions options = byDefault();
            options.solve.model = model;
            options.solve.gravity = gravity;
            const Droplet low = makeDroplet(comb(), options);
            // Rounded inner corners do not count.
            EXPECT_NEAR(low.total.height_max, puddleHeight(options.solve, kAngle, area(low.meshes.front())),
                        1e-6 * low.total.height_max);
            EXPECT_LT(low.total.contact_angle.mean, 0.8 * kAngle);
            EXPECT_THAT(low.limits, ElementsAre(FillLimit::Puddle));
            EXPECT_EQ(low.severe_warnings, 0U);

            if (model == Model::Linear) {
                options.solve.fill.below_puddle = false;
                const Droplet tower = makeDroplet(comb(), options);
                EXPECT_NEAR(tower.total.contact_angle.mean, kAngle, 1e-6);
                EXPECT_GT(tower.total.height_max, 1.5 * low.total.height_max);
                EXPECT_THAT(tower.limits, ElementsAre(FillLimit::None));
                EXPECT_EQ(tower.severe_warnings, 1U);
            }
        }
    }
}

TEST(Amounts, ReliefOfTheGroundAddsToAPuddle)
{
    DropletOptions options = byDefault();
    options.solve.ground = BaseSurface::cylinder(-30e-3, 0.0);
    const Droplet droplet = makeDroplet(comb(), options);
    EXPECT_GT(droplet.total.height_max, puddle(options, droplet.total.footprint_area));
    EXPECT_LT(droplet.total.height_max, puddle(options, droplet.total.footprint_area) + 3e-3);
}

TEST(Amounts, WithoutDensityAreThoseWithoutGravity)
{
    DropletOptions options = byDefault();
    options.solve.gravity = 0.0;
    const Droplet floating = makeDroplet(comb(), options);
    options.solve.gravity = kStandardGravity;
    options.solve.liquid.density = 0.0;
    EXPECT_EQ(makeDroplet(comb(), options).surface.vertices, floating.surface.vertices);
}

/// On a wall liquid gathers at the lower end of a wide footprint. The ground above it is dry, and what is wet is
/// covered: the area of the liquid's surface is at least that of its base.
TEST(Amounts, OnAWallTheDryPartIsTold)
{
    DropletOptions options = byDefault(2000);
    options.solve.tilt = 0.5 * std::numbers::pi;
    for (const double width : {2e-3, 30e-3, 50e-3}) {
        const Droplet droplet = makeDroplet(testing::domainOf(testing::polygonLoop({{0, 0},
                                                                                    {width, 0},
                                                                                    {width, 0.3 * width},
                                                                                    {0.3 * width, 0.3 * width},
                                                                                    {0.3 * width, width},
                                                                                    {0, width}})),
                                            options);
        const ShapeFigures& figures = droplet.total;
        EXPECT_GT(figures.volume, 0.0) << width;
        const bool is_dry = width > 10e-3;
        EXPECT_EQ(figures.dry_area > 0.01 * figures.footprint_area, is_dry) << figures.dry_area;
        EXPECT_GE(figures.liquid_area, figures.footprint_area - figures.dry_area);
        EXPECT_DOUBLE_EQ(figures.surface_energy, options.solve.liquid.surface_tension * figures.liquid_area);
        const auto told = Contains(HasSubstr("of the footprint dry"));
        EXPECT_THAT(droplet.warnings, ::testing::Conditional(is_dry, told, ::testing::Not(told))) << width;
    }
}

/// Of discs at one pressure, all but one stay below a half ball: more liquid goes to that one.
TEST(Amounts, ADropletThatGathersWhatAllShareIsTold)
{
    Domain discs;
    discs.extent = {0.1, 0.1};
    for (int k = 0; k < 5; ++k) {
        Loop disc = testing::ellipseLoop(k == 0 ? 1.2e-3 : 1e-3, k == 0 ? 1.2e-3 : 1e-3);
        for (Vec2& point : disc.points) {
            point.x += k * 12e-3;
        }
        discs.droplets.push_back(testing::domainOf(disc).droplets.front());
    }
    DropletOptions options;
    options.mesh.triangles = 4000;
    options.solve.gravity = 0.0;
    options.solve.fill = {FillBy::Volume, 4e-9, FillSharing::Total};
    const auto told = Contains(HasSubstr("of the liquid into droplet 1 of 5"));
    EXPECT_THAT(makeDroplet(discs, options).warnings, IsEmpty());
    options.solve.fill.amount = 40e-9;
    EXPECT_THAT(makeDroplet(discs, options).warnings, told);
}

TEST(Amounts, SmallRoundDropletsKeepTheirAngle)
{
    const Droplet droplet = makeDroplet(testing::domainOf(testing::ellipseLoop(2e-3, 2e-3)), byDefault());
    EXPECT_NEAR(droplet.total.contact_angle.mean, kAngle, 1e-6);
    EXPECT_THAT(droplet.limits, ElementsAre(FillLimit::None));
    EXPECT_THAT(droplet.warnings, IsEmpty());
}

/// Droplets at one pressure have one height at most, too.
TEST(Amounts, HoldForDropletsThatShareTheirLiquid)
{
    Domain two = comb();
    Loop disc = testing::ellipseLoop(2e-3, 2e-3);
    for (Vec2& point : disc.points) {
        point.x -= 5e-3;
    }
    two.droplets.push_back(testing::domainOf(disc).droplets.front());
    DropletOptions options = byDefault();
    options.solve.fill.sharing = FillSharing::Total;
    const Droplet droplets = makeDroplet(two, options);
    EXPECT_NEAR(droplets.total.height_max, puddle(options, 1.0), 1e-6 * droplets.total.height_max);
    EXPECT_THAT(droplets.limits, ElementsAre(FillLimit::Puddle, FillLimit::Puddle));
}

/// Mercury on a comb cannot have 140°: the largest angle that was found is taken.
TEST(Amounts, AnglesThatDoNotExistBecomeTheLargestThatDo)
{
    DropletOptions options = byDefault(1500);
    options.solve.liquid = liquidNamed("mercury");
    options.solve.fill.amount = 140.0 * kDegree;
    const Droplet droplet = makeDroplet(
        testing::domainOf(testing::ellipseLoop(1e-3, 1e-3), {testing::reversed(testing::ellipseLoop(0.8e-3, 0.8e-3))}),
        options);
    EXPECT_GT(droplet.total.contact_angle.mean, 40.0 * kDegree * (1.0 - 1e-6));
    EXPECT_LT(droplet.total.contact_angle.mean, 139.0 * kDegree);
    EXPECT_THAT(droplet.limits, ElementsAre(FillLimit::Existence));
    EXPECT_THAT(droplet.warnings, Contains(HasSubstr("a mean contact angle of 140 degrees does not exist on this")));
}

/// Short triangles along the rim do not make a letter of 20 mm the wide puddle that a height field stands in for.
TEST(Amounts, GradedMeshesKeepTheirSheets)
{
    const Domain el = testing::domainOf(
        testing::polygonLoop({{0, 0}, {20e-3, 0}, {20e-3, 5e-3}, {5e-3, 5e-3}, {5e-3, 20e-3}, {0, 20e-3}}));
    DropletOptions options = byDefault(4000);
    options.mesh.grading = 8;
    EXPECT_FALSE(makeDroplet(el, options).solution.droplets.front().isHeightField());
}

/// A letter's default is a sheet: as many triangles as were asked for, and the same ones as for that angle.
TEST(Amounts, SheetsHaveTheTrianglesThatWereAskedFor)
{
    const Domain el = testing::domainOf(
        testing::polygonLoop({{0, 0}, {8e-3, 0}, {8e-3, 2e-3}, {2e-3, 2e-3}, {2e-3, 8e-3}, {0, 8e-3}}));
    for (const std::size_t triangles : {1000U, 8000U}) {
        DropletOptions options = byDefault(triangles);
        options.solve.fill.amount = 60.0 * kDegree;
        const Droplet droplet = makeDroplet(el, options);
        ASSERT_FALSE(droplet.solution.droplets.front().isHeightField());
        const CapillarySurface& sheet = droplet.solution.droplets.front();
        EXPECT_NEAR(static_cast<double>(sheet.triangles.size()), static_cast<double>(triangles),
                    0.1 * static_cast<double>(triangles));

        // The report is that of the sheet, not of the height field that was tried first.
        const SolveReport& report = droplet.solution.report;
        EXPECT_EQ(report.method, "multifrontal-ldlt");
        EXPECT_EQ(report.unknowns, sheet.vertices.size() - sheet.rimVertexCount());
        EXPECT_EQ(report.iterations, 1U);
        EXPECT_GT(report.residual, 0.0);
        EXPECT_LT(report.residual, 1e-7);

        options.allow_less = false;
        options.solve.fill.below_puddle = false;
        const Droplet asked = makeDroplet(el, options);
        EXPECT_EQ(asked.surface.vertices, droplet.surface.vertices);
        EXPECT_THAT(asked.warnings, Not(Contains(HasSubstr("upright"))));
    }
}

}  // namespace
}  // namespace droplet
