// SPDX-License-Identifier: GPL-3.0-or-later
// Schneider: An algorithm for automatically fitting digitized curves. Graphics Gems, 1990.
#include "bezier.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

namespace droplet {
namespace {

/// Turn at a point, between the directions to points this far away, that makes it a corner.
constexpr double kCorner = std::numbers::pi / 3.0;
constexpr std::size_t kReach = 2;

/// Newton steps for the points' parameters.
constexpr int kRounds = 4;

Vec2 unit(Vec2 a)
{
    const double size = length(a);
    return size > 0.0 ? (1.0 / size) * a : Vec2{1.0, 0.0};
}

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
    std::size_t index = 0;
};

Worst worstOf(const Curve& c, std::span<const Vec2> points, const std::vector<double>& t)
{
    Worst worst{0.0, points.size() / 2};
    for (std::size_t i = 1; i + 1 < points.size(); ++i) {
        const double distance = length(at(c, t[i]) - points[i]);
        if (distance > worst.distance) {
            worst = {distance, i};
        }
    }
    return worst;
}

class Fitter {
public:
    explicit Fitter(double tolerance) : tolerance_(tolerance) {}

    void fit(std::span<const Vec2> points, Vec2 leaving, Vec2 arriving)
    {
        if (points.size() == 2) {
            const double third = length(points[1] - points[0]) / 3.0;
            curves.push_back({points[0] + third * leaving, points[1] + third * arriving, points[1]});
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
        const Vec2 along = unit(points[k + 1] - points[k - 1]);
        fit(points.first(k + 1), leaving, -1.0 * along);
        fit(points.subspan(k), along, arriving);
    }

    std::vector<BezierCurve> curves;

private:
    double tolerance_;
};

}  // namespace

BezierPath fitBezier(const std::vector<Vec2>& points, double tolerance)
{
    const std::size_t count = points.size();
    const auto point = [&](std::size_t k) { return points[k % count]; };
    // Joints: corners where the turn is greatest nearby, or else three points.
    std::vector<std::size_t> joints;
    std::vector<bool> is_corner;
    if (count > 4 * kReach) {
        std::vector<double> turn(count);
        for (std::size_t i = 0; i < count; ++i) {
            const Vec2 before = point(i) - point(i + count - kReach);
            const Vec2 after = point(i + kReach) - point(i);
            turn[i] = std::abs(std::atan2(cross(before, after), dot(before, after)));
        }
        for (std::size_t i = 0; i < count; ++i) {
            bool is_greatest = turn[i] > kCorner;
            for (std::size_t k = 1; k <= kReach && is_greatest; ++k) {
                is_greatest = turn[i] > turn[(i + k) % count] && turn[i] >= turn[(i + count - k) % count];
            }
            if (is_greatest) {
                joints.push_back(i);
                is_corner.push_back(true);
            }
        }
    }
    for (std::size_t k = 0; joints.size() < 2 && k < 3; ++k) {
        const std::size_t i =
            ((joints.empty() || !is_corner.front() ? 0 : joints.front()) + (k + 1) * count / 3) % count;
        if (std::find(joints.begin(), joints.end(), i) == joints.end()) {
            joints.push_back(i);
            is_corner.push_back(false);
        }
    }
    std::vector<std::size_t> order(joints.size());
    for (std::size_t k = 0; k < order.size(); ++k) {
        order[k] = k;
    }
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return joints[a] < joints[b]; });

    BezierPath path;
    path.start = point(joints[order.front()]);
    Fitter fitter(tolerance);
    for (std::size_t k = 0; k < order.size(); ++k) {
        const std::size_t begin = joints[order[k]];
        const std::size_t next = order[(k + 1) % order.size()];
        const std::size_t end = joints[next] > begin ? joints[next] : joints[next] + count;
        std::vector<Vec2> piece;
        for (std::size_t i = begin; i <= end; ++i) {
            piece.push_back(point(i));
        }
        const auto tangent = [&](std::size_t joint, std::size_t place, bool is_leaving) {
            const std::size_t i = place % count;
            if (is_corner[joint]) {
                return unit(is_leaving ? point(i + 1) - point(i) : point(i + count - 1) - point(i));
            }
            const Vec2 along = unit(point(i + 1) - point(i + count - 1));
            return is_leaving ? along : -1.0 * along;
        };
        fitter.fit(piece, tangent(order[k], begin, true), tangent(next, end, false));
    }
    path.curves = std::move(fitter.curves);
    return path;
}

}  // namespace droplet
