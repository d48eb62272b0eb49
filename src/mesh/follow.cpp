// SPDX-License-Identifier: GPL-3.0-or-later
//
// Harmonic motion of inner vertices, by linear finite elements. It reproduces translations and other affine motions of
// the rim exactly.
#include "droplet/mesh/follow.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <string>
#include <utility>

#include "droplet/error.h"
#include "droplet/mesh/triangulate.h"
#include "droplet/units.h"
#include "mesh/curve.h"
#include "mesh/harmonic.h"
#include "number_text.h"

namespace droplet {
namespace {

/// Limits beyond which a mesh is rejected; see follow().
constexpr double kMinAngle = 15.0 * kDegree;
constexpr double kMaxStretch = 1.5;
constexpr double kMaxSagitta = 0.2;

/// Range of the spacing of rim vertices, relative to that on the first loop; outside of it, places are evened out
/// further. Triangles at short edges of a rim have small angles already: of 119 steps in which the word Water becomes a
/// ring, with the linear model, 22 kept their vertices with 0.6 and 31 with 0.8.
constexpr double kMinSpacing = 0.8;
constexpr double kMaxSpacing = 2.0;

/// Largest distance between a bend of the rim and the corner that it becomes, over the larger one of their distances
/// from the other loop, or over an edge. A corner that moves leaves the old loop; where one becomes round and another
/// one appears elsewhere, as when a word flows into a ring, both are near both loops, 10 to 60 edges apart.
constexpr double kMaxSlide = 4.0;

Vec2 centroid(const std::vector<Vec2>& points)
{
    // Relative to the first point, so that places far from the origin lose no digits.
    const Vec2 origin = points.front();
    Vec2 moment;
    double twice = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Vec2 a = points[i] - origin;
        const Vec2 b = points[(i + 1) % points.size()] - origin;
        twice += cross(a, b);
        moment = moment + cross(a, b) * (a + b);
    }
    return origin + (1.0 / (3.0 * twice)) * moment;
}

double enclosed(const std::vector<Vec2>& points)
{
    const Vec2 origin = points.front();
    double twice = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        twice += cross(points[i] - origin, points[(i + 1) % points.size()] - origin);
    }
    return 0.5 * twice;
}

/// Pairs of a corner of the loop and the bend of the rim that becomes it; each is the other's nearest, and they are no
/// farther apart than a corner moves.
std::vector<std::pair<std::size_t, std::size_t>> cornerPairs(const Loop& loop, const Curve& after,
                                                             const std::vector<Vec2>& moved)
{
    const Curve rim(moved);
    const auto gap = [](const Curve& curve, Vec2 p) {
        return length(curve.at(curve.nearest(p, 0.0, curve.size())) - p);
    };
    const double edge = rim.length() / static_cast<double>(moved.size());
    const auto is_near = [&](Vec2 corner, Vec2 bend) {
        return length(corner - bend) <= kMaxSlide * std::max({gap(rim, corner), gap(after, bend), edge});
    };
    constexpr double kLeastBend = 25.0 * kDegree;  // corners of outlines turn by 35° or more
    const std::size_t count = moved.size();
    std::vector<std::size_t> bends;
    for (std::size_t v = 0; v < count; ++v) {
        const Vec2 in = moved[v] - moved[(v + count - 1) % count];
        const Vec2 out = moved[(v + 1) % count] - moved[v];
        if (std::abs(std::atan2(cross(in, out), dot(in, out))) > kLeastBend) {
            bends.push_back(v);
        }
    }
    std::vector<std::size_t> corners;
    for (std::size_t i = 0; i < loop.points.size(); ++i) {
        if (loop.corner[i] != 0) {
            corners.push_back(i);
        }
    }
    const auto nearest = [](Vec2 p, const std::vector<std::size_t>& among, const std::vector<Vec2>& points) {
        return *std::min_element(among.begin(), among.end(), [&](std::size_t a, std::size_t b) {
            return length(points[a] - p) < length(points[b] - p);
        });
    };
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    for (const std::size_t i : corners) {
        if (!bends.empty()) {
            const std::size_t v = nearest(loop.points[i], bends, moved);
            if (nearest(moved[v], corners, loop.points) == i && is_near(loop.points[i], moved[v])) {
                pairs.emplace_back(i, v);
            }
        }
    }
    return pairs;
}

