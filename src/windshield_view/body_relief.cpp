// SPDX-License-Identifier: GPL-3.0-or-later
// The vertices of a capillary body lie on rays from its apex, seen from above, so that every ray has a profile.
// Profiles are tabulated at even steps of s = 1 − √(1 − ρ), where ρ is the distance from the apex over that of the
// outline: a cap's height is smooth in s up to the contact line, also where it is vertical there.
#include "windshield_view/body_relief.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "droplet/error.h"

namespace droplet {
namespace {

/// Vertex of a profile.
struct Knot {
    double s = 0.0;
    double height = 0.0;
    double x = 0.0;  // of the normal
    double y = 0.0;
};

struct Profile {
    double angle = 0.0;
    double radius = 0.0;
    std::vector<Knot> knots;  // from the apex to the outline

    [[nodiscard]] Knot at(double s) const
    {
        std::size_t k = 1;
        while (k + 1 < knots.size() && knots[k].s < s) {
            ++k;
        }
        const Knot& a = knots[k - 1];
        const Knot& b = knots[k];
        const double t = (s - a.s) / (b.s - a.s);
        return {s, a.height + t * (b.height - a.height), a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
    }
};

std::vector<Profile> profilesOf(const DropletBodies& bodies, const BodyConditions& conditions, Vec3& apex)
{
    std::vector<Vec3> vertices(bodies.vertices());
    std::vector<Vec3> normals(bodies.vertices());
    bodies.make(conditions, vertices, normals);
    apex = vertices.back();
    const std::size_t slices = bodies.rimVertices();
    const std::size_t rings = (vertices.size() - 1) / slices;
    std::vector<Profile> profiles(slices);
    double last = -std::numbers::pi;
    for (std::size_t j = 0; j < slices; ++j) {
        Profile& profile = profiles[j];
        std::size_t outermost = 0;
        const auto radius = [&](std::size_t ring) {
            const Vec3 p = vertices[ring * slices + j] - apex;
            return std::hypot(p.x, p.y);
        };
        for (std::size_t ring = 1; ring < rings; ++ring) {
            outermost = radius(ring) > radius(outermost) ? ring : outermost;
        }
        const Vec3 rim = vertices[outermost * slices + j] - apex;
        profile.radius = radius(outermost);
        profile.angle = std::atan2(rim.y, rim.x);
        if (profile.angle < last - std::numbers::pi) {
            profile.angle += 2.0 * std::numbers::pi;
        }
        last = profile.angle;
        profile.knots.push_back({0.0, apex.z, normals.back().x, normals.back().y});
        for (std::size_t ring = rings; ring-- > outermost;) {
            const std::size_t v = ring * slices + j;
            const double s = 1.0 - std::sqrt(std::max(1.0 - radius(ring) / profile.radius, 0.0));
            if (s > profile.knots.back().s) {
                profile.knots.push_back({s, vertices[v].z, normals[v].x, normals[v].y});
            }
        }
    }
    return profiles;
}

/// Volume below flat triangles between the profiles [m³].
double volumeBelow(const std::vector<Profile>& profiles)
{
    double volume = 0.0;
    for (std::size_t j = 0; j < profiles.size(); ++j) {
        const Profile& a = profiles[j];
        const Profile& b = profiles[(j + 1) % profiles.size()];
        const auto corner = [](const Profile& profile, std::size_t k) {
            const Knot& knot = profile.knots[std::min(k, profile.knots.size() - 1)];
            const double distance = profile.radius * (1.0 - (1.0 - knot.s) * (1.0 - knot.s));
            return Vec3{distance * std::cos(profile.angle), distance * std::sin(profile.angle), knot.height};
        };
        const auto add = [&](Vec3 p, Vec3 q, Vec3 r) {
            const double area = 0.5 * ((q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x));
            volume += area * (p.z + q.z + r.z) / 3.0;
        };
        for (std::size_t k = 1; k < std::max(a.knots.size(), b.knots.size()); ++k) {
            add(corner(a, k - 1), corner(a, k), corner(b, k));
            add(corner(a, k - 1), corner(b, k), corner(b, k - 1));
        }
    }
    return volume;
}

}  // namespace

void checkBody(BodyShape shape)
{
    if (shape != BodyShape::Capsule && shape != BodyShape::Capillary) {
        throw Error(ErrorCode::InvalidArgument, "body must be Capsule or Capillary");
    }
}

struct BodyRelief::Cell {
    const Direction* first = nullptr;
    float turn = 0.0F;      ///< share of the next direction
    float distance = 0.0F;  ///< from the apex [m]
    float radius = 0.0F;    ///< of the outline [m]

