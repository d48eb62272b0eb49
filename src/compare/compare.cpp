// SPDX-License-Identifier: GPL-3.0-or-later
// Quadrature: D. A. Dunavant, "High degree efficient symmetrical Gaussian quadrature rules for the triangle" (1985),
// rule of degree 4. Sides of a surface: J. A. Bærentzen, H. Aanæs, "Signed distance computation using the angle
// weighted pseudonormal" (2005).
//
// All computations use a frame in which both surfaces lie within [−1, 1]³. Its origin is the middle of their bounding
// box, and its scale a power of two, so that scaling has no round-off.
#include "droplet/compare/compare.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <string>

#include "compare/hausdorff.h"
#include "droplet/error.h"
#include "number_text.h"
#include "rays/nearest.h"
#include "surface/half_edges.h"

namespace droplet {
namespace {

constexpr double kSamePlace = 1e-9;  // in the frame; triangles this near to a point meet there
constexpr std::size_t kChunk = 256;  // triangles or vertices per task

struct Box {
    Vec3 lowest;
    Vec3 highest;
};

Box boxAround(const Surface& surface)
{
    Box box{surface.vertices[surface.triangles[0][0]], surface.vertices[surface.triangles[0][0]]};
    for (const Triangle& triangle : surface.triangles) {
        for (const std::uint32_t v : triangle) {
            const Vec3 p = surface.vertices[v];
            box.lowest = {std::min(box.lowest.x, p.x), std::min(box.lowest.y, p.y), std::min(box.lowest.z, p.z)};
            box.highest = {std::max(box.highest.x, p.x), std::max(box.highest.y, p.y), std::max(box.highest.z, p.z)};
        }
    }
    return box;
}

Box boxAround(const Box& a, const Box& b)
{
    return {
        {std::min(a.lowest.x, b.lowest.x), std::min(a.lowest.y, b.lowest.y), std::min(a.lowest.z, b.lowest.z)},
        {std::max(a.highest.x, b.highest.x), std::max(a.highest.y, b.highest.y), std::max(a.highest.z, b.highest.z)}};
}

/// Coordinates in which both surfaces have a size of about 1.
class Frame {
public:
    explicit Frame(const Box& box) : middle_(box.lowest + 0.5 * (box.highest - box.lowest))
    {
        const Vec3 half = 0.5 * (box.highest - box.lowest);
        const double largest = std::max({half.x, half.y, half.z});
        if (!std::isfinite(largest * largest * largest)) {
            throw Error(ErrorCode::InvalidArgument, "the surfaces are too large or too far apart to be compared");
        }
        int exponent = 0;
        std::frexp(largest, &exponent);
        // The inverse of the scale must be finite, too.
        scale_ = largest > 0.0 ? std::ldexp(1.0, std::max(exponent, -1000)) : 1.0;
        size_ = 2.0 * largest / scale_;
    }

    [[nodiscard]] Vec3 in(Vec3 p) const { return (1.0 / scale_) * (p - middle_); }
    [[nodiscard]] Vec3 out(Vec3 p) const { return middle_ + scale_ * p; }
    /// Longest side of the box, in the frame.
    [[nodiscard]] double size() const { return size_; }
    /// Metres per unit of the frame.
    [[nodiscard]] double scale() const { return scale_; }

private:
    Vec3 middle_;
    double scale_ = 1.0;
    double size_ = 0.0;
};

std::vector<Corners3> cornersIn(const Frame& frame, const Surface& surface)
{
    std::vector<Corners3> corners;
    corners.reserve(surface.triangles.size());
    for (const auto& [a, b, c] : surface.triangles) {
        corners.push_back(
            {frame.in(surface.vertices[a]), frame.in(surface.vertices[b]), frame.in(surface.vertices[c])});
    }
    return corners;
}

double angleBetween(Vec3 a, Vec3 b)
{
    return std::atan2(length(cross(a, b)), dot(a, b));  // exact for small angles, unlike acos
}

/// Barycentric coordinates of a point of a triangle; without area, the nearest corner has all weight.
Vec3 weightsAt(Vec3 p, const Corners3& triangle, Vec3 facet)
{
    const auto& [a, b, c] = triangle;
    const double squared = dot(facet, facet);
    if (squared > 0.0) {
        const double at_a = std::clamp(dot(cross(c - b, p - b), facet) / squared, 0.0, 1.0);
        const double at_b = std::clamp(dot(cross(a - c, p - c), facet) / squared, 0.0, 1.0 - at_a);
        return {at_a, at_b, 1.0 - at_a - at_b};
    }
    const double to_a = length(p - a);
    const double to_b = length(p - b);
    const double to_c = length(p - c);
    return to_a <= to_b && to_a <= to_c ? Vec3{1.0, 0.0, 0.0}
           : to_b <= to_c               ? Vec3{0.0, 1.0, 0.0}
                                        : Vec3{0.0, 0.0, 1.0};
}

/// Normal of a surface at a point of a triangle; not of unit length.
Vec3 normalAt(const Surface& surface, std::uint32_t triangle, Vec3 weights, Vec3 facet)
{
    const auto& [a, b, c] = surface.triangles[triangle];
    const Vec3 normal =
        weights.x * surface.normals[a] + weights.y * surface.normals[b] + weights.z * surface.normals[c];
    return dot(normal, normal) > 0.0 ? normal : facet;
}

/// One surface in the frame.
struct Side {
    Side(const Frame& frame, const Surface& its) : surface(its), tree(cornersIn(frame, its)) {}

