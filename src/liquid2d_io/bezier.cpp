// SPDX-License-Identifier: GPL-3.0-or-later
// Schneider: An algorithm for automatically fitting digitized curves. Graphics Gems, 1990.
#include "bezier.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include "plain_length.h"
#include "unit_vector.h"

namespace droplet {
namespace {

/// Turn that makes a corner, between the directions to the places at the reach before and after it.
constexpr double kCorner = std::numbers::pi / 3.0;

/// Reach of a corner, in tolerances.
constexpr double kReach = 5.0;

/// Greatest distance of neighbouring points, in tolerances: a curve is compared with points.
constexpr double kStep = 4.0;

/// Newton steps for the points' parameters.
constexpr int kRounds = 4;
constexpr Vec2 kRight{1.0, 0.0};  // direction where there is none

using Curve = std::array<Vec2, 4>;

Vec2 at(const Curve& c, double t)
{
    const double s = 1.0 - t;
    return s * s * s * c[0] + 3.0 * s * s * t * c[1] + 3.0 * s * t * t * c[2] + t * t * t * c[3];
}

std::vector<double> chordLengths(std::span<const Vec2> points)
{
    std::vector<double> t(points.size());
    for (std::size_t i = 1; i < points.size(); ++i) {
        t[i] = t[i - 1] + length(points[i] - points[i - 1]);
    }
    for (double& value : t) {
        value /= t.back() > 0.0 ? t.back() : 1.0;
    }
    return t;
}

/// Curve with given tangents at its ends that is nearest to the points at their parameters.
Curve fitted(std::span<const Vec2> points, const std::vector<double>& t, Vec2 leaving, Vec2 arriving)
{
    const Vec2 first = points.front();
    const Vec2 last = points.back();
    double c00 = 0.0;
    double c01 = 0.0;
    double c11 = 0.0;
    double x0 = 0.0;
    double x1 = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double u = t[i];
        const double v = 1.0 - u;
        const double b1 = 3.0 * v * v * u;
        const double b2 = 3.0 * v * u * u;
        const Vec2 rest = points[i] - ((v * v * v + b1) * first + (u * u * u + b2) * last);
        const Vec2 a0 = b1 * leaving;
        const Vec2 a1 = b2 * arriving;
        c00 += dot(a0, a0);
        c01 += dot(a0, a1);
        c11 += dot(a1, a1);
        x0 += dot(a0, rest);
        x1 += dot(a1, rest);
    }
    const double chord = length(last - first);
    const double determinant = c00 * c11 - c01 * c01;
    double alpha = chord / 3.0;
    double beta = alpha;
    if (std::abs(determinant) > 1e-12 * c00 * c11) {
        alpha = (x0 * c11 - x1 * c01) / determinant;
        beta = (c00 * x1 - c01 * x0) / determinant;
    }
    // Handles that point back, or reach beyond the other end, make loops.
    if (!(alpha > 1e-3 * chord) || !(beta > 1e-3 * chord) || alpha + beta > 3.0 * chord) {
        alpha = beta = chord / 3.0;
    }
    return {first, first + alpha * leaving, last + beta * arriving, last};
}

/// Better parameters of the points: one step of Newton's method each.
void improve(const Curve& c, std::span<const Vec2> points, std::vector<double>& t)
{
    for (std::size_t i = 1; i + 1 < points.size(); ++i) {
        const double u = t[i];
        const double v = 1.0 - u;
        const Vec2 away = at(c, u) - points[i];
        const Vec2 slope = 3.0 * v * v * (c[1] - c[0]) + 6.0 * v * u * (c[2] - c[1]) + 3.0 * u * u * (c[3] - c[2]);
        const Vec2 bend = 6.0 * v * (c[2] - 2.0 * c[1] + c[0]) + 6.0 * u * (c[3] - 2.0 * c[2] + c[1]);
        const double down = dot(slope, slope) + dot(away, bend);
        if (down > 0.0) {
            t[i] = std::clamp(u - dot(away, slope) / down, 0.0, 1.0);
        }
    }
}

struct Worst {
    double distance = 0.0;
    std::size_t index = 0;  ///< of an inner point
};

/// Bound of the distance between curve and polyline, in both directions.
///
/// From a parameter to the next, the polyline's place moves linearly, and the curve leaves the line between its two
/// places by no more than an eighth of the square of the interval times the greatest second derivative.
Worst worstOf(const Curve& c, std::span<const Vec2> points, const std::vector<double>& t)
{
    const double bend = 6.0 * std::max(length(c[2] - 2.0 * c[1] + c[0]), length(c[3] - 2.0 * c[2] + c[1]));
    Worst worst{0.0, points.size() / 2};
    double before = 0.0;
    for (std::size_t i = 1; i < points.size(); ++i) {
        const double interval = t[i] - t[i - 1];
        if (interval < 0.0) {
            // The curve passes the points in another order.
            return {std::numeric_limits<double>::infinity(), points.size() / 2};
        }
        const double after = plainLength(at(c, t[i]) - points[i]);
        const double distance = std::max(before, after) + 0.125 * interval * interval * bend;
        if (distance > worst.distance) {
            const bool is_inner = i + 1 < points.size();
            worst = {distance, is_inner && (after > before || i == 1) ? i : i - 1};
        }
        before = after;
    }
    return worst;
}

class Fitter {
public:
    explicit Fitter(double tolerance) : tolerance_(tolerance) {}

