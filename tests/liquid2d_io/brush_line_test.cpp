// SPDX-License-Identifier: GPL-3.0-or-later
#include "liquid2d_io/brush_line.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace {

using droplet::BezierCurve;
using droplet::BezierPath;
using droplet::brushLines;
using droplet::fitBezier;
using droplet::Vec2;

std::vector<Vec2> flattened(const BezierPath& path, int parts)
{
    std::vector<Vec2> points;
    Vec2 start = path.start;
    for (const BezierCurve& c : path.curves) {
        for (int k = 0; k < parts; ++k) {
            const double t = static_cast<double>(k) / parts;
            const double s = 1.0 - t;
            points.push_back(s * s * s * start + 3.0 * s * s * t * c.leaving + 3.0 * s * t * t * c.arriving +
                             t * t * t * c.end);
        }
        start = c.end;
    }
    return points;
}

double distanceOf(Vec2 p, const std::vector<Vec2>& polyline)
{
    double nearest = 1e9;
    for (std::size_t k = 0; k < polyline.size(); ++k) {
        const Vec2 a = polyline[k];
        const Vec2 side = polyline[(k + 1) % polyline.size()] - a;
        const double t = dot(side, side) > 0.0 ? std::clamp(dot(p - a, side) / dot(side, side), 0.0, 1.0) : 0.0;
        nearest = std::min(nearest, length(p - (a + t * side)));
    }
    return nearest;
}

/// Liquid lies on the left on the screen.
std::vector<Vec2> ellipse(Vec2 centre, Vec2 radii, double turn = -1.0)
{
    std::vector<Vec2> points;
    for (int k = 0; k < 400; ++k) {
        const double angle = turn * 2.0 * std::numbers::pi * k / 400.0;
        points.push_back(centre + Vec2{radii.x * std::cos(angle), radii.y * std::sin(angle)});
    }
    return points;
}

double areaOf(const std::vector<Vec2>& points)
{
    double area = 0.0;
    for (std::size_t k = 0; k < points.size(); ++k) {
        area += 0.5 * cross(points[k], points[(k + 1) % points.size()]);
    }
    return std::abs(area);
}

/// Area between the two edges of the line of an outline.
double lineArea(const std::vector<BezierPath>& lines, std::size_t outline)
{
    return std::abs(areaOf(flattened(lines.at(2 * outline), 40)) - areaOf(flattened(lines.at(2 * outline + 1), 40)));
}

TEST(BrushLine, IsEvenAroundLargeForms)
{
    const std::vector<BezierPath> outlines{fitBezier(ellipse({100.0, 100.0}, {60.0, 40.0}), 0.05)};
    const std::vector<BezierPath> lines = brushLines(outlines, 3.0);
    ASSERT_EQ(lines.size(), 2U);
    const std::vector<Vec2> outline = flattened(outlines[0], 200);
    for (const BezierPath& edge : lines) {
        EXPECT_EQ(edge.curves.size(), outlines[0].curves.size());
        for (const Vec2 x : flattened(edge, 20)) {
            EXPECT_NEAR(distanceOf(x, outline), 1.5, 0.1);
        }
    }
}

TEST(BrushLine, LeavesTwoThirdsOfADropletToItsColour)
{
    for (const double radius : {0.4, 1.0, 2.0, 3.0, 4.0}) {
        const std::vector<BezierPath> outlines{fitBezier(ellipse({10.0, 10.0}, {radius, radius}), 0.01)};
        const std::vector<BezierPath> lines = brushLines(outlines, 3.2);
        const double width = std::min(3.2, 0.35 * 2.0 * radius);
        // A line as wide as 0.35 of the diameter takes the radius from 1 to 0.65 and 1.35: 0.42 of the disc is left.
        EXPECT_NEAR(lineArea(lines, 0), 2.0 * std::numbers::pi * radius * width,
                    0.1 * std::numbers::pi * radius * radius)
            << radius;
        for (const BezierPath& edge : lines) {
            for (const Vec2 x : flattened(edge, 20)) {
                EXPECT_LT(std::abs(length(x - Vec2{10.0, 10.0}) - radius), 0.5 * 0.35 * 2.0 * radius * 1.03) << radius;
            }
        }
    }
}

TEST(BrushLine, FollowsTheThicknessOfATailToItsTip)
{
    // A wedge, 60 px long and 12 px thick at its wide end.
    const auto half = [](double x) { return 0.1 * x; };
    std::vector<Vec2> wedge;
    for (int k = 0; k <= 120; ++k) {
        wedge.push_back({0.5 * k, half(0.5 * k)});
    }
    for (int k = 120; k > 0; --k) {
        wedge.push_back({0.5 * k, -half(0.5 * k)});
    }
    for (const bool is_reversed : {false, true}) {
        std::vector<Vec2> points = wedge;
        if (is_reversed) {
            std::reverse(points.begin(), points.end());
        }
        const std::vector<BezierPath> lines = brushLines({fitBezier(points, 0.02)}, 3.2);
        double widest = 0.0;
        for (const BezierPath& edge : lines) {
            for (const Vec2 x : flattened(edge, 10)) {
                const double off = std::abs(std::abs(x.y) - half(x.x)) * std::cos(std::atan(0.1));
                if (x.x > 1.0 && x.x < 55.0) {
                    // Half of the line, on either side, over the thickness of the wedge.
                    EXPECT_LT(2.0 * off, 0.35 * 2.0 * half(x.x) * 1.1 + 0.05) << x.x;
                    widest = std::max(widest, 2.0 * off);
                }
                EXPECT_GT(x.x, -0.2);
            }
        }
        EXPECT_NEAR(widest, 3.2, 0.1);
    }
}

TEST(BrushLine, NarrowsInHolesAndBetweenBodies)
{
    // A hole of 4 px in a large disc.
    const std::vector<BezierPath> disc{fitBezier(ellipse({100.0, 100.0}, {50.0, 50.0}), 0.01),
                                       fitBezier(ellipse({110.0, 100.0}, {2.0, 2.0}, 1.0), 0.01)};
    const std::vector<BezierPath> lines = brushLines(disc, 3.2);
    EXPECT_NEAR(lineArea(lines, 1), 2.0 * std::numbers::pi * 2.0 * 0.35 * 4.0, 1.5);
    EXPECT_NEAR(lineArea(lines, 0), 2.0 * std::numbers::pi * 50.0 * 3.2, 10.0);
    // Two squares with a gap of 2 px: each line takes half of it, at 0.7.
    const std::vector<BezierPath> squares{fitBezier({{0, 0}, {0, 40}, {40, 40}, {40, 0}}, 0.01),
                                          fitBezier({{42, 0}, {42, 40}, {82, 40}, {82, 0}}, 0.01)};
    const std::vector<BezierPath> both = brushLines(squares, 3.2);
    double reach = 0.0;
    for (const std::size_t edge : {std::size_t{0}, std::size_t{1}}) {
        for (const Vec2 x : flattened(both[edge], 20)) {
            if (x.y > 15.0 && x.y < 25.0) {
                reach = std::max(reach, x.x);
            }
        }
    }
    EXPECT_NEAR(reach, 40.0 + 0.5 * 0.7 * 2.0, 0.05);
}

}  // namespace
