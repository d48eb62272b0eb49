// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/liquid2d_io/liquid_drawing.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <sstream>
#include <vector>

#include "droplet/error.h"
#include "liquid2d_io/bezier.h"

namespace {

using droplet::BezierCurve;
using droplet::BezierPath;
using droplet::DeepPicture;
using droplet::Error;
using droplet::Layer;
using droplet::LiquidShape;
using droplet::LiquidView;
using droplet::Loop;
using droplet::Vec2;
using testing::HasSubstr;
using testing::Not;
using testing::ThrowsMessage;

Loop ellipse(Vec2 centre, Vec2 radii, int points, bool is_hole = false)
{
    Loop loop;
    for (int k = 0; k < points; ++k) {
        const double angle = (is_hole ? -2.0 : 2.0) * std::numbers::pi * k / points;
        loop.points.push_back(centre + Vec2{radii.x * std::cos(angle), radii.y * std::sin(angle)});
    }
    loop.corner.resize(loop.points.size());
    return loop;
}

double total(const DeepPicture& mask)
{
    return std::accumulate(mask.levels.begin(), mask.levels.end(), 0.0) / 65535.0;
}

const LiquidView kView{{2.0, 1.0}, 200, 100};
constexpr double kPixel = 0.01 * 0.01;

TEST(LiquidMask, CoversExactlyTheArea)
{
    LiquidShape shape;
    shape.liquid = {ellipse({0.9, 0.5}, {0.612, 0.333}, 237), ellipse({0.8, 0.45}, {0.123, 0.211}, 101, true)};
    shape.droplets = {ellipse({1.77, 0.8}, {0.011, 0.007}, 13)};
    const DeepPicture mask = liquidMask(shape, kView);
    // Each pixel is rounded to 1/65535.
    EXPECT_NEAR(total(mask) * kPixel, shape.area(), 0.5 / 65535.0 * kPixel * 2000.0);
    EXPECT_EQ(mask.levels[50 * 200 + 80], 0U);
    EXPECT_EQ(mask.levels[50 * 200 + 120], 65535U);
}

TEST(LiquidMask, CutsWhatLiesOutsideOfTheWindow)
{
    // A rectangle turned by 30° around a corner of the window: a quarter of the plane is inside, at any angle.
    for (const Vec2 corner : {Vec2{0.0, 0.0}, Vec2{2.0, 0.0}, Vec2{2.0, 1.0}, Vec2{0.0, 1.0}}) {
        LiquidShape shape;
        Loop square;
        for (int k = 0; k < 4; ++k) {
            const double angle = std::numbers::pi * (k / 2.0 + 1.0 / 6.0);
            square.points.push_back(corner + 0.4 * Vec2{std::cos(angle), std::sin(angle)});
        }
        square.corner.resize(4);
        shape.liquid = {square};
        EXPECT_NEAR(total(liquidMask(shape, kView)) * kPixel, 0.25 * signedArea(square), 1e-7);
    }
    LiquidShape whole;
    whole.liquid = {ellipse({1.0, 0.5}, {90.0, 90.0}, 50)};
    EXPECT_DOUBLE_EQ(total(liquidMask(whole, kView)), 200.0 * 100.0);
}

Vec2 at(Vec2 start, const BezierCurve& c, double t)
{
    const double s = 1.0 - t;
    return s * s * s * start + 3.0 * s * s * t * c.leaving + 3.0 * s * t * t * c.arriving + t * t * t * c.end;
}

/// Greatest distance of the points from the path.
double distanceOf(const std::vector<Vec2>& points, const BezierPath& path)
{
    std::vector<Vec2> dense;
    Vec2 start = path.start;
    for (const BezierCurve& curve : path.curves) {
        for (int k = 0; k < 600; ++k) {
            dense.push_back(at(start, curve, k / 600.0));
        }
        start = curve.end;
    }
    double worst = 0.0;
    for (const Vec2 p : points) {
        double nearest = 1e9;
        for (const Vec2 q : dense) {
            nearest = std::min(nearest, length(p - q));
        }
        worst = std::max(worst, nearest);
    }
    return worst;
}

TEST(Bezier, CircleNeedsFewCurves)
{
    const std::vector<Vec2> points = ellipse({5.0, 5.0}, {40.0, 40.0}, 400).points;
    const BezierPath path = droplet::fitBezier(points, 0.1);
    EXPECT_LE(path.curves.size(), 10U);
    EXPECT_LT(distanceOf(points, path), 0.1 + 0.02);
    EXPECT_EQ(path.curves.back().end, path.start);
}

TEST(Bezier, StaysWithinTheToleranceAndKeepsTips)
{
    // A drop with a sharp tip at angle 0, and waves on its rim.
    std::vector<Vec2> points;
    for (int k = 0; k < 600; ++k) {
        const double a = 2.0 * std::numbers::pi * k / 600.0;
        const double r = 30.0 + 30.0 * std::exp(-4.0 * std::min(a, 2.0 * std::numbers::pi - a)) + std::cos(11.0 * a);
        points.push_back({r * std::cos(a), r * std::sin(a)});
    }
    const BezierPath path = droplet::fitBezier(points, 0.25);
    EXPECT_LT(distanceOf(points, path), 0.25 + 0.05);
    EXPECT_LT(path.curves.size(), 60U);
    // The tip is a joint of the path.
    double nearest = length(path.start - points[0]);
    for (const BezierCurve& curve : path.curves) {
        nearest = std::min(nearest, length(curve.end - points[0]));
    }
    EXPECT_LT(nearest, 0.5);
}

TEST(Bezier, TakesTinyLoops)
{
    const BezierPath path = droplet::fitBezier({{0, 0}, {1, 0}, {0, 1}}, 0.3);
    EXPECT_FALSE(path.curves.empty());
    EXPECT_EQ(path.curves.back().end, path.start);
}

LiquidShape someShape()
{
    LiquidShape shape;
    shape.liquid = {ellipse({1.0, 0.4}, {0.7, 0.3}, 200), ellipse({1.0, 0.4}, {0.1, 0.1}, 60, true)};
    shape.foam = {shape.liquid[1]};
    shape.droplets = {ellipse({1.7, 0.85}, {0.05, 0.05}, 40)};
    return shape;
}

TEST(LiquidSvg, HasAGroupForEachLayerAndFewPoints)
{
    const LiquidShape shape = someShape();
    const std::vector<droplet::Region> walls{droplet::rectangle({0.0, 0.0}, {2.0, 0.05})};
    std::ostringstream out;
    writeLiquidSvg({shape, walls}, kView, droplet::liquidLookNamed("comic"), out);
    for (const char* id : {"background", "liquid", "droplets", "foam", "walls"}) {
        EXPECT_THAT(out.str(), HasSubstr(std::string("id=\"") + id + "\""));
    }
    EXPECT_LT(out.str().size(), 2500U);
    std::ostringstream again;
    writeLiquidSvg({shape, walls}, kView, droplet::liquidLookNamed("comic"), again);
    EXPECT_EQ(out.str(), again.str());
    std::ostringstream plain;
    writeLiquidSvg({shape, {}}, kView, droplet::liquidLookNamed("flat"), plain);
    EXPECT_THAT(plain.str(), Not(HasSubstr("background")));
    EXPECT_THAT(plain.str(), Not(HasSubstr("walls")));
}

TEST(LiquidLayer, ShowsWhatTheMaskCovers)
{
    const LiquidShape shape = someShape();
    droplet::LiquidLook look = droplet::liquidLookNamed("flat");
    look.foam.reset();
    const Layer layer = liquidLayer({shape, {}}, kView, look);
    const DeepPicture mask = liquidMask(shape, kView);
    double drawn = 0.0;
    for (std::size_t k = 0; k < mask.levels.size(); ++k) {
        drawn += layer.rgba[4 * k + 3] / 255.0;
    }
    EXPECT_NEAR(drawn, total(mask), 0.005 * total(mask));
    EXPECT_EQ(layer.rgba[4 * (60 * 200 + 60)], look.water[0]);
}

TEST(LiquidDrawing, RefusesUnknownLooksAndEmptyViews)
{
    EXPECT_THAT([] { droplet::liquidLookNamed("oil"); }, ThrowsMessage<Error>(HasSubstr("flat, comic, ink, night")));
    EXPECT_THAT(
        [] {
            droplet::liquidMask({}, {{1.0, 1.0}, 0, 10});
        },
        ThrowsMessage<Error>(HasSubstr("view.width is 0")));
    EXPECT_THAT(
        [] {
            droplet::liquidMask({}, {{0.0, 1.0}, 10, 10});
        },
        ThrowsMessage<Error>(HasSubstr("view.size.x is 0")));
}

}  // namespace
