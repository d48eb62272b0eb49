// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/shape/base_surface.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "droplet/error.h"
#include "droplet/units.h"

namespace droplet {
namespace {

using ::testing::HasSubstr;

constexpr double kPi = std::numbers::pi;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

std::string messageOf(const std::function<void()>& call, ErrorCode code = ErrorCode::InvalidArgument)
{
    try {
        call();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), code);
        EXPECT_THAT(error.what(), ::testing::Not(HasSubstr("\n")));
        return error.what();
    }
    ADD_FAILURE() << "accepted";
    return "";
}

/// Central differences; their error is of the order of step² times third derivatives.
Vec2 slopeOf(const BaseSurface& ground, Vec2 p, double step)
{
    return {(ground.at(p + Vec2{step, 0}).height - ground.at(p - Vec2{step, 0}).height) / (2 * step),
            (ground.at(p + Vec2{0, step}).height - ground.at(p - Vec2{0, step}).height) / (2 * step)};
}

/// Map of floats from a function of the pixel's centre, in pixels from the top left.
HeightMap mapOf(int width, int height, const std::function<double(double, double)>& level)
{
    HeightMap map{width, height, {}, true};
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            map.levels.push_back(static_cast<float>(level(x + 0.5, y + 0.5)));
        }
    }
    return map;
}

TEST(BaseSurface, IsThePlaneByDefault)
{
    const BaseSurface plane;
    EXPECT_TRUE(plane.flat());
    EXPECT_EQ(plane.at({3, -4}).height, 0.0);
    EXPECT_EQ(plane.at({3, -4}).gradient, Vec2{});
}

TEST(BaseSurface, SphereHasItsPointsAtItsRadius)
{
    for (const double radius : {0.04, -0.04, 1e3}) {
        const BaseSurface ground = BaseSurface::sphere(radius);
        EXPECT_FALSE(ground.flat());
        EXPECT_EQ(ground.at({0, 0}).height, 0.0);
        for (const Vec2 p : {Vec2{0.01, 0.0}, Vec2{-0.02, 0.015}, Vec2{0.0, -0.0399}}) {
            const GroundPoint found = ground.at(p);
            const double up = found.height + radius;  // above the centre
            EXPECT_NEAR(std::sqrt(dot(p, p) + up * up), std::abs(radius), 1e-15 * std::abs(radius)) << radius;
            EXPECT_EQ(found.height > 0.0, radius < 0.0);
            // The normal points from the centre.
            EXPECT_NEAR(found.gradient.x * up, -p.x, 1e-12 * std::abs(radius));
            EXPECT_NEAR(found.gradient.y * up, -p.y, 1e-12 * std::abs(radius));
        }
    }
    // 1 − √(1 − x²) = x²/2 + x⁴/8 … is exact to the last bit; the difference itself would be 0.
    EXPECT_NEAR(BaseSurface::sphere(-1.0).at({1e-9, 0}).height / 5e-19, 1.0, 1e-15);
}

TEST(BaseSurface, CylinderIsACircleAcrossItsAxis)
{
    for (const double radius : {0.033, -0.033}) {
        for (const double axis : {0.0, 0.5 * kPi, 0.7, -2.0}) {
            const BaseSurface ground = BaseSurface::cylinder(radius, axis);
            const BaseSurface sphere = BaseSurface::sphere(radius);
            const Vec2 along{std::cos(axis), std::sin(axis)};
            const Vec2 across{-along.y, along.x};
            for (const double s : {-0.03, 0.0, 0.01}) {
                const GroundPoint found = ground.at(0.5 * along + s * across);
                const GroundPoint expected = sphere.at({s, 0.0});
                EXPECT_NEAR(found.height, expected.height, 1e-15);
                EXPECT_NEAR(dot(found.gradient, along), 0.0, 1e-14);
                EXPECT_NEAR(dot(found.gradient, across), expected.gradient.x, 1e-13);
            }
        }
    }
    // Axis y: a can that is upright in the picture curves down to the sides.
    const BaseSurface can = BaseSurface::cylinder(0.033, 0.5 * kPi);
    EXPECT_NEAR(can.at({0.0, 0.02}).height, 0.0, 1e-17);
    EXPECT_LT(can.at({0.02, 0.0}).height, -6e-3);
}