/// Places on a loop that are nearest to points that were on the loop before it, in their order, from one lap to the
/// next.
std::vector<double> nearestPlaces(const Curve& before, const Curve& after, const std::vector<Vec2>& moved)
{
    const std::size_t count = moved.size();
    const double ratio = after.length() / before.length();
    // The common offset is that of the sampled vertex with which the others agree best.
    constexpr std::size_t kSamples = 16;
    std::vector<double> sampled;
    for (std::size_t k = 0; k < std::min(kSamples, count); ++k) {
        const std::size_t v = k * count / std::min(kSamples, count);
        sampled.push_back(after.nearest(moved[v], 0.0, after.size()) - ratio * before.arc(v));
    }
    double common = 0.0;
    double min = std::numeric_limits<double>::infinity();
    for (const double offset : sampled) {
        double disagreement = 0.0;
        for (const double other : sampled) {
            const double apart = after.wrapped(other - offset);
            disagreement += std::min(apart, after.length() - apart);
        }
        if (disagreement < min) {
            min = disagreement;
            common = offset;
        }
    }
    // The nearest place is searched an eighth of the loop to both sides of it.
    constexpr double kReach = 0.125;
    std::vector<double> places(count);
    for (std::size_t v = 0; v < count; ++v) {
        const double expected = ratio * before.arc(v) + common;
        const double from = expected - kReach * after.length();
        std::size_t pieces = after.pieceAt(expected + kReach * after.length()) + after.size() - after.pieceAt(from);
        pieces = pieces % after.size() + 1;
        places[v] = after.nearest(moved[v], from, pieces);
    }
    return places;
}

/// Places of all vertices on the new loop, and which of them become corners.
struct Places {
    std::vector<double> values;
    std::vector<std::uint8_t> fixed;  ///< 0, kBend or kCorner
};
constexpr std::uint8_t kBend = 1;
constexpr std::uint8_t kCorner = 2;

/// Whether the spacing of vertices is similar to that on the first loop.
bool evenlySpaced(const Curve& first, const Curve& after, const std::vector<double>& places)
{
    const double ratio = after.length() / first.length();
    for (std::size_t v = 0; v < places.size(); ++v) {
        const double next = v + 1 < places.size() ? places[v + 1] : places[0] + after.length();
        const double spacing = (next - places[v]) / (ratio * (first.arc(v + 1) - first.arc(v)));
        if (!(spacing >= kMinSpacing && spacing <= kMaxSpacing)) {
            return false;
        }
    }
    return true;
}

/// Frees fixed vertices that leave too much or too little room for those between them and the next fixed ones.
void freeCrowded(const Curve& first, const Curve& after, Places& places)
{
    std::vector<std::size_t> fixed;
    for (std::size_t v = 0; v < places.values.size(); ++v) {
        if (places.fixed[v] != 0) {
            fixed.push_back(v);
        }
    }
    const double ratio = after.length() / first.length();
    const auto are_apart = [&](std::size_t v, std::size_t w) {
        const double lap = w > v ? 0.0 : 1.0;
        const double room = places.values[w] - places.values[v] + lap * after.length();
        const double spacing = room / (ratio * (first.arc(w) - first.arc(v) + lap * first.length()));
        return spacing >= kMinSpacing && spacing <= kMaxSpacing;
    };
    for (std::size_t k = 0; k < fixed.size() && fixed.size() > 1;) {
        const std::size_t next = (k + 1) % fixed.size();
        const bool next_is_corner = places.fixed[fixed[next]] == kCorner;
        if (are_apart(fixed[k], fixed[next]) || (places.fixed[fixed[k]] == kCorner && next_is_corner)) {
            ++k;
            continue;
        }
        const std::size_t freed = next_is_corner ? k : next;
        places.fixed[fixed[freed]] = 0;
        fixed.erase(fixed.begin() + static_cast<std::ptrdiff_t>(freed));
        k = 0;
    }
}

