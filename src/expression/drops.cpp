// SPDX-License-Identifier: GPL-3.0-or-later
// "Expressive Rendering for 2D Animations of Liquids", section 3: a droplet has a tail along its way. Departures:
//
// - A droplet of several particles is one shape. Its head is the ellipse of the particles' second moments, so that a
//   thread that tears off keeps its form; a small one becomes round soon, as if by surface tension.
// - Equation 1 holds half of the rectangle and no taper, and the paper's spline changes a tail's radius by a seventh
//   at most over the whole range of its slope. Here a tail is a power of the distance from its tip; it leaves the head
//   along a tangent, and the head's radius follows from the area of the shape itself.
//
// All of it happens in a space in which the head is a circle; that space and the plane have the same areas.
#include "drops.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "other_liquid.h"
#include "surface_kernel.h"
#include "unit_vector.h"

namespace droplet {
namespace {

/// Points of a spine.
constexpr std::size_t kPoints = 16;

/// Points of half of an outline: of the head, and of the tail.
constexpr int kHeadPoints = 14;
constexpr int kTailPoints = 18;

/// Time in which a small droplet becomes round [s].
constexpr double kRounding = 0.25;

/// Numbers of particles up to which a droplet becomes round, and from which on it keeps its form.
constexpr double kRound = 8.0;
constexpr double kKept = 16.0;

/// Cosine of the greatest bend of a tail: one that has bounced off a wall ends there.
constexpr double kBend = 0.5;

/// Distance from the middle of a tail at which it ends before other liquid, in spacings: a particle's radius, half of
/// the tail, and a gap as wide as that.
constexpr double kClearance = 1.25;

/// Distance of the places at which a tail is tested for that, in spacings.
constexpr double kSample = 0.2;

/// Direction where there is none.
constexpr Vec2 kRight{1.0, 0.0};

/// Points at equal distances along a polyline.
std::vector<Vec2> resampled(const std::vector<Vec2>& way, double size)
{
    std::vector<Vec2> points{way.front()};
    const double step = size / static_cast<double>(kPoints - 1);
    double missing = step;
    for (std::size_t k = 0; k + 1 < way.size() && points.size() < kPoints; ++k) {
        const Vec2 side = way[k + 1] - way[k];
        const double side_length = length(side);
        double at = missing;
        for (; at <= side_length * (1.0 + 1e-9) && points.size() < kPoints; at += step) {
            points.push_back(way[k] + (at / side_length) * side);
        }
        missing = at - side_length;
    }
    return points;
}

double lengthOf(const std::vector<Vec2>& way)
{
    double sum = 0.0;
    for (std::size_t k = 0; k + 1 < way.size(); ++k) {
        sum += length(way[k + 1] - way[k]);
    }
    return sum;
}

/// Water of a particle that holds air, in areas of a particle: it becomes an eraser gradually.
double waterOf(double air)
{
    return 1.0 - smoothRamp(air, 0.0, kEraserFade);
}

/// Way of a droplet's centroid in the ellipse's space, latest first, as far back as all its particles have been in
/// flight.
std::vector<Vec2> wayOf(const DropMembers& members, const DropEllipse& ellipse, const ExpressionState& state,
                        const ParticleFrame& frame, double flight)
{
    std::vector<Vec2> way;
    for (std::size_t k = 0; k < state.past.size(); ++k) {
        Vec2 centre;
        for (const std::uint32_t i : members.indices) {
            const std::vector<Vec2>& past = state.past[k].position;
            const std::uint32_t id = frame.id[i];
            centre = centre + (id < past.size() ? past[id] : Vec2{std::nan(""), 0.0});
        }
        centre = (1.0 / static_cast<double>(members.indices.size())) * centre;
        if (!std::isfinite(centre.x)) {
            break;
        }
        Vec2 place = ellipse.compressed(centre - ellipse.centre);
        const double age = frame.time - state.past[k].time;
        const bool is_last = age > flight && k > 0;
        if (is_last) {
            const double last_age = frame.time - state.past[k - 1].time;
            place = way.back() + ((flight - last_age) / (age - last_age)) * (place - way.back());
        }
        if (way.size() >= 2 && dot(unit(way[1] - way[0], kRight), unit(place - way.back(), kRight)) < kBend) {
            break;
        }
        way.push_back(place);
        if (is_last) {
            break;
        }
    }
    return way;
}

}  // namespace

DropEllipse ellipseOf(const std::vector<std::uint32_t>& indices, const ParticleFrame& frame)
{
    DropEllipse ellipse;
    const double share = 1.0 / static_cast<double>(indices.size());
    for (const std::uint32_t i : indices) {
        ellipse.centre = ellipse.centre + share * frame.position[i];
    }
    // A disc of the area spacing² has this moment about its diameters.
    const double own = frame.spacing * frame.spacing / (4.0 * std::numbers::pi);
    double xx = own;
    double xy = 0.0;
    double yy = own;
    for (const std::uint32_t i : indices) {
        const Vec2 arm = frame.position[i] - ellipse.centre;
        xx += share * arm.x * arm.x;
        xy += share * arm.x * arm.y;
        yy += share * arm.y * arm.y;
    }
    const double mean = 0.5 * (xx + yy);
    const double apart = std::hypot(0.5 * (xx - yy), xy);
    const double smaller = std::max(mean - apart, own);
    const double angle = 0.5 * std::atan2(2.0 * xy, xx - yy);
    ellipse.axis = {std::cos(angle), std::sin(angle)};
    ellipse.stretch = std::pow((mean + apart) / smaller, 0.25);
    // An ellipse has the area 4π√(det).
    ellipse.fill = own / (share * std::sqrt((mean + apart) * smaller));
    return ellipse;
}

double Teardrop::halfWidth(double along) const
{
    if (length <= head || along <= head * tangent) {
        return std::sqrt(std::max(head * head - along * along, 0.0));
    }
    const double begin = head * tangent;
    const double t = std::min((along - begin) / (length - begin), 1.0);
    return head * std::sqrt(1.0 - tangent * tangent) * std::pow(1.0 - t, exponent);
}

double Teardrop::area() const
{
    if (length <= head) {
        return std::numbers::pi * head * head;
    }
    const double cosine = std::sqrt(1.0 - tangent * tangent);
    return head * head * (0.5 * std::numbers::pi + std::asin(tangent) + tangent * cosine) +
           2.0 * head * cosine * (length - head * tangent) / (exponent + 1.0);
}

Teardrop teardropOf(double radius, double length, double slope)
{
    // p = 2 at the slope 0.7, 0.6 at 0.2, where the tip is blunt, and 6.7 at 1.2, where the tail is a thread.
    const double exponent = 2.0 * std::pow(10.0 / 3.0, 2.0 * (slope - 0.7));
    const auto shape = [&](double head) {
        Teardrop drop{head, length, exponent, 1.0};
        if (length > head) {
            // The tail's slope, −p·w/(L − x), is that of the circle at x = r·s: (p − 1)·r·s² + L·s − p·r = 0.
            const double q = (exponent - 1.0) * head;
            drop.tangent = 2.0 * exponent * head / (length + std::sqrt(length * length + 4.0 * q * exponent * head));
        }
        return drop;
    };
    const double area = std::numbers::pi * radius * radius;
    double low = 0.0;
    double high = radius;
    for (int k = 0; k < 40; ++k) {
        const double middle = 0.5 * (low + high);
        (shape(middle).area() > area ? high : low) = middle;
    }
    return shape(high);
}

std::vector<Vec2> Drop::outline(double spacing) const
{
    const Vec2 ahead = spine.size() > 1 ? unit(spine[0] - spine[1], kRight) : kRight;
    const bool is_disc = !(shape.length > shape.head) || spine.size() < 2;
    const double step = shape.length / static_cast<double>(kPoints - 1);
    // Directions at the points of the spine; between them they turn evenly.
    std::vector<Vec2> forward;
    for (std::size_t k = 0; k < spine.size(); ++k) {
        const Vec2 before = spine[k == 0 ? 0 : k - 1];
        const Vec2 after = spine[std::min(k + 1, spine.size() - 1)];
        forward.push_back(unit(before - after, kRight));
    }
    const auto place = [&](double along, double side) {
        Vec2 middle = -along * ahead;
        Vec2 direction = ahead;
        if (!is_disc && along > 0.0) {
            const double at = std::min(along / step, static_cast<double>(kPoints - 1));
            const auto k = std::min(static_cast<std::size_t>(at), kPoints - 2);
            const double part = at - static_cast<double>(k);
            middle = spine[k] + part * (spine[k + 1] - spine[k]);
            direction = unit(forward[k] + part * (forward[k + 1] - forward[k]), kRight);
        }
        return middle + side * Vec2{-direction.y, direction.x};
    };
    std::vector<Vec2> points;
    const auto add = [&](double along, double side) { points.push_back(ellipse.stretched(place(along, side))); };
    // Along the left side from the nose to the tip, and back on the right.
    const double end = is_disc ? std::numbers::pi : 0.5 * std::numbers::pi + std::asin(shape.tangent);
    const int head_points = is_disc ? 2 * kHeadPoints : kHeadPoints;
    for (int k = 0; k < head_points; ++k) {
        const double angle = end * k / head_points;
        add(-shape.head * std::cos(angle), shape.head * std::sin(angle));
    }
    const auto tail_at = [&](int k) {
        // Denser at the tip, which is blunt if the exponent is less than 1.
        const double left = 1.0 - static_cast<double>(k) / kTailPoints;
        const double begin = shape.head * shape.tangent;
        return shape.length - (shape.length - begin) * left * left;
    };
    for (int k = 0; !is_disc && k < kTailPoints; ++k) {
        add(tail_at(k), shape.halfWidth(tail_at(k)));
    }
    add(is_disc ? shape.head : shape.length, 0.0);
    for (int k = kTailPoints - 1; !is_disc && k >= 0; --k) {
        add(tail_at(k), -shape.halfWidth(tail_at(k)));
    }
    for (int k = head_points - 1; k > 0; --k) {
        const double angle = end * k / head_points;
        add(-shape.head * std::cos(angle), -shape.head * std::sin(angle));
    }
    // Chords and bends of the spine take and give a little area.
    double area = 0.0;
    for (std::size_t k = 0; k < points.size(); ++k) {
        area += 0.5 * cross(points[k], points[(k + 1) % points.size()]);
    }
    const double wanted = water * spacing * spacing;
    const double scale = std::sqrt(wanted / std::max(area, 0.5 * wanted));
    for (Vec2& x : points) {
        x = ellipse.centre + scale * x;
    }
    return points;
}

namespace {

/// Length along a way, up to one, at which it comes near to other liquid. In the ellipse's space.
double freeLength(const std::vector<Vec2>& way, double size, const DropEllipse& ellipse, std::uint32_t own,
                  const OtherLiquid& others, double spacing)
{
    const double step = kSample * spacing;
    double done = 0.0;
    for (std::size_t k = 0; k + 1 < way.size(); ++k) {
        const Vec2 side = way[k + 1] - way[k];
        const double side_length = length(side);
        double at = 0.0;
        while (at < side_length) {
            if (done + at >= size) {
                return size;
            }
            const Vec2 place = ellipse.centre + ellipse.stretched(way[k] + (at / side_length) * side);
            if (others.distance(place, [&](std::uint32_t group) { return group != own; }) < kClearance * spacing) {
                return done + at;
            }
            at += step;
        }
        done += side_length;
    }
    return std::min(done, size);
}

}  // namespace

std::vector<Drop> dropsOf(const ExpressionState& state, const ParticleFrame& frame, const ExpressionOptions& options)
{
    std::map<std::uint32_t, DropMembers> groups;
    for (std::uint32_t i = 0; i < frame.id.size(); ++i) {
        const std::uint32_t id = frame.id[i];
        if (state.group[id] != ExpressionState::kNoGroup) {
            DropMembers& members = groups[state.group[id]];
            members.indices.push_back(i);
            members.is_landed = members.is_landed || state.landed[id] != 0;
        }
    }
    std::vector<Drop> drops;
    if (groups.empty()) {
        return drops;
    }
    const OtherLiquid others(frame, state.group);
    const double own_radius = frame.spacing / std::sqrt(std::numbers::pi);
    for (auto& [name, members] : groups) {
        Drop drop;
        drop.ellipse = ellipseOf(members.indices, frame);
        double flight = state.flight[frame.id[members.indices.front()]];
        for (const std::uint32_t i : members.indices) {
            flight = std::min(flight, state.flight[frame.id[i]]);
        }
        const auto count = static_cast<double>(members.indices.size());
        drop.water = 0.0;
        for (const std::uint32_t i : members.indices) {
            drop.water += waterOf(state.air[frame.id[i]]);
        }
        if (!(drop.water > 0.0)) {
            continue;
        }
        const double kept = std::max(smoothRamp(count, kRound, kKept), smoothRamp(flight / kRounding, 1.0, 0.0));
        drop.ellipse.stretch = std::pow(drop.ellipse.stretch, kept);
        const double radius = own_radius * std::sqrt(drop.water);
        const auto is_liquid = [](std::uint32_t group) { return group == ExpressionState::kNoGroup; };
        drop.is_near = members.is_landed ||
                       std::any_of(members.indices.begin(), members.indices.end(), [&](const std::uint32_t i) {
                           return others.distance(frame.position[i], is_liquid) < others.reach();
                       });
        double size = 0.0;
        if (options.tail_length > 0.0 && flight > 0.0) {
            const std::vector<Vec2> way =
                wayOf(members, drop.ellipse, state, frame, std::min(flight, options.tail_length));
            size = std::min(lengthOf(way), options.max_tail * radius);
            if (size > radius && !members.is_landed) {
                size = freeLength(way, size, drop.ellipse, name, others, frame.spacing);
            }
            if (size > radius && way.size() > 1) {
                drop.spine = resampled(way, size);
                if (drop.spine.size() < kPoints) {
                    drop.spine.push_back(way.back());
                }
            }
        }
        drop.shape = teardropOf(radius, std::max(size, radius), options.tail_slope);
        if (drop.spine.size() < kPoints) {
            drop.spine = {Vec2{}};
            drop.shape = teardropOf(radius, radius, options.tail_slope);
        }
        if (members.is_landed) {
            // A droplet that has landed becomes liquid as its tail goes.
            drop.share = smoothRamp(flight / options.tail_length, 0.0, 1.0);
        }
        drop.members = std::move(members);
        drops.push_back(std::move(drop));
    }
    return drops;
}

}  // namespace droplet