    [[nodiscard]] Vec3 normal(std::uint32_t triangle, Vec3 p) const
    {
        const Vec3 facet = tree.facet(triangle);
        return normalAt(surface, triangle, weightsAt(p, tree.triangles()[triangle], facet), facet);
    }

    const Surface& surface;
    NearestTriangles tree;
};

/// Smallest angle between a normal and the normals of the other side at a point.
double angleAt(const Side& other, Vec3 normal, const NearestTriangles::Found& found)
{
    double min = angleBetween(normal, other.normal(found.triangle, found.point));
    constexpr double kAlike = 1e-6;  // below it, other normals at the point do not matter
    if (min > kAlike) {
        for (const std::uint32_t triangle : other.tree.within(found.point, kSamePlace)) {
            min = std::min(min, angleBetween(normal, other.normal(triangle, found.point)));
        }
    }
    return min;
}

/// Integrals over a triangle, or many.
struct Sums {
    double area = 0.0;
    double distance = 0.0;
    double distance_squared = 0.0;
    double angle_squared = 0.0;
    double largest_angle = -1.0;
    Vec3 at;

    void add(const Sums& other)
    {
        area += other.area;
        distance += other.distance;
        distance_squared += other.distance_squared;
        angle_squared += other.angle_squared;
        if (other.largest_angle > largest_angle) {
            largest_angle = other.largest_angle;
            at = other.at;
        }
    }
};

struct Node {
    Vec3 weights;
    double share;
};

/// Dunavant's rule of degree 4.
std::array<Node, 6> quadrature()
{
    constexpr double kNear = 0.091576213509770743;
    constexpr double kFar = 0.44594849091596489;
    constexpr double kNearShare = 0.10995174365532187;
    constexpr double kFarShare = 0.22338158967801147;
    std::array<Node, 6> nodes{};
    std::size_t count = 0;
    for (const auto& [a, share] : {std::pair(kNear, kNearShare), std::pair(kFar, kFarShare)}) {
        nodes[count++] = {{a, a, 1.0 - 2.0 * a}, share};
        nodes[count++] = {{a, 1.0 - 2.0 * a, a}, share};
        nodes[count++] = {{1.0 - 2.0 * a, a, a}, share};
    }
    return nodes;
}

struct IntegralOptions {
    double reach = 0.0;    ///< largest distance of a triangle that faces the same way
    double longest = 0.0;  ///< longest side of a triangle that is not cut
};

using Halves = std::array<Corners3, 2>;

/// Triangle, cut at the middle of its longest side; empty if that is short enough.
std::optional<Halves> halved(const Corners3& corners, double short_enough)
{
    std::size_t longest = 0;
    double size = -1.0;
    for (std::size_t k = 0; k < 3; ++k) {
        const double side = length(corners[(k + 1) % 3] - corners[k]);
        constexpr double kTie = 1.0 + 1e-9;  // round-off must not choose between sides of equal length
        if (side > kTie * size) {
            size = side;
            longest = k;
        }
    }
    if (!(size > short_enough)) {
        return std::nullopt;
    }
    const Vec3 a = corners[longest];
    const Vec3 b = corners[(longest + 1) % 3];
    const Vec3 c = corners[(longest + 2) % 3];
    const Vec3 middle = 0.5 * (a + b);
    return Halves{Corners3{a, middle, c}, Corners3{middle, b, c}};
}

/// Number of pieces of a triangle, up to a limit.
std::size_t countPieces(const Corners3& corners, double longest, std::size_t limit)
{
    const std::optional<Halves> halves = limit > 1 ? halved(corners, longest) : std::nullopt;
    if (!halves) {
        return 1;
    }
    const std::size_t first = countPieces((*halves)[0], longest, limit - 1);
    return first >= limit ? first : first + countPieces((*halves)[1], longest, limit - first);
}

/// Limit of pieces: a constant, and a number per triangle of both surfaces.
constexpr std::size_t kPieces = std::size_t{1} << 14;
constexpr std::size_t kPiecesOfTriangle = 16;

/// Longest side that is not cut. It grows until the number of pieces is in the limit: damaged files may have many large
/// triangles that intersect each other.
double longestSide(const std::vector<Corners3>& triangles, double longest, std::size_t max)
{
    for (;; longest *= 2.0) {
        std::size_t count = 0;
        for (const Corners3& triangle : triangles) {
            count += countPieces(triangle, longest, max + 1 - count);
            if (count > max) {
                break;
            }
        }
        if (count <= max) {
            return longest;
        }
    }
}

/// Integrals of distances and angles over triangles of one side.
class Integrator {
public:
    Integrator(const Side& side, const Side& other, const IntegralOptions& options)
        : side_(side), other_(other), options_(options)
    {
    }

