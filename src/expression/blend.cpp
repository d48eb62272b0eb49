// SPDX-License-Identifier: GPL-3.0-or-later
//
// Liquid between two shapes lies where the weighted mean of a function of both signed distances is above a level. The
// function is linear within a spacing of the rim and a logarithm beyond: with distances themselves, a body that has
// nothing near it in the other shape would vanish at once, for its depth is small beside its distance from the rest.
// The level is the one that encloses the mean of both areas. Droplets are finer than the grid: they are scaled as they
// are.
#include "droplet/expression/blend.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include "droplet/liquid2d/fluid_scene.h"
#include "grid_field.h"
#include "liquid2d/bounds.h"
#include "liquid2d/region.h"
#include "require.h"
#include "surface_kernel.h"

namespace droplet {
namespace {

Region regionOf(const std::vector<Loop>& loops)
{
    Region region;
    for (const Loop& loop : loops) {
        region.loops.push_back(loop.points);
    }
    return region;
}

/// Whether the middle of a hole is in one of others, or the reverse.
bool isAtOneOf(const std::vector<Loop>& others, const Loop& hole)
{
    const auto holds_middle = [](const Loop& loop, const Loop& other) {
        return contains(regionOf({loop}), momentsOf(regionOf({other})).centroid);
    };
    return std::any_of(others.begin(), others.end(),
                       [&](const Loop& other) { return holds_middle(other, hole) || holds_middle(hole, other); });
}

/// Detached droplet with its holes.
struct Body {
    std::vector<Loop> loops;
    Vec2 centroid{};
    double area = 0.0;

    [[nodiscard]] double radius() const { return std::sqrt(area / std::numbers::pi); }
};

std::vector<Body> bodiesOf(const std::vector<Loop>& droplets)
{
    std::vector<Body> bodies;
    for (const Loop& loop : droplets) {
        if (signedArea(loop) > 0.0) {
            bodies.push_back({{loop}});
        }
    }
    for (const Loop& loop : droplets) {
        if (signedArea(loop) <= 0.0) {
            const auto owner = std::find_if(bodies.begin(), bodies.end(), [&](const Body& body) {
                return contains({{body.loops.front().points}}, loop.points.front());
            });
            if (owner != bodies.end()) {
                owner->loops.push_back(loop);
            }
        }
    }
    for (Body& body : bodies) {
        const RegionMoments moments = momentsOf(regionOf(body.loops));
        body.centroid = moments.centroid;
        body.area = moments.area;
    }
    return bodies;
}

/// Adds a body's loops, moved and scaled to an area.
void addScaled(std::vector<Loop>& loops, const Body& body, Vec2 centroid, double area)
{
    const double scale = std::sqrt(area / body.area);
    for (Loop loop : body.loops) {
        for (Vec2& p : loop.points) {
            p = centroid + scale * (p - body.centroid);
        }
        loops.push_back(std::move(loop));
    }
}

/// Liquid between two shapes.
class LiquidBetween {
public:
    LiquidBetween(const LiquidShape& from, const LiquidShape& to, const BlendOptions& options)
        : spacing_(options.spacing), field_(fieldOver(from, to, options))
    {
        field_.add(regionOf(from.liquid), [&](double d) { return kIso + (1.0 - options.weight) * damped(d); });
        field_.add(regionOf(to.liquid), [&](double d) { return options.weight * damped(d); });
    }

    [[nodiscard]] std::vector<Loop> loops(double area, double min_area) const
    {
        return field_.loopsOfArea(area, min_area);
    }

