// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sub-pixel place: the height function of volume-of-fluid methods (S. J. Cummins, M. M. Francois and D. B. Kothe,
// "Estimating curvature from volume fractions", 2005). The coverage summed across the rim gives its mean place. This is
// exact for straight edges, while interpolation of single pixels is up to 0.09 px off.

#include "outline/faired_rim.h"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "outline/fairing.h"

namespace droplet {
namespace {

/// Coverage this close to 0 or 1 counts as dry or liquid. It allows for JPEG ringing at good quality and for many times
/// the rounding to 8 bits.
constexpr double kSaturated = 0.04;

/// Share of rim crossings beside an intermediate pixel from which a mask counts as anti-aliased. In hard masks no
/// crossing is, in anti-aliased ones most are, except on sides along pixel borders.
constexpr double kAntiAliasedShare = 0.15;

/// Number of pixels examined on either side of the rim until full liquid and full dry: an edge at 45° needs 2, a blur
/// of 1.5 px another 2.
constexpr int kReach = 4;

/// Standard deviations of a measured place [px]; all larger than those measured on discs of 3 to 100 px, rendered
/// exactly in 8 bits. In order: the height function with its neighbours, and without; interpolation between two pixels,
/// at worst 0.09 off; a pixel beside a corner, where neither holds; the image's border.
constexpr double kHeightSpread = 0.02;
constexpr double kRoughHeightSpread = 0.05;
constexpr double kInterpolatedSpread = 0.1;
constexpr double kCornerSpread = 0.4;
constexpr double kBorderSpread = 0.002;

/// The pixels of crossings this near to a corner cover both its sides [px].
constexpr double kCornerNeighbourhood = 1.5;

/// Fairness of the curve on which corners are searched. It smooths single pixels (waves under 6 px) and keeps turns.
constexpr double kDetectionFairness = 10.0;

/// Chords for the search of turns [px]. Long chords place turns better. Short ones find the two corners of strokes of 4
/// px, which long chords merge into one.
constexpr std::array<Chord, 2> kChords{{{2.0, 0.75}, {1.25, 0.5}}};

/// Gain in log-likelihood that a corner must bring to the curve around it. In anti-aliased masks, arcs of 3 px and more
/// gain up to 500, and right angles at least 2000. In hard masks, a right angle between sides of 8 px gains 8.
constexpr double kCornerGain = 1000.0;
constexpr double kCornerGainHard = 4.0;

/// Sum of |coverage − end| over the pixels after a pixel, in steps of `out`, until the coverage reaches `end` (0 or 1);
/// none if it does not get there monotonically.
std::optional<double> tail(const CoverageField& field, int x, int y, Step out, double end)
{
    // Nearly full pixels count, too, down to half a step of 8 bits.
    constexpr double kExact = 0.002;
    double sum = 0.0;
    double last = std::abs(field.coverage(x, y) - end);
    for (int k = 1; last > kExact; ++k) {
        const double c = std::abs(field.coverage(x + k * out.x, y + k * out.y) - end);
        if (k > kReach || c > last + kExact) {
            return last <= kSaturated ? std::optional(sum) : std::nullopt;
        }
        sum += c;
        last = c;
    }
    return sum;
}

/// Place of the rim along a line of pixels through (x, y), from the centre of that pixel in the direction of `out`, by
/// the height function; none if the line does not run from full liquid to full dry.
std::optional<double> heightAlong(const CoverageField& field, int x, int y, Step out)
{
    const std::optional<double> missing = tail(field, x, y, {-out.x, -out.y}, 1.0);
    const std::optional<double> ahead = tail(field, x, y, out, 0.0);
    if (!missing || !ahead) {
        return std::nullopt;
    }
    return -0.5 + field.coverage(x, y) - *missing + *ahead;
}

/// Step across the slot toward the drier side, if the rim runs more along the slot than across it.
std::optional<Step> sidestep(const CoverageField& field, const Crossing& at)
{
    const Step d = at.toward();
    const Step f{-d.y, d.x};
    const auto pair = [&](int k) {
        return field.coverage(at.x + k * f.x, at.y + k * f.y) +
               field.coverage(at.x + d.x + k * f.x, at.y + d.y + k * f.y);
    };
    double along = 0.0;
    for (int k = -1; k <= 1; ++k) {
        along +=
            field.coverage(at.x + k * f.x, at.y + k * f.y) - field.coverage(at.x + d.x + k * f.x, at.y + d.y + k * f.y);
    }
    const double across = 0.5 * (pair(-1) - pair(1));
    // A sum over three rows and two half-differences over two columns: both are three times the mean gradient.
    if (std::abs(across) * 1.5 <= std::abs(along)) {
        return std::nullopt;
    }
    return across > 0 ? f : Step{-f.x, -f.y};
}

/// Place measured from grey levels.
struct Reading {
    double place = 0.0;
    bool curved = false;  ///< whether the rim's curvature over neighbouring lines of pixels was known and corrected for
};

/// Place where a rim that runs across a slot crosses it. It is the mean place of a line of pixels, minus a
/// twenty-fourth of the second difference between lines (the mean of a parabola over a pixel).
std::optional<Reading> readAcross(const CoverageField& field, const Crossing& at)
{
    const Step d = at.toward();
    const std::optional<double> here = heightAlong(field, at.x, at.y, d);
    if (!here) {
        return std::nullopt;
    }
    const std::optional<double> before = heightAlong(field, at.x + d.y, at.y - d.x, d);
    const std::optional<double> after = heightAlong(field, at.x - d.y, at.y + d.x, d);
    if (!before || !after) {
        return Reading{*here, false};
    }
    return Reading{*here - (*before - 2.0 * *here + *after) / 24.0, true};
}

/// Place where a rim that runs along a slot crosses it: where the parabola through the heights of the lines beside it
/// reaches the level of the slot.
/// @param side  step toward dry
std::optional<Reading> readAlong(const CoverageField& field, const Crossing& at, Step side)
{
    const Step d = at.toward();
    const std::optional<double> here = heightAlong(field, at.x, at.y, side);
    const std::optional<double> there = heightAlong(field, at.x + d.x, at.y + d.y, side);
    if (!here || !there || *here <= *there + 1e-6) {
        return std::nullopt;
    }
    const std::optional<double> before = heightAlong(field, at.x - d.x, at.y - d.y, side);
    const std::optional<double> beyond = heightAlong(field, at.x + 2 * d.x, at.y + 2 * d.y, side);
    if (!before || !beyond) {
        return Reading{*here / (*here - *there), false};
    }
    const double bend = 0.5 * (*before - *here - *there + *beyond);
    const double fall = *here - *there;
    double t = *here / fall;
    // h(t) = h₀ − t·fall − ½ bend t(1 − t); each height minus bend/24, because it is a mean
    for (int k = 0; k < 4; ++k) {
        const double value = *here - bend / 24.0 - t * fall - 0.5 * bend * t * (1.0 - t);
        t += value / (fall + 0.5 * bend * (1.0 - 2.0 * t));
    }
    return Reading{t, true};
}

/// Measures the place of a crossing from the grey levels around it.
void measure(const CoverageField& field, const Crossing& at, Slot& slot)
{
    const Step d = at.toward();
    const double liquid = field.coverage(at.x, at.y);
    const double dry = field.coverage(at.x + d.x, at.y + d.y);
    slot.measured = (liquid - field.threshold()) / std::max(liquid - dry, 1e-9);
    slot.spread = kInterpolatedSpread;
    // Areas give the level line of half coverage only; other thresholds use a level set of the greys.
    if (field.threshold() == 0.5) {
        const std::optional<Step> side = sidestep(field, at);
        const std::optional<Reading> reading = side ? readAlong(field, at, *side) : readAcross(field, at);
        if (reading && reading->place > -0.25 && reading->place < 1.25) {
            slot.measured = reading->place;
            slot.spread = reading->curved ? kHeightSpread : kRoughHeightSpread;
        }
    }
    slot.measured = std::clamp(*slot.measured, kSlotMargin, 1.0 - kSlotMargin);
    slot.t = std::clamp(*slot.measured, 2.0 * kSlotMargin, 1.0 - 2.0 * kSlotMargin);
}

bool isGrey(const CoverageField& field, int x, int y)
{
    const double c = field.coverage(x, y);
    return c > kSaturated && c < 1.0 - kSaturated;
}

}  // namespace

bool looksAntiAliased(const CoverageField& field, const std::vector<Border>& borders)
{
    std::size_t grey = 0;
    std::size_t all = 0;
    for (const Border& border : borders) {
        all += border.size();
        for (const Crossing& at : border) {
            const Step d = at.toward();
            grey += isGrey(field, at.x, at.y) || isGrey(field, at.x + d.x, at.y + d.y) ? 1 : 0;
        }
    }
    return static_cast<double>(grey) > kAntiAliasedShare * static_cast<double>(all);
}

SlotLoop placeSlots(const CoverageField& field, const Border& border, bool anti_aliased)
{
    SlotLoop loop;
    loop.reserve(border.size());
    for (const Crossing& at : border) {
        const Step d = at.toward();
        Slot slot{{at.x + 0.5, at.y + 0.5}, {static_cast<double>(d.x), static_cast<double>(d.y)}, 0.5, {}, 0.0};
        if (anti_aliased) {
            measure(field, at, slot);
        } else if (!field.inside(at.x + d.x, at.y + d.y)) {
            // Liquid that reaches the image's border ends there, not somewhere beyond.
            slot.measured = 0.5;
            slot.spread = kBorderSpread;
        }
        loop.push_back(slot);
    }
    return loop;
}

namespace {

/// Loosens the places of crossings near a break, because their pixels cover both sides of the corner.
void loosenAt(SlotLoop& loop, const std::vector<std::uint8_t>& breaks)
{
    const std::size_t n = loop.size();
    const auto loosen = [&](std::size_t i) {
        Slot& slot = loop[i];
        if (slot.measured && slot.spread > kBorderSpread) {
            slot.spread = kCornerSpread;
        }
    };
    for (std::size_t gap = 0; gap < n; ++gap) {
        if (breaks[gap] == 0) {
            continue;
        }
        const Vec2 centre = 0.5 * (loop[gap].point() + loop[(gap + 1) % n].point());
        for (std::size_t i = gap, count = 0; count < n && length(loop[i].point() - centre) < kCornerNeighbourhood;
             i = (i + n - 1) % n, ++count) {
            loosen(i);
        }
        for (std::size_t i = (gap + 1) % n, count = 0;
             count < n && length(loop[i].point() - centre) < kCornerNeighbourhood; i = (i + 1) % n, ++count) {
            loosen(i);
        }
    }
}

/// Cost of a curve within a few pixels of a turn.
double costAround(const SlotLoop& loop, const std::vector<double>& strains, const Turn& turn)
{
    constexpr double kWindow = 5.0;  // reach of the fairing around a break [px]
    const std::size_t n = loop.size();
    double cost = 0.0;
    double way = 0.0;
    for (std::size_t i = turn.first, count = 0; count < n && way < kWindow; i = (i + n - 1) % n, ++count) {
        cost += strains[i];
        way += length(loop[i].point() - loop[(i + n - 1) % n].point());
    }
    way = 0.0;
    for (std::size_t i = turn.last, count = 0; count < n && way < kWindow; i = (i + 1) % n, ++count) {
        cost += strains[i];
        way += length(loop[i].point() - loop[(i + 1) % n].point());
    }
    return cost;
}

}  // namespace

PixelLoop withCorners(const CorneredLoop& cornered)
{
    const SlotLoop& loop = cornered.slots;
    PixelLoop result;
    std::vector<std::uint8_t> is_dropped(loop.size(), 0);
    std::vector<std::uint8_t> is_corner(loop.size(), 0);
    std::vector<std::optional<Vec2>> tip_after(loop.size());
    for (const Corner& corner : cornered.corners) {
        const Turn& turn = corner.turn;
        if (corner.replaces_first || corner.replaces_last) {
            is_corner[corner.replaces_first ? turn.first : turn.last] = 1;
            continue;
        }
        tip_after[turn.first] = corner.tip;
        for (std::size_t k = (turn.first + 1) % loop.size(); k != turn.last; k = (k + 1) % loop.size()) {
            is_dropped[k] = 1;
        }
    }
    for (std::size_t i = 0; i < loop.size(); ++i) {
        if (is_dropped[i] == 0) {
            result.points.push_back(loop[i].point());
            result.corner.push_back(is_corner[i]);
        }
        if (tip_after[i]) {
            result.points.push_back(*tip_after[i]);
            result.corner.push_back(1);
        }
    }
    return result;
}

CorneredLoop fairWhole(SlotLoop slots)
{
    fair(slots);
    return {std::move(slots), {}};
}

namespace {

/// Input of fairing with corners, the same at every turn.
struct CornerSearch {
    const SlotLoop& measured;
    const Coverage& coverage;
    SlotLoop smooth;
    std::vector<double> smooth_strain;
    std::vector<Turn> ends = {};  ///< the turn from the last slot of an open loop to its first; otherwise empty
};

/// Turns without those near the ends of an open loop, where chords would reach beyond it; the end itself stays.
std::vector<Turn> awayFromEnds(const CornerSearch& search, std::vector<Turn> turns)
{
    constexpr double kNear = 3.5;  // [px]
    if (search.ends.empty()) {
        return turns;
    }
    const SlotLoop& loop = search.measured;
    const Vec2 first = loop.front().point();
    const Vec2 last = loop.back().point();
    std::erase_if(turns, [&](const Turn& turn) {
        const Vec2 from = loop[turn.first].point();
        const Vec2 to = loop[turn.last].point();
        return turn != search.ends.front() &&
               (turn.last < turn.first || length(from - first) < kNear || length(to - last) < kNear);
    });
    return turns;
}

/// Adds further turns to turns, where they do not overlap; in order along a loop of `slots` slots.
std::vector<Turn> withoutOverlap(std::vector<Turn> turns, const std::vector<Turn>& further, std::size_t slots)
{
    std::vector<std::uint8_t> taken = breaksAt(turns, slots);
    for (const Turn& turn : further) {
        bool free = true;
        for (std::size_t k = turn.first; k != turn.last; k = (k + 1) % slots) {
            free = free && taken[k] == 0;
        }
        for (std::size_t k = turn.first; free && k != turn.last; k = (k + 1) % slots) {
            taken[k] = 1;
        }
        if (free) {
            turns.push_back(turn);
        }
    }
    std::sort(turns.begin(), turns.end(), [](const Turn& a, const Turn& b) { return a.first < b.first; });
    return turns;
}

/// Fairs a loop with a break at every turn, repeatedly, each time without the turns that are not corners.
/// @param turns  with the ends, in order
/// @return       the loop with the remaining corners; smooth everywhere if none remain
CorneredLoop keepCorners(const CornerSearch& search, std::vector<Turn> turns)
{
    const double min_gain = search.coverage ? kCornerGain : kCornerGainHard;
    // Turns of the rough curve may be a slot or two off. So each round but the last tries failed turns at a new place.
    constexpr int kRelocations = 2;
    int relocations = 0;
    while (turns.size() > search.ends.size()) {
        const std::vector<std::uint8_t> breaks = breaksAt(turns, search.measured.size());
        CorneredLoop result{search.measured, {}};
        loosenAt(result.slots, breaks);
        fair(result.slots, {.breaks = breaks});
        const std::vector<double> broken_strain = strain(result.slots, {.breaks = breaks});
        std::vector<Turn> kept;
        std::vector<Turn> failed;
        for (const Turn& turn : turns) {
            if (!search.ends.empty() && turn == search.ends.front()) {
                kept.push_back(turn);
                continue;
            }
            const double gain =
                costAround(search.smooth, search.smooth_strain, turn) - costAround(result.slots, broken_strain, turn);
            const std::optional<Corner> corner =
                gain > min_gain ? findCorner(result.slots, breaks, turn, search.coverage) : std::nullopt;
            if (corner) {
                result.corners.push_back(*corner);
                kept.push_back(turn);
            } else {
                failed.push_back(turn);
            }
        }
        if (failed.empty()) {
            return result;
        }
        if (relocations < kRelocations) {
            ++relocations;
            const std::vector<Turn> moved = awayFromEnds(search, relocated(result.slots, failed));
            std::vector<Turn> elsewhere = withoutOverlap(kept, moved, search.measured.size());
            if (elsewhere != turns) {
                turns = std::move(elsewhere);
                continue;
            }
            // No turn has moved, so none would in another round.
            relocations = kRelocations;
        }
        turns = std::move(kept);
    }
    return {search.smooth, {}};
}

}  // namespace

CorneredLoop fairWithCorners(const SlotLoop& measured, const Coverage& coverage, bool is_open)
{
    constexpr std::size_t kShort = 8;  // slots; shorter ones are not faired
    CornerSearch search{measured, coverage, measured, {}};
    std::vector<std::uint8_t> breaks;
    if (is_open) {
        if (measured.size() < kShort) {
            return {measured, {}};
        }
        search.ends.push_back({measured.size() - 1, 0});
        breaks = breaksAt(search.ends, measured.size());
    }
    SlotLoop rough = measured;
    tbb::parallel_invoke(
        [&] {
            fair(search.smooth, {.breaks = breaks});
            search.smooth_strain = strain(search.smooth, {.breaks = breaks});
        },
        [&] { fair(rough, {.breaks = breaks, .fairness = kDetectionFairness}); });
    std::optional<CorneredLoop> best;
    std::vector<Turn> known = search.ends;
    std::vector<Turn> tried;
    for (const Chord& chord : kChords) {
        std::vector<Turn> turns = awayFromEnds(search, sharpTurns(rough, chord, known));
        if (turns.size() == known.size() || turns == tried) {
            continue;
        }
        best = keepCorners(search, turns);
        known = search.ends;
        for (const Corner& corner : best->corners) {
            known.push_back(corner.turn);
        }
        tried = std::move(turns);
    }
    return best ? *std::move(best) : CorneredLoop{std::move(search.smooth), {}};
}

}  // namespace droplet