/// Evens places out until the spacing is similar to that on the first loop. Fixed ones stay. If many passes over the
/// loop are not enough, places between fixed ones get the spacing to which passes without end would lead: the same part
/// of that on the first loop everywhere.
void even(const Curve& first, const Curve& after, Places& places)
{
    const std::size_t count = places.values.size();
    const double ratio = after.length() / first.length();
    std::vector<double> offsets(count);
    for (std::size_t v = 0; v < count; ++v) {
        offsets[v] = places.values[v] - ratio * first.arc(v);
    }
    const auto place = [&] {
        for (std::size_t v = 0; v < count; ++v) {
            places.values[v] = ratio * first.arc(v) + offsets[v];
        }
        return evenlySpaced(first, after, places.values);
    };
    std::vector<double> evened = offsets;
    constexpr std::size_t kMaxPasses = 256;
    for (std::size_t done = 0, passes = 1; passes <= kMaxPasses; passes *= 4) {
        if (place()) {
            return;
        }
        for (; done < passes; ++done) {
            for (std::size_t v = 0; v < count; ++v) {
                if (places.fixed[v] == 0) {
                    const double below = offsets[v > 0 ? v - 1 : count - 1];
                    const double above = offsets[v + 1 < count ? v + 1 : 0];
                    evened[v] = 0.25 * (below + above) + 0.5 * offsets[v];
                }
            }
            offsets = evened;
        }
    }
    if (place()) {
        return;
    }
    std::vector<std::size_t> fixed;
    for (std::size_t v = 0; v < count; ++v) {
        if (places.fixed[v] != 0) {
            fixed.push_back(v);
        }
    }
    if (fixed.empty()) {
        const double mean = std::accumulate(offsets.begin(), offsets.end(), 0.0) / static_cast<double>(count);
        std::fill(offsets.begin(), offsets.end(), mean);
    }
    for (std::size_t k = 0; k < fixed.size(); ++k) {
        const std::size_t from = fixed[k];
        const std::size_t to = fixed[(k + 1) % fixed.size()];
        const std::size_t steps = to > from ? to - from : to + count - from;
        // Relative to the length between them, as every edge of the first loop grows by the same part.
        const double lap = to > from ? 0.0 : first.length();
        for (std::size_t n = 1; n < steps; ++n) {
            const std::size_t v = from + n < count ? from + n : from + n - count;
            const double along = first.arc(v) - first.arc(from) + (v > from ? 0.0 : first.length());
            const double part = along / (first.arc(to) - first.arc(from) + lap);
            offsets[v] = offsets[from] + part * (offsets[to] - offsets[from]);
        }
    }
    (void)place();
}

/// Places of vertices on the new loop: the nearest ones, evened out.
/// @param moved  the vertices, brought to the new loop's centre and size
Places placesOf(const Curve& first, const Curve& before, const Curve& after, const Loop& loop,
                const std::vector<Vec2>& moved)
{
    Places places{nearestPlaces(before, after, moved), std::vector<std::uint8_t>(moved.size(), 0)};
    for (const auto& [corner, v] : cornerPairs(loop, after, moved)) {
        places.values[v] += std::remainder(after.arc(corner) - places.values[v], after.length());
        places.fixed[v] = kBend;
    }
    freeCrowded(first, after, places);
    even(first, after, places);
    return places;
}

/// Assigns the nearest vertex to every corner of the loop; false if two corners need the same.
bool assignCorners(const Loop& loop, const Curve& after, Places& places)
{
    const std::size_t count = places.values.size();
    std::vector<std::uint8_t> taken(count, 0);
    for (std::size_t i = 0; i < loop.points.size(); ++i) {
        if (loop.corner[i] == 0) {
            continue;
        }
        std::size_t best = 0;
        double min = std::numeric_limits<double>::infinity();
        double move = 0.0;
        for (std::size_t v = 0; v < count; ++v) {
            const double ahead = after.wrapped(after.arc(i) - places.values[v]);
            const double way = ahead < 0.5 * after.length() ? ahead : ahead - after.length();
            if (std::abs(way) < min) {
                min = std::abs(way);
                move = way;
                best = v;
            }
        }
        if (taken[best] != 0) {
            return false;
        }
        taken[best] = 1;
        places.fixed[best] = kCorner;
        places.values[best] += move;
    }
    return true;
}

