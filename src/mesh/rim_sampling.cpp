// SPDX-License-Identifier: GPL-3.0-or-later
//
// Local width by the poles of N. Amenta and M. Bern, "Surface reconstruction by Voronoi filtering" (1999): the largest
// Delaunay circle inside the domain that touches a rim point approximates the medial ball there.

#include "mesh/rim_sampling.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <unordered_map>
#include <utility>

#include "droplet/error.h"
#include "mesh/triangulation.h"

namespace droplet {
namespace {

/// Largest angle, roughly, by which a rim edge turns, so that a small round droplet has 18 edges [rad]. A chord that
/// turns by δ has a sagitta of δ/8 of its length.
constexpr double kTurnPerEdge = 0.35;

/// Largest change of edge length per unit of length along the rim; neighbours then differ by less than a factor of 2.
constexpr double kGradation = 0.4;

/// If a circle touches the rim only at points at most this many radii apart along it, it is in a corner, not in a
/// narrow part. Corners of less than 37° count as narrow.
constexpr double kCornerReach = 6.0;

std::vector<double> arcLengths(const std::vector<Vec2>& points)
{
    std::vector<double> at(points.size() + 1, 0.0);
    for (std::size_t i = 0; i < points.size(); ++i) {
        at[i + 1] = at[i] + length(points[(i + 1) % points.size()] - points[i]);
    }
    return at;
}

/// Place of a rim point: loop and index in it.
struct Place {
    std::size_t loop = 0;
    std::size_t index = 0;
};

/// Width of the liquid at every point of every loop; infinite where no circle was found.
/// @param detail  points of a loop nearer than this along it count as one place
std::vector<std::vector<double>> localWidths(const std::vector<Loop>& loops, double detail)
{
    std::vector<std::vector<Vec2>> polygons;
    std::vector<Place> places;
    std::vector<std::vector<double>> arcs;
    std::vector<std::vector<double>> widths;
    for (std::size_t k = 0; k < loops.size(); ++k) {
        const std::vector<Vec2>& points = loops[k].points;
        polygons.push_back(points);
        arcs.push_back(arcLengths(points));
        widths.emplace_back(points.size(), std::numeric_limits<double>::infinity());
        for (std::size_t i = 0; i < points.size(); ++i) {
            places.push_back({k, i});
        }
    }
    Triangulation triangulation;
    std::uint32_t count = 0;
    for (const std::vector<VertexHandle>& loop : insert(triangulation, polygons).loops) {
        for (const VertexHandle v : loop) {
            v->info().index = count++;
        }
    }
    markDomain(triangulation);

    const auto apart = [&](const Place& a, const Place& b) {
        if (a.loop != b.loop) {
            return std::numeric_limits<double>::infinity();
        }
        const double way = std::abs(arcs[a.loop][a.index] - arcs[a.loop][b.index]);
        return std::min(way, arcs[a.loop].back() - way);
    };
    for (auto f = triangulation.finite_faces_begin(); f != triangulation.finite_faces_end(); ++f) {
        if (!f->is_in_domain()) {
            continue;
        }
        const auto& a = f->vertex(0)->point();
        const auto& b = f->vertex(1)->point();
        const auto& c = f->vertex(2)->point();
        const Vec2 ab{b.x() - a.x(), b.y() - a.y()};
        const Vec2 ac{c.x() - a.x(), c.y() - a.y()};
        const Vec2 bc = ac - ab;
        const double radius = length(ab) * length(ac) * length(bc) / (2.0 * std::abs(cross(ab, ac)));
        const Place& pa = places[*f->vertex(0)->info().index];
        const Place& pb = places[*f->vertex(1)->info().index];
        const Place& pc = places[*f->vertex(2)->info().index];
        if (std::max({apart(pa, pb), apart(pb, pc), apart(pa, pc)}) > std::max(detail, kCornerReach * radius)) {
            for (const Place& p : {pa, pb, pc}) {
                double& width = widths[p.loop][p.index];
                // The largest circle at a point is the medial one; smaller ones fit between neighbouring points.
                width = std::isinf(width) ? 2.0 * radius : std::max(width, 2.0 * radius);
            }
        }
    }
    return widths;
}

/// Loop with the length along it, and the sum of absolute turning angles, up to every point.
struct MeasuredLoop {
    const std::vector<Vec2>* points = nullptr;
    std::vector<double> arc;
    std::vector<double> turned;
};

MeasuredLoop measure(const Loop& loop)
{
    const std::vector<Vec2>& p = loop.points;
    const std::size_t n = p.size();
    MeasuredLoop result{&p, arcLengths(p), {0.0}};
    for (std::size_t i = 0; i < n; ++i) {
        const Vec2 before = p[i] - p[i > 0 ? i - 1 : n - 1];
        const Vec2 after = p[i + 1 < n ? i + 1 : 0] - p[i];
        result.turned.push_back(result.turned.back() + std::abs(std::atan2(cross(before, after), dot(before, after))));
    }
    return result;
}

/// Consecutive points of a loop, and a circle that contains them.
struct Stretch {
    std::size_t loop = 0;
    std::size_t begin = 0;
    std::size_t end = 0;
    Vec2 centre;
    double radius = 0.0;
};

std::vector<Stretch> stretchesOf(const std::vector<MeasuredLoop>& loops)
{
    constexpr std::size_t kPoints = 16;
    std::vector<Stretch> stretches;
    for (std::size_t k = 0; k < loops.size(); ++k) {
        const std::vector<Vec2>& points = *loops[k].points;
        for (std::size_t begin = 0; begin < points.size(); begin += kPoints) {
            const std::size_t end = std::min(begin + kPoints, points.size());
            Stretch stretch{k, begin, end, points[begin + (end - begin) / 2], 0.0};
            for (std::size_t i = begin; i < end; ++i) {
                stretch.radius = std::max(stretch.radius, length(points[i] - stretch.centre));
            }
            stretches.push_back(stretch);
        }
    }
    return stretches;
}

/// Test whether a circle narrower than `widest` can touch two stretches of the rim at points that are far apart along
/// it.
class Narrowness {
public:
    Narrowness(const std::vector<MeasuredLoop>& loops, double detail, double widest)
        : loops_(loops), detail_(detail), widest_(widest)
    {
    }

