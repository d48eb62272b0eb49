// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/flow/flow_terrain.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>
#include <utility>

#include "flow/flow_terrain_content.h"
#include "flow/following.h"

namespace droplet {
namespace {

std::vector<double> areasUntil(const FlowSurface& surface)
{
    std::vector<double> areas;
    areas.reserve(surface.faces.size());
    double sum = 0.0;
    for (const FlowSurface::Face& face : surface.faces) {
        sum += areaOf(face);
        areas.push_back(sum);
    }
    return areas;
}

double halfSizeOf(Vec3 low, Vec3 high)
{
    return 0.5 * std::max({high.x - low.x, high.y - low.y, high.z - low.z});
}

std::vector<Corners3> scaledTriangles(const FlowSurface& surface)
{
    const auto [low, high] = boxOf(surface);
    const Vec3 middle = 0.5 * (low + high);
    const double scale = 1.0 / halfSizeOf(low, high);
    std::vector<Corners3> triangles;
    triangles.reserve(surface.faces.size());
    for (const FlowSurface::Face& face : surface.faces) {
        Corners3 scaled;
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 p = scale * (face.corners[k] - middle);
            scaled[k] = {std::clamp(p.x, -1.0, 1.0), std::clamp(p.y, -1.0, 1.0), std::clamp(p.z, -1.0, 1.0)};
        }
        triangles.push_back(scaled);
    }
    return triangles;
}

}  // namespace

double areaOf(const FlowSurface::Face& face)
{
    return 0.5 * length(cross(face.corners[1] - face.corners[0], face.corners[2] - face.corners[0]));
}

FlowTerrain::Content::Content(FlowSurface of, GroundMotion moving, std::shared_ptr<const FlowSurface> at_rest)
    : surface(std::move(of)),
      motion(std::move(moving)),
      rest(std::move(at_rest)),
      tree(scaledTriangles(surface)),
      landing(surface, tree.triangles()),
      area_until(areasUntil(surface))
{
    std::tie(low, high) = boxOf(surface);
}

double FlowTerrain::Content::halfSize() const
{
    return halfSizeOf(low, high);
}

Vec3 FlowTerrain::Content::feltOn(const FlowDroplet& droplet, double time) const
{
    if (droplet.contact == FlowContact::Air) {
        return -1.0 * motion.driftOf(droplet.face, time).acceleration;
    }
    const FlowSurface::Face& face = surface.faces[droplet.face];
    const std::array<Vec3, 3>& velocity = motion.velocity[droplet.face];
    // The change of the ground's velocity along a direction of the face.
    const auto change_along = [&](Vec3 v) {
        Vec3 change;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t side = (k + 1) % 3;  // opposite to the corner
            const double height = dot(face.corners[k] - face.corners[side], face.inward[side]);
            change = change + (dot(v, face.inward[side]) / height) * velocity[k];
        }
        return change;
    };
    const Vec3 side = face.corners[1] - face.corners[0];
    const Vec3 x = (1.0 / length(side)) * side;
    const Vec3 y = cross(face.normal, x);
    const Vec3 along_x = change_along(x);
    const Vec3 along_y = change_along(y);
    // The angular velocity: a normal stays one, and the face turns as its sides do on average.
    const Vec3 spin = dot(along_y, face.normal) * x - dot(along_x, face.normal) * y +
                      0.5 * (dot(along_x, y) - dot(along_y, x)) * face.normal;
    const Vec3 speed = droplet.leg.velocityAt(time);
    const Vec3 place = droplet.leg.placeAt(time);
    // A point of the face has X = Σ w c; with weights w that change, X'' = Σ w c'' + 2 Σ w' c' + Σ w'' c. A velocity
    // along the face turns with it, which is one of the two Σ w' c' as far as it is a turn.
    return -1.0 * mixed(motion.acceleration[droplet.face], weightsOn(face.corners, place)) - change_along(speed) -
           cross(spin, speed);
}

GroundMotion::Drift GroundMotion::driftOf(std::uint32_t face, double at) const
{
    if (rests()) {
        return {};
    }
    const auto mean = [](const std::array<Vec3, 3>& v) { return (1.0 / 3.0) * (v[0] + v[1] + v[2]); };
    const Vec3 speed = mean(velocity[face]);
    const Vec3 change = mean(acceleration[face]);
    const double t = at - time;
    return {t * speed + 0.5 * t * t * change, speed + t * change, change};
}

FlowTerrain::FlowTerrain(FlowSurface surface) : FlowTerrain(std::move(surface), {}, nullptr) {}
FlowTerrain::FlowTerrain(FlowSurface surface, GroundMotion motion, std::shared_ptr<const FlowSurface> rest)
    : content_(std::make_unique<Content>(std::move(surface), std::move(motion), std::move(rest)))
{
}
FlowTerrain::~FlowTerrain() = default;
FlowTerrain::FlowTerrain(FlowTerrain&& other) noexcept = default;
FlowTerrain& FlowTerrain::operator=(FlowTerrain&& other) noexcept = default;

const FlowSurface& FlowTerrain::surface() const
{
    return content_->surface;
}

const GroundMotion& FlowTerrain::motion() const
{
    return content_->motion;
}

double FlowTerrain::area() const
{
    return content_->area_until.back();
}

double FlowTerrain::diameter() const
{
    return length(content_->high - content_->low);
}

FlowTerrain::Point FlowTerrain::pointAt(double u, double v) const
{
    const std::vector<double>& until = content_->area_until;
    const double area = u * until.back();
    const auto found = std::min<std::ptrdiff_t>(std::upper_bound(until.begin(), until.end(), area) - until.begin(),
                                                std::ssize(until) - 1);
    const auto face = static_cast<std::size_t>(found);
    const double before = face > 0 ? until[face - 1] : 0.0;
    // What is left of u chooses the line parallel to a side, v the point on it.
    const double share = std::clamp((area - before) / (until[face] - before), 0.0, 1.0);
    const double down = std::sqrt(share);
    const auto& [a, b, c] = surface().faces[face].corners;
    return {static_cast<std::uint32_t>(face), a + down * ((1.0 - v) * (b - a) + v * (c - a))};
}

FlowTerrain::Point FlowTerrain::nearest(Vec3 place) const
{
    const Content& c = *content_;
    const Vec3 scaled = (1.0 / c.halfSize()) * (place - c.middle());
    const Vec3 inside{std::clamp(scaled.x, -1.0, 1.0), std::clamp(scaled.y, -1.0, 1.0),
                      std::clamp(scaled.z, -1.0, 1.0)};
    const std::uint32_t face = c.tree.nearest(inside).triangle;
    return {face, nearestPoint(place, c.surface.faces[face].corners)};
}

std::optional<FlowTerrain::Point> FlowTerrain::firstAlong(Vec3 origin, Vec3 direction) const
{
    const auto hit = content_->landing.firstAlong(origin, direction);
    return hit ? std::optional(Point{hit->face, hit->place}) : std::nullopt;
}

bool FlowTerrain::isInside(Vec3 place) const
{
    // The winding number: the solid angle of all faces over 4π (A. van Oosterom, J. Strackee, IEEE Trans. Biomed. Eng.
    // 30 (1983) 125).
    double half_angles = 0.0;
    for (const FlowSurface::Face& face : surface().faces) {
        const Vec3 a = face.corners[0] - place;
        const Vec3 b = face.corners[1] - place;
        const Vec3 c = face.corners[2] - place;
        const double la = length(a);
        const double lb = length(b);
        const double lc = length(c);
        half_angles += std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
    }
    return half_angles > std::numbers::pi;
}

}  // namespace droplet