/// Calls work(place, point) for all points of a loop between two places.
template <typename Work>
void forPointsBetween(const Loop& loop, const Curve& after, double from, double to, const Work& work)
{
    double lap = from - after.wrapped(from);
    for (std::size_t i = after.pieceAt(from) + 1;; ++i) {
        if (i >= after.size()) {
            i -= after.size();
            lap += after.length();
        }
        if (lap + after.arc(i) >= to) {
            break;
        }
        work(lap + after.arc(i), loop.points[i]);
    }
}

/// Moves an end of every chord that is far from its piece of the loop to the point that is farthest from it.
/// @return  whether any was moved
bool assignBends(const Loop& loop, const Curve& after, Places& places)
{
    const std::size_t count = places.values.size();
    bool is_any = false;
    for (std::size_t v = 0; v < count; ++v) {
        const std::size_t w = (v + 1) % count;
        const double lap = w > 0 ? 0.0 : after.length();
        const double from = places.values[v];
        const double to = places.values[w] + lap;
        if (!(to > from)) {
            continue;
        }
        const Vec2 a = after.at(from);
        const Vec2 chord = after.at(to) - a;
        double most = kMaxSagitta * dot(chord, chord);
        std::optional<double> bend;
        forPointsBetween(loop, after, from, to, [&](double place, Vec2 p) {
            if (const double away = std::abs(cross(chord, p - a)); away > most) {
                most = away;
                bend = place;
            }
        });
        if (!bend) {
            continue;
        }
        const bool is_first_nearer = *bend - from < to - *bend;
        const bool takes_first = places.fixed[v] == 0 && (is_first_nearer || places.fixed[w] != 0);
        if (takes_first || places.fixed[w] == 0) {
            places.values[takes_first ? v : w] = takes_first ? *bend : *bend - lap;
            places.fixed[takes_first ? v : w] = kBend;
            is_any = true;
        }
    }
    return is_any;
}

/// Moves all vertices except corners across the rim by the same distance, until the polygon has the loop's area.
void keepArea(double wanted, const std::vector<std::uint8_t>& fixed, std::vector<Vec2>& points)
{
    constexpr int kPasses = 3;  // the error is squared each time
    const std::size_t count = points.size();
    for (int pass = 0; pass < kPasses; ++pass) {
        std::vector<Vec2> outward(count);
        double reach = 0.0;
        for (std::size_t v = 0; v < count; ++v) {
            const Vec2 chord = points[(v + 1) % count] - points[(v + count - 1) % count];
            if (fixed[v] == 0 && length(chord) > 0.0) {
                outward[v] = (1.0 / length(chord)) * Vec2{chord.y, -chord.x};
                reach += 0.5 * length(chord);
            }
        }
        if (!(reach > 0.0)) {
            return;
        }
        const double step = (wanted - enclosed(points)) / reach;
        for (std::size_t v = 0; v < count; ++v) {
            points[v] = points[v] + step * outward[v];
        }
    }
}

/// Whether every chord is close to its piece of the loop.
bool chordsFit(const Loop& loop, const Curve& after, const std::vector<double>& places, const std::vector<Vec2>& points)
{
    const std::size_t count = points.size();
    for (std::size_t v = 0; v < count; ++v) {
        const double from = places[v];
        const double to = v + 1 < count ? places[v + 1] : places[0] + after.length();
        const Vec2 chord = points[(v + 1) % count] - points[v];
        const double size = length(chord);
        if (!(to > from && size > 0.0)) {
            return false;
        }
        bool fits = true;
        forPointsBetween(loop, after, from, to, [&](double, Vec2 p) {
            fits = fits && !(std::abs(cross(chord, p - points[v])) > kMaxSagitta * size * size);
        });
        if (!fits) {
            return false;
        }
    }
    return true;
}

std::vector<Vec2> loopOf(const PlanarMesh& mesh, std::size_t loop)
{
    return {mesh.vertices.begin() + mesh.loop_starts[loop], mesh.vertices.begin() + mesh.loop_starts[loop + 1]};
}

