// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/liquid2d_io/liquid_drawing.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <numeric>
#include <random>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "droplet/error.h"
#include "liquid2d_io/bezier.h"
#include "liquid2d_io/pixel_coverage.h"

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

std::vector<Vec2> inPixels(std::vector<Vec2> points)
{
    for (Vec2& x : points) {
        x = {100.0 * x.x, 100.0 * (1.0 - x.y)};
    }
    return points;
}

void addLoop(droplet::PixelCoverage& coverage, const std::vector<Vec2>& points)
{
    for (std::size_t k = 0; k < points.size(); ++k) {
        coverage.addLine(points[k], points[(k + 1) % points.size()]);
    }
}

TEST(LiquidMask, CoversExactlyTheArea)
{
    LiquidShape shape;
    shape.liquid = {ellipse({0.9, 0.5}, {0.612, 0.333}, 237), ellipse({0.8, 0.45}, {0.123, 0.211}, 101, true)};
    shape.droplets = {ellipse({1.77, 0.8}, {0.011, 0.007}, 13)};
    droplet::PixelCoverage coverage(kView.width, kView.height);
    for (const auto* loops : {&shape.liquid, &shape.droplets}) {
        for (const Loop& loop : *loops) {
            addLoop(coverage, inPixels(loop.points));
        }
    }
    const std::vector<double> shares = coverage.shares();
    const double covered = std::accumulate(shares.begin(), shares.end(), 0.0) * kPixel;
    EXPECT_NEAR(covered, shape.area(), 1e-9 * shape.area());
    // The mask has the same shares, each rounded to 1/65535.
    const DeepPicture mask = liquidMask(shape, kView);
    ASSERT_EQ(mask.levels.size(), shares.size());
    for (std::size_t k = 0; k < shares.size(); ++k) {
        ASSERT_NEAR(mask.levels[k], 65535.0 * shares[k], 0.5 + 1e-6) << k;
    }
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

/// Points of a path, so many for each curve.
std::vector<Vec2> flattened(const BezierPath& path, int parts)
{
    std::vector<Vec2> dense;
    Vec2 start = path.start;
    for (const BezierCurve& curve : path.curves) {
        for (int k = 0; k < parts; ++k) {
            dense.push_back(at(start, curve, static_cast<double>(k) / parts));
        }
        start = curve.end;
    }
    return dense;
}

/// Greatest distance of places on one closed polyline from the other one.
double distanceOf(const std::vector<Vec2>& polyline, const std::vector<Vec2>& other)
{
    double worst = 0.0;
    for (std::size_t i = 0; i < polyline.size(); ++i) {
        const Vec2 side = polyline[(i + 1) % polyline.size()] - polyline[i];
        const int parts = static_cast<int>(length(side) / 0.4) + 1;
        for (int part = 0; part < parts; ++part) {
            const Vec2 p = polyline[i] + (static_cast<double>(part) / parts) * side;
            double nearest = 1e9;
            for (std::size_t k = 0; k < other.size(); ++k) {
                const Vec2 a = other[k];
                const Vec2 ab = other[(k + 1) % other.size()] - a;
                const double t = dot(ab, ab) > 0.0 ? std::clamp(dot(p - a, ab) / dot(ab, ab), 0.0, 1.0) : 0.0;
                nearest = std::min(nearest, length(p - (a + t * ab)));
            }
            worst = std::max(worst, nearest);
        }
    }
    return worst;
}

/// Greatest distance of the points from the path.
double distanceOf(const std::vector<Vec2>& points, const BezierPath& path)
{
    return distanceOf(points, flattened(path, 60));
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

TEST(Bezier, StaysWithinTheToleranceOfPolygonsInBothDirections)
{
    std::mt19937 random(7);
    std::vector<Vec2> star;
    for (int k = 0; k < 40; ++k) {
        const double angle = 2.0 * std::numbers::pi * k / 40.0;
        const double radius = 10.0 + 50.0 * static_cast<double>(random()) / 4294967296.0;
        star.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
    const std::vector<std::pair<const char*, std::vector<Vec2>>> polygons{
        {"square", {{0, 0}, {50, 0}, {50, 50}, {0, 50}}},
        {"triangle", {{0, 0}, {80, 5}, {20, 60}}},
        {"sliver", {{0, 0}, {90, 0.2}, {0, 0.4}}},
        {"octagon", ellipse({0, 0}, {30, 30}, 8).points},
        {"96 corners", ellipse({0, 0}, {60, 60}, 96).points},
        {"seven small corners", ellipse({0, 0}, {1.2, 1.2}, 7).points},
        {"star", star},
    };
    for (const auto& [name, polygon] : polygons) {
        for (const double tolerance : {0.3, 0.05}) {
            const BezierPath path = droplet::fitBezier(polygon, tolerance);
            EXPECT_EQ(path.curves.back().end, path.start) << name;
            // The flattened curve is this near to the curve.
            constexpr double kFlat = 0.01;
            EXPECT_LT(distanceOf(polygon, path), tolerance + kFlat) << name;
            EXPECT_LT(distanceOf(flattened(path, 60), polygon), tolerance + kFlat) << name;
        }
    }
}

TEST(Bezier, KeepsTheCornersOfSmallPolygons)
{
    const std::vector<std::vector<Vec2>> polygons{
        {{0, 0}, {1, 0}, {0, 1}}, {{0, 0}, {50, 0}, {50, 50}, {0, 50}}, {{0, 0}, {90, 2}, {0, 4}}};
    for (const std::vector<Vec2>& polygon : polygons) {
        const BezierPath path = droplet::fitBezier(polygon, 0.3);
        std::vector<Vec2> ends;
        for (const BezierCurve& curve : path.curves) {
            ends.push_back(curve.end);
        }
        EXPECT_THAT(ends, testing::IsSupersetOf(polygon));
        EXPECT_LE(ends.size(), polygon.size());
    }
}

TEST(Bezier, TakesLoopsWithoutArea)
{
    const std::vector<std::vector<Vec2>> loops{
        {{1, 2}}, {{1, 2}, {1, 2}, {1, 2}}, {{0, 0}, {40, 0}}, {{0, 0}, {0, 1e-9}}};
    for (const std::vector<Vec2>& loop : loops) {
        const BezierPath path = droplet::fitBezier(loop, 0.3);
        ASSERT_FALSE(path.curves.empty());
        EXPECT_EQ(path.curves.back().end, path.start);
        EXPECT_LT(distanceOf(loop, path), 0.3);
    }
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
    for (const char* id : {"background", "liquid", "droplets", "foam", "lines", "walls"}) {
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

std::size_t countOf(const std::string& what, const std::string& text)
{
    std::size_t count = 0;
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) {
        ++count;
    }
    return count;
}

std::string svgOf(const droplet::DrawnLiquid& scene, const droplet::LiquidLook& look)
{
    std::ostringstream out;
    writeLiquidSvg(scene, kView, look, out);
    return out.str();
}

TEST(LiquidSvg, DrawsOverlappingWallsWithoutAHole)
{
    const std::vector<droplet::Region> walls{droplet::rectangle({0.0, 0.0}, {2.0, 0.1}),
                                             droplet::rectangle({0.0, 0.0}, {0.1, 1.0})};
    const std::string svg = svgOf({LiquidShape(), walls}, droplet::liquidLookNamed("flat"));
    EXPECT_EQ(countOf("<path ", svg), 2U);
    EXPECT_EQ(countOf("M", svg), 2U);
    EXPECT_EQ(countOf("<g id=\"walls\">", svg), 1U);
}

TEST(LiquidSvg, DrawsTheLineOfFoamWithoutColourOnce)
{
    const LiquidShape shape = someShape();
    const std::string svg = svgOf({shape, {}}, droplet::liquidLookNamed("ink"));
    EXPECT_THAT(svg, Not(HasSubstr("foam")));
    // The liquid's rim and hole, and the droplet; each has a line with two edges.
    const std::size_t lines = svg.find("id=\"lines\"");
    EXPECT_EQ(countOf("M", svg.substr(0, lines)), 3U);
    EXPECT_EQ(countOf("M", svg.substr(lines)), 2U * 3U);
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

/// Attribute of an element of SVG.
std::string attribute(const std::string& element, const std::string& name)
{
    const std::size_t begin = element.find(" " + name + "=\"") + name.size() + 3;
    return element.substr(begin, element.find('"', begin) - begin);
}

/// Polylines of path data with absolute M and L, relative c, and z.
std::vector<std::vector<Vec2>> polylinesOf(const std::string& data)
{
    std::vector<std::vector<Vec2>> polylines;
    std::istringstream in(data);
    const auto place = [&] {
        Vec2 x;
        in >> x.x >> x.y;
        return x;
    };
    char command = 0;
    while (in >> std::ws && in.peek() != EOF) {
        if (std::isalpha(in.peek()) != 0) {
            in >> command;
            if (command == 'M') {
                polylines.push_back({place()});
            }
            continue;
        }
        std::vector<Vec2>& points = polylines.back();
        if (command != 'c') {
            points.push_back(place());
            continue;
        }
        const Vec2 start = points.back();
        const Vec2 leaving = start + place();
        const Vec2 arriving = start + place();
        const Vec2 end = start + place();
        for (int k = 1; k <= 20; ++k) {
            points.push_back(at(start, {leaving, arriving, end}, k / 20.0));
        }
    }
    return polylines;
}

TEST(LiquidLayer, ShowsThePathsOfTheSvg)
{
    LiquidShape shape = someShape();
    shape.liquid.push_back(ellipse({0.15, 0.15}, {0.1, 0.02}, 30));
    const std::vector<droplet::Region> walls{droplet::rectangle({0.0, 0.0}, {2.0, 0.153}),
                                             droplet::rectangle({0.0, 0.0}, {0.087, 1.0})};
    droplet::LiquidLook look = droplet::liquidLookNamed("flat");
    look.background = droplet::Colour{250, 240, 10};
    const std::string svg = svgOf({shape, walls}, look);
    std::vector<double> expected;
    for (int k = 0; k < kView.width * kView.height; ++k) {
        expected.insert(expected.end(), look.background->begin(), look.background->end());
    }
    std::size_t paths = 0;
    for (std::size_t begin = svg.find("<path "); begin != std::string::npos; begin = svg.find("<path ", begin + 1)) {
        const std::string element = svg.substr(begin, svg.find("/>", begin) - begin);
        droplet::PixelCoverage coverage(kView.width, kView.height);
        for (const std::vector<Vec2>& polyline : polylinesOf(attribute(element, "d"))) {
            addLoop(coverage, polyline);
        }
        const unsigned long colour = std::stoul(attribute(element, "fill").substr(1), nullptr, 16);
        const std::vector<double> shares = coverage.shares();
        for (std::size_t k = 0; k < shares.size(); ++k) {
            // Foam runs clockwise.
            const double share = std::abs(shares[k]);
            for (std::size_t c = 0; c < 3; ++c) {
                const auto level = static_cast<double>((colour >> (16U - 8U * c)) & 0xFFU);
                expected[3 * k + c] += share * (level - expected[3 * k + c]);
            }
        }
        ++paths;
    }
    EXPECT_EQ(paths, 5U);
    const Layer layer = liquidLayer({shape, walls}, kView, look);
    double worst = 0.0;
    double sum = 0.0;
    for (std::size_t k = 0; k < expected.size(); ++k) {
        const double difference = std::abs(layer.rgba[k / 3 * 4 + k % 3] - expected[k]);
        worst = std::max(worst, difference);
        sum += difference;
    }
    // Cairo counts 15 rows of samples in a pixel, which more than one edge may cross.
    EXPECT_LT(worst, 255.0 / 10.0);
    EXPECT_LT(sum / static_cast<double>(expected.size()), 0.1);
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

/// A droplet smaller than the look's least one is not drawn, whatever its form; liquid always is.
TEST(LiquidDrawing, LeavesDustOut)
{
    // In a window of 2 m, 2 thousandths are 4 mm.
    LiquidShape shape;
    shape.droplets = {ellipse({0.5, 0.5}, {2.1e-3, 2.1e-3}, 24), ellipse({1.0, 0.5}, {4.2e-3, 1.05e-3}, 24)};
    LiquidShape smaller;
    smaller.droplets = {ellipse({0.5, 0.5}, {1.9e-3, 1.9e-3}, 24), ellipse({1.0, 0.5}, {3.8e-3, 0.95e-3}, 24)};
    LiquidShape liquid;
    liquid.liquid = smaller.droplets;
    droplet::LiquidLook look = droplet::liquidLookNamed("flat");
    const auto drawn = [&](const LiquidShape& drawn_shape) {
        const Layer layer = liquidLayer({drawn_shape, {}}, {{2.0, 1.0}, 1000, 500}, look);
        std::size_t count = 0;
        for (std::size_t k = 3; k < layer.rgba.size(); k += 4) {
            count += layer.rgba[k] > 0 ? 1 : 0;
        }
        return count;
    };
    EXPECT_GT(drawn(shape), 0U);
    EXPECT_EQ(drawn(smaller), 0U);
    EXPECT_GT(drawn(liquid), 0U);
    look.least_droplet = 0.0;
    EXPECT_GT(drawn(smaller), 0U);
}

}  // namespace