    [[nodiscard]] bool between(const Stretch& a, const Stretch& b) const
    {
        const double nearest = length(a.centre - b.centre) - a.radius - b.radius;
        if (nearest > widest_ || (a.loop == b.loop && isStraight(a, b))) {
            return false;
        }
        for (std::size_t i = a.begin; i < a.end; ++i) {
            for (std::size_t j = b.begin; j < b.end; ++j) {
                if (between(a.loop, i, b.loop, j)) {
                    return true;
                }
            }
        }
        return false;
    }

private:
    /// A curve that turns by less than θ < π is at most 1/cos(θ/2) times as long as its chord. So within 2·arccos(1/3)
    /// no two points are farther apart along it than three chords, or kCornerReach radii.
    [[nodiscard]] bool isStraight(const Stretch& a, const Stretch& b) const
    {
        static_assert(kCornerReach == 6.0);
        constexpr double kTurn = 2.46;
        const std::vector<double>& turned = loops_[a.loop].turned;
        const double inside = std::max(turned[a.end], turned[b.end]) - std::min(turned[a.begin], turned[b.begin]);
        const double outside =
            turned.back() - (std::max(turned[a.begin], turned[b.begin]) - std::min(turned[a.end], turned[b.end]));
        return inside < kTurn || outside < kTurn;
    }

