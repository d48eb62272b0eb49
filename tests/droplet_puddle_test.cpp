// SPDX-License-Identifier: GPL-3.0-or-later
// Puddles from 1 mm to 1 m at the default number of triangles. The linear model: Bessel functions. The exact model: a
// droplet of revolution (support/young_laplace.h), and for wide ones the first integral of the Young–Laplace equation
// across the rim, h² = 4λ² sin²(θ/2) + (8λ³/3R)(1 − cos³(θ/2)), whose next term is of the order (λ/R)².
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "droplet/droplet.h"
#include "droplet/error.h"
#include "droplet/units.h"
#include "support/domains.h"
#include "support/young_laplace.h"

namespace droplet {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double kAngle = 40.0 * kDegree;

Droplet puddle(double width, Model model, const TriangulateOptions& mesh = {})
{
    DropletOptions options;
    options.solve.model = model;
    options.solve.fill.amount = kAngle;
    options.mesh = mesh;
    return makeDroplet(testing::domainOf(testing::ellipseLoop(0.5 * width, 0.5 * width)), options);
}

double layer()
{
    return *capillaryLength(Liquid{}, kStandardGravity);
}

double linearHeight(double radius)
{
    const double x = radius / layer();
    return std::tan(kAngle) * layer() * (std::cyl_bessel_i(0.0, x) - 1.0) / std::cyl_bessel_i(1.0, x);
}

double exactHeight(double radius)
{
    const double x = radius / layer();
    if (x < 4.0) {
        return radius * testing::dropletOfAngle(x * x, kAngle).height;
    }
    const double sine = std::sin(0.5 * kAngle);
    const double rest = 1.0 - std::pow(std::cos(0.5 * kAngle), 3.0);
    return layer() * std::sqrt(4.0 * sine * sine + 8.0 / (3.0 * x) * rest);
}

TEST(Puddle, HeightIsWithinOnePercentFromAMillimetreToAMetre)
{
    for (const double width : {1e-3, 1e-2, 0.06, 0.1, 0.2, 0.5, 1.0}) {
        const Droplet linear = puddle(width, Model::Linear);
        EXPECT_NEAR(linear.total.height_max / linearHeight(0.5 * width), 1.0, 0.01) << width;
        EXPECT_THAT(linear.warnings, IsEmpty()) << width;
        if (width < 0.02 || width > 0.1) {
            const Droplet exact = puddle(width, Model::Exact);
            EXPECT_NEAR(exact.total.height_max / exactHeight(0.5 * width), 1.0, 0.01) << width;
            EXPECT_THAT(exact.warnings, IsEmpty()) << width;
        }
    }
}

TEST(Puddle, ConvergesOnGradedTriangles)
{
    std::vector<double> errors;
    for (const std::size_t triangles : {10'000U, 40'000U, 160'000U}) {
        const Droplet droplet = puddle(1.0, Model::Exact, {.triangles = triangles, .edge = {}});
        errors.push_back(1.0 - droplet.total.height_max / exactHeight(0.5));
    }
    // Order 2 in the length of edges halves the error twice where the number of triangles is four times as large.
    EXPECT_GT(errors[0], 4.0 * errors[1]);
    EXPECT_GT(errors[1], 4.0 * errors[2]);
    EXPECT_LT(errors[2], 2e-3);
}

TEST(Puddle, WarnsWhereTrianglesAreTooLong)
{
    const Droplet even = puddle(0.3, Model::Exact, {.triangles = 40'000, .edge = {}, .grading = 1});
    EXPECT_THAT(even.warnings,
                ElementsAre(HasSubstr("heights may be off by about 4.4 %; raise the number of triangles to")));
    EXPECT_LT(even.total.height_max, 0.99 * exactHeight(0.15));
    const Droplet fine = puddle(0.3, Model::Linear, {.triangles = 1, .edge = 2.5e-3});
    EXPECT_THAT(fine.warnings, ElementsAre(HasSubstr("shorten the edges to 1.44mm for 1 %")));
}

/// The error that is stated is that of the height, within a factor of two, for sheets, too.
TEST(Puddle, StatesTheErrorOfItsHeight)
{
    for (const double degrees : {40.0, 60.0, 117.0}) {
        DropletOptions options;
        options.solve.model = Model::Auto;
        options.solve.fill.amount = degrees * kDegree;
        options.mesh.triangles = 3000;
        const Droplet droplet = makeDroplet(testing::domainOf(testing::ellipseLoop(0.25, 0.25)), options);
        const double sine = std::sin(0.5 * degrees * kDegree);
        const double rest = 1.0 - std::pow(std::cos(0.5 * degrees * kDegree), 3.0);
        const double exact = layer() * std::sqrt(4.0 * sine * sine + 8.0 * layer() / 0.75 * rest);
        const double error = std::abs(droplet.total.height_max / exact - 1.0);
        ASSERT_FALSE(droplet.warnings.empty());
        const std::string& warning = droplet.warnings.back();
        const auto at = warning.find("off by about ");
        ASSERT_NE(at, std::string::npos) << warning;
        const double stated = 0.01 * std::stod(warning.substr(at + 13));
        EXPECT_LT(stated, 2.0 * error) << degrees;
        EXPECT_GT(stated, 0.5 * error) << degrees;
    }
}

/// Corners that point inward are upright in a height field, and need sheets at 60°. Neither may lose the layer along
/// the rim: the error is at most about what is stated, and the middle is flat.
TEST(Puddle, StatesTheErrorOfItsHeightWithInnerCorners)
{
    for (const double width : {0.3, 1.0}) {
        for (const double degrees : {40.0, 100.0}) {
            SCOPED_TRACE(width);
            SCOPED_TRACE(degrees);
            DropletOptions options;
            options.solve.fill.amount = degrees * kDegree;
            options.mesh.triangles = 5000;
            const double arm = 0.3 * width;
            const Droplet droplet = makeDroplet(
                testing::domainOf(
                    testing::polygonLoop({{0, 0}, {width, 0}, {width, arm}, {arm, arm}, {arm, width}, {0, width}})),
                options);
            const double endless = 2.0 * layer() * std::sin(0.5 * degrees * kDegree);
            const std::string& warning = droplet.warnings.back();
            const auto at = warning.find("off by about ");
            const double stated = at == std::string::npos ? 0.01 : 0.01 * std::stod(warning.substr(at + 13));
            EXPECT_NEAR(droplet.total.height_max / endless, 1.0, 2.0 * stated);
            // The layer holds less than a puddle with upright walls, by about its width times half of the height.
            const double rim = layer() * droplet.total.rim_length;
            EXPECT_GT(droplet.total.volume, (1.0 - 2.0 * stated) * endless * (droplet.total.footprint_area - rim));
        }
    }
}

/// A width in the wrong unit: edges longer than the layer would make a film of a puddle, 47 times too low.
TEST(Puddle, IsRefinedOrRefusedWhereTrianglesAreLongerThanTheLayer)
{
    const Droplet wide = puddle(20.0, Model::Exact, {.triangles = 500, .edge = {}});
    EXPECT_NEAR(wide.total.height_max / exactHeight(10.0), 1.0, 0.1);
    EXPECT_THAT(wide.warnings, ElementsAre(HasSubstr("the bend of the liquid at its rim takes"),
                                           HasSubstr("heights may be off by about ")));
    try {
        (void)puddle(20.0, Model::Exact, {.triangles = 500, .edge = 0.1});
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::InvalidArgument);
        EXPECT_THAT(error.what(), HasSubstr("the edge length 0.1 m must be at most 0.00272661 m"));
    }
    try {
        (void)puddle(1e4, Model::Exact, {.triangles = 500, .edge = {}});
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::InvalidInput);
        EXPECT_THAT(error.what(), HasSubstr("check the footprint's width"));
    }
}

TEST(Puddle, IsGradedOnlyWhereOneLayerBends)
{
    const auto size = [](double width, SolveOptions solve) {
        DropletOptions options;
        options.solve = std::move(solve);
        options.mesh.triangles = 2000;
        return makeDroplet(testing::domainOf(testing::ellipseLoop(0.5 * width, 0.5 * width)), options).meshes[0];
    };
    EXPECT_EQ(size(0.1, {}).lattice, nullptr);
    EXPECT_NE(size(0.002, {}).lattice, nullptr);
    EXPECT_NE(size(0.1, {.gravity = 0.0}).lattice, nullptr);
    EXPECT_NE(size(0.1, {.tilt = 1.0 * kDegree, .no_penetration = true}).lattice, nullptr);
}

}  // namespace
}  // namespace droplet
