// SPDX-License-Identifier: GPL-3.0-or-later
// A flight is a parabola: chords that stray from it by less than floats can tell find the face, the parabola itself the
// time. Only its parts near the surface are followed.
#include "flow/landing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <vector>

#include "rays/nearest.h"
#include "rays/ray_tree.h"

namespace droplet {
namespace {

// Chords stray from the parabola by at most this share of the surface's size.
constexpr double kSagitta = 1e-6;
// Flights are followed in the bounding cube of the surface and this much around it, over half the cube's side.
constexpr double kMargin = 1e-3;
// A flight that ends sooner has not left the surface [s], unless it goes on over another part of it.
constexpr double kShortestFlight = 1e-9;

/// Where a t² + b t + c is 0; infinite or not a number where there are fewer zeros.
std::array<double, 2> zerosOf(const std::array<double, 3>& coefficients)
{
    const auto [a, b, c] = coefficients;
    const double q = -0.5 * (b + std::copysign(std::sqrt(b * b - 4.0 * a * c), b));  // without cancellation
    return {q / a, c / q};
}

}  // namespace

struct Landing::Scene {
    RayTree tree;
    const std::vector<FlowSurface::Face>* faces = nullptr;
    Vec3 middle;
    double size = 0.0;  // half the longest side of the bounding box [m]

    /// A flight, and the face that it left.
    struct Flight {
        const Leg& leg;
        std::uint32_t left = 0;
    };

    /// When the flight meets a face from outside, after it began; empty if it does not.
    [[nodiscard]] std::optional<double> meets(const Flight& flight, std::uint32_t number) const
    {
        const Leg& leg = flight.leg;
        const FlowSurface::Face& face = (*faces)[number];
        const Coordinate above{dot(leg.place - face.corners[0], face.normal), dot(leg.velocity, face.normal),
                               dot(leg.push, face.normal), 0.0};
        const auto time = above.fallsBelowZero(0.0, std::numeric_limits<double>::infinity());
        const bool goes_on = number != flight.left && dot(face.normal, (*faces)[flight.left].normal) > 0.0;
        if (!time || (*time < kShortestFlight && !goes_on)) {
            return std::nullopt;
        }
        const Vec3 place = leg.placeAt(leg.begin + *time);
        // A droplet that is beyond a side without a neighbour, or that it has just left, lands if it comes nearer.
        const Vec3 velocity = leg.velocityAt(leg.begin + *time);
        for (std::size_t k = 0; k < 3; ++k) {
            if ((number == flight.left || face.neighbour[k] == FlowSurface::kNone) &&
                dot(place - face.corners[k], face.inward[k]) < 0.0 && dot(velocity, face.inward[k]) <= 0.0) {
                return std::nullopt;
            }
        }
        return length(place - nearestPoint(place, face.corners)) <= 2.0 * kSagitta * size
                   ? std::optional(leg.begin + *time)
                   : std::nullopt;
    }

    /// Half the side of the cube that flights are followed in [m].
    [[nodiscard]] double reach() const { return (1.0 + kMargin) * size; }

    [[nodiscard]] bool isNear(Vec3 place) const
    {
        const Vec3 p = place - middle;
        return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) <= reach();
    }

    /// When a flight passes a plane of the cube's sides, in order, between its begin and its end.
    [[nodiscard]] std::vector<double> passages(const Leg& flight, double from, double to) const
    {
        std::vector<double> times{from, to};
        const auto add = [&](double place, double speed, double push) {
            for (const double plane : {-reach(), reach()}) {
                for (const double time : zerosOf({0.5 * push, speed, place - plane})) {
                    if (flight.begin + time > from && flight.begin + time < to) {
                        times.push_back(flight.begin + time);
                    }
                }
            }
        };
        const Vec3 p = flight.place - middle;
        add(p.x, flight.velocity.x, flight.push.x);
        add(p.y, flight.velocity.y, flight.push.y);
        add(p.z, flight.velocity.z, flight.push.z);
        std::sort(times.begin(), times.end());
        return times;
    }
};

std::pair<Vec3, Vec3> boxOf(const FlowSurface& surface)
{
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    Vec3 low{kInfinity, kInfinity, kInfinity};
    Vec3 high{-kInfinity, -kInfinity, -kInfinity};
    for (const FlowSurface::Face& face : surface.faces) {
        for (const Vec3 p : face.corners) {
            low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
            high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
        }
    }
    return {low, high};
}

Landing::Landing(const FlowSurface& surface, const std::vector<Corners3>& scaled)
{
    const auto [low, high] = boxOf(surface);
    const double size = 0.5 * std::max({high.x - low.x, high.y - low.y, high.z - low.z});
    scene_.reset(new Scene{RayTree(scaled), &surface.faces, 0.5 * (low + high), size});
}

Landing::~Landing() = default;
Landing::Landing(Landing&& other) noexcept = default;

std::optional<Landing::Hit> Landing::next(const Leg& flight, std::uint32_t left, double from, double to) const
{
    const Scene& s = *scene_;
    const Scene::Flight whole{flight, left};
    const auto meets = [&](std::uint32_t number) { return s.meets(whole, number).has_value(); };
    const double pull = length(flight.push);
    const double chord = pull > 0.0 ? std::sqrt(8.0 * kSagitta * s.size / pull) : to - from;
    const std::vector<double> passages = s.passages(flight, from, to);
    for (std::size_t k = 1; k < passages.size(); ++k) {
        if (!s.isNear(flight.placeAt(std::midpoint(passages[k - 1], passages[k])))) {
            continue;
        }
        double begin = passages[k - 1];
        while (begin < passages[k]) {
            const double end = std::min(std::max(begin + chord, std::nextafter(begin, to)), passages[k]);
            Vec3 p = (1.0 / s.size) * (flight.placeAt(begin) - s.middle);
            if (begin == flight.begin) {
                p = p + (2.0 * kSagitta) * (*s.faces)[left].normal;  // above a part that continues the face
            }
            const Vec3 way = (1.0 / s.size) * (flight.placeAt(end) - s.middle) - p;
            if (const auto number = s.tree.first(p, way, 1.0, std::ref(meets))) {
                const FlowSurface::Face& face = (*s.faces)[*number];
                Hit hit{*s.meets(whole, *number), *number, {}};
                hit.place = nearestPoint(flight.placeAt(hit.time), face.corners);
                return hit;
            }
            begin = end;
        }
    }
    return std::nullopt;
}

std::optional<Landing::Hit> Landing::firstAlong(Vec3 origin, Vec3 direction) const
{
    const Scene& s = *scene_;
    const Vec3 unit = (1.0 / length(direction)) * direction;
    const Vec3 from = (1.0 / s.size) * (origin - s.middle);
    const auto number = s.tree.first(from, unit, std::numeric_limits<double>::infinity());
    if (!number) {
        return std::nullopt;
    }
    const FlowSurface::Face& face = (*s.faces)[*number];
    const double steepness = dot(unit, face.normal);
    const double way = steepness != 0.0 ? dot(face.corners[0] - origin, face.normal) / steepness : 0.0;
    return Hit{0.0, *number, nearestPoint(origin + way * unit, face.corners)};
}

}  // namespace droplet
