// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/wind_io/chart.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "drawing/lettering.h"
#include "droplet/error.h"

namespace droplet {
namespace {

using ::testing::Contains;
using ::testing::Each;
using ::testing::SizeIs;

TunnelSweep sweptPreset(const char* name)
{
    const ForcePreset& preset = forcePresetNamed(name);
    TunnelSweep what;
    what.model = preset.model;
    what.volumes = preset.volumes;
    what.slopes = {preset.slope};
    what.winds = {0.0, 16.0};
    return what;
}

template <typename Mark>
std::vector<Mark> marksOf(const Drawing& drawing)
{
    std::vector<Mark> found;
    for (const auto& mark : drawing.marks) {
        if (const auto* one = std::get_if<Mark>(&mark)) {
            found.push_back(*one);
        }
    }
    return found;
}

std::vector<std::string> textsOf(const Drawing& drawing)
{
    std::vector<std::string> texts;
    for (const Text& text : marksOf<Text>(drawing)) {
        texts.push_back(text.text);
    }
    return texts;
}

/// Scale of an axis, from two of the numbers beside it.
double windAt(const Drawing& drawing, double x)
{
    std::map<std::string, double> at;
    for (const Text& text : marksOf<Text>(drawing)) {
        if (text.anchor == Anchor::Middle) {
            at[text.text] = text.at.x;
        }
    }
    return 16.0 * (x - at.at("0")) / (at.at("16") - at.at("0"));
}

double rateAt(const Drawing& drawing, double y)
{
    std::map<std::string, double> at;
    for (const Text& text : marksOf<Text>(drawing)) {
        if (text.anchor == Anchor::End) {
            at[text.text] = text.at.y - 0.5 * text.size;
        }
    }
    return 8.0 * (y - at.at("0")) / (at.at("8") - at.at("0"));
}

std::vector<Line> curvesOf(const Drawing& drawing)
{
    std::vector<Line> lines = marksOf<Line>(drawing);
    std::erase_if(lines, [](const Line& line) { return line.points.size() < 100; });
    return lines;
}

TEST(AccelerationChart, CurvesMatchTheModel)
{
    for (const char* preset : {"thesis", "hashimoto"}) {
        const TunnelSweep what = sweptPreset(preset);
        const Tunnel tunnel = sweep(what);
        const Drawing drawing = accelerationChart(what, tunnel);
        const auto curves = curvesOf(drawing);
        ASSERT_THAT(curves, SizeIs(what.volumes.size()));
        for (std::size_t v = 0; v < curves.size(); ++v) {
            const TunnelCase& of = tunnel.cases[v];
            std::size_t still = 0;
            for (const Vec2& p : curves[v].points) {
                const double wind = windAt(drawing, p.x);
                const double rate = acceleration(of.forces, drivingForce(of.forces, of.slope, wind), 0.0);
                EXPECT_NEAR(rateAt(drawing, p.y), rate, 1e-6);
                still += std::abs(rate) < 1e-9 ? 1 : 0;
            }
            // Corners are exact, not only near the samples.
            for (const auto& threshold : {of.thresholds.lower, of.thresholds.upper}) {
                if (threshold) {
                    EXPECT_TRUE(std::ranges::any_of(curves[v].points, [&](const Vec2& p) {
                        return std::abs(windAt(drawing, p.x) - *threshold) < 1e-6;
                    }));
                }
            }
            EXPECT_GT(still, 5U);
        }
    }
}

TEST(AccelerationChart, ShadesTheStillBandOfEveryDroplet)
{
    const TunnelSweep what = sweptPreset("hashimoto");
    const Tunnel tunnel = sweep(what);
    const Drawing drawing = accelerationChart(what, tunnel);
    const auto bands = marksOf<Area>(drawing);
    ASSERT_THAT(bands, SizeIs(4));
    for (std::size_t v = 0; v < bands.size(); ++v) {
        EXPECT_NEAR(windAt(drawing, bands[v].points[0].x), *tunnel.cases[v].thresholds.lower, 1e-9);
        EXPECT_NEAR(windAt(drawing, bands[v].points[1].x), *tunnel.cases[v].thresholds.upper, 1e-9);
    }
}

TEST(AccelerationChart, NamesItsAxesAndCurves)
{
    ChartOptions options;
    options.title = "A plane";
    options.measured = kMeasuredStillBand;
    const TunnelSweep what = sweptPreset("thesis");
    const auto texts = textsOf(accelerationChart(what, sweep(what), options));
    for (const char* words : {"A plane", "wind along the slope, m/s", "acceleration up the slope, m/s²", "−4", "16",
                              "5 µL", "100 µL", "measured still 7–11 m/s", "slope 35°, hysteresis 0.257"}) {
        EXPECT_THAT(texts, Contains(words)) << words;
    }
}

// For any sweep, nothing leaves the page and no texts overlap.
TEST(AccelerationChart, IsLegibleForAnySweep)
{
    std::vector<TunnelSweep> sweeps{sweptPreset("thesis"), sweptPreset("hashimoto"), sweptPreset("hashimoto"),
                                    sweptPreset("thesis"), sweptPreset("thesis")};
    sweeps[1].volumes.clear();
    for (int k = 1; k <= 100; ++k) {
        sweeps[1].volumes.push_back(1e-9 * k);
    }
    sweeps[2].slopes = {0.0, 0.5, 1.0};
    sweeps[2].hystereses = {0.0, 0.05, 0.5, 1.9};
    sweeps[3].model.wetting.sliding_angle = 0.2;
    sweeps[4].model.air.density = 0.0;
    sweeps[4].winds = {3.0};
    for (const TunnelSweep& what : sweeps) {
        const Tunnel tunnel = sweep(what);
        for (const Drawing& drawing : {accelerationChart(what, tunnel), regimeMap(what, tunnel)}) {
            const auto inside = [&](const Vec2& p) {
                return p.x >= 0.0 && p.x <= drawing.width && p.y >= 0.0 && p.y <= drawing.height;
            };
            for (const Line& line : marksOf<Line>(drawing)) {
                EXPECT_TRUE(std::ranges::all_of(line.points, inside));
            }
            for (const Area& area : marksOf<Area>(drawing)) {
                EXPECT_TRUE(std::ranges::all_of(area.points, inside));
            }
            struct Box {
                Vec2 low;
                Vec2 high;
                std::string text;
            };
            std::vector<Box> boxes;
            for (const Text& text : marksOf<Text>(drawing)) {
                const double width = textWidth(text.text, text.size);
                const double shift = text.anchor == Anchor::Middle ? 0.5 : text.anchor == Anchor::End ? 1.0 : 0.0;
                const Vec2 low{text.at.x - shift * width, text.at.y - text.size};
                boxes.push_back({low, {low.x + width, text.at.y}, text.text});
                EXPECT_TRUE(inside(boxes.back().low) && inside(boxes.back().high)) << text.text;
            }
            for (std::size_t a = 0; a < boxes.size(); ++a) {
                for (std::size_t b = 0; b < a; ++b) {
                    EXPECT_FALSE(boxes[a].low.x < boxes[b].high.x && boxes[b].low.x < boxes[a].high.x &&
                                 boxes[a].low.y < boxes[b].high.y && boxes[b].low.y < boxes[a].high.y)
                        << boxes[a].text << " over " << boxes[b].text;
                }
            }
        }
    }
}

double areaOf(const std::vector<Vec2>& points)
{
    double twice = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        twice += cross(points[i], points[(i + 1) % points.size()]);
    }
    return std::abs(0.5 * twice);
}

TEST(RegimeMap, HasFourRegimes)
{
    for (const char* preset : {"thesis", "hashimoto"}) {
        const TunnelSweep what = sweptPreset(preset);
        const Drawing drawing = regimeMap(what, sweep(what));
        const auto areas = marksOf<Area>(drawing);
        ASSERT_THAT(areas, SizeIs(4));
        Vec2 low = areas[0].points[0];
        Vec2 high = low;
        double all = 0.0;
        for (const Area& area : areas) {
            all += areaOf(area.points);
            for (const Vec2& p : area.points) {
                low = {std::min(low.x, p.x), std::min(low.y, p.y)};
                high = {std::max(high.x, p.x), std::max(high.y, p.y)};
            }
        }
        EXPECT_NEAR(all, (high.x - low.x) * (high.y - low.y), 1e-6 * all);
        for (const char* words : {"runs down", "still", "climbs", "volume, µL"}) {
            EXPECT_THAT(textsOf(drawing), Contains(words));
        }
        EXPECT_THAT(textsOf(drawing), Contains(::testing::StartsWith("torn off")));
    }
}

TEST(RegimeMap, AreasMatchTheModel)
{
    const TunnelSweep what = sweptPreset("thesis");
    const Drawing drawing = regimeMap(what, sweep(what));
    // The scale of volumes comes from the numbers beside the axis.
    std::map<std::string, double> at;
    for (const Text& text : marksOf<Text>(drawing)) {
        if (text.anchor == Anchor::End) {
            at[text.text] = text.at.y - 0.5 * text.size;
        }
    }
    const double decade = at.at("10") - at.at("100");
    const auto areas = marksOf<Area>(drawing);
    const auto inside = [](const std::vector<Vec2>& polygon, Vec2 p) {
        bool is_inside = false;
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const Vec2 a = polygon[i];
            const Vec2 b = polygon[(i + 1) % polygon.size()];
            if ((a.y <= p.y) != (b.y <= p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) {
                is_inside = !is_inside;
            }
        }
        return is_inside;
    };
    int seen[4] = {};
    for (const double volume : {3e-9, 7e-9, 12e-9, 31e-9, 90e-9, 170e-9}) {
        const DropletForces forces = forcesOn(what.model, volume);
        for (double wind = 0.3; wind < 16.0; wind += 0.71) {
            const CapSize cap = capOf(volume, what.model.wetting.contact_angle);
            const auto regime =
                wind > tearOffWind(what.model, cap).value()
                    ? 3U
                    : static_cast<std::size_t>(regimeOf(forces, drivingForce(forces, what.slopes[0], wind)));
            double x = 0.0;
            for (double step = 1000.0; step > 1e-9; step *= 0.5) {
                x += windAt(drawing, x + step) < wind ? step : 0.0;
            }
            const Vec2 p{x, at.at("10") - decade * std::log10(volume / 10e-9)};
            EXPECT_TRUE(inside(areas[regime].points, p)) << volume << " " << wind;
            ++seen[regime];
        }
    }
    EXPECT_THAT(seen, Each(::testing::Gt(5)));
}

TEST(Charts, HaveARowForEachSlope)
{
    TunnelSweep what = sweptPreset("thesis");
    what.slopes = {0.2, 0.5, 0.9};
    what.hystereses = {0.05, 0.2, 0.5, 1.0};
    const Tunnel tunnel = sweep(what);
    for (const Drawing& drawing : {accelerationChart(what, tunnel), regimeMap(what, tunnel)}) {
        std::map<std::string, double> rows;
        std::map<std::string, double> columns;
        std::size_t panels = 0;
        for (const Text& text : marksOf<Text>(drawing)) {
            if (const std::size_t comma = text.text.find(", hysteresis"); comma != std::string::npos) {
                const double row = rows.emplace(text.text.substr(0, comma), text.at.y).first->second;
                const double column = columns.emplace(text.text.substr(comma), text.at.x).first->second;
                EXPECT_EQ(text.at.y, row) << text.text;
                EXPECT_EQ(text.at.x, column) << text.text;
                ++panels;
            }
        }
        EXPECT_EQ(panels, 12U);
        EXPECT_THAT(rows, SizeIs(3));
        EXPECT_THAT(columns, SizeIs(4));
    }
}

TEST(Charts, RejectTooManyPanels)
{
    TunnelSweep what = sweptPreset("thesis");
    what.slopes.assign(13, 0.5);
    const Tunnel tunnel = sweep(what);
    EXPECT_THROW(accelerationChart(what, tunnel), Error);
    EXPECT_THROW(regimeMap(what, tunnel), Error);
}

}  // namespace
}  // namespace droplet