/// New places of the vertices of one loop on another.
/// @param first   the loop with which the run of frames began, as many vertices
/// @param points  the loop at its present place
std::optional<std::vector<Vec2>> moveLoop(const std::vector<Vec2>& first, const std::vector<Vec2>& points,
                                          const Loop& loop)
{
    const double area_before = enclosed(points);
    const double area_after = enclosed(loop.points);
    if (!(area_before * area_after > 0.0)) {
        return std::nullopt;
    }
    const double scale = std::sqrt(area_after / area_before);
    const Vec2 from = centroid(points);
    const Vec2 to = centroid(loop.points);
    std::vector<Vec2> moved;
    moved.reserve(points.size());
    for (const Vec2 p : points) {
        moved.push_back(to + scale * (p - from));
    }
    const Curve at_first(first);
    const Curve after(loop.points);
    Places places = placesOf(at_first, Curve(points), after, loop, moved);
    if (!assignCorners(loop, after, places)) {
        return std::nullopt;
    }
    constexpr int kRounds = 6;
    for (int round = 0; round < kRounds; ++round) {
        const bool has_bends = assignBends(loop, after, places);
        if (!has_bends && evenlySpaced(at_first, after, places.values)) {
            break;
        }
        freeCrowded(at_first, after, places);
        even(at_first, after, places);
    }
    (void)assignBends(loop, after, places);
    for (std::size_t v = 0; v < points.size(); ++v) {
        moved[v] = after.at(places.values[v]);
    }
    keepArea(area_after, places.fixed, moved);
    return chordsFit(loop, after, places.values, moved) ? std::optional(moved) : std::nullopt;
}

/// Sine of a triangle's smallest angle; negative if the triangle is turned over.
double smallestSine(const PlanarMesh& mesh, const Triangle& t)
{
    const auto squared = [&](std::uint32_t a, std::uint32_t b) {
        const Vec2 along = mesh.vertices[b] - mesh.vertices[a];
        return dot(along, along);
    };
    const double a = squared(t[0], t[1]);
    const double b = squared(t[1], t[2]);
    const double c = squared(t[2], t[0]);
    // The two longest edges enclose it.
    const double longest = std::max({a * b, b * c, c * a});
    return longest > 0.0 ? doubleArea(mesh, t) / std::sqrt(longest) : 0.0;
}

/// Moves inner vertices at angles that are too small, by a pattern search for places at which the smallest angle around
/// them is largest.
/// @param wanted  angle from which a vertex stays [rad]
void raiseAngles(PlanarMesh& mesh, double wanted)
{
    const double least = std::sin(wanted);
    const std::uint32_t on_rim = mesh.rimVertexCount();
    std::vector<std::vector<std::uint32_t>> around(mesh.vertices.size());
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        for (const std::uint32_t v : mesh.triangles[t]) {
            if (v >= on_rim) {
                around[v].push_back(t);
            }
        }
    }
    // No more is looked at than is needed to know that it is at most `enough`.
    const auto worst = [&](std::uint32_t v, double enough) {
        double sine = 1.0;
        for (const std::uint32_t t : around[v]) {
            sine = std::min(sine, smallestSine(mesh, mesh.triangles[t]));
            if (sine <= enough) {
                break;
            }
        }
        return sine;
    };
    constexpr double kAll = -1.0;                                   // no sine is less
    std::vector<std::uint8_t> is_settled(mesh.vertices.size(), 0);  // 1: nothing around it has moved since it was tried
    // Neighbours make room for one another, so a few passes are needed; each begins with long moves.
    constexpr int kPasses = 16;
    constexpr int kHalvings = 4;
    constexpr int kDirections = 8;
    for (int pass = 0; pass < kPasses; ++pass) {
        bool has_moved = false;
        for (std::uint32_t v = on_rim; v < mesh.vertices.size(); ++v) {
            if (is_settled[v] != 0) {
                continue;
            }
            is_settled[v] = 1;
            double best = worst(v, kAll);
            if (best >= least) {
                continue;
            }
            const Vec2 start = mesh.vertices[v];
            double size = 0.0;
            for (const std::uint32_t t : around[v]) {
                size += std::abs(doubleArea(mesh, mesh.triangles[t]));
            }
            double step = 0.5 * std::sqrt(size / static_cast<double>(around[v].size()));
            for (int halving = 0; halving < kHalvings; ++halving, step *= 0.5) {
                const Vec2 from = mesh.vertices[v];
                Vec2 found = from;
                for (int k = 0; k < kDirections; ++k) {
                    const double angle = 2.0 * std::numbers::pi * k / kDirections;
                    mesh.vertices[v] = from + step * Vec2{std::cos(angle), std::sin(angle)};
                    if (const double there = worst(v, best); there > best) {
                        best = there;
                        found = mesh.vertices[v];
                    }
                }
                mesh.vertices[v] = found;
            }
            if (mesh.vertices[v] != start) {
                has_moved = true;
                for (const std::uint32_t t : around[v]) {
                    for (const std::uint32_t w : mesh.triangles[t]) {
                        is_settled[w] = 0;
                    }
                }
            }
        }
        if (!has_moved) {
            break;
        }
    }
}

