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
#include <string>
#include <utility>

#include "droplet/error.h"
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

/// Range of the spacing of rim vertices, relative to the old spacing; outside of it, places are evened out further.
constexpr double kMinSpacing = 0.5;
constexpr double kMaxSpacing = 2.0;

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

/// Pairs of a corner of the loop and the bend of the rim that becomes it; each is the other's nearest.
std::vector<std::pair<std::size_t, std::size_t>> cornerPairs(const Loop& loop, const std::vector<Vec2>& moved)
{
    constexpr double kBend = 25.0 * kDegree;  // corners of outlines turn by 35° or more
    const std::size_t count = moved.size();
    std::vector<std::size_t> bends;
    for (std::size_t v = 0; v < count; ++v) {
        const Vec2 in = moved[v] - moved[(v + count - 1) % count];
        const Vec2 out = moved[(v + 1) % count] - moved[v];
        if (std::abs(std::atan2(cross(in, out), dot(in, out))) > kBend) {
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
            if (nearest(moved[v], corners, loop.points) == i) {
                pairs.emplace_back(i, v);
            }
        }
    }
    return pairs;
}

/// Offset of every vertex on the new loop from its share of the length; a rigid motion gives one common offset.
struct Offsets {
    std::vector<double> values;
    std::vector<std::uint8_t> fixed;  ///< 1 at vertices that become corners
};

Offsets offsetsOf(const Curve& before, const Curve& after, const Loop& loop, const std::vector<Vec2>& moved)
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
    Offsets offsets{std::vector<double>(count), std::vector<std::uint8_t>(count, 0)};
    for (std::size_t v = 0; v < count; ++v) {
        const double expected = ratio * before.arc(v) + common;
        const double from = expected - kReach * after.length();
        std::size_t pieces = after.pieceAt(expected + kReach * after.length()) + after.size() - after.pieceAt(from);
        pieces = pieces % after.size() + 1;
        offsets.values[v] = after.nearest(moved[v], from, pieces) - ratio * before.arc(v);
    }
    for (const auto& [corner, v] : cornerPairs(loop, moved)) {
        const double offset = after.arc(corner) - ratio * before.arc(v);
        offsets.values[v] = common + std::remainder(offset - common, after.length());
        offsets.fixed[v] = 1;
    }
    return offsets;
}

/// Whether the spacing of vertices is similar to the old one.
bool evenlySpaced(const Curve& before, const Curve& after, const std::vector<double>& places)
{
    const double ratio = after.length() / before.length();
    for (std::size_t v = 0; v < places.size(); ++v) {
        const double next = v + 1 < places.size() ? places[v + 1] : places[0] + after.length();
        const double spacing = (next - places[v]) / (ratio * (before.arc(v + 1) - before.arc(v)));
        if (!(spacing >= kMinSpacing && spacing <= kMaxSpacing)) {
            return false;
        }
    }
    return true;
}

/// Places of all vertices on the new loop, and which of them become corners.
struct Places {
    std::vector<double> values;
    std::vector<std::uint8_t> fixed;
};

Places placesOf(const Curve& before, const Curve& after, const Loop& loop, const std::vector<Vec2>& moved)
{
    const std::size_t count = moved.size();
    const double ratio = after.length() / before.length();
    Offsets offsets = offsetsOf(before, after, loop, moved);
    Places places{std::vector<double>(count), offsets.fixed};
    const std::size_t max_passes = 16 * count;
    for (std::size_t done = 0, passes = 1;; passes *= 4) {
        for (std::size_t v = 0; v < count; ++v) {
            places.values[v] = ratio * before.arc(v) + offsets.values[v];
        }
        if (done > max_passes || evenlySpaced(before, after, places.values)) {
            return places;
        }
        for (; done < passes; ++done) {
            std::vector<double> evened = offsets.values;
            for (std::size_t v = 0; v < count; ++v) {
                if (offsets.fixed[v] == 0) {
                    evened[v] = 0.25 * (offsets.values[(v + count - 1) % count] + offsets.values[(v + 1) % count]) +
                                0.5 * offsets.values[v];
                }
            }
            offsets.values = std::move(evened);
        }
    }
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
        places.fixed[best] = 1;
        places.values[best] += move;
    }
    return true;
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
        double lap = from - after.wrapped(from);
        for (std::size_t i = after.pieceAt(from) + 1;; ++i) {
            if (i >= after.size()) {
                i -= after.size();
                lap += after.length();
            }
            if (lap + after.arc(i) >= to) {
                break;
            }
            if (std::abs(cross(chord, loop.points[i] - points[v])) > kMaxSagitta * size * size) {
                return false;
            }
        }
    }
    return true;
}

std::vector<Vec2> loopOf(const PlanarMesh& mesh, std::size_t loop)
{
    return {mesh.vertices.begin() + mesh.loop_starts[loop], mesh.vertices.begin() + mesh.loop_starts[loop + 1]};
}

/// New places of the vertices of one loop on another.
std::optional<std::vector<Vec2>> moveLoop(const std::vector<Vec2>& points, const Loop& loop)
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
    const Curve before(points);
    const Curve after(loop.points);
    Places places = placesOf(before, after, loop, moved);
    if (!assignCorners(loop, after, places)) {
        return std::nullopt;
    }
    for (std::size_t v = 0; v < points.size(); ++v) {
        moved[v] = after.at(places.values[v]);
    }
    keepArea(area_after, places.fixed, moved);
    return chordsFit(loop, after, places.values, moved) ? std::optional(moved) : std::nullopt;
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

}  // namespace

PlanarMesh moveRim(const PlanarMesh& mesh, const std::vector<Vec2>& rim)
{
    const std::uint32_t on_rim = mesh.rimVertexCount();
    if (rim.size() != on_rim) {
        throw Error(ErrorCode::InvalidArgument,
                    fmt::format("rim has {} vertices, must have {} as the mesh's rim", rim.size(), on_rim));
    }
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
        const std::optional<std::vector<Vec2>> moved = moveLoop(loopOf(last, k), *(*loops)[k]);
        if (!moved) {
            return std::nullopt;
        }
        rim.insert(rim.end(), moved->begin(), moved->end());
    }
    PlanarMesh mesh = moveRim(first, rim);
    const bool whole = std::all_of(mesh.triangles.begin(), mesh.triangles.end(),
                                   [&](const Triangle& t) { return doubleArea(mesh, t) > 0.0; });
    if (!whole || minAngle(mesh) < std::min(kMinAngle, angles * minAngle(first))) {
        return std::nullopt;
    }
    return mesh;
}

}  // namespace droplet
