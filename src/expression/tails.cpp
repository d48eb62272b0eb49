// SPDX-License-Identifier: GPL-3.0-or-later
// "Expressive Rendering for 2D Animations of Liquids", section 3. Departures: equation 1 holds half of the rectangle
// and no taper, so the head's radius follows from the area of the tapering body itself; and the tails of a droplet of
// several particles lead to one tip.
#include "tails.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "surface_kernel.h"

namespace droplet {
namespace {

/// Points of a skeleton.
constexpr std::size_t kPoints = 12;

/// Distance of a particle from the middle of its droplet, in radii of the droplet, from which on tails get shorter;
/// they are gone at twice that. A row of three particles has 1.1, one of five 1.7. At 1.5 tails of torn sheets pop.
constexpr double kCompact = 1.25;

/// Length of a tail, in radii of its droplet, below which it is none.
constexpr double kLeastTail = 0.05;

/// Area of discs along a straight skeleton and the strips between them, over the square of the head's radius.
/// @param length  of the skeleton, in radii of the head
double sweptArea(double length, const Taper& taper)
{
    constexpr int kSteps = 40;
    const double begin = -1.0;
    const double end = length + taper(1.0);
    double area = 0.0;
    for (int k = 0; k < kSteps; ++k) {
        const double x = begin + (end - begin) * (k + 0.5) / kSteps;
        const double strip = x >= 0.0 && x <= length ? taper(x / length) : 0.0;
        double square = strip * strip;
        for (int m = 0; m <= kSteps; ++m) {
            const double u = static_cast<double>(m) / kSteps;
            const double r = taper(u);
            const double away = x - u * length;
            square = std::max(square, r * r - away * away);
        }
        area += 2.0 * std::sqrt(square) * (end - begin) / kSteps;
    }
    return area;
}

/// Points at equal distances along a polyline of a length at most.
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

}  // namespace

double taper(double along, double slope)
{
    // Cubic Hermite spline from 1 with the tangent −slope to 0 with a zero tangent.
    const double t = along;
    return 1.0 - 3.0 * t * t + 2.0 * t * t * t - slope * (t - 2.0 * t * t + t * t * t);
}

double headRadius(double length, const Taper& taper)
{
    double low = 0.0;
    double high = 1.0;
    for (int k = 0; k < 24; ++k) {
        const double middle = 0.5 * (low + high);
        (middle * middle * sweptArea(length / middle, taper) > std::numbers::pi ? high : low) = middle;
    }
    return 0.5 * (low + high);
}

std::vector<Tail> tailsOf(const ExpressionState& state, const ParticleFrame& frame, const ExpressionOptions& options)
{
    std::vector<Tail> tails(frame.position.size());
    if (!(options.tail_length > 0.0) || !(options.max_tail > 0.0) || state.past.size() < 2) {
        return tails;
    }
    std::map<std::uint32_t, std::vector<std::uint32_t>> bodies;
    for (std::uint32_t i = 0; i < tails.size(); ++i) {
        if (state.flight[frame.id[i]] > 0.0) {
            // Droplets that have landed keep their tails until they are gone.
            bodies[state.group[frame.id[i]]].push_back(i);
        }
    }
    if (bodies.empty()) {
        return tails;
    }
    // Radii of heads by lengths of tails; between the entries they are linear.
    constexpr std::size_t kEntries = 9;
    std::array<double, kEntries> radii{};
    for (std::size_t k = 0; k < kEntries; ++k) {
        radii[k] = headRadius(options.max_tail * static_cast<double>(k) / (kEntries - 1),
                              [&](double along) { return taper(along, options.tail_slope); });
    }
    const auto radius_at = [&](double size) {
        const double place = std::min(size / options.max_tail, 1.0) * (kEntries - 1);
        const auto k = std::min(static_cast<std::size_t>(place), kEntries - 2);
        return radii[k] + (place - static_cast<double>(k)) * (radii[k + 1] - radii[k]);
    };

    const double own_radius = frame.spacing / std::sqrt(std::numbers::pi);
    for (const auto& [name, members] : bodies) {
        // Way of the centroid, as far back as all particles have been in flight.
        double flight = options.tail_length;
        for (const std::uint32_t i : members) {
            flight = std::min(flight, state.flight[frame.id[i]]);
        }
        std::vector<Vec2> way;
        for (std::size_t k = 0; k < state.past.size(); ++k) {
            Vec2 centre;
            for (const std::uint32_t i : members) {
                const std::vector<Vec2>& past = state.past[k].position;
                const std::uint32_t id = frame.id[i];
                centre = centre + (id < past.size() ? past[id] : Vec2{std::nan(""), 0.0});
            }
            centre = (1.0 / static_cast<double>(members.size())) * centre;
            if (!std::isfinite(centre.x)) {
                break;
            }
            const double age = frame.time - state.past[k].time;
            if (age > flight && k > 0) {
                const double last_age = frame.time - state.past[k - 1].time;
                way.push_back(way.back() + ((flight - last_age) / (age - last_age)) * (centre - way.back()));
                break;
            }
            way.push_back(centre);
        }
        const double radius = own_radius * std::sqrt(static_cast<double>(members.size()));
        // Particles that have parted are no droplet any more.
        double spread = 0.0;
        for (const std::uint32_t i : members) {
            spread = std::max(spread, length(frame.position[i] - way.front()));
        }
        const double together = smoothRamp(2.0 - spread / (kCompact * radius), 0.0, 1.0);
        const double size = together * std::min(lengthOf(way), options.max_tail * radius);
        if (!(size > kLeastTail * radius)) {
            continue;
        }
        const std::vector<Vec2> skeleton = resampled(way, size);
        const double shrink = radius_at(size / radius);
        for (const std::uint32_t i : members) {
            Tail& tail = tails[i];
            const Vec2 arm = shrink * (frame.position[i] - skeleton.front());
            for (std::size_t k = 0; k < skeleton.size(); ++k) {
                const double narrow = taper(static_cast<double>(k) / (kPoints - 1), options.tail_slope);
                tail.place.push_back(skeleton[k] + narrow * arm);
                tail.width.push_back(shrink * narrow);
            }
        }
    }
    return tails;
}

}  // namespace droplet
