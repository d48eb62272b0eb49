// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/places.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace droplet {

std::optional<FlowTerrain::Point> Places::pointOf(const RandomStream& random, std::uint64_t& counter) const
{
    for (std::uint64_t tries = 0; tries < kMaxTries; ++tries) {
        const std::uint64_t i = counter++;
        const FlowTerrain::Point point = terrain.pointAt(random.uniform(2 + 3 * i), random.uniform(3 + 3 * i));
        if (takes(point, random.uniform(4 + 3 * i))) {
            return point;
        }
    }
    return std::nullopt;
}

double Places::share(std::uint64_t seed, std::uint64_t points) const
{
    const RandomStream random(seed, RandomPurpose::Scatter, std::numeric_limits<std::uint64_t>::max());
    std::uint64_t taken = 0;
    for (std::uint64_t i = 0; i < points; ++i) {
        const FlowTerrain::Point point = terrain.pointAt(random.uniform(3 * i), random.uniform(3 * i + 1));
        taken += takes(point, random.uniform(3 * i + 2)) ? 1 : 0;
    }
    return static_cast<double>(taken) / static_cast<double>(points);
}

bool Places::takes(const FlowTerrain::Point& point, double u) const
{
    return (!coverage || u < coverage(point)) && isMet(point) && (inside || isOutside(point));
}

/// Whether rain meets a point first.
bool Places::isMet(const FlowTerrain::Point& point) const
{
    if (!from) {
        return true;
    }
    const Vec3 up = (1.0 / length(*from)) * *from;
    if (!(dot(terrain.surface().faces[point.face].normal, up) > 0.0)) {
        return false;
    }
    const double size = terrain.diameter();
    const std::optional<FlowTerrain::Point> met = terrain.firstAlong(point.place + 2.0 * size * up, -1.0 * up);
    constexpr double kNear = 1e-6;  // the search works with floats
    return met && (met->face == point.face || length(met->place - point.place) <= kNear * size);
}

/// Whether at least a tenth of the rays that leave a point, spread by their cosine, pass the rest of the surface.
bool Places::isOutside(const FlowTerrain::Point& point) const
{
    constexpr int kRays = 40;
    constexpr int kLeast = 4;
    constexpr double kTurn = std::numbers::pi * (3.0 - 2.23606797749979);  // golden angle
    constexpr double kOff = 1e-5;                                          // the search works with floats
    const Vec3 n = terrain.surface().faces[point.face].normal;
    const Vec3 any = cross(n, std::abs(n.x) < 0.9 ? Vec3{1.0, 0.0, 0.0} : Vec3{0.0, 1.0, 0.0});
    const Vec3 left = (1.0 / length(any)) * any;
    const Vec3 ahead = cross(left, n);
    const Vec3 origin = point.place + kOff * terrain.diameter() * n;
    int free = 0;
    for (int k = 0; k < kRays && free < kLeast && free + kRays - k >= kLeast; ++k) {
        // Every few rays are spread over the half ball.
        constexpr int kStride = 13;
        const double out = ((k * kStride) % kRays + 0.5) / kRays;  // square of the sine
        const double turn = kTurn * k;
        const Vec3 ray = std::sqrt(out) * (std::cos(turn) * ahead + std::sin(turn) * left) + std::sqrt(1.0 - out) * n;
        free += terrain.firstAlong(origin, ray) ? 0 : 1;
    }
    return free >= kLeast;
}

}  // namespace droplet