TEST(BaseSurface, GradientsAreThoseOfTheHeights)
{
    const auto bumpy = [](double x, double y) { return std::sin(0.9 * x) * std::cos(0.7 * y) + 0.01 * x * y; };
    const std::vector<BaseSurface> grounds = {BaseSurface::sphere(0.04), BaseSurface::sphere(-0.05),
                                              BaseSurface::cylinder(0.03, 0.3), BaseSurface::cylinder(-0.03, 2.0),
                                              BaseSurface::heightMap(mapOf(9, 7, bumpy), {0.03, 0.02}, 1e-3)};
    for (std::size_t k = 0; k < grounds.size(); ++k) {
        for (double x = -0.0143; x < 0.015; x += 0.0037) {
            for (double y = -0.0091; y < 0.01; y += 0.0029) {
                const Vec2 exact = grounds[k].at({x, y}).gradient;
                const Vec2 found = slopeOf(grounds[k], {x, y}, 1e-6);
                EXPECT_NEAR(exact.x, found.x, 2e-8) << k;
                EXPECT_NEAR(exact.y, found.y, 2e-8) << k;
            }
        }
    }
}

TEST(BaseSurface, EndsAtTheRadiusOfTheSphereOrCylinder)
{
    const BaseSurface sphere = BaseSurface::sphere(-0.04);
    EXPECT_NO_THROW((void)sphere.at({0.0399, 0.0}));
    const std::string far = messageOf([&] { (void)sphere.at({0.03, 0.04}); });
    EXPECT_THAT(far, HasSubstr("radius 40 mm"));
    EXPECT_THAT(far, HasSubstr("50 mm"));
    EXPECT_THAT(messageOf([&] { (void)sphere.at({0.04, 0.0}); }), HasSubstr("sphere"));
    const BaseSurface cylinder = BaseSurface::cylinder(0.033, 0.0);
    EXPECT_NO_THROW((void)cylinder.at({5.0, 0.0329}));
    EXPECT_THAT(messageOf([&] { (void)cylinder.at({0.0, -0.034}); }), HasSubstr("34 mm"));
    EXPECT_THAT(messageOf([&] { (void)cylinder.at({0.0, kNan}); }), HasSubstr("nan"));
    EXPECT_EQ(sphere.find({0.0, 0.0399}).value().height, sphere.at({0.0, 0.0399}).height);
    EXPECT_FALSE(sphere.find({0.0, 0.04}));
    EXPECT_FALSE(cylinder.find({0.0, kNan}));
}

TEST(BaseSurface, MayHaveNoGroundAtSomePoints)
{
    const BaseSurface cliff([](Vec2 p) { return p.x < 0.0 ? std::optional(GroundPoint{1e-3, {}}) : std::nullopt; });
    EXPECT_EQ(cliff.find({-1e-3, 0.0}).value().height, 1e-3);
    EXPECT_FALSE(cliff.find({1e-3, 0.0}));
    const std::vector<Vec2> points = {{-1e-3, 0.0}, {2e-3, 3e-3}};
    EXPECT_THAT(messageOf([&] { cliff.requireAt(points); }), HasSubstr("x 2 mm, y 3 mm"));
}