    [[nodiscard]] bool between(std::size_t k, std::size_t i, std::size_t l, std::size_t j) const
    {
        const std::vector<Vec2>& points = *loops_[k].points;
        const Vec2 across = (*loops_[l].points)[j] - points[i];
        const double squared = dot(across, across);
        if (squared > widest_ * widest_) {
            return false;
        }
        if (k == l) {
            const std::vector<double>& arc = loops_[k].arc;
            const double way = std::abs(arc[i] - arc[j]);
            const double apart = std::min(way, arc.back() - way);
            // A chord is at most a diameter
            if (apart <= detail_ || apart * apart <= 0.25 * kCornerReach * kCornerReach * squared) {
                return false;
            }
        }
        // Chords of a circle inside the liquid go to the left, within the loop's roughness.
        constexpr double kRough = 0.3;
        const Vec2 along = points[i + 1 < points.size() ? i + 1 : 0] - points[i > 0 ? i - 1 : points.size() - 1];
        const double left = cross(along, across);
        return left >= 0.0 || left * left <= kRough * kRough * squared * dot(along, along);
    }

    const std::vector<MeasuredLoop>& loops_;
    double detail_;
    double widest_;
};

/// Whether the liquid may be narrower than `widest` anywhere, as localWidths() would find.
bool isNarrowSomewhere(const std::vector<Loop>& loops, double detail, double widest)
{
    std::vector<MeasuredLoop> measured;
    measured.reserve(loops.size());
    for (const Loop& loop : loops) {
        measured.push_back(measure(loop));
    }
    std::vector<Stretch> stretches = stretchesOf(measured);
    double largest = 0.0;
    for (const Stretch& stretch : stretches) {
        largest = std::max(largest, stretch.radius);
    }
    const double reach = widest + 2.0 * largest;
    // Sorted from left to right, so that only stretches within reach are compared.
    std::stable_sort(stretches.begin(), stretches.end(),
                     [](const Stretch& a, const Stretch& b) { return a.centre.x < b.centre.x; });
    const Narrowness narrowness(measured, detail, widest);
    for (std::size_t i = 0; i < stretches.size(); ++i) {
        for (std::size_t j = i; j < stretches.size() && stretches[j].centre.x - stretches[i].centre.x <= reach; ++j) {
            if (std::abs(stretches[j].centre.y - stretches[i].centre.y) <= reach &&
                (narrowness.between(stretches[i], stretches[j]) || narrowness.between(stretches[j], stretches[i]))) {
                return true;
            }
        }
    }
    return false;
}

std::vector<std::vector<double>> unknownWidths(const std::vector<Loop>& loops)
{
    std::vector<std::vector<double>> widths;
    widths.reserve(loops.size());
    for (const Loop& loop : loops) {
        widths.emplace_back(loop.points.size(), std::numeric_limits<double>::infinity());
    }
    return widths;
}

/// Reduces lengths to the distances of corners along a closed loop, which are vertices.
void limitToCorners(std::vector<double>& lengths, const Loop& loop, const std::vector<double>& arc)
{
    const std::size_t n = lengths.size();
    std::optional<std::size_t> last;
    for (std::size_t k = 0; k < 2 * n; ++k) {
        const std::size_t i = k % n;
        if (loop.corner[i] == 0) {
            continue;
        }
        if (last && *last % n != i) {
            const double way = arc[i] - arc[*last % n] + (i < *last % n ? arc.back() : 0.0);
            for (std::size_t j = *last; j <= k; ++j) {
                lengths[j % n] = std::min(lengths[j % n], way);
            }
        }
        last = k;
    }
}

/// Reduces lengths so that they change along a closed loop no faster than kGradation.
void grade(std::vector<double>& lengths, const std::vector<double>& arc)
{
    const std::size_t n = lengths.size();
    for (std::size_t lap = 0; lap < 2; ++lap) {
        for (std::size_t i = 0; i < n; ++i) {
            const std::size_t next = (i + 1) % n;
            lengths[next] = std::min(lengths[next], lengths[i] + kGradation * (arc[i + 1] - arc[i]));
        }
    }
    for (std::size_t lap = 0; lap < 2; ++lap) {
        for (std::size_t i = n; i-- > 0;) {
            const std::size_t next = (i + 1) % n;
            lengths[i] = std::min(lengths[i], lengths[next] + kGradation * (arc[i + 1] - arc[i]));
        }
    }
}

/// Place of a rim vertex on a loop: index of a point plus a fraction of the piece to the next.
struct Mark {
    std::size_t index = 0;
    double fraction = 0.0;
    bool exact = false;  ///< the edge from here follows the loop exactly, because space is narrow
};

/// Loop that is being sampled.
struct Sampling {
    const Loop* loop = nullptr;
    std::vector<double> arc;
    std::vector<Mark> marks;