    void fit(std::span<const Vec2> points, Vec2 leaving, Vec2 arriving)
    {
        if (points.size() == 2) {
            // A curve is within the hull of its control points, hence no farther from the side than they are.
            const double reach = std::min(length(points[1] - points[0]) / 3.0, tolerance_);
            curves.push_back({points[0] + reach * leaving, points[1] + reach * arriving, points[1]});
            return;
        }
        std::vector<double> t = chordLengths(points);
        Curve curve = fitted(points, t, leaving, arriving);
        Worst worst = worstOf(curve, points, t);
        // Newton's method helps if the first curve is near.
        for (int round = 0; round < kRounds && worst.distance > tolerance_ && worst.distance < 4.0 * tolerance_;
             ++round) {
            improve(curve, points, t);
            curve = fitted(points, t, leaving, arriving);
            worst = worstOf(curve, points, t);
        }
        if (worst.distance <= tolerance_) {
            curves.push_back({curve[1], curve[2], curve[3]});
            return;
        }
        const std::size_t k = worst.index;
        const Vec2 along = unit(points[k + 1] - points[k - 1], kRight);
        fit(points.first(k + 1), leaving, -1.0 * along);
        fit(points.subspan(k), along, arriving);
    }

    std::vector<BezierCurve> curves;

private:
    double tolerance_;
};

/// Closed polyline with points in between where neighbours are farther apart than the step, without repeated points.
std::vector<Vec2> subdivided(const std::vector<Vec2>& points, double step)
{
    std::vector<Vec2> result;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Vec2 a = points[i];
        const Vec2 side = points[(i + 1) % points.size()] - a;
        const double size = length(side);
        if (!(size > 0.0)) {
            continue;
        }
        const auto parts = static_cast<std::size_t>(std::ceil(size / step));
        for (std::size_t part = 0; part < parts; ++part) {
            result.push_back(a + (static_cast<double>(part) / static_cast<double>(parts)) * side);
        }
    }
    return result;
}

/// Closed polyline by the length along it.
class Rim {
public:
    explicit Rim(const std::vector<Vec2>& points) : points_(points), along_(points.size() + 1)
    {
        for (std::size_t i = 0; i < points.size(); ++i) {
            along_[i + 1] = along_[i] + length(points[(i + 1) % points.size()] - points[i]);
        }
    }

    [[nodiscard]] double perimeter() const { return along_.back(); }

    /// Turn at a point, between the directions to the places at the reach before and after it [rad].
    [[nodiscard]] double turn(std::size_t i, double reach) const
    {
        const Vec2 before = points_[i] - placeAt(along_[i] - reach);
        const Vec2 after = placeAt(along_[i] + reach) - points_[i];
        return std::abs(std::atan2(cross(before, after), dot(before, after)));
    }