TEST(BaseSurface, RefusesInvalidGrounds)
{
    for (const double radius : {0.0, kInfinity, -kInfinity, kNan}) {
        EXPECT_THAT(messageOf([&] { BaseSurface::sphere(radius); }), HasSubstr("radius"));
        EXPECT_THAT(messageOf([&] { BaseSurface::cylinder(radius, 0.0); }), HasSubstr("radius"));
    }
    EXPECT_THAT(messageOf([] { BaseSurface::cylinder(1.0, kNan); }), HasSubstr("axis"));
    const HeightMap map = mapOf(2, 2, [](double, double) { return 1.0; });
    EXPECT_THAT(messageOf([&] { BaseSurface::heightMap(map, {0.0, 1.0}); }), HasSubstr("extent"));
    EXPECT_THAT(messageOf([&] { BaseSurface::heightMap(map, {1.0, kInfinity}); }), HasSubstr("extent"));
    EXPECT_THAT(messageOf([&] { BaseSurface::heightMap(map, {1.0, 1.0}, kNan); }), HasSubstr("depth"));
    HeightMap grey = map;
    grey.in_floats = false;
    EXPECT_THAT(messageOf([&] { BaseSurface::heightMap(grey, {1.0, 1.0}); }), HasSubstr("depth"));
    HeightMap torn = map;
    torn.levels.pop_back();
    messageOf([&] { BaseSurface::heightMap(torn, {1.0, 1.0}); }, ErrorCode::InvalidInput);
}

TEST(BaseSurface, HeightMapHasTheOrientationOfThePicture)
{
    // 2 × 3 pixels of 1 mm. The plane's y axis points up, rows of the picture go down.
    HeightMap map{2, 3, {0, 1, 2, 3, 4, 5}, true};
    const BaseSurface ground = BaseSurface::heightMap(map, {2e-3, 3e-3});
    EXPECT_NEAR(ground.at({-0.5e-3, 1e-3}).height, 0.0, 1e-12);
    EXPECT_NEAR(ground.at({0.5e-3, 1e-3}).height, 1.0, 1e-12);
    EXPECT_NEAR(ground.at({-0.5e-3, 0.0}).height, 2.0, 1e-12);
    EXPECT_NEAR(ground.at({0.5e-3, -1e-3}).height, 5.0, 1e-12);
    // Twice as deep, and stretched to another rectangle.
    const BaseSurface other = BaseSurface::heightMap(map, {20.0, 3e-3}, 2.0);
    EXPECT_NEAR(other.at({5.0, -1e-3}).height, 10.0, 1e-12);
    EXPECT_NEAR(other.at({5.0, -1e-3}).gradient.x, ground.at({0.5e-3, -1e-3}).gradient.x * 2e-4, 1e-9);
}

TEST(BaseSurface, HeightMapIsExactForQuadratics)
{
    // Sixteenths, which are exact as floats.
    const auto quadratic = [](double x, double y) { return 3 + x / 2 - y / 4 + x * x / 4 - x * y / 2 + y * y / 8; };
    const int width = 12;
    const int height = 9;
    const BaseSurface ground =
        BaseSurface::heightMap(mapOf(width, height, quadratic), {double(width), double(height)}, 0.5);
    for (double x = 1.5; x <= width - 1.5; x += 0.17) {
        for (double y = 1.5; y <= height - 1.5; y += 0.13) {
            const GroundPoint found = ground.at({x - 0.5 * width, 0.5 * height - y});
            EXPECT_NEAR(found.height, 0.5 * quadratic(x, y), 1e-13);
            EXPECT_NEAR(found.gradient.x, 0.5 * (0.5 + x / 2 - y / 2), 1e-13);
            EXPECT_NEAR(found.gradient.y, -0.5 * (-0.25 - x / 2 + y / 4), 1e-13);
        }
    }
}

// Third order in the pixel size: for half the size, the error of a sine is an eighth, that of its slope a quarter.
TEST(BaseSurface, HeightMapConvergesWithOrderThree)
{
    double before = 0.0;
    double slope_before = 0.0;
    for (const int count : {32, 64, 128}) {
        const double pixel = 8.0 / count;
        const BaseSurface ground = BaseSurface::heightMap(
            mapOf(count, count, [&](double x, double y) { return std::sin(pixel * x) + std::cos(pixel * y); }),
            {8.0, 8.0});
        double worst = 0.0;
        double slope_worst = 0.0;
        for (double x = -3.0; x < 3.0; x += 0.0131) {
            const GroundPoint found = ground.at({x, 0.7 * x});
            worst = std::max(worst, std::abs(found.height - std::sin(4.0 + x) - std::cos(4.0 - 0.7 * x)));
            slope_worst = std::max(slope_worst, std::abs(found.gradient.x - std::cos(4.0 + x)));
        }
        if (before > 0.0) {
            EXPECT_GT(std::log2(before / worst), 2.7) << count;              // measured 3.02, 3.04
            EXPECT_GT(std::log2(slope_before / slope_worst), 1.8) << count;  // measured 1.91, 2.06
        }
        before = worst;
        slope_before = slope_worst;
    }
}

