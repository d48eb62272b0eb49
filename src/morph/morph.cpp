// SPDX-License-Identifier: GPL-3.0-or-later
// L. Shi, Y. Yu, "Taming liquids for rapidly changing targets", SCA 2005: feedback of velocity and shape drives a
// liquid. Departures: the shape's feedback goes to a place for each particle, by optimal transport, for it has no gaps
// and needs no gathering; the liquid is of particles. N. Thürey, R. Keiser, M. Pauly, U. Rüde, "Detail-preserving fluid
// control", SCA 2006: forces act on the smoothed part of the velocity alone, at the beginning of a way.
#include "droplet/morph/morph.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "droplet/error.h"
#include "droplet/liquid2d/fluid.h"
#include "droplet/morph/morph_targets.h"
#include "droplet/outline/outline.h"
#include "expression/grid_field.h"
#include "expression/surface_kernel.h"
#include "liquid2d/bounds.h"
#include "liquid2d/region.h"
#include "require.h"

namespace droplet {
namespace {

// Lengths are in roots of the liquid's area and times in durations of a transition. The constants were set by the
// pictures of words that become rings and stars.

/// Surface tension over density at MorphOptions::surface_tension = 1: letters become drops before they meet.
constexpr double kTension = 2e-2;
/// Time in which a particle takes up the velocity that is asked of it, on the way and at the end.
constexpr double kLoose = 0.05;
constexpr double kFirm = 0.01;
/// Part of the time, at the end, in which particles are steered one by one more and more.
constexpr double kAlone = 0.25;
/// Radius in which the asked velocities are smoothed, in spacings.
constexpr double kTogether = 4.0;
/// Greatest rate at which the rest of a way is covered.
constexpr double kMaxRate = 60.0;
/// Times at which places are given out anew, for the liquid has mixed.
constexpr int kNewPlaces = 10;
constexpr double kLastNewPlaces = 0.75;
/// Parts of the time at both ends in which the footprint itself turns into the liquid's surface.
constexpr double kBlend = 0.2;
/// Loops that enclose less than so many particles are dropped.
constexpr double kSpeck = 4.0;
/// Radius of the surface's kernel at the ends, in spacings.
constexpr double kFine = 2.2;
/// Radius of it halfway, where the liquid is stretched; at least so many spacings.
constexpr double kCoarse = 0.05;
constexpr double kLeastCoarse = 3.6;

/// Slits up to this width fuse, on the way.
constexpr double kSlit = 0.1;
/// Parts of the time at both ends in which that width grows, and falls.
constexpr double kFusing = 0.4;
constexpr double kParting = 0.15;

/// Part of the way after a part of the time, with the least jerk, and its derivative.
double wayAt(double t)
{
    return t * t * t * (10.0 + t * (-15.0 + 6.0 * t));
}
double speedAt(double t)
{
    return 30.0 * t * t * (1.0 - t) * (1.0 - t);
}

/// Velocities averaged over a radius, on a grid.
class VelocityAverage {
public:
    VelocityAverage(const std::vector<Vec2>& position, double radius) : cell_(0.5 * radius)
    {
        const auto [lower, upper] = boundsOf(position);
        constexpr double kMargin = 4.0;
        lower_ = lower - Vec2{kMargin * cell_, kMargin * cell_};
        columns_ = static_cast<std::size_t>((upper.x - lower_.x) / cell_ + 2.0 * kMargin);
        rows_ = static_cast<std::size_t>((upper.y - lower_.y) / cell_ + 2.0 * kMargin);
    }

    [[nodiscard]] std::vector<Vec2> of(const std::vector<Vec2>& position, const std::vector<Vec2>& velocity) const
    {
        std::vector<Node> nodes(columns_ * rows_);
        for (std::size_t i = 0; i < position.size(); ++i) {
            around(position[i], [&](std::size_t k, double weight) {
                nodes[k].mass += weight;
                nodes[k].momentum = nodes[k].momentum + weight * velocity[i];
            });
        }
        // Two passes along each axis make almost a Gaussian.
        for (const std::size_t step : {std::size_t{1}, columns_, std::size_t{1}, columns_}) {
            const std::vector<Node> before = nodes;
            for (std::size_t k = step; k + step < nodes.size(); ++k) {
                nodes[k].mass = 0.25 * (before[k - step].mass + before[k + step].mass) + 0.5 * before[k].mass;
                nodes[k].momentum =
                    0.25 * (before[k - step].momentum + before[k + step].momentum) + 0.5 * before[k].momentum;
            }
        }
        std::vector<Vec2> average(position.size());
        for (std::size_t i = 0; i < position.size(); ++i) {
            Node sum;
            around(position[i], [&](std::size_t k, double weight) {
                sum.mass += weight * nodes[k].mass;
                sum.momentum = sum.momentum + weight * nodes[k].momentum;
            });
            average[i] = (1.0 / sum.mass) * sum.momentum;
        }
        return average;
    }

private:
    struct Node {
        double mass = 0.0;
        Vec2 momentum{};
    };