    /// Mixes values of both directions.
    [[nodiscard]] float mix(float a, float b) const { return a + turn * (b - a); }

    /// Surface at a place that is not beyond the outline.
    [[nodiscard]] Node node() const
    {
        const float s = 1.0F - std::sqrt(std::max(1.0F - distance / radius, 0.0F));
        const float place = s * static_cast<float>(kLevels);
        const std::size_t level = std::min(static_cast<std::size_t>(place), kLevels - 1);
        const float t = place - static_cast<float>(level);
        const auto between = [&](float Node::*const value) {
            const auto along = [&](const Direction& d) {
                const float a = d.nodes[level].*value;
                return a + t * (d.nodes[level + 1].*value - a);
            };
            return mix(along(first[0]), along(first[1]));
        };
        return {between(&Node::height), between(&Node::x), between(&Node::y)};
    }
};

BodyRelief::BodyRelief(const DropletBodies& bodies, const BodyConditions& conditions)
{
    Vec3 apex;
    const std::vector<Profile> profiles = profilesOf(bodies, conditions, apex);
    apex_ = {static_cast<float>(apex.x), static_cast<float>(apex.y)};
    constexpr double kTurn = 2.0 * std::numbers::pi;
    std::size_t j = 0;
    for (std::size_t k = 0; k < kAngles; ++k) {
        // Profiles are in the order of their angles, from about 0 on.
        const double angle = kTurn * static_cast<double>(k) / static_cast<double>(kAngles);
        const auto angle_of = [&](std::size_t i) {
            return profiles[i % profiles.size()].angle + (i >= profiles.size() ? kTurn : 0.0);
        };
        const double from = angle < angle_of(0) ? angle + kTurn : angle;
        while (j + 1 < profiles.size() && angle_of(j + 1) <= from) {
            ++j;
        }
        const Profile& a = profiles[j];
        const Profile& b = profiles[(j + 1) % profiles.size()];
        const double t = std::clamp((from - angle_of(j)) / (angle_of(j + 1) - angle_of(j)), 0.0, 1.0);
        Direction& direction = directions_[k];
        direction.radius = static_cast<float>(a.radius + t * (b.radius - a.radius));
        for (std::size_t level = 0; level <= kLevels; ++level) {
            const double s = static_cast<double>(level) / static_cast<double>(kLevels);
            const Knot one = a.at(s);
            const Knot other = b.at(s);
            direction.nodes[level] = {static_cast<float>(one.height + t * (other.height - one.height)),
                                      static_cast<float>(one.x + t * (other.x - one.x)),
                                      static_cast<float>(one.y + t * (other.y - one.y))};
            top_ = std::max(top_, direction.nodes[level].height);
        }
        const float cosine = static_cast<float>(std::cos(angle));
        const float sine = static_cast<float>(std::sin(angle));
        const Vec2f out{apex_.x + direction.radius * cosine, apex_.y + direction.radius * sine};
        low = k == 0 ? out : Vec2f{std::min(low.x, out.x), std::min(low.y, out.y)};
        high = k == 0 ? out : Vec2f{std::max(high.x, out.x), std::max(high.y, out.y)};
    }
    for (std::size_t k = 0; k < kAngles; ++k) {
        const float before = directions_[(k + kAngles - 1) % kAngles].radius;
        const float after = directions_[(k + 1) % kAngles].radius;
        const auto step = static_cast<float>(2.0 * kTurn / static_cast<double>(kAngles));
        const float slope = (after - before) / (step * directions_[k].radius);
        directions_[k].square = 1.0F / std::sqrt(1.0F + slope * slope);
    }
    directions_[kAngles] = directions_[0];
    // Between the vertices this surface is round: it holds more than the body's flat triangles.
    scale(static_cast<float>(std::cbrt(volumeBelow(profiles) / static_cast<double>(volume()))));
    half_width = 0.5F * (high.y - low.y);
}

float BodyRelief::volume() const
{
    // ∫∫ h ρ R² dρ dφ with ρ = s (2 − s)
    constexpr int kParts = 4;  // of a level
    float volume = 0.0F;
    for (std::size_t k = 0; k < kAngles; ++k) {
        const Direction& direction = directions_[k];
        float integral = 0.0F;
        for (std::size_t level = 0; level < kLevels; ++level) {
            for (int part = 0; part < kParts; ++part) {
                const float t = (static_cast<float>(part) + 0.5F) / kParts;
                const float s = (static_cast<float>(level) + t) / static_cast<float>(kLevels);
                const float a = direction.nodes[level].height;
                integral += (a + t * (direction.nodes[level + 1].height - a)) * s * (2.0F - s) * 2.0F * (1.0F - s);
            }
        }
        volume += direction.radius * direction.radius * integral;
    }
    return volume * static_cast<float>(2.0 * std::numbers::pi / (kAngles * kLevels * kParts));
}

void BodyRelief::scale(float factor)
{
    for (Direction& direction : directions_) {
        direction.radius *= factor;
        for (Node& node : direction.nodes) {
            node.height *= factor;
        }
    }
    top_ *= factor;
    low = {apex_.x + factor * (low.x - apex_.x), apex_.y + factor * (low.y - apex_.y)};
    high = {apex_.x + factor * (high.x - apex_.x), apex_.y + factor * (high.y - apex_.y)};
}

BodyRelief::Cell BodyRelief::cellAt(Vec2f place) const
{
    const float x = place.x - apex_.x;
    const float y = place.y - apex_.y;
    constexpr auto kPerRadian = static_cast<float>(static_cast<double>(kAngles) / (2.0 * std::numbers::pi));
    float turn = std::atan2(y, x) * kPerRadian;
    turn = turn < 0.0F ? turn + static_cast<float>(kAngles) : turn;
    const std::size_t k = std::min(static_cast<std::size_t>(turn), kAngles - 1);
    Cell cell{&directions_[k], turn - static_cast<float>(k), std::sqrt(x * x + y * y), 0.0F};
    cell.radius = cell.mix(cell.first[0].radius, cell.first[1].radius);
    return cell;
}

float BodyRelief::inside(Vec2f place) const
{
    const Cell cell = cellAt(place);
    return (cell.radius - cell.distance) * cell.mix(cell.first[0].square, cell.first[1].square);
}

BodyRelief::Point BodyRelief::at(Vec2f place) const
{
    Cell cell = cellAt(place);
    cell.distance = std::min(cell.distance, cell.radius);
    const Node node = cell.node();
    return {node.height, unit({node.x, node.y, std::sqrt(std::max(1.0F - node.x * node.x - node.y * node.y, 0.0F))})};
}

float BodyRelief::heightAt(Vec2f place) const
{
    const Cell cell = cellAt(place);
    constexpr float kSteep = 4.0F;  // beyond the outline the surface drops, so that every ray meets it
    return cell.distance < cell.radius ? cell.node().height : kSteep * (cell.radius - cell.distance);
}

Vec3f BodyRelief::normalAtExit(Vec2f from, Vec3f direction) const
{
    const auto place = [&](float way) { return Vec2f{from.x + way * direction.x, from.y + way * direction.y}; };
    const auto above = [&](float way) { return heightAt(place(way)) - way * direction.z; };
    // Illinois: regula falsi that halves the value at an end that stays.
    float begin = 0.0F;
    float end = top_ / direction.z;
    float at_begin = above(begin);
    float at_end = above(end);
    float way = 0.0F;
    const float tolerance = 2e-3F * top_;
    constexpr int kMaxSteps = 12;
    bool rose = false;
    for (int step = 0; step < kMaxSteps && at_begin > tolerance && at_end < 0.0F; ++step) {
        way = begin + (end - begin) * at_begin / (at_begin - at_end);
        const float height = above(way);
        if (std::abs(height) <= tolerance) {
            break;
        }
        const bool rises = height > 0.0F;
        if (rises) {
            begin = way;
            at_begin = height;
            at_end *= step > 0 && rose ? 0.5F : 1.0F;
        } else {
            end = way;
            at_end = height;
            at_begin *= step > 0 && !rose ? 0.5F : 1.0F;
        }
        rose = rises;
    }
    return at(place(way)).normal;
}

Reliefs::Reliefs(const Glass& glass, BodyShape shape, const ForceModel& forces) : glass_(glass), forces_(forces)
{
    if (shape == BodyShape::Capillary) {
        bodies_.emplace(shape, forces);
    }
}

std::optional<BodyRelief> Reliefs::of(const RunningDroplet& droplet) const
{
    const auto place = bodies_ ? glass_.place(droplet.position) : std::nullopt;
    if (!place) {
        return std::nullopt;
    }
    BodyConditions conditions;
    conditions.volume = droplet.volume;
    conditions.speed = length(droplet.velocity);
    if (conditions.speed > 0.0) {
        const DropletForces f = forcesOn(forces_, droplet.volume);
        conditions.gravity.x = (f.sliding_friction + f.viscous * conditions.speed) / f.mass;
    } else {
        const Vec2 along = gravityAlong(*place, forces_.gravity);
        conditions.gravity = {along.x, along.y, 0.0};
    }
    conditions.gravity.z = -forces_.gravity * place->normal.z;
    return BodyRelief(*bodies_, conditions);
}

}  // namespace droplet
