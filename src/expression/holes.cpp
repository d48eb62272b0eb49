// SPDX-License-Identifier: GPL-3.0-or-later
// Holes that open and close within a frame or two flicker. The next frames are not known, so: a small hole is drawn
// once it has lasted; a hole that was drawn is held open, by a dent in the field that goes where the particles around
// it go, until it has been seen. Large holes, such as the air below a crest that falls, are drawn at once.
#include "holes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "liquid2d/bounds.h"
#include "liquid2d/cell_grid.h"
#include "liquid2d/region.h"

namespace droplet {
namespace {

/// Time after which a small hole is drawn: two frames of 24 a second, with a margin for rounding [s].
constexpr double kWait = 1.9 / 24.0;

/// Time for which a hole that closed is drawn as a bay, if a thin bridge closes it [s].
constexpr double kBay = 5.9 / 24.0;

/// Time that a hole is drawn for, at least: at the frame 2/24 s later it is still there [s].
constexpr double kShown = 2.1 / 24.0;

/// Particles nearer than so many spacings to a hole lie around it.
constexpr double kAround = 1.5;

/// Radius of a hole that is held open over the clearance around its centre, at most: less of longer ones.
constexpr double kLongest = 1.2;

/// Area from which on a hole is drawn at once, in areas of a particle.
constexpr double kLarge = 3.0;

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
    const bool is_around = contains(Region{{rim.points}}, hole.centre);
    hole.clearance = is_around ? std::numeric_limits<double>::max() : 0.0;
    for (const Vec2 x : rim.points) {
        hole.reach = std::max(hole.reach, length(x - hole.centre));
        hole.clearance = std::min(hole.clearance, length(x - hole.centre));
    }
    return hole;
}

/// Holes of the frame before, where the particles around them have gone to.
std::vector<LiquidHole> movedHoles(const ExpressionState& state, double spacing)
{
    std::vector<LiquidHole> holes = state.holes;
    if (holes.empty() || state.past.size() < 2) {
        return holes;
    }
    const std::vector<Vec2>& now = state.past[0].position;
    std::vector<Vec2> before;
    std::vector<Vec2> way;
    for (std::size_t id = 0; id < state.past[1].position.size(); ++id) {
        const Vec2 x = state.past[1].position[id];
        if (!std::isnan(x.x) && !std::isnan(now[id].x)) {
            before.push_back(x);
            way.push_back(now[id] - x);
        }
    }
    if (before.empty()) {
        return holes;
    }
    const auto [lower, upper] = boundsOf(before);
    CellGrid cells(lower, upper, kAround * spacing);
    const std::vector<std::uint32_t> order = cells.sort(before);
    // Mean way of the particles around a place.
    const auto way_at = [&](Vec2 place, double reach) {
        const Vec2 corner{reach, reach};
        const Vec2 low = place - corner;
        const Vec2 high = place + corner;
        Vec2 sum;
        double count = 0.0;
        for (int row = cells.row(low.y); row <= cells.row(high.y); ++row) {
            const auto [first, last] = cells.range(row, cells.column(low.x), cells.column(high.x));
            for (std::uint32_t m = first; m < last; ++m) {
                if (length(before[order[m]] - place) < reach) {
                    sum = sum + way[order[m]];
                    count += 1.0;
                }
            }
        }
        return (count > 0.0 ? 1.0 / count : 0.0) * sum;
    };
    for (LiquidHole& hole : holes) {
        hole.centre = hole.centre + way_at(hole.centre, hole.reach + kAround * spacing);
        if (hole.gap) {
            hole.gap = *hole.gap + way_at(*hole.gap, kAround * spacing);
        }
    }
    return holes;
}

}  // namespace

std::vector<OpenHole> openHoles(const ExpressionState& state, double spacing)
{
    std::vector<OpenHole> open;
    for (const LiquidHole& hole : movedHoles(state, spacing)) {
        if (hole.clearance > 0.0 && hole.shown && state.past.front().time - *hole.shown < kShown) {
            open.push_back({hole.centre, std::min(std::sqrt(hole.area / std::numbers::pi), kLongest * hole.clearance)});
        }
    }
    return open;
}

std::vector<LiquidHole> followedHoles(const std::vector<Loop>& rims, const ExpressionState& state,
                                      const ParticleFrame& frame, const OpenBay& open_bay)
{
    if (rims.empty()) {
        return {};
    }
    std::vector<LiquidHole> holes;
    holes.reserve(rims.size());
    for (const Loop& rim : rims) {
        holes.push_back(measured(rim));
    }
    const std::vector<LiquidHole> old = movedHoles(state, frame.spacing);
    struct Pair {
        double distance = 0.0;
        std::size_t before = 0;
        std::size_t now = 0;
    };
    std::vector<Pair> pairs;
    for (std::size_t now = 0; now < holes.size(); ++now) {
        for (std::size_t before = 0; before < old.size(); ++before) {
            const double distance = length(holes[now].centre - old[before].centre);
            if (distance < holes[now].reach + old[before].reach + frame.spacing) {
                pairs.push_back({distance, before, now});
            }
        }
    }
    std::stable_sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) { return a.distance < b.distance; });
    // Nearest pairs first; further parts of a hole that was drawn are drawn too, and begin to last.
    constexpr double kNever = std::numeric_limits<double>::max();
    std::vector<char> is_taken(old.size(), 0);
    for (LiquidHole& hole : holes) {
        hole.seen = kNever;
    }
    for (const Pair& pair : pairs) {
        LiquidHole& hole = holes[pair.now];
        const LiquidHole& before = old[pair.before];
        if (hole.seen == kNever && is_taken[pair.before] == 0) {
            is_taken[pair.before] = 1;
            hole.seen = before.seen;
            hole.shown = before.shown;
            hole.gap = before.gap;
        } else if (before.shown && !hole.shown) {
            hole.shown = frame.time;
        }
    }
    for (std::size_t k = 0; k < holes.size(); ++k) {
        LiquidHole& hole = holes[k];
        hole.seen = std::min(hole.seen, frame.time);
        const bool is_large = hole.area >= kLarge * frame.spacing * frame.spacing;
        const double age = frame.time - hole.seen;
        const bool waits = !hole.shown && state.remembers && (is_large ? age < kBay && open_bay(k, hole) : age < kWait);
        if (!hole.shown && !waits) {
            hole.shown = frame.time;
        }
        if (hole.shown) {
            hole.gap.reset();
        }
    }
    return holes;
}

}  // namespace droplet