    template <typename Visit>
    void around(Vec2 place, const Visit& visit) const
    {
        const double x = (place.x - lower_.x) / cell_;
        const double y = (place.y - lower_.y) / cell_;
        const auto i = static_cast<std::size_t>(x);
        const auto j = static_cast<std::size_t>(y);
        const double u = x - static_cast<double>(i);
        const double v = y - static_cast<double>(j);
        const std::size_t k = j * columns_ + i;
        visit(k, (1.0 - u) * (1.0 - v));
        visit(k + 1, u * (1.0 - v));
        visit(k + columns_, (1.0 - u) * v);
        visit(k + columns_ + 1, u * v);
    }

    double cell_;
    Vec2 lower_;
    std::size_t columns_ = 0;
    std::size_t rows_ = 0;
};

/// Liquid on its way from one footprint to the next, both of area 1.
class Transition {
public:
    Transition(const Region& from, const Region& to, const MorphOptions& options)
        : from_(from), to_(to), target_(sampleRegion(to, options.particles))
    {
        const std::size_t count = options.particles;
        scene_.spacing = std::sqrt(1.0 / static_cast<double>(count));
        scene_.gravity = {};
        scene_.density = 1.0;
        scene_.surface_tension = kTension * options.surface_tension;
        // Nothing leaves the plane.
        for (const Region* region : {&from, &to}) {
            for (const std::vector<Vec2>& loop : region->loops) {
                for (const Vec2 p : loop) {
                    scene_.margin = std::max(scene_.margin, 2.0 * length(p));
                }
            }
        }
        scene_.max_particles = count;
        state_.position = sampleRegion(from, count);
        state_.velocity.resize(count);
        state_.density.assign(count, 1.0);
        state_.pressure.resize(count);
        for (std::size_t i = 0; i < count; ++i) {
            state_.id.push_back(state_.next_id++);
        }
        goal_.resize(count);
        givePlaces();
    }

    /// Advances to a part of the time.
    void advance(double until)
    {
        FluidOptions options;
        options.control = [&](const FluidState& state, std::span<Vec2> acceleration) { steer(state, acceleration); };
        while (state_.time < until) {
            const double next = static_cast<double>(places_given_) / kNewPlaces;
            state_ = advanceFluid(std::move(state_), scene_, std::min(until, next), options);
            if (state_.time >= next) {
                if (next <= kLastNewPlaces) {
                    givePlaces();
                } else {
                    ++places_given_;
                }
            }
        }
    }

    /// Loops around the liquid, of area 1.
    [[nodiscard]] std::vector<Loop> loops() const
    {
        const double d = scene_.spacing;
        const double t = state_.time;
        const double coarse = smoothRamp(2.0 * std::min(t, 1.0 - t), 0.0, 1.0);
        const double greatest = std::max(kCoarse, kLeastCoarse * d);
        const double radius = kFine * d + (greatest - kFine * d) * coarse;
        const double of_from = 1.0 - smoothRamp(t / kBlend, 0.0, 1.0);
        const double of_to = 1.0 - smoothRamp((1.0 - t) / kBlend, 0.0, 1.0);
        Bounds box = boundsOf(state_.position);
        for (const Region* region : {of_from > 0.0 ? &from_ : nullptr, of_to > 0.0 ? &to_ : nullptr}) {
            if (region != nullptr) {
                std::for_each(region->loops.begin(), region->loops.end(),
                              [&](const std::vector<Vec2>& loop) { box.include(loop); });
            }
        }
        const Vec2 margin{2.0 * greatest, 2.0 * greatest};
        GridField field(box.lower - margin, box.upper + margin, 0.5 * d);
        field.add({state_.position, d * d, radius}, 1.0 - of_from - of_to);
        const auto add_ramp = [&](const Region& region, double weight) {
            field.add(region, [&](double distance) { return weight * std::clamp(0.5 + 0.5 * distance / d, 0.0, 1.0); });
        };
        if (of_from > 0.0) {
            add_ramp(from_, of_from);
        }
        if (of_to > 0.0) {
            add_ramp(to_, of_to);
        }
        field.fill(kSlit * smoothRamp(t / kFusing, 0.0, 1.0) * smoothRamp((1.0 - t) / kParting, 0.0, 1.0));
        return field.loopsOfArea(1.0, kSpeck * d * d);
    }

private:
    void givePlaces()
    {
        ++places_given_;
        const std::vector<std::uint32_t> target = assignTargets(state_.position, target_);
        for (std::size_t i = 0; i < target.size(); ++i) {
            goal_[state_.id[i]] = target_[target[i]];
        }
    }

