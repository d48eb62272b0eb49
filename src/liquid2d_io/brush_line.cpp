// SPDX-License-Identifier: GPL-3.0-or-later
// The thickness at a place is the diameter of the circle that touches the outline there and reaches to the opposite
// side: |q − p|²/|n·(q − p)|, the least over the places q whose normals point the other way. Only circles that would
// narrow the line matter, so only places nearby are compared. Curves are then cut where the width changes, and each
// piece is moved to either side by half of the width at its ends.
#include "brush_line.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "liquid2d/cell_grid.h"
#include "unit_vector.h"

namespace droplet {
namespace {

/// Width of a line over the gap between two bodies, at most: each of them takes half a line of it.
constexpr double kGapShare = 0.7;

/// Cosine between the normals of opposite sides: the sides of a corner of 90° are none.
constexpr double kOpposite = -0.3;

/// Change of the width along the line, at most: a brush is lifted and set down gradually.
constexpr double kLift = 0.25;

/// Cosine of the turn from which on a corner is a tip.
constexpr double kTip = -0.3;

/// Greatest length of a mitre over half of the width.
constexpr double kMitre = 1.5;

/// Widths between two places of a piece, over the full width: how much less and more they may be than asked for. One
/// does not see the former; the latter is for rounding.
constexpr double kLess = 0.12;
constexpr double kMore = 0.005;

/// Places on a curve, at least.
constexpr int kLeastPlaces = 4;

struct Cubic {
    Vec2 a, b, c, d;