/// Finds for every loop of the mesh the loop of the footprint that it becomes.
std::optional<std::vector<const Loop*>> matchingLoops(const PlanarMesh& mesh, const Footprint& footprint)
{
    const std::size_t count = mesh.loopCount();
    if (count != 1 + footprint.holes.size()) {
        return std::nullopt;
    }
    std::vector<const Loop*> found{&footprint.rim};
    std::vector<std::uint8_t> taken(footprint.holes.size(), 0);
    const Vec2 shift = centroid(footprint.rim.points) - centroid(loopOf(mesh, 0));
    for (std::size_t k = 1; k < count; ++k) {
        const Vec2 middle = centroid(loopOf(mesh, k)) + shift;
        std::size_t best = 0;
        double min = std::numeric_limits<double>::infinity();
        for (std::size_t h = 0; h < footprint.holes.size(); ++h) {
            const double away = length(centroid(footprint.holes[h].points) - middle);
            if (away < min) {
                min = away;
                best = h;
            }
        }
        if (taken[best] != 0) {
            return std::nullopt;
        }
        taken[best] = 1;
        found.push_back(&footprint.holes[best]);
    }
    return found;
}

/// Moves the rim of a mesh; inner vertices follow harmonically. Triangles may be turned over.
/// @param rim  new places of the rim's vertices
PlanarMesh moveHarmonically(const PlanarMesh& mesh, const std::vector<Vec2>& rim)
{
    const std::uint32_t on_rim = mesh.rimVertexCount();
    PlanarMesh moved = mesh;
    moved.lattice = {};
    std::copy(rim.begin(), rim.end(), moved.vertices.begin());
    std::vector<Vec3> places;
    places.reserve(mesh.vertices.size());
    for (const Vec2 p : mesh.vertices) {
        places.push_back({p.x, p.y, 0.0});
    }
    Eigen::MatrixX2d moves(static_cast<Eigen::Index>(on_rim), 2);
    for (std::uint32_t v = 0; v < on_rim; ++v) {
        const Vec2 move = rim[v] - mesh.vertices[v];
        moves.row(static_cast<Eigen::Index>(v)) << move.x, move.y;
    }
    const Eigen::MatrixX2d inside = harmonic(places, mesh.triangles, moves);
    for (Eigen::Index i = 0; i < inside.rows(); ++i) {
        Vec2& vertex = moved.vertices[on_rim + static_cast<std::size_t>(i)];
        vertex = vertex + Vec2{inside(i, 0), inside(i, 1)};
    }
    return moved;
}

bool isWhole(const PlanarMesh& mesh)
{
    return std::all_of(mesh.triangles.begin(), mesh.triangles.end(),
                       [&](const Triangle& t) { return doubleArea(mesh, t) > 0.0; });
}

}  // namespace