    [[nodiscard]] Sums over(std::uint32_t triangle) const
    {
        Sums sums;
        const Corners3& corners = side_.tree.triangles()[triangle];
        std::uint32_t guess = 0;
        if (length(side_.tree.facet(triangle)) > 0.0) {
            overPiece(triangle, corners, guess, sums);
        }
        return sums;
    }

private:
    void overPiece(std::uint32_t triangle, const Corners3& corners, std::uint32_t& guess, Sums& sums) const
    {
        if (const std::optional<Halves> halves = halved(corners, options_.longest)) {
            overPiece(triangle, (*halves)[0], guess, sums);
            overPiece(triangle, (*halves)[1], guess, sums);
            return;
        }
        const auto& [a, b, c] = corners;
        const double area = 0.5 * length(cross(b - a, c - a));
        static const std::array<Node, 6> nodes = quadrature();
        for (const Node& node : nodes) {
            const Vec3 p = node.weights.x * a + node.weights.y * b + node.weights.z * c;
            const NearestTriangles::Found found = other_.tree.nearest(p, guess);
            guess = found.triangle;
            const double angle = angleFrom(triangle, p, found);
            const double weight = node.share * area;
            sums.distance += weight * found.distance;
            sums.distance_squared += weight * found.distance * found.distance;
            sums.angle_squared += weight * angle * angle;
            if (angle > sums.largest_angle) {
                sums.largest_angle = angle;
                sums.at = p;
            }
        }
        sums.area += area;
    }

    [[nodiscard]] double angleFrom(std::uint32_t triangle, Vec3 p, const NearestTriangles::Found& found) const
    {
        const Vec3 normal = side_.normal(triangle, p);
        const Vec3 facet = side_.tree.facet(triangle);
        if (!(dot(other_.tree.facet(found.triangle), facet) > 0.0)) {
            if (const auto facing = other_.tree.nearestFacing(p, facet, options_.reach)) {
                return angleAt(other_, normal, *facing);
            }
        }
        return angleAt(other_, normal, found);
    }

    const Side& side_;
    const Side& other_;
    IntegralOptions options_;
};

Sums integrals(const Side& side, const Side& other, const IntegralOptions& options)
{
    const Integrator integrator(side, other, options);
    const std::size_t count = side.tree.triangles().size();
    std::vector<Sums> sums(count);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, kChunk), [&](const auto& range) {
        for (std::size_t t = range.begin(); t < range.end(); ++t) {
            sums[t] = integrator.over(static_cast<std::uint32_t>(t));
        }
    });
    Sums total;
    for (const Sums& one : sums) {
        total.add(one);
    }
    return total;
}