    [[nodiscard]] Vec2 at(double t) const
    {
        const double s = 1.0 - t;
        return s * s * s * a + 3.0 * s * s * t * b + 3.0 * s * t * t * c + t * t * t * d;
    }
    /// Direction; handles may have no length.
    [[nodiscard]] Vec2 direction(double t) const
    {
        const double s = 1.0 - t;
        const Vec2 slope = s * s * (b - a) + 2.0 * s * t * (c - b) + t * t * (d - c);
        const Vec2 chord = d - a;
        return length(slope) > 1e-6 * length(chord) ? unit(slope) : unit(chord);
    }
    [[nodiscard]] double hull() const { return length(b - a) + length(c - b) + length(d - c); }
    /// Part between two parameters.
    [[nodiscard]] Cubic part(double from, double to) const
    {
        const auto slope = [&](double t) {
            const double s = 1.0 - t;
            return s * s * (b - a) + 2.0 * s * t * (c - b) + t * t * (d - c);
        };
        const Vec2 begin = at(from);
        const Vec2 end = at(to);
        return {begin, begin + (to - from) * slope(from), end - (to - from) * slope(to), end};
    }
};

/// Place on an outline.
struct Place {
    Vec2 at;
    Vec2 normal;         ///< of length 1; the mean one at a corner
    double mitre = 1.0;  ///< offset along it, over half of the width
    double width = 0.0;
    std::size_t curve = 0;
    double t = 0.0;
};

/// Places along an outline; the last curve ends at the first.
std::vector<Place> placesOf(const std::vector<Cubic>& curves, double width, double step)
{
    std::vector<Place> places;
    for (std::size_t k = 0; k < curves.size(); ++k) {
        const Cubic& curve = curves[k];
        const int parts = std::max(kLeastPlaces, static_cast<int>(std::ceil(curve.hull() / step)));
        for (int i = 0; i < parts; ++i) {
            const double t = static_cast<double>(i) / parts;
            Vec2 along = curve.direction(t);
            Place place{curve.at(t), {}, 1.0, width, k, t};
            if (i == 0) {
                const Vec2 before = curves[(k + curves.size() - 1) % curves.size()].direction(1.0);
                const double turn = dot(before, along);
                place.width = turn < kTip ? 0.0 : width;
                place.mitre = std::min(std::sqrt(2.0 / std::max(1.0 + turn, 1e-9)), kMitre);
                along = unit(before + along);
            }
            place.normal = {-along.y, along.x};
            places.push_back(place);
        }
    }
    return places;
}

/// Narrows lines where they would take more than their share of what they surround.
void narrow(std::vector<std::vector<Place>>& outlines, double width)
{
    const double reach = width / kLineShare;
    Vec2 lower{std::numeric_limits<double>::max(), std::numeric_limits<double>::max()};
    Vec2 upper = -1.0 * lower;
    std::vector<Vec2> at;
    std::vector<Vec2> normals;
    std::vector<const std::vector<Place>*> owner;
    for (const std::vector<Place>& outline : outlines) {
        for (const Place& place : outline) {
            lower = {std::min(lower.x, place.at.x), std::min(lower.y, place.at.y)};
            upper = {std::max(upper.x, place.at.x), std::max(upper.y, place.at.y)};
            at.push_back(place.at);
            normals.push_back(place.normal);
            owner.push_back(&outline);
        }
    }
    if (at.empty()) {
        return;
    }
    CellGrid cells(lower, upper, reach);
    const std::vector<std::uint32_t> order = cells.sort(at);
    for (std::vector<Place>& outline : outlines) {
        for (Place& place : outline) {
            const int column = cells.column(place.at.x);
            const int row = cells.row(place.at.y);
            double thickness = reach;  // of a gap, as much as asks for the same line
            for (int r = row - 1; r <= row + 1; ++r) {
                const auto [first, last] = cells.range(r, column - 1, column + 1);
                for (std::uint32_t m = first; m < last; ++m) {
                    const std::uint32_t q = order[m];
                    const Vec2 across = at[q] - place.at;
                    const double height = dot(place.normal, across);
                    // The liquid lies on the left on the screen, where y points down.
                    const bool is_gap = height > 0.0 && owner[q] != &outline;
                    const double square = dot(across, across) * (is_gap ? kGapShare / kLineShare : 1.0);
                    if (square < thickness * std::abs(height) && dot(place.normal, normals[q]) < kOpposite) {
                        thickness = square / std::abs(height);
                    }
                }
            }
            place.width = std::min(place.width, kLineShare * thickness);
        }
        const std::size_t count = outline.size();
        for (std::size_t k = 0; k < 2 * count; ++k) {
            Place& next = outline[(k + 1) % count];
            next.width =
                std::min(next.width, outline[k % count].width + kLift * length(next.at - outline[k % count].at));
        }
        for (std::size_t k = 2 * count; k > 0; --k) {
            Place& before = outline[(k - 1) % count];
            before.width =
                std::min(before.width, outline[k % count].width + kLift * length(before.at - outline[k % count].at));
        }
    }
}

/// Piece moved to one side.
/// @param side  1 or −1
Cubic moved(const Cubic& piece, const Place& begin, const Place& end, double side)
{
    const Vec2 a = piece.a + (0.5 * side * begin.width * begin.mitre) * begin.normal;
    const Vec2 d = piece.d + (0.5 * side * end.width * end.mitre) * end.normal;
    const double chord = length(piece.d - piece.a);
    const double scale = chord > 0.0 ? std::min(length(d - a) / chord, 2.0) : 1.0;
    // A third of the offset's derivative: the width changes linearly with the parameter.
    const double opening = side * (end.width - begin.width) / 6.0;
    return {a, a + scale * (piece.b - piece.a) + opening * begin.normal,
            d + scale * (piece.c - piece.d) - opening * end.normal, d};
}

/// Whether the width changes about linearly from one place to another one, which may be the end of its curve.
/// @param width  of the whole line
bool isEven(const std::vector<Place>& places, std::size_t begin, std::size_t end, double width)
{
    const double from = places[begin].t;
    const Place& last = places[end % places.size()];
    const double to = end < places.size() && last.curve == places[begin].curve ? last.t : 1.0;
    for (std::size_t k = begin + 1; k < end; ++k) {
        const double part = (places[k].t - from) / (to - from);
        const double here = places[begin].width + part * (last.width - places[begin].width);
        if (here < places[k].width - kLess * width || here > places[k].width + kMore * width) {
            return false;
        }
    }
    return true;
}

BezierPath pathOf(const std::vector<Cubic>& pieces)
{
    BezierPath path;
    path.start = pieces.front().a;
    for (const Cubic& piece : pieces) {
        path.curves.push_back({piece.b, piece.c, piece.d});
    }
    return path;
}

std::vector<Cubic> reversed(const std::vector<Cubic>& pieces)
{
    std::vector<Cubic> result = pieces;
    std::reverse(result.begin(), result.end());
    for (Cubic& piece : result) {
        std::swap(piece.a, piece.d);
        std::swap(piece.b, piece.c);
    }
    return result;
}

}  // namespace

std::vector<BezierPath> brushLines(const std::vector<BezierPath>& outlines, double width)
{
    std::vector<std::vector<Cubic>> curves(outlines.size());
    std::vector<std::vector<Place>> places(outlines.size());
    for (std::size_t k = 0; k < outlines.size(); ++k) {
        Vec2 start = outlines[k].start;
        for (const BezierCurve& curve : outlines[k].curves) {
            curves[k].push_back({start, curve.leaving, curve.arriving, curve.end});
            start = curve.end;
        }
        // The circle through the nearest of these places is too large by 2 % at most where the line narrows.
        places[k] = placesOf(curves[k], width, 0.5 * width);
    }
    narrow(places, width);
    std::vector<BezierPath> lines;
    for (std::size_t k = 0; k < outlines.size(); ++k) {
        std::vector<Cubic> outer;
        std::vector<Cubic> inner;
        const std::size_t count = places[k].size();
        for (std::size_t i = 0; i < count;) {
            // As far along the curve as the width changes evenly.
            std::size_t next = i + 1;
            while (next < count && places[k][next].curve == places[k][i].curve &&
                   isEven(places[k], i, next + 1, width)) {
                ++next;
            }
            const Place& begin = places[k][i];
            const Place& end = places[k][next % count];
            const Cubic piece =
                curves[k][begin.curve].part(begin.t, next < count && end.curve == begin.curve ? end.t : 1.0);
            outer.push_back(moved(piece, begin, end, 1.0));
            inner.push_back(moved(piece, begin, end, -1.0));
            i = next;
        }
        lines.push_back(pathOf(outer));
        lines.push_back(pathOf(reversed(inner)));
    }
    return lines;
}

}  // namespace droplet