    /// Depth of a place below the rim, about; negative outside.
    [[nodiscard]] double depth(Vec2 place) const
    {
        const double value = field_.at(place) - kIso;
        return std::copysign(spacing_ * std::expm1(std::abs(value)), value);
    }

private:
    static GridField fieldOver(const LiquidShape& from, const LiquidShape& to, const BlendOptions& options)
    {
        constexpr double kMargin = 8.0;  // spacings: liquid may grow by a few
        Bounds box;
        for (const LiquidShape* shape : {&from, &to}) {
            for (const std::vector<Loop>* loops : {&shape->liquid, &shape->droplets}) {
                std::for_each(loops->begin(), loops->end(), [&](const Loop& loop) { box.include(loop.points); });
            }
        }
        const Vec2 margin{kMargin * options.spacing, kMargin * options.spacing};
        return {box.lower - margin, box.upper + margin, options.resolution * options.spacing};
    }

    [[nodiscard]] double damped(double distance) const
    {
        return std::copysign(std::log1p(std::abs(distance) / spacing_), distance);
    }

    double spacing_;
    GridField field_;
};

/// Droplets between two shapes. A droplet that is in both goes from one to the other.
std::vector<Loop> dropletsBetween(const LiquidShape& from, const LiquidShape& to, const LiquidBetween& liquid,
                                  double weight)
{
    const std::vector<Body> first = bodiesOf(from.droplets);
    const std::vector<Body> second = bodiesOf(to.droplets);
    std::vector<Loop> loops;
    // Liquid that covers a droplet takes it up.
    const auto add_alone = [&](const Body& body, double share) {
        const double covered = smoothRamp(liquid.depth(body.centroid), 0.0, body.radius());
        if (const double area = share * (1.0 - covered) * body.area; area > 0.0) {
            addScaled(loops, body, body.centroid, area);
        }
    };
    std::vector<bool> is_taken(second.size());
    for (const Body& a : first) {
        std::size_t k = 0;
        while (k < second.size() && (is_taken[k] || length(second[k].centroid - a.centroid) >
                                                        0.5 * std::min(a.radius(), second[k].radius()))) {
            ++k;
        }
        if (k == second.size()) {
            add_alone(a, 1.0 - weight);
            continue;
        }
        is_taken[k] = true;
        const Body& b = second[k];
        addScaled(loops, weight < 0.5 ? a : b, (1.0 - weight) * a.centroid + weight * b.centroid,
                  std::lerp(a.area, b.area, weight));
    }
    for (std::size_t k = 0; k < second.size(); ++k) {
        if (!is_taken[k]) {
            add_alone(second[k], weight);
        }
    }
    return loops;
}

}  // namespace

void BlendOptions::validate() const
{
    require(weight >= 0.0 && weight <= 1.0, "weight", weight, "from 0 to 1");
    require(spacing > 0.0 && std::isfinite(spacing), "spacing", spacing, "a finite number above 0");
    require(resolution >= 0.2 && resolution <= 1.0, "resolution", resolution, "from 0.2 to 1 spacings");
    require(min_area >= 0.0 && std::isfinite(min_area), "min_area", min_area, "finite and at least 0");
}

LiquidShape blended(const LiquidShape& from, const LiquidShape& to, const BlendOptions& options)
{
    options.validate();
    const auto is_empty = [](const LiquidShape& shape) { return shape.liquid.empty() && shape.droplets.empty(); };
    if (options.weight == 0.0 || options.weight == 1.0 || (is_empty(from) && is_empty(to))) {
        LiquidShape shape = options.weight == 1.0 ? to : from;
        shape.time = from.time;
        shape.holes.clear();
        return shape;
    }
    LiquidShape shape;
    shape.time = from.time;
    const LiquidBetween liquid(from, to, options);
    const double area = std::lerp(areaOf(from.liquid), areaOf(to.liquid), options.weight);
    if (area > 0.0) {
        shape.liquid = liquid.loops(area, options.min_area * options.spacing * options.spacing);
    }
    for (const Loop& loop : shape.liquid) {
        if (signedArea(loop) < 0.0 && (isAtOneOf(from.foam, loop) || isAtOneOf(to.foam, loop))) {
            shape.foam.push_back(loop);
        }
    }
    shape.droplets = dropletsBetween(from, to, liquid, options.weight);
    return shape;
}

}  // namespace droplet