PlanarMesh movableCover(const PlanarMesh& mesh)
{
    PlanarMesh split = cover(mesh);
    std::vector<std::uint32_t> next(split.rimVertexCount());
    for (std::size_t loop = 0; loop < split.loopCount(); ++loop) {
        for (std::uint32_t v = split.loop_starts[loop]; v < split.loop_starts[loop + 1]; ++v) {
            next[v] = nextOnRim(split, loop, v);
        }
    }
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle_of = [&](std::uint32_t a, std::uint32_t b) -> std::optional<std::uint32_t> {
        if (a >= next.size() || b >= next.size() || next[a] == b || next[b] == a) {
            return std::nullopt;
        }
        const auto [found, is_new] =
            middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(split.vertices.size()));
        if (is_new) {
            split.vertices.push_back(0.5 * (split.vertices[a] + split.vertices[b]));
        }
        return found->second;
    };
    const auto is_middle = [first = split.vertices.size()](std::uint32_t v) { return v >= first; };
    const std::vector<Triangle> whole = std::exchange(split.triangles, {});
    split.triangles.reserve(2 * whole.size());
    for (const Triangle& t : whole) {
        // What is left of the triangle while corners beside a middle are cut off.
        std::vector<std::uint32_t> left;
        left.reserve(6);
        for (std::size_t k = 0; k < 3; ++k) {
            left.push_back(t[k]);
            if (const auto middle = middle_of(t[k], t[(k + 1) % 3])) {
                left.push_back(*middle);
            }
        }
        for (std::size_t k = 0; left.size() > 3;) {
            const std::uint32_t before = left[(k + left.size() - 1) % left.size()];
            const std::uint32_t after = left[(k + 1) % left.size()];
            if (!is_middle(left[k]) && (is_middle(before) || is_middle(after))) {
                split.triangles.push_back({before, left[k], after});
                left.erase(left.begin() + static_cast<std::ptrdiff_t>(k));
            } else {
                ++k;
            }
            k %= left.size();
        }
        split.triangles.push_back({left[0], left[1], left[2]});
    }
    return split;
}

std::optional<PlanarMesh> moveRim(const PlanarMesh& mesh, const std::vector<Vec2>& rim)
{
    if (rim.size() != mesh.rimVertexCount()) {
        throw Error(ErrorCode::InvalidArgument, fmt::format("rim has {} vertices, must have {} as the mesh's rim",
                                                            rim.size(), mesh.rimVertexCount()));
    }
    PlanarMesh moved = moveHarmonically(mesh, rim);
    if (!isWhole(moved)) {
        constexpr double kWhole = 2.0 * kDegree;  // covers have any angles: what matters is that it is positive
        raiseAngles(moved, kWhole);
    }
    return isWhole(moved) ? std::optional(std::move(moved)) : std::nullopt;
}

std::optional<PlanarMesh> follow(const PlanarMesh& first, const PlanarMesh& last, const Footprint& footprint,
                                 double angles)
{
    if (first.vertices.size() != last.vertices.size() || first.loop_starts != last.loop_starts ||
        first.triangles != last.triangles) {
        throw Error(ErrorCode::InvalidArgument, "first and last must have the same loops and triangles");
    }
    const std::optional<std::vector<const Loop*>> loops = matchingLoops(last, footprint);
    const double stretch = std::sqrt(area(footprint) / area(first));
    if (!loops || !(stretch <= kMaxStretch && stretch >= 1.0 / kMaxStretch)) {
        return std::nullopt;
    }
    std::vector<Vec2> rim;
    for (std::size_t k = 0; k < loops->size(); ++k) {
        const std::optional<std::vector<Vec2>> moved = moveLoop(loopOf(first, k), loopOf(last, k), *(*loops)[k]);
        if (!moved) {
            return std::nullopt;
        }
        rim.insert(rim.end(), moved->begin(), moved->end());
    }
    const auto is_good = [](const PlanarMesh& mesh, double angle) { return isWhole(mesh) && minAngle(mesh) >= angle; };
    const double wanted = angles > 0.0 ? kMinAngle : 0.0;
    const double first_angle = minAngle(first);
    const double least_angle = first_angle >= kMinAngle ? wanted : angles * first_angle;
    PlanarMesh mesh = moveHarmonically(first, rim);
    if (is_good(mesh, wanted)) {
        return mesh;
    }
    for (const PlanarMesh* from : {&first, &last}) {
        mesh = moveHarmonically(*from, rim);
        // More than is needed, so that the angles beside a small one make room for it.
        constexpr double kRoom = 1.7;
        raiseAngles(mesh, kRoom * wanted);
        if (is_good(mesh, least_angle)) {
            return mesh;
        }
    }
    return std::nullopt;
}

}  // namespace droplet