/// Contact angles along the rim. Its edges belong to triangles with two vertices on the rim and one inside, because no
/// inner edge joins two rim vertices.
std::optional<ContactAngleRange> contactAngles(const Surface& surface)
{
    std::optional<ContactAngleRange> range;
    double around = 0.0;
    double sum = 0.0;
    for (const Triangle& triangle : surface.triangles) {
        if (surface.contact_angle.empty()) {
            break;
        }
        const auto on_rim = [&](std::size_t k) { return surface.contact_angle[triangle[k % 3]] != 0.0F; };
        for (std::size_t k = 0; k < 3; ++k) {
            if (on_rim(k) && on_rim(k + 1) && !on_rim(k + 2)) {
                const std::uint32_t v = triangle[k];
                const std::uint32_t w = triangle[(k + 1) % 3];
                const auto at_v = static_cast<double>(surface.contact_angle[v]);
                const auto at_w = static_cast<double>(surface.contact_angle[w]);
                const double edge = length(surface.vertices[w] - surface.vertices[v]);
                around += edge;
                sum += edge * 0.5 * (at_v + at_w);
                if (!range) {
                    range = ContactAngleRange{at_v, 0.0, at_v};
                }
                range->min = std::min({range->min, at_v, at_w});
                range->max = std::max({range->max, at_v, at_w});
            }
        }
    }
    if (range) {
        range->mean = around > 0.0 ? sum / around : 0.5 * (range->min + range->max);
    }
    return range;
}

SurfaceMeasures measured(const Surface& surface, const Box& box)
{
    SurfaceMeasures result;
    result.vertices = surface.vertices.size();
    result.triangles = surface.triangles.size();
    result.lowest = box.lowest;
    result.highest = box.highest;
    for (const auto& [a, b, c] : surface.triangles) {
        const Vec3 origin = surface.vertices[a];
        result.area += 0.5 * length(cross(surface.vertices[b] - origin, surface.vertices[c] - origin));
    }
    result.volume = enclosedVolume(surface);
    result.topology = topology(halfEdges(surface));
    result.contact_angle = contactAngles(surface);
    return result;
}

bool sameTopology(const Topology& a, const Topology& b)
{
    return a.manifold == b.manifold && a.closed == b.closed && a.euler == b.euler && a.components == b.components &&
           a.boundary_loops == b.boundary_loops;
}

void check(const CompareOptions& options)
{
    const auto refuse = [](const std::string& what) {
        throw Error(ErrorCode::InvalidArgument, "compare options: " + what);
    };
    if (!(options.share > 0.0 && options.share < 1.0)) {
        refuse("share = " + numberText(options.share) + " must be more than 0 and less than 1");
    }
    if (options.tolerance && !(*options.tolerance >= 0.0 && std::isfinite(*options.tolerance))) {
        refuse("tolerance = " + numberText(*options.tolerance) + " must be finite and not negative");
    }
}

SurfaceDistance distanceOf(const HausdorffBounds& bounds, const Sums& sums, const Frame& frame)
{
    SurfaceDistance result;
    result.lower = frame.scale() * bounds.lower;
    result.upper = frame.scale() * bounds.upper;
    result.at = frame.out(bounds.at);
    result.nearest = frame.out(bounds.nearest);
    if (sums.area > 0.0) {
        result.mean = frame.scale() * (sums.distance / sums.area);
        result.rms = frame.scale() * std::sqrt(sums.distance_squared / sums.area);
    }
    return result;
}

NormalDeviation deviationOf(const Sums& sums, const Frame& frame)
{
    NormalDeviation result;
    if (sums.area > 0.0) {
        result.largest = sums.largest_angle;
        result.rms = std::sqrt(sums.angle_squared / sums.area);
        result.at = frame.out(sums.at);
    }
    return result;
}

/// Angle of a triangle around a point: that of a corner, π on a side, 2π inside.
double angleAround(Vec3 p, const Corners3& triangle)
{
    for (std::size_t k = 0; k < 3; ++k) {
        if (length(p - triangle[k]) <= kSamePlace) {
            return angleBetween(triangle[(k + 1) % 3] - triangle[k], triangle[(k + 2) % 3] - triangle[k]);
        }
    }
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 side = triangle[(k + 1) % 3] - triangle[k];
        if (length(cross(side, p - triangle[k])) <= kSamePlace * length(side)) {
            return std::numbers::pi;
        }
    }
    return 2.0 * std::numbers::pi;
}

}  // namespace