    [[nodiscard]] Vec2 at(const Mark& m) const
    {
        const std::vector<Vec2>& p = loop->points;
        return p[m.index] + m.fraction * (p[(m.index + 1) % p.size()] - p[m.index]);
    }
    [[nodiscard]] double arcAt(const Mark& m) const
    {
        return arc[m.index] + m.fraction * (arc[m.index + 1] - arc[m.index]);
    }
    [[nodiscard]] bool isCorner(const Mark& m) const { return m.fraction == 0.0 && loop->corner[m.index] != 0; }
    [[nodiscard]] std::size_t size() const { return marks.size(); }
    [[nodiscard]] const Mark& next(std::size_t i) const { return marks[(i + 1) % marks.size()]; }
};

/// Place at a length along a loop; a point of the loop if one is near.
Mark markAt(const Sampling& sampling, double way)
{
    const std::size_t n = sampling.loop->points.size();
    way = std::fmod(way, sampling.arc.back());
    const auto after = std::upper_bound(sampling.arc.begin(), sampling.arc.end() - 1, way);
    const auto i = static_cast<std::size_t>(after - sampling.arc.begin()) - 1;
    const double fraction = (way - sampling.arc[i]) / (sampling.arc[i + 1] - sampling.arc[i]);
    // Snap to a point of the loop, because that point may become a mark, too.
    constexpr double kSnap = 0.05;
    if (fraction > 1.0 - kSnap) {
        return {(i + 1) % n, 0.0, false};
    }
    return {i, fraction < kSnap ? 0.0 : fraction, false};
}

/// Points of the loop strictly between two marks, in order.
std::vector<std::size_t> between(const Sampling& sampling, const Mark& from, const Mark& to)
{
    const std::size_t n = sampling.loop->points.size();
    std::vector<std::size_t> result;
    const bool wraps = sampling.arcAt(to) <= sampling.arcAt(from);
    const std::size_t last = to.index + (wraps ? n : 0);
    for (std::size_t i = from.index + 1; i <= last; ++i) {
        if (i < last || to.fraction > 0.0) {
            result.push_back(i % n);
        }
    }
    return result;
}

/// Distributes marks so that edges have about the wanted length everywhere. Corners are marks.
void distribute(Sampling& sampling, const std::vector<double>& lengths)
{
    const Loop& loop = *sampling.loop;
    const std::size_t n = loop.points.size();
    std::vector<std::size_t> stops;
    for (std::size_t i = 0; i < n; ++i) {
        if (loop.corner[i] != 0) {
            stops.push_back(i);
        }
    }
    if (stops.empty()) {
        stops.push_back(0);
    }
    const bool whole = stops.size() == 1;
    for (std::size_t k = 0; k < stops.size(); ++k) {
        const std::size_t begin = stops[k];
        const std::size_t end = whole ? begin + n : (k + 1 < stops.size() ? stops[k + 1] : stops[0] + n);
        std::vector<double> edges{0.0};  // number of edges that fit up to every point
        for (std::size_t i = begin; i < end; ++i) {
            const std::size_t at = i < n ? i : i - n;
            const double mean = 0.5 * (lengths[at] + lengths[at + 1 < n ? at + 1 : 0]);
            edges.push_back(edges.back() + (sampling.arc[at + 1] - sampling.arc[at]) / mean);
        }
        // At least six vertices if fewer than three corners determine the loop's shape.
        const std::size_t min = stops.size() < 3 ? 6 / stops.size() : 1;
        const auto count = std::max(min, static_cast<std::size_t>(std::lround(edges.back())));
        sampling.marks.push_back({begin, 0.0, false});
        std::size_t i = 0;
        for (std::size_t j = 1; j < count; ++j) {
            const double wanted = edges.back() * static_cast<double>(j) / static_cast<double>(count);
            while (edges[i + 1] <= wanted) {
                ++i;
            }
            const std::size_t point = begin + i < n ? begin + i : begin + i - n;
            const double fraction = (wanted - edges[i]) / (edges[i + 1] - edges[i]);
            sampling.marks.push_back(
                markAt(sampling, sampling.arc[point] + fraction * (sampling.arc[point + 1] - sampling.arc[point])));
        }
    }
    std::sort(sampling.marks.begin(), sampling.marks.end(), [](const Mark& a, const Mark& b) {
        return a.index < b.index || (a.index == b.index && a.fraction < b.fraction);
    });
    sampling.marks.erase(
        std::unique(sampling.marks.begin(), sampling.marks.end(),
                    [](const Mark& a, const Mark& b) { return a.index == b.index && a.fraction == b.fraction; }),
        sampling.marks.end());
}

/// Mark in the middle between two.
Mark middle(const Sampling& sampling, const Mark& from, const Mark& to)
{
    const double begin = sampling.arcAt(from);
    const double end = sampling.arcAt(to);
    return markAt(sampling, begin + 0.5 * (end > begin ? end - begin : end - begin + sampling.arc.back()));
}

/// Mark between two at a point of the loop; none if there is no point between them.
std::optional<Mark> pointBetween(const Sampling& sampling, const Mark& from, const Mark& to)
{
    const std::vector<std::size_t> inside = between(sampling, from, to);
    if (inside.empty()) {
        return std::nullopt;
    }
    return Mark{inside[inside.size() / 2], 0.0, false};
}

bool bulges(const Sampling& sampling, const Mark& from, const Mark& to)
{
    const Vec2 a = sampling.at(from);
    const Vec2 chord = sampling.at(to) - a;
    const double chord_length = length(chord);
    double sagitta = 0.0;
    for (const std::size_t i : between(sampling, from, to)) {
        sagitta = std::max(sagitta, std::abs(cross(chord, sampling.loop->points[i] - a)));
    }
    return sagitta > kTurnPerEdge / 8.0 * chord_length * chord_length;
}

/// Splits edges that turn too much, down to the length `shortest`.
void splitBulges(Sampling& sampling, double shortest)
{
    for (bool changed = true; changed;) {
        changed = false;
        std::vector<Mark> marks;
        for (std::size_t i = 0; i < sampling.size(); ++i) {
            const Mark& from = sampling.marks[i];
            const Mark& to = sampling.next(i);
            marks.push_back(from);
            if (length(sampling.at(to) - sampling.at(from)) > 2.0 * shortest && bulges(sampling, from, to)) {
                marks.push_back(middle(sampling, from, to));
                changed = true;
            }
        }
        std::rotate(
            marks.begin(),
            std::min_element(marks.begin(), marks.end(),
                             [&](const Mark& a, const Mark& b) { return sampling.arcAt(a) < sampling.arcAt(b); }),
            marks.end());
        sampling.marks = std::move(marks);
    }
}

/// Moves vertices outward off the loop, so that every loop's polygon encloses the loop's area. A chord cuts off a
/// segment, and each of its two ends makes up for half of it. Corners stay.
RimPolygon keepArea(const Sampling& sampling)
{
    const std::size_t n = sampling.size();
    RimPolygon polygon(n);
    for (std::size_t i = 0; i < n; ++i) {
        polygon[i] = sampling.at(sampling.marks[i]);
    }
    std::vector<double> missing(n, 0.0);
    for (std::size_t i = 0; i < n; ++i) {
        // Twice the area between chord and curve; positive where the curve lies to the right of the chord
        const Vec2 origin = polygon[i];
        Vec2 last = origin;
        for (const std::size_t j : between(sampling, sampling.marks[i], sampling.next(i))) {
            const Vec2 here = sampling.loop->points[j];
            missing[i] += cross(last - origin, here - origin);
            last = here;
        }
        missing[i] = 0.5 * (missing[i] + cross(last - origin, polygon[(i + 1) % n] - origin));
    }
    RimPolygon result = polygon;
    for (std::size_t i = 0; i < n; ++i) {
        const std::size_t before = (i + n - 1) % n;
        if (sampling.isCorner(sampling.marks[i]) || sampling.marks[i].exact || sampling.marks[before].exact) {
            continue;
        }
        const Vec2 along = polygon[(i + 1) % n] - polygon[before];
        const double shorter =
            std::min(length(polygon[(i + 1) % n] - polygon[i]), length(polygon[i] - polygon[before]));
        const double both = length(polygon[(i + 1) % n] - polygon[i]) + length(polygon[i] - polygon[before]);
        if (length(along) < 0.5 * shorter) {
            continue;
        }
        // A larger shift would not correct a chord but change the shape.
        const double max = kTurnPerEdge / 8.0 * shorter;
        const double shift = std::clamp((missing[before] + missing[i]) / both, -max, max);
        result[i] = polygon[i] + (shift / length(along)) * Vec2{along.y, -along.x};
    }
    return result;
}

/// Makes chosen edges follow the loop more closely: halves them, and keeps their ends on the loop.
/// @param chosen  one flag per edge
/// @return        whether anything changed
bool followLoop(Sampling& sampling, const std::vector<std::uint8_t>& chosen)
{
    bool changed = false;
    std::vector<Mark> marks;
    for (std::size_t i = 0; i < sampling.size(); ++i) {
        Mark mark = sampling.marks[i];
        const std::optional<Mark> middle =
            chosen[i] != 0 ? pointBetween(sampling, mark, sampling.next(i)) : std::optional<Mark>();
        if (chosen[i] != 0) {
            changed = changed || !mark.exact || middle;
            mark.exact = true;
        }
        marks.push_back(mark);
        if (middle) {
            marks.push_back({middle->index, middle->fraction, true});
        }
    }
    // The middle of the last edge may lie past the loop's first point.
    std::rotate(marks.begin(),
                std::min_element(marks.begin(), marks.end(),
                                 [&](const Mark& a, const Mark& b) { return sampling.arcAt(a) < sampling.arcAt(b); }),
                marks.end());
    sampling.marks = std::move(marks);
    return changed;
}

/// Whether the segments ab and cd cross or touch.
bool meet(Vec2 a, Vec2 b, Vec2 c, Vec2 d)
{
    const auto apart = [](double p, double q, double r, double s) {
        return std::max(p, q) < std::min(r, s) || std::max(r, s) < std::min(p, q);
    };
    // This also handles collinear segments that do not touch.
    if (apart(a.x, b.x, c.x, d.x) || apart(a.y, b.y, c.y, d.y)) {
        return false;
    }
    const double u = cross(b - a, c - a);
    const double v = cross(b - a, d - a);
    const double s = cross(d - c, a - c);
    const double t = cross(d - c, b - c);
    return ((u <= 0 && v >= 0) || (u >= 0 && v <= 0)) && ((s <= 0 && t >= 0) || (s >= 0 && t <= 0));
}

/// Edge of one of several polygons.
struct EdgeId {
    std::size_t loop = 0;
    std::size_t index = 0;