    /// Length from a point forward to another one.
    [[nodiscard]] double between(std::size_t from, std::size_t to) const
    {
        const double way = along_[to] - along_[from];
        return way < 0.0 ? way + perimeter() : way;
    }

private:
    [[nodiscard]] Vec2 placeAt(double length_along) const
    {
        const double s = length_along - std::floor(length_along / perimeter()) * perimeter();
        const auto next = std::upper_bound(along_.begin() + 1, along_.end() - 1, s);
        const auto i = static_cast<std::size_t>(next - along_.begin()) - 1;
        const double size = along_[i + 1] - along_[i];
        const double part = size > 0.0 ? (s - along_[i]) / size : 0.0;
        return points_[i] + part * (points_[(i + 1) % points_.size()] - points_[i]);
    }

    const std::vector<Vec2>& points_;
    std::vector<double> along_;  ///< length from the first point to each point, and the perimeter
};

/// Points where the turn is greater than a corner's, and greatest within the reach.
std::vector<std::size_t> cornersOf(const std::vector<Vec2>& points, double tolerance)
{
    const Rim rim(points);
    // A circle turns by 45° over twice an eighth of its perimeter, so that no circle has corners, however small.
    const double reach = std::min(kReach * tolerance, 0.125 * rim.perimeter());
    const std::size_t count = points.size();
    std::vector<double> turn(count);
    for (std::size_t i = 0; i < count; ++i) {
        turn[i] = rim.turn(i, reach);
    }
    std::vector<std::size_t> corners;
    for (std::size_t i = 0; i < count; ++i) {
        bool is_greatest = turn[i] > kCorner;
        for (std::size_t k = (i + 1) % count; is_greatest && k != i && rim.between(i, k) <= reach;
             k = (k + 1) % count) {
            is_greatest = turn[i] > turn[k];
        }
        for (std::size_t k = (i + count - 1) % count; is_greatest && k != i && rim.between(k, i) <= reach;
             k = (k + count - 1) % count) {
            is_greatest = turn[i] >= turn[k];
        }
        if (is_greatest) {
            corners.push_back(i);
        }
    }
    return corners;
}

}  // namespace

BezierPath fitBezier(const std::vector<Vec2>& polyline, double tolerance)
{
    const std::vector<Vec2> points = subdivided(polyline, kStep * tolerance);
    const std::size_t count = points.size();
    BezierPath path;
    if (count < 2) {
        // All points are at one place.
        path.start = polyline.front();
        path.curves.push_back({path.start, path.start, path.start});
        return path;
    }
    const auto point = [&](std::size_t k) { return points[k % count]; };
    struct Joint {
        std::size_t index = 0;
        bool is_corner = false;
    };
    std::vector<Joint> joints;
    for (const std::size_t corner : cornersOf(points, tolerance)) {
        joints.push_back({corner, true});
    }
    // A curve cannot go once around: without two corners, points at thirds of the way are joints too.
    if (joints.size() < 2) {
        const std::size_t first = joints.empty() ? 0 : joints.front().index;
        for (std::size_t k = joints.size(); k < std::min<std::size_t>(count, 3); ++k) {
            joints.push_back({(first + k * count / 3) % count, false});
        }
        std::sort(joints.begin(), joints.end(), [](Joint a, Joint b) { return a.index < b.index; });
    }

    path.start = point(joints.front().index);
    Fitter fitter(tolerance);
    for (std::size_t k = 0; k < joints.size(); ++k) {
        const Joint begin = joints[k];
        const Joint end = joints[(k + 1) % joints.size()];
        const std::size_t last = end.index > begin.index ? end.index : end.index + count;
        std::vector<Vec2> piece;
        for (std::size_t i = begin.index; i <= last; ++i) {
            piece.push_back(point(i));
        }
        const auto tangent = [&](Joint joint, bool is_leaving) {
            const Vec2 here = point(joint.index);
            const Vec2 next = point(joint.index + 1);
            const Vec2 previous = point(joint.index + count - 1);
            if (joint.is_corner) {
                return unit(is_leaving ? next - here : previous - here, kRight);
            }
            const Vec2 along = unit(next - previous, kRight);
            return is_leaving ? along : -1.0 * along;
        };
        fitter.fit(piece, tangent(begin, true), tangent(end, false));
    }
    path.curves = std::move(fitter.curves);
    return path;
}

}  // namespace droplet