std::optional<double> Comparison::relativeVolume() const
{
    return a.volume != 0.0 ? std::optional((b.volume - a.volume) / std::abs(a.volume)) : std::nullopt;
}

Comparison compare(const Surface& a, const Surface& b, const CompareOptions& options)
{
    a.validate();
    b.validate();
    check(options);
    const Box box_a = boxAround(a);
    const Box box_b = boxAround(b);
    const Frame frame(boxAround(box_a, box_b));
    const Side side_a(frame, a);
    const Side side_b(frame, b);

    HausdorffOptions search;
    search.share = options.share;
    const std::size_t enough = kPieces + kPiecesOfTriangle * (a.triangles.size() + b.triangles.size());
    search.max_pieces = std::min(options.max_pieces, enough);
    if (options.tolerance) {
        search.tolerance = *options.tolerance / frame.scale();
    }
    const HausdorffBounds from_a = hausdorff(side_a.tree.triangles(), side_b.tree, search);
    const HausdorffBounds from_b = hausdorff(side_b.tree.triangles(), side_a.tree, search);
    constexpr double kLongest = 1.0 / 25.0;  // share of the box around both
    const double reach = 2.0 * std::max(from_a.upper, from_b.upper) + kSamePlace;
    const auto integral = [&](const Side& side, const Side& other) {
        return integrals(side, other, {reach, longestSide(side.tree.triangles(), kLongest * frame.size(), enough)});
    };
    const Sums over_a = integral(side_a, side_b);
    const Sums over_b = integral(side_b, side_a);
    // Sums of both, which do not depend on the order.
    Sums over_both;
    over_both.area = over_a.area + over_b.area;
    over_both.distance = over_a.distance + over_b.distance;
    over_both.distance_squared = over_a.distance_squared + over_b.distance_squared;
    over_both.angle_squared = over_a.angle_squared + over_b.angle_squared;

    Comparison result;
    result.a = measured(a, box_a);
    result.b = measured(b, box_b);
    result.from_a = distanceOf(from_a, over_a, frame);
    result.from_b = distanceOf(from_b, over_b, frame);
    result.symmetric = distanceOf(from_a.lower >= from_b.lower ? from_a : from_b, over_both, frame);
    result.symmetric.upper = std::max(result.from_a.upper, result.from_b.upper);
    result.normals_of_a = deviationOf(over_a, frame);
    result.normals_of_b = deviationOf(over_b, frame);
    result.normals =
        result.normals_of_a.largest >= result.normals_of_b.largest ? result.normals_of_a : result.normals_of_b;
    result.normals.rms = over_both.area > 0.0 ? std::sqrt(over_both.angle_squared / over_both.area) : 0.0;
    result.same_topology = sameTopology(result.a.topology, result.b.topology);
    return result;
}

std::vector<double> signedDistances(const Surface& a, const Surface& b)
{
    a.validate();
    b.validate();
    Box box_a{a.vertices[0], a.vertices[0]};
    for (const Vec3 p : a.vertices) {
        box_a = boxAround(box_a, {p, p});
    }
    const Frame frame(boxAround(box_a, boxAround(b)));
    const NearestTriangles tree(cornersIn(frame, b));
    std::vector<double> distances(a.vertices.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, distances.size(), kChunk), [&](const auto& range) {
        std::uint32_t guess = 0;
        for (std::size_t v = range.begin(); v < range.end(); ++v) {
            const Vec3 p = frame.in(a.vertices[v]);
            const NearestTriangles::Found found = tree.nearest(p, guess);
            guess = found.triangle;
            Vec3 normal;
            for (const std::uint32_t triangle : tree.within(found.point, kSamePlace)) {
                const Vec3 facet = tree.facet(triangle);
                const double size = length(facet);
                if (size > 0.0) {
                    normal = normal + (angleAround(found.point, tree.triangles()[triangle]) / size) * facet;
                }
            }
            const double distance = frame.scale() * found.distance;
            distances[v] = dot(p - found.point, normal) < 0.0 ? -distance : distance;
        }
    });
    return distances;
}

}  // namespace droplet
