// SPDX-License-Identifier: GPL-3.0-or-later
// Holes that open and close within a frame or two flicker. The next frames are not known, so: a small hole is drawn
// once it has lasted; a hole that was drawn is held open, by a dent in the field that goes with the liquid around it,
// until it has been seen. Large holes, such as the air below a crest that falls, are drawn at once.
#include "holes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "liquid2d/bounds.h"
#include "liquid2d/cell_grid.h"

namespace droplet {
namespace {

/// Time after which a small hole is drawn: two frames of 24 a second, with a margin for rounding [s].
constexpr double kWait = 1.9 / 24.0;

/// Time that a hole is drawn for, at least: at the frame 2/24 s later it is still there [s].
constexpr double kShown = 2.1 / 24.0;

/// Area from which on a hole is drawn at once, in areas of a particle.
constexpr double kLarge = 3.0;

Vec2 placeAfter(const LiquidHole& hole, double time)
{
    return hole.centre + time * hole.velocity;
}

double lastStep(const ExpressionState& state)
{
    return state.past.size() > 1 ? state.past[0].time - state.past[1].time : 0.0;
}

LiquidHole measured(const Loop& rim)
{
    LiquidHole hole;
    const Vec2 origin = rim.points.front();
    Vec2 moment;
    for (std::size_t k = 0; k < rim.points.size(); ++k) {
        const Vec2 a = rim.points[k] - origin;
        const Vec2 b = rim.points[(k + 1) % rim.points.size()] - origin;
        const double twice = cross(a, b);
        hole.area += 0.5 * twice;
        moment = moment + (twice / 6.0) * (a + b);
    }
    hole.centre = origin + (hole.area != 0.0 ? 1.0 / hole.area : 0.0) * moment;
    hole.area = std::abs(hole.area);
    for (const Vec2 x : rim.points) {
        hole.reach = std::max(hole.reach, length(x - hole.centre));
    }
    return hole;
}

/// Gives holes the mean velocity of the particles along their rims.
void addVelocities(std::vector<LiquidHole>& holes, const std::vector<Loop>& rims, const ParticleFrame& frame)
{
    Bounds box;
    for (const Loop& rim : rims) {
        box.include(rim.points);
    }
    const double cell = 2.0 * frame.spacing;
    CellGrid cells(box.lower - Vec2{cell, cell}, box.upper + Vec2{cell, cell}, cell);
    const std::vector<std::uint32_t> order = cells.sort(frame.position);
    for (std::size_t k = 0; k < holes.size(); ++k) {
        Vec2 sum;
        double count = 0.0;
        for (const Vec2 x : rims[k].points) {
            const int column = cells.column(x.x);
            const auto [first, last] = cells.range(cells.row(x.y), column, column);
            for (std::uint32_t m = first; m < last; ++m) {
                sum = sum + frame.velocity[order[m]];
                count += 1.0;
            }
        }
        holes[k].velocity = (count > 0.0 ? 1.0 / count : 0.0) * sum;
    }
}

}  // namespace

std::vector<OpenHole> openHoles(const ExpressionState& state)
{
    std::vector<OpenHole> open;
    for (const LiquidHole& hole : state.holes) {
        if (hole.shown && state.past.front().time - *hole.shown < kShown) {
            open.push_back({placeAfter(hole, lastStep(state)), std::sqrt(hole.area / std::numbers::pi)});
        }
    }
    return open;
}

std::vector<LiquidHole> followedHoles(const std::vector<Loop>& rims, const ExpressionState& state,
                                      const ParticleFrame& frame)
{
    if (rims.empty()) {
        return {};
    }
    std::vector<LiquidHole> holes;
    holes.reserve(rims.size());
    for (const Loop& rim : rims) {
        holes.push_back(measured(rim));
    }
    addVelocities(holes, rims, frame);
    const double step = lastStep(state);
    struct Pair {
        double distance = 0.0;
        std::size_t before = 0;
        std::size_t now = 0;
    };
    std::vector<Pair> pairs;
    for (std::size_t now = 0; now < holes.size(); ++now) {
        for (std::size_t before = 0; before < state.holes.size(); ++before) {
            const LiquidHole& old = state.holes[before];
            const double distance = length(holes[now].centre - placeAfter(old, step));
            if (distance < holes[now].reach + old.reach + frame.spacing) {
                pairs.push_back({distance, before, now});
            }
        }
    }
    std::stable_sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) { return a.distance < b.distance; });
    // Nearest pairs first; further parts of a hole that was drawn are drawn too, and begin to last.
    constexpr double kNever = std::numeric_limits<double>::max();
    std::vector<char> is_taken(state.holes.size(), 0);
    for (LiquidHole& hole : holes) {
        hole.seen = kNever;
    }
    for (const Pair& pair : pairs) {
        LiquidHole& hole = holes[pair.now];
        const LiquidHole& before = state.holes[pair.before];
        if (hole.seen == kNever && is_taken[pair.before] == 0) {
            is_taken[pair.before] = 1;
            hole.seen = before.seen;
            hole.shown = before.shown;
        } else if (before.shown && !hole.shown) {
            hole.shown = frame.time;
        }
    }
    for (LiquidHole& hole : holes) {
        hole.seen = std::min(hole.seen, frame.time);
        const bool is_large = hole.area >= kLarge * frame.spacing * frame.spacing;
        if (!hole.shown && (is_large || !state.remembers || frame.time - hole.seen > kWait)) {
            hole.shown = frame.time;
        }
    }
    return holes;
}

}  // namespace droplet