    friend bool operator==(const EdgeId&, const EdgeId&) = default;
};

/// Edges that cross or touch other edges than their neighbours, found with a grid of cells as large as an edge.
std::vector<EdgeId> meetingEdges(const std::vector<RimPolygon>& polygons)
{
    double total = 0.0;
    std::size_t count = 0;
    for (const RimPolygon& p : polygons) {
        for (std::size_t i = 0; i < p.size(); ++i) {
            total += length(p[(i + 1) % p.size()] - p[i]);
            ++count;
        }
    }
    const double cell = total / static_cast<double>(count);
    std::unordered_map<std::uint64_t, std::vector<EdgeId>> grid;
    std::vector<EdgeId> found;
    for (std::size_t loop = 0; loop < polygons.size(); ++loop) {
        const RimPolygon& p = polygons[loop];
        for (std::size_t i = 0; i < p.size(); ++i) {
            const Vec2 a = p[i];
            const Vec2 b = p[(i + 1) % p.size()];
            const EdgeId id{loop, i};
            bool is_meeting = false;
            const auto [x0, x1] = std::minmax(a.x, b.x);
            const auto [y0, y1] = std::minmax(a.y, b.y);
            for (auto y = std::llround(std::floor(y0 / cell)); y <= std::llround(std::floor(y1 / cell)); ++y) {
                for (auto x = std::llround(std::floor(x0 / cell)); x <= std::llround(std::floor(x1 / cell)); ++x) {
                    std::vector<EdgeId>& there =
                        grid[(static_cast<std::uint64_t>(y) << 32U) ^ (static_cast<std::uint64_t>(x) & 0xffffffffU)];
                    for (const EdgeId& other : there) {
                        const RimPolygon& q = polygons[other.loop];
                        const bool neighbours = other.loop == loop && ((other.index + 1) % q.size() == i ||
                                                                       (i + 1) % q.size() == other.index);
                        if (!neighbours && !(other == id) &&
                            meet(a, b, q[other.index], q[(other.index + 1) % q.size()])) {
                            is_meeting = true;
                            found.push_back(other);
                        }
                    }
                    if (there.empty() || !(there.back() == id)) {
                        there.push_back(id);
                    }
                }
            }
            if (is_meeting) {
                found.push_back(id);
            }
        }
    }
    return found;
}

}  // namespace

RimSampler::RimSampler(const Footprint& footprint, double widest) : loops_{footprint.rim}, widest_(widest)
{
    loops_.insert(loops_.end(), footprint.holes.begin(), footprint.holes.end());
    double total = 0.0;
    std::size_t count = 0;
    for (const Loop& loop : loops_) {
        total += arcLengths(loop.points).back();
        count += loop.points.size();
    }
    // Traced loops have a point every 0.8 px. Detail below half a pixel comes from the raster.
    finest_ = 0.6 * total / static_cast<double>(count);
    // To triangulate all points of the loops would take longer than everything else on a coarse mesh of wide strokes.
    if (isNarrowSomewhere(loops_, finest_, widest)) {
        widths_ = localWidths(loops_, finest_);
        widest_ = std::numeric_limits<double>::infinity();
    } else {
        widths_ = unknownWidths(loops_);
    }
}

std::vector<RimPolygon> RimSampler::sample(double edge) const
{
    if (edge > widest_) {
        RimSampler all = *this;
        all.widest_ = edge;
        all.widths_ = localWidths(loops_, finest_);
        return all.sample(edge);
    }
    std::vector<Sampling> samplings(loops_.size());
    for (std::size_t k = 0; k < loops_.size(); ++k) {
        Sampling& sampling = samplings[k];
        sampling.loop = &loops_[k];
        sampling.arc = arcLengths(loops_[k].points);
        std::vector<double> lengths(widths_[k].size());
        for (std::size_t i = 0; i < lengths.size(); ++i) {
            lengths[i] = std::min(edge, std::max(finest_, widths_[k][i]));
        }
        limitToCorners(lengths, loops_[k], sampling.arc);
        grade(lengths, sampling.arc);
        distribute(sampling, lengths);
        splitBulges(sampling, std::min(edge, finest_));
    }
    // Chords that cut across a gap narrower than their sagitta must follow the loop more closely and exactly.
    while (true) {
        std::vector<RimPolygon> polygons;
        std::vector<std::vector<std::uint8_t>> meets;
        for (const Sampling& sampling : samplings) {
            polygons.push_back(keepArea(sampling));
            meets.emplace_back(sampling.size(), 0);
        }
        const std::vector<EdgeId> meeting = meetingEdges(polygons);
        if (meeting.empty()) {
            return polygons;
        }
        for (const EdgeId& id : meeting) {
            meets[id.loop][id.index] = 1;
        }
        bool changed = false;
        for (std::size_t k = 0; k < samplings.size(); ++k) {
            changed = followLoop(samplings[k], meets[k]) || changed;
        }
        if (!changed) {
            throwCrossing();
        }
    }
}

}  // namespace droplet
