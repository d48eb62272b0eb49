// SPDX-License-Identifier: GPL-3.0-or-later
//
// A contact line that has come to a sharp edge stays there: on the other side its contact angle, from θ on, would have
// to grow by the angle of the edge (J. W. Gibbs, Trans. Connecticut Acad. 3 (1878) 343; J. F. Oliver, C. Huh and S. G.
// Mason, J. Colloid Interface Sci. 59 (1977) 568). So no droplet at rest has its circle across one. Its points are the
// ends of straight ways over the surface, which turn over at edges. They are compared with the plane through them: on
// one side of an edge, on round ground and on fine roughness, all lie near it.
#include "flow/footing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "unit_vector.h"

namespace droplet {
namespace {

constexpr std::size_t kAround = 16;
constexpr int kMostFaces = 1000;       // of a way; only slivers at a corner have more
constexpr double kMostOff = 0.2;       // of the plane, over the radius: a ridge of 37° under the middle
constexpr double kLeastOff = 0.05;     // a rim that is nearer looks like one on the plane
constexpr double kFlat = 0.642787609;  // cosine of 50°: ground that is steeper is beyond an edge

/// End of a way.
struct Footprint {
    Vec3 place;
    Vec3 normal;
};

/// Straight way over the surface; empty if the surface ends on it.
/// @param direction  unit, along the face
std::optional<Footprint> along(const FlowSurface& surface, const FlowTerrain::Point& from, Vec3 direction, double way)
{
    std::uint32_t face = from.face;
    Vec3 place = from.place;
    for (int passed = 0; passed < kMostFaces; ++passed) {
        const FlowSurface::Face& here = surface.faces[face];
        double nearest = way;
        std::size_t side = 3;
        for (std::size_t k = 0; k < 3; ++k) {
            const double speed = -dot(direction, here.inward[k]);
            const double distance = std::max(0.0, dot(place - here.corners[k], here.inward[k]));
            if (speed > 0.0 && distance < nearest * speed) {
                nearest = distance / speed;
                side = k;
            }
        }
        place = place + nearest * direction;
        way -= nearest;
        if (side == 3) {
            return Footprint{place, here.normal};
        }
        const std::uint32_t next = here.neighbour[side];
        if (next == FlowSurface::kNone) {
            return std::nullopt;
        }
        const FlowSurface::Face& there = surface.faces[next];
        const auto back = static_cast<std::size_t>(std::find(there.neighbour.begin(), there.neighbour.end(), face) -
                                                   there.neighbour.begin());
        const double across = -dot(direction, here.inward[side]);
        direction = direction + across * (here.inward[side] + there.inward[back]);
        face = next;
    }
    return std::nullopt;
}

/// Ground of another part of the object where the surface ends.
std::optional<Footprint> below(const FlowTerrain& terrain, Vec3 place, Vec3 normal, double radius)
{
    const auto met = terrain.firstAlong(place + radius * normal, -1.0 * normal);
    if (!met || dot(met->place - place, normal) < -radius) {
        return std::nullopt;
    }
    return Footprint{met->place, terrain.surface().faces[met->face].normal};
}

}  // namespace

std::optional<Vec3> awayFromEdge(const FlowTerrain& terrain, const FlowTerrain::Point& point, double radius)
{
    const FlowSurface& surface = terrain.surface();
    const FlowSurface::Face& face = surface.faces[point.face];
    double inside = radius;
    for (std::size_t k = 0; k < 3; ++k) {
        inside = std::min(inside, dot(point.place - face.corners[k], face.inward[k]));
    }
    if (inside >= radius) {
        return std::nullopt;
    }
    const Vec3 left = face.inward[0];
    const Vec3 ahead = cross(left, face.normal);
    std::array<std::optional<Footprint>, kAround> rim;
    Vec3 sum;
    double count = 0.0;
    for (std::size_t k = 0; k < kAround; ++k) {
        const double angle = 2.0 * std::numbers::pi * static_cast<double>(k) / kAround;
        const Vec3 direction = std::cos(angle) * ahead + std::sin(angle) * left;
        rim[k] = along(surface, point, direction, radius);
        if (!rim[k]) {
            rim[k] = below(terrain, point.place + radius * direction, face.normal, radius);
        }
        if (rim[k]) {
            sum = sum + rim[k]->place;
            count += 1.0;
        }
    }
    if (count < static_cast<double>(kAround)) {
        return count > 0.0 ? (1.0 / count) * sum : point.place;
    }
    const Vec3 middle = (1.0 / count) * sum;
    Vec3 area;
    for (std::size_t k = 0; k < kAround; ++k) {
        area = area + cross(rim[k]->place - middle, rim[(k + 1) % kAround]->place - middle);
    }
    const Vec3 normal = unit(area, face.normal);
    bool is_even = true;
    sum = {};
    count = 0.0;
    for (const auto& end : rim) {
        const double off = std::abs(dot(end->place - middle, normal)) / radius;
        is_even = is_even && (off <= kLeastOff || (off <= kMostOff && dot(end->normal, normal) >= kFlat));
        if (dot(end->normal, face.normal) >= kFlat) {
            sum = sum + end->place;
            count += 1.0;
        }
    }
    if (is_even) {
        return std::nullopt;
    }
    return count > 0.0 ? (1.0 / count) * sum : point.place;
}

}  // namespace droplet
