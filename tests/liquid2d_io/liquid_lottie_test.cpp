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
using testing::IsEmpty;
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

/// Frames that layers with a name cover, in the order of the layers.
std::vector<std::pair<int, int>> framesOf(const json& file, const std::string& name)
{
    std::vector<std::pair<int, int>> frames;
    for (const json& layer : file.at("layers")) {
        if (layer.at("nm").get<std::string>().starts_with(name)) {
            frames.emplace_back(layer.at("ip"), layer.at("op"));
        }
    }
    return frames;
}

TEST(LiquidLottie, ShowsEveryFrameInItsTurn)
{
    const json file = json::parse(animation(droplet::liquidLookNamed("comic")));
    EXPECT_EQ(file.at("fr"), 12.5);
    EXPECT_EQ(file.at("ip"), 0);
    EXPECT_EQ(file.at("op"), 5);
    EXPECT_EQ(file.at("w"), 200);
    EXPECT_EQ(file.at("h"), 100);
    using Frames = std::pair<int, int>;
    EXPECT_THAT(framesOf(file, "frame"),
                ElementsAre(Frames{0, 1}, Frames{1, 2}, Frames{2, 3}, Frames{3, 4}, Frames{4, 5}));
    EXPECT_THAT(framesOf(file, "walls"), ElementsAre(Frames{0, 3}, Frames{3, 4}, Frames{4, 5}));
    EXPECT_THAT(framesOf(file, "background"), ElementsAre(Frames{0, 5}));
    // Later layers are below earlier ones.
    EXPECT_EQ(file.at("layers").front().at("nm"), "walls");
    EXPECT_EQ(file.at("layers").back().at("sc"), "#fcf6e8");
    int index = 0;
    for (const json& layer : file.at("layers")) {
        EXPECT_EQ(layer.at("ind"), ++index);
    }
    EXPECT_THAT(framesOf(json::parse(animation(droplet::liquidLookNamed("flat"))), "background"), IsEmpty());
}

TEST(LiquidLottie, HasClosedPathsForAllShapes)
{
    const json file = json::parse(animation(droplet::liquidLookNamed("comic")));
    std::size_t paths = 0;
    for (const json& layer : file.at("layers")) {
        for (const json& group : layer.value("shapes", json::array())) {
            const json& items = group.at("it");
            EXPECT_EQ(items.back().at("ty"), "tr");
            EXPECT_EQ(items.at(items.size() - 2).at("ty"), "fl");
            EXPECT_EQ(items.at(items.size() - 2).at("r"), 2) << "even-odd rule";
            for (const json& item : items) {
                if (item.at("ty") != "sh") {
                    continue;
                }
                const json& path = item.at("ks").at("k");
                EXPECT_EQ(path.at("c"), true);
                EXPECT_GE(path.at("v").size(), 2U);
                EXPECT_EQ(path.at("i").size(), path.at("v").size());
                EXPECT_EQ(path.at("o").size(), path.at("v").size());
                for (const char* list : {"v", "i", "o"}) {
                    EXPECT_THAT(path.at(list), Each(SizeIs(2)));
                }
                ++paths;
            }
        }
    }
    // Four frames of a rim, a hole, foam and a droplet; three layers of two walls.
    EXPECT_EQ(paths, 4U * 4U + 3U * 2U);
}

Vec2 pointOf(const json& list, std::size_t k)
{
    return {list.at(k).at(0).get<double>(), list.at(k).at(1).get<double>()};
}

TEST(LiquidLottie, HasTheCurvesOfTheOutlines)
{
    const json file = json::parse(animation(droplet::liquidLookNamed("flat")));
    const json& frame = file.at("layers").at(3);  // behind three layers of walls
    ASSERT_EQ(frame.at("nm"), "frame 1");
    std::vector<std::string> names;
    for (const json& group : frame.at("shapes")) {
        names.push_back(group.at("nm"));
    }
    EXPECT_THAT(names, ElementsAre("foam", "droplets", "liquid"));
    // The rim is a circle of 30 px around (50, 60) px.
    const json& path = frame.at("shapes").at(2).at("it").at(0).at("ks").at("k");
    const std::size_t count = path.at("v").size();
    for (std::size_t k = 0; k < count; ++k) {
        const std::size_t next = (k + 1) % count;
        const Vec2 a = pointOf(path.at("v"), k);
        const Vec2 d = pointOf(path.at("v"), next);
        const Vec2 b = a + pointOf(path.at("o"), k);
        const Vec2 c = d + pointOf(path.at("i"), next);
        for (const double t : {0.0, 0.25, 0.5, 0.75}) {
            const double s = 1.0 - t;
            const Vec2 x = s * s * s * a + 3.0 * s * s * t * b + 3.0 * s * t * t * c + t * t * t * d;
            EXPECT_NEAR(length(x - Vec2{50.0, 60.0}), 30.0, 0.35);
        }
    }
}

TEST(LiquidLottie, HasLinesOnTopAndNoFoamWithoutColour)
{
    const json file = json::parse(animation(droplet::liquidLookNamed("ink")));
    const json& shapes = file.at("layers").at(3).at("shapes");
    ASSERT_THAT(shapes, SizeIs(2));
    EXPECT_EQ(shapes.at(0).at("nm"), "droplets");
    const json& items = shapes.at(1).at("it");
    // Two paths, the line, the filling below it, the place.
    ASSERT_THAT(items, SizeIs(5));
    EXPECT_EQ(items.at(2).at("ty"), "st");
    EXPECT_DOUBLE_EQ(items.at(2).at("w").at("k").get<double>(), 0.4);
    EXPECT_EQ(items.at(3).at("ty"), "fl");
}

TEST(LiquidLottie, RefusesRatesThatAreNotPositive)
{
    EXPECT_THAT([] { LiquidLottie(kView, droplet::liquidLookNamed("flat"), 0.0); },
                ThrowsMessage<droplet::Error>(HasSubstr("frames_per_second is 0")));
}

}  // namespace