    void steer(const FluidState& state, std::span<Vec2> acceleration) const
    {
        const double t = std::min(state.time, 1.0);
        // Particles that cover the rest of their way at this rate are where wayAt() says.
        const double rate = t < 1.0 ? std::min(speedAt(t) / (1.0 - wayAt(t)), kMaxRate) : kMaxRate;
        std::vector<Vec2> asked(state.position.size());
        for (std::size_t i = 0; i < asked.size(); ++i) {
            asked[i] = rate * (goal_[state.id[i]] - state.position[i]);
        }
        const double together = smoothRamp((1.0 - t) / kAlone, 0.0, 1.0);
        const VelocityAverage average(state.position, kTogether * scene_.spacing);
        const std::vector<Vec2> common = average.of(state.position, asked);
        const double firmness = 1.0 / std::max(together * kLoose + (1.0 - together) * kFirm, 2.0 * state.step);
        for (std::size_t i = 0; i < asked.size(); ++i) {
            const Vec2 wanted = together * common[i] + (1.0 - together) * asked[i];
            acceleration[i] = acceleration[i] + firmness * (wanted - state.velocity[i]);
        }
    }

    const Region& from_;
    const Region& to_;
    std::vector<Vec2> target_;
    FluidScene scene_;
    FluidState state_;
    std::vector<Vec2> goal_;  ///< by id
    int places_given_ = 0;
};

/// Region scaled about a point that becomes the origin.
Region scaled(const Region& region, Vec2 middle, double factor)
{
    Region result = region;
    for (std::vector<Vec2>& loop : result.loops) {
        for (Vec2& p : loop) {
            p = factor * (p - middle);
        }
    }
    return result;
}

std::vector<Loop> loopsOf(const Region& region)
{
    std::vector<Loop> loops;
    for (const std::vector<Vec2>& points : region.loops) {
        Loop& loop = loops.emplace_back(Loop{points, std::vector<std::uint8_t>(points.size(), 0)});
        if (!isInsideOnLeft(region, points)) {
            std::reverse(loop.points.begin(), loop.points.end());
        }
    }
    return loops;
}

}  // namespace

void MorphOptions::validate() const
{
    require(size.x > 0.0 && std::isfinite(size.x), "size.x", size.x, "a finite number above 0");
    require(size.y > 0.0 && std::isfinite(size.y), "size.y", size.y, "a finite number above 0");
    require(frames >= 3, "frames", frames, "at least 3");
    require(particles >= 1000 && particles <= 200000, "particles", particles, "from 1000 to 200000");
    require(surface_tension >= 0.0 && surface_tension <= 10.0, "surface_tension", surface_tension, "from 0 to 10");
}

void morph(const std::vector<Region>& footprints, const MorphOptions& options, const MorphSink& take)
{
    options.validate();
    require(footprints.size() >= 2, "footprints", footprints.size(), "at least 2");
    const std::size_t legs = footprints.size() - 1;
    require(options.frames > 2 * legs, "frames", options.frames, "at least two for every transition, and one more");
    std::vector<double> area;
    for (const Region& footprint : footprints) {
        area.push_back(momentsOf(footprint).area);
        require(area.back() > 0.0, "area of a footprint", area.back(), "above 0");
    }
    const Vec2 middle = 0.5 * options.size;
    const std::size_t last = options.frames - 1;
    for (std::size_t leg = 0; leg < legs; ++leg) {
        const std::size_t begin = leg * last / legs;
        const std::size_t end = (leg + 1) * last / legs;
        const Region from = scaled(footprints[leg], middle, 1.0 / std::sqrt(area[leg]));
        const Region to = scaled(footprints[leg + 1], middle, 1.0 / std::sqrt(area[leg + 1]));
        Transition transition(from, to, options);
        for (std::size_t frame = begin; frame < end; ++frame) {
            LiquidShape shape;
            shape.time = static_cast<double>(frame) / static_cast<double>(last);
            if (frame == begin) {
                shape.liquid = loopsOf(footprints[leg]);
            } else {
                const double t = static_cast<double>(frame - begin) / static_cast<double>(end - begin);
                transition.advance(t);
                shape.liquid = transition.loops();
                // Then liquid that is in both footprints stays where it is: its ways are those of the scaled ones.
                const double way = wayAt(t);
                const double side = 1.0 / ((1.0 - way) / std::sqrt(area[leg]) + way / std::sqrt(area[leg + 1]));
                for (Loop& loop : shape.liquid) {
                    for (Vec2& p : loop.points) {
                        p = middle + side * p;
                    }
                }
            }
            take(frame, shape);
        }
    }
    LiquidShape shape;
    shape.time = 1.0;
    shape.liquid = loopsOf(footprints.back());
    take(last, shape);
}

}  // namespace droplet
