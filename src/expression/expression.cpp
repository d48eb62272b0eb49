// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/expression/expression.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "bays.h"
#include "drops.h"
#include "entry_named.h"
#include "field.h"
#include "holes.h"
#include "isoline.h"
#include "require.h"
#include "smooth.h"
#include "wall_contact.h"

namespace droplet {
namespace {

/// Places of particles that hold air.
std::vector<Vec2> erasersOf(const ExpressionState& state, const ParticleFrame& frame)
{
    std::vector<Vec2> erasers;
    for (std::size_t i = 0; i < frame.position.size(); ++i) {
        if (state.air[frame.id[i]] > 0.0) {
            erasers.push_back(frame.position[i]);
        }
    }
    return erasers;
}

/// Whether a hole is foam: it holds an eraser.
bool isFoam(const LiquidHole& hole, const std::vector<Vec2>& erasers)
{
    return std::any_of(erasers.begin(), erasers.end(), [&](Vec2 x) { return length(x - hole.centre) < hole.reach; });
}

bool contains(const Loop& loop, Vec2 point)
{
    bool is_inside = false;
    for (std::size_t k = 0; k < loop.points.size(); ++k) {
        const Vec2 a = loop.points[k];
        const Vec2 b = loop.points[(k + 1) % loop.points.size()];
        if ((a.y <= point.y) != (b.y <= point.y) && point.x < a.x + (b.x - a.x) * (point.y - a.y) / (b.y - a.y)) {
            is_inside = !is_inside;
        }
    }
    return is_inside;
}

Loop outlineOf(const Drop& drop, double spacing)
{
    Loop loop{drop.outline(spacing), {}};
    loop.corner.resize(loop.points.size());
    return loop;
}

/// Droplet near liquid that does not touch it yet: its loop is that of the field, on whose grid small ones have
/// corners.
/// @param area  of the loop, in areas of a particle
const Drop* dropOf(const Loop& loop, double area, const std::vector<Drop>& drops)
{
    // Less than that of two droplets that touch; the grid loses a part of thin tails.
    constexpr double kLeast = 0.4;
    constexpr double kMost = 1.6;
    for (const Drop& drop : drops) {
        const bool is_separate = drop.is_near && !drop.members.is_landed;
        if (is_separate && area > kLeast * drop.water && area < kMost * drop.water &&
            contains(loop, drop.ellipse.centre)) {
            return &drop;
        }
    }
    return nullptr;
}

/// Draws a hole as a bay, if it is closed off by a thin bridge; returns whether it is.
bool openBay(const Loop& rim, LiquidHole& hole, LiquidShape& shape, const ParticleFrame& frame)
{
    for (const Bridge& bridge : bridgesOf(rim, shape.liquid, frame, hole.gap)) {
        if (std::optional<Loop> bay = withBay(shape.liquid, rim, bridge, frame.spacing)) {
            shape.liquid[bridge.outline] = std::move(*bay);
            hole.gap = bridge.middle;
            return true;
        }
    }
    return false;
}

}  // namespace

void ExpressionOptions::validate() const
{
    const auto at_least_zero = [](const char* field, double value) {
        droplet::require(std::isfinite(value) && value >= 0.0, field, value, "finite and at least 0");
    };
    const auto within = [](const char* field, double value, double min, double max, const char* constraint) {
        droplet::require(value >= min && value <= max, field, value, constraint);
    };
    at_least_zero("tail_length", tail_length);
    within("tail_slope", tail_slope, 0.2, 1.2, "from 0.2 to 1.2");
    within("max_tail", max_tail, 0.0, 100.0, "from 0 to 100 radii");
    within("eraser_share", eraser_share, 0.0, 1.0, "from 0 to 1");
    at_least_zero("air", air);
    at_least_zero("release", release);
    within("claws", claws, 0.0, 100.0, "from 0 to 100 spacings");
    within("max_air", max_air, 0.0, 1000.0, "from 0 to 1000 areas of a particle");
    within("smoothing", smoothing, 0.0, 2.0, "from 0 to 2");
    within("fairing", fairing, 0.0, 10.0, "from 0 to 10");
    within("resolution", resolution, 0.2, 1.0, "from 0.2 to 1 spacings");
    at_least_zero("min_area", min_area);
    at_least_zero("droplet_size", droplet_size);
}

LiquidStyle liquidStyleNamed(std::string_view name)
{
    constexpr std::array<std::pair<LiquidStyle, const char*>, 4> kStyles{{{LiquidStyle::Realistic, "realistic"},
                                                                          {LiquidStyle::Cartoon, "cartoon"},
                                                                          {LiquidStyle::Wave, "wave"},
                                                                          {LiquidStyle::Paper, "paper"}}};
    return valueNamed(kStyles, name, "style");
}

ExpressionOptions expressionOf(LiquidStyle style)
{
    ExpressionOptions options;
    if (style == LiquidStyle::Realistic) {
        return options;
    }
    options.tail_length = 0.25;
    options.resolution = 0.4;
    options.fairing = 2.5;
    options.max_tail = 5.0;
    options.min_area = 0.6;
    if (style == LiquidStyle::Wave) {
        options.claws = 16.0;
    }
    if (style == LiquidStyle::Paper) {
        options.air = 120.0;
        options.release = 20.0;
        options.max_air = 30.0;
    }
    return options;
}

LiquidShape liquidShape(const ExpressionState& state, const ParticleFrame& frame, const ExpressionOptions& options)
{
    options.validate();
    LiquidShape shape;
    shape.time = frame.time;
    const double particle = frame.spacing * frame.spacing;
    std::vector<Loop> holes;
    const std::vector<Drop> drops = dropsOf(state, frame, options);
    std::vector<Loop> loops = smoothed(isolines(fieldOf(drops, state, frame, options)), frame.spacing, options.fairing);
    meetWalls(loops, frame);
    for (Loop& loop : loops) {
        const double area = signedArea(loop);
        if (std::abs(area) < options.min_area * particle) {
            continue;
        }
        if (area < 0.0) {
            holes.push_back(std::move(loop));
        } else if (const Drop* drop = dropOf(loop, area / particle, drops)) {
            shape.droplets.push_back(outlineOf(*drop, frame.spacing));
        } else {
            (area <= options.droplet_size * particle ? shape.droplets : shape.liquid).push_back(std::move(loop));
        }
    }
    const std::vector<Vec2> erasers = options.air > 0.0 ? erasersOf(state, frame) : std::vector<Vec2>();
    // A hole that may wait is drawn as a bay meanwhile, or not at all if it is small.
    shape.holes = followedHoles(holes, state, frame,
                                [&](std::size_t k, LiquidHole& hole) { return openBay(holes[k], hole, shape, frame); });
    for (std::size_t k = 0; k < holes.size(); ++k) {
        Loop& hole = holes[k];
        if (!shape.holes[k].shown) {
            continue;
        }
        const bool is_in_droplet = std::any_of(shape.droplets.begin(), shape.droplets.end(), [&](const Loop& droplet) {
            return contains(droplet, hole.points.front());
        });
        if (is_in_droplet) {
            shape.droplets.push_back(std::move(hole));
            continue;
        }
        if (isFoam(shape.holes[k], erasers)) {
            shape.foam.push_back(hole);
        }
        shape.liquid.push_back(std::move(hole));
    }
    for (const Drop& drop : drops) {
        if (!drop.is_near) {
            shape.droplets.push_back(outlineOf(drop, frame.spacing));
        }
    }
    return shape;
}

ExpressionState remember(ExpressionState state, const LiquidShape& shape)
{
    state.holes = shape.holes;
    state.remembers = true;
    return state;
}

}  // namespace droplet