TEST(BaseSurface, HeightMapHasAContinuousGradient)
{
    unsigned state = 7;
    const BaseSurface ground = BaseSurface::heightMap(mapOf(6, 5,
                                                            [&](double, double) {
                                                                state = state * 1664525U + 1013904223U;
                                                                return (state >> 16) / 65536.0;
                                                            }),
                                                      {6.0, 5.0});
    constexpr double kStep = 1e-9;
    // Rows and columns of centres, also beyond the picture.
    for (double at = -6.0; at <= 6.0; at += 0.5) {
        for (double along = -5.3; along < 5.4; along += 0.31) {
            for (const bool swap : {false, true}) {
                const Vec2 p = swap ? Vec2{along, at} : Vec2{at, along};
                const Vec2 step = swap ? Vec2{0, kStep} : Vec2{kStep, 0};
                const GroundPoint before = ground.at(p - step);
                const GroundPoint after = ground.at(p + step);
                EXPECT_NEAR(before.height, after.height, 1e-7);
                EXPECT_NEAR(before.gradient.x, after.gradient.x, 1e-7);
                EXPECT_NEAR(before.gradient.y, after.gradient.y, 1e-7);
            }
        }
    }
}

TEST(BaseSurface, HeightMapKeepsItsBorderHeightOutside)
{
    const HeightMap map = mapOf(4, 3, [](double x, double y) { return x + 10 * y; });
    const BaseSurface ground = BaseSurface::heightMap(map, {4.0, 3.0});
    for (const double far : {3.0, 100.0, 1e300}) {
        EXPECT_NEAR(ground.at({far, 0.0}).height, map.at(3, 1), 1e-6);
        EXPECT_NEAR(ground.at({-far, 1.0}).height, map.at(0, 0), 1e-6);
        EXPECT_NEAR(ground.at({far, -far}).height, map.at(3, 2), 1e-6);
        EXPECT_EQ(ground.at({far, -far}).gradient, Vec2{});
    }
    const BaseSurface one = BaseSurface::heightMap({1, 1, {0.25F}, false}, {1.0, 1.0}, 8e-3);
    EXPECT_NEAR(one.at({0.4, -0.2}).height, 2e-3, 1e-18);
}

TEST(BaseSurface, ReportsTheOutermostPoint)
{
    const std::vector<Vec2> points{{0.0, 0.0}, {2e-3, 1e-3}, {-3e-3, 2e-3}, {0.5e-3, -3.2e-3}};
    BaseSurface::sphere(3.7e-3).requireAt(points);
    EXPECT_THAT(messageOf([&] { BaseSurface::sphere(1e-3).requireAt(points); }), HasSubstr("exceed 3.60555 mm"));
    EXPECT_THAT(messageOf([&] { BaseSurface::cylinder(1e-3, 0.0).requireAt(points); }), HasSubstr("exceed 3.2 mm"));
    const BaseSurface half([](Vec2 p) {
        if (p.x > 0.0) {
            throw Error(ErrorCode::InvalidArgument, "no ground at " + std::to_string(p.x));
        }
        return GroundPoint{};
    });
    EXPECT_THAT(messageOf([&] { half.requireAt(points); }), HasSubstr("0.002"));
    BaseSurface().requireAt(points);
    BaseSurface::sphere(1e-3).requireAt({});
}

}  // namespace
}  // namespace droplet
