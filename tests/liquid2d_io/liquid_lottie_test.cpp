// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/liquid2d_io/liquid_lottie.h"

#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "droplet/error.h"

namespace {

using droplet::LiquidLook;
using droplet::LiquidLottie;
using droplet::LiquidShape;
using droplet::LiquidView;
using droplet::Loop;
using droplet::Region;
using droplet::Vec2;
using nlohmann::json;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;
using testing::ThrowsMessage;

const LiquidView kView{{2.0, 1.0}, 200, 100};

Loop circle(Vec2 centre, double radius, bool is_hole = false)
{
    Loop loop;
    for (int k = 0; k < 60; ++k) {
        const double angle = (is_hole ? -2.0 : 2.0) * std::numbers::pi * k / 60.0;
        loop.points.push_back(centre + radius * Vec2{std::cos(angle), std::sin(angle)});
    }
    loop.corner.resize(loop.points.size());
    return loop;
}

LiquidShape shapeAt(double x)
{
    LiquidShape shape;
    shape.liquid = {circle({x, 0.4}, 0.3), circle({x, 0.4}, 0.1, true)};
    shape.foam = {shape.liquid[1]};
    shape.droplets = {circle({x, 0.85}, 0.05)};
    return shape;
}

/// Five frames: a wall that moves at the last two, the third frame without liquid.
std::string animation(const LiquidLook& look)
{
    LiquidLottie lottie(kView, look, 12.5);
    for (int frame = 0; frame < 5; ++frame) {
        const std::vector<Region> walls{droplet::rectangle({0.0, 0.0}, {2.0, 0.05}),
                                        droplet::rectangle({0.0, 0.0}, {0.05, frame < 3 ? 1.0 : 0.1 * frame})};
        lottie.add({frame == 2 ? LiquidShape() : shapeAt(0.5 + 0.1 * frame), walls});
    }
    std::ostringstream out;
    lottie.write(out);
    return out.str();
}

/// Layer with a name.
json layerNamed(const json& file, const std::string& name)
{
    for (const json& layer : file.at("layers")) {
        if (layer.at("nm") == name) {
            return layer;
        }
    }
    return {};
}

/// Path of a shape that shows at a frame.
json pathAt(const json& shape, int frame)
{
    const json& value = shape.at("ks");
    if (value.at("a") == 0) {
        return value.at("k");
    }
    json path;
    for (const json& key : value.at("k")) {
        if (key.at("t") <= frame) {
            path = key.at("s").at(0);
        }
    }
    return path;
}

Vec2 pointOf(const json& list, std::size_t k)
{
    return {list.at(k).at(0).get<double>(), list.at(k).at(1).get<double>()};
}

/// Points of a path, sixteen for each curve.
std::vector<Vec2> pointsOf(const json& path)
{
    std::vector<Vec2> points;
    const std::size_t count = path.at("v").size();
    for (std::size_t k = 0; k < count; ++k) {
        const std::size_t next = (k + 1) % count;
        const Vec2 a = pointOf(path.at("v"), k);
        const Vec2 d = pointOf(path.at("v"), next);
        const Vec2 b = a + pointOf(path.at("o"), k);
        const Vec2 c = d + pointOf(path.at("i"), next);
        for (int i = 0; i < 16; ++i) {
            const double t = i / 16.0;
            const double s = 1.0 - t;
            points.push_back(s * s * s * a + 3.0 * s * s * t * b + 3.0 * s * t * t * c + t * t * t * d);
        }
    }
    return points;
}

double areaOf(const std::vector<Vec2>& points)
{
    double area = 0.0;
    for (std::size_t k = 0; k < points.size(); ++k) {
        area += 0.5 * cross(points[k], points[(k + 1) % points.size()]);
    }
    return area;
}

TEST(LiquidLottie, HasALayerForEachMaterial)
{
    const json file = json::parse(animation(droplet::liquidLookNamed("comic")));
    EXPECT_EQ(file.at("fr"), 12.5);
    EXPECT_EQ(file.at("ip"), 0);
    EXPECT_EQ(file.at("op"), 5);
    EXPECT_EQ(file.at("w"), 200);
    EXPECT_EQ(file.at("h"), 100);
    // Later layers are below earlier ones.
    std::vector<std::string> names;
    int index = 0;
    for (const json& layer : file.at("layers")) {
        names.push_back(layer.at("nm"));
        EXPECT_EQ(layer.at("ind"), ++index);
        EXPECT_EQ(layer.at("ip"), 0);
        EXPECT_EQ(layer.at("op"), 5);
    }
    EXPECT_THAT(names, ElementsAre("walls", "lines", "foam", "droplets", "liquid", "background"));
    EXPECT_EQ(file.at("layers").back().at("sc"), "#fcf6e8");
    const json flat = json::parse(animation(droplet::liquidLookNamed("flat")));
    EXPECT_THAT(flat.at("layers"), SizeIs(4));
    EXPECT_TRUE(layerNamed(flat, "lines").is_null());
    EXPECT_TRUE(layerNamed(flat, "background").is_null());
    const json ink = json::parse(animation(droplet::liquidLookNamed("ink")));
    EXPECT_TRUE(layerNamed(ink, "foam").is_null());
}

TEST(LiquidLottie, HasKeyframesThatHoldWherePathsChange)
{
    const json file = json::parse(animation(droplet::liquidLookNamed("comic")));
    for (const json& layer : file.at("layers")) {
        for (const json& group : layer.value("shapes", json::array())) {
            const json& items = group.at("it");
            EXPECT_EQ(items.back().at("ty"), "tr");
            EXPECT_EQ(items.at(items.size() - 2).at("ty"), "fl");
            EXPECT_EQ(items.at(items.size() - 2).at("r"), group.at("nm") == "wall" ? 2 : 1);
            for (const json& item : items) {
                if (item.at("ty") != "sh" || item.at("ks").at("a") == 0) {
                    continue;
                }
                // Players take the number of vertices from the first keyframe.
                const std::size_t count = item.at("ks").at("k").at(0).at("s").at(0).at("v").size();
                int last = -1;
                json before;
                for (const json& key : item.at("ks").at("k")) {
                    EXPECT_EQ(key.at("h"), 1);
                    EXPECT_GT(key.at("t"), last);
                    last = key.at("t");
                    const json& path = key.at("s").at(0);
                    EXPECT_NE(path, before);
                    before = path;
                    EXPECT_EQ(path.at("c"), true);
                    for (const char* list : {"v", "i", "o"}) {
                        EXPECT_THAT(path.at(list), SizeIs(count));
                        EXPECT_THAT(path.at(list), Each(SizeIs(2)));
                    }
                }
            }
        }
    }
    // Of two walls, the first does not move, and the second one at the last two frames.
    const json walls = layerNamed(file, "walls").at("shapes");
    ASSERT_THAT(walls, SizeIs(2));
    EXPECT_EQ(walls.at(0).at("it").at(0).at("ks").at("a"), 0);
    EXPECT_THAT(walls.at(1).at("it").at(0).at("ks").at("k"), SizeIs(3));
}

TEST(LiquidLottie, ShowsTheOutlinesOfEveryFrame)
{
    const json file = json::parse(animation(droplet::liquidLookNamed("comic")));
    for (int frame = 0; frame < 5; ++frame) {
        const json items = layerNamed(file, "liquid").at("shapes").at(0).at("it");
        double area = 0.0;
        for (const json& item : items) {
            if (item.at("ty") != "sh") {
                continue;
            }
            const std::vector<Vec2> points = pointsOf(pathAt(item, frame));
            area -= areaOf(points);
            if (areaOf(points) < 0.0) {
                // The rim is a circle of 30 px, counter-clockwise on the screen.
                for (const Vec2 x : points) {
                    EXPECT_NEAR(length(x - Vec2{50.0 + 10.0 * frame, 60.0}), 30.0, 0.35);
                }
            }
        }
        EXPECT_NEAR(area, frame == 2 ? 0.0 : std::numbers::pi * (900.0 - 100.0), 30.0) << frame;
    }
}

TEST(LiquidLottie, FillsLinesOfTheirWidth)
{
    const json file = json::parse(animation(droplet::liquidLookNamed("ink")));
    const json items = layerNamed(file, "lines").at("shapes").at(0).at("it");
    double area = 0.0;
    for (const json& item : items) {
        if (item.at("ty") == "sh") {
            area += areaOf(pointsOf(pathAt(item, 0)));
        }
    }
    // Rim, hole and droplet, of 30, 10 and 5 px, with lines of 0.4 px.
    EXPECT_NEAR(std::abs(area), 0.4 * 2.0 * std::numbers::pi * (30.0 + 10.0 + 5.0), 4.0);
}

TEST(LiquidLottie, RefusesRatesThatAreNotPositive)
{
    EXPECT_THAT([] { LiquidLottie(kView, droplet::liquidLookNamed("flat"), 0.0); },
                ThrowsMessage<droplet::Error>(HasSubstr("frames_per_second is 0")));
}

}  // namespace
