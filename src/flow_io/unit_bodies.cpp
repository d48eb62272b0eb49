// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow_io/unit_bodies.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include "axes.h"
#include "box_corners.h"
#include "flow_io/seat.h"
#include "unit_vector.h"

namespace droplet {
namespace {

struct Body {
    std::vector<Vec3> vertices;
    std::vector<Vec3> normals;
};

Body bodyOf(const DropletBodies& bodies, const BodyConditions& conditions)
{
    Body body{std::vector<Vec3>(bodies.vertices()), std::vector<Vec3>(bodies.vertices())};
    bodies.make(conditions, body.vertices, body.normals);
    return body;
}

/// Distance from the origin to the farthest of the triangles along a ray, or 0.
/// T. Möller and B. Trumbore, "Fast, minimum storage ray-triangle intersection", J. Graphics Tools 2 (1997) 21.
double farthest(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles, Vec3 direction)
{
    constexpr double kSlack = 1e-9;  // rays through an edge must meet one of its triangles
    double best = 0.0;
    for (const auto& [a, b, c] : triangles) {
        const Vec3 first = vertices[b] - vertices[a];
        const Vec3 second = vertices[c] - vertices[a];
        const Vec3 across = cross(direction, second);
        const double det = dot(first, across);
        if (det == 0.0) {
            continue;
        }
        const Vec3 from = -1.0 * vertices[a];
        const double u = dot(from, across) / det;
        const Vec3 other = cross(from, first);
        const double v = dot(direction, other) / det;
        if (u >= -kSlack && v >= -kSlack && u + v <= 1.0 + kSlack) {
            best = std::max(best, dot(second, other) / det);
        }
    }
    return best;
}

/// Distance from the origin to the rim.
double farthestOnRim(const std::vector<Vec3>& vertices, std::size_t rim, Vec2 direction)
{
    double best = 0.0;
    for (std::size_t k = 0; k < rim; ++k) {
        const Vec2 a{vertices[k].x, vertices[k].y};
        const Vec2 b{vertices[(k + 1) % rim].x, vertices[(k + 1) % rim].y};
        const double side_a = cross(direction, a);
        const double side_b = cross(direction, b);
        if ((side_a <= 0.0) != (side_b <= 0.0)) {
            const double share = side_a / (side_a - side_b);
            best = std::max(best, dot(direction, a + share * (b - a)));
        }
    }
    return best;
}

/// Sets the normals to the mean of those of the triangles around each vertex.
void setNormals(DropletMesh& mesh)
{
    mesh.normals.assign(mesh.vertices.size(), {});
    for (const auto& [a, b, c] : mesh.triangles) {
        const Vec3 area = cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]);
        for (const std::uint32_t i : {a, b, c}) {
            mesh.normals[i] = mesh.normals[i] + area;
        }
    }
    for (Vec3& normal : mesh.normals) {
        normal = unit(normal, {0.0, 0.0, -1.0});  // a seated base may have triangles without area
    }
}

/// Adds the triangles between a top vertex and rings of vertices around it, which follow it from `first` on.
void addRings(DropletMesh& mesh, std::uint32_t first, const BodyDetail& detail)
{
    for (std::uint32_t k = 0; k < detail.around; ++k) {
        const std::uint32_t next = (k + 1) % detail.around;
        mesh.triangles.push_back({first, first + 1 + k, first + 1 + next});
        for (std::uint32_t ring = 0; ring + 1 < detail.rings; ++ring) {
            const std::uint32_t upper = first + 1 + ring * detail.around;
            const std::uint32_t lower = upper + detail.around;
            mesh.triangles.push_back({upper + k, lower + k, lower + next});
            mesh.triangles.push_back({upper + k, lower + next, upper + next});
        }
    }
}

double angleOf(std::uint32_t k, const BodyDetail& detail)
{
    return 2.0 * std::numbers::pi * k / detail.around;
}

/// Frame of a mesh that a pose scales, turns and shifts.
class UnitFrame {
public:
    explicit UnitFrame(const DropletPose& pose)
        : frame_(frameOf(pose)),
          scale_{static_cast<double>(pose.along), static_cast<double>(pose.across), static_cast<double>(pose.up)}
    {
    }

    [[nodiscard]] const DropletFrame& frame() const { return frame_; }
    [[nodiscard]] Vec3 toObject(Vec3 p) const
    {
        return frame_.place + turned({scale_.x * p.x, scale_.y * p.y, scale_.z * p.z});
    }
    [[nodiscard]] Vec3 fromObject(Vec3 p) const
    {
        const Vec3 local = turnedBack(p - frame_.place);
        return {local.x / scale_.x, local.y / scale_.y, local.z / scale_.z};
    }
    [[nodiscard]] Vec3 normalToObject(Vec3 n) const
    {
        return turned(unit({n.x / scale_.x, n.y / scale_.y, n.z / scale_.z}));
    }
    [[nodiscard]] Vec3 normalFromObject(Vec3 n) const
    {
        const Vec3 local = turnedBack(n);
        return unit({local.x * scale_.x, local.y * scale_.y, local.z * scale_.z});
    }

private:
    [[nodiscard]] Vec3 turned(Vec3 v) const { return v.x * frame_.ahead + v.y * frame_.left + v.z * frame_.normal; }
    [[nodiscard]] Vec3 turnedBack(Vec3 v) const
    {
        return {dot(v, frame_.ahead), dot(v, frame_.left), dot(v, frame_.normal)};
    }

    DropletFrame frame_;
    Vec3 scale_;
};

}  // namespace

double unitVolume(const DropletBodies& bodies)
{
    constexpr double kVolume = 20e-9;
    const Body body = bodyOf(bodies, {kVolume, 0.0, {}, false});
    double radius = 0.0;
    for (std::size_t k = 0; k < bodies.rimVertices(); ++k) {
        radius = std::max(radius, length(body.vertices[k]));
    }
    return kVolume / (radius * radius * radius);
}

Vec2 halfSizes(const DropletBodies& bodies, const BodyConditions& conditions)
{
    const auto [low, high] = cornersOf(bodyOf(bodies, conditions).vertices);
    return {0.5 * (high.x - low.x), 0.5 * (high.y - low.y)};
}

DropletMesh unitBody(const DropletBodies& bodies, const BodyConditions& conditions, const BodyDetail& detail,
                     double volume)
{
    std::vector<Vec3> vertices = bodyOf(bodies, conditions).vertices;
    const auto scale = [](std::vector<Vec3>& all, Vec3 by) {
        for (Vec3& p : all) {
            p = {by.x * p.x, by.y * p.y, by.z * p.z};
        }
    };
    const auto half = [](const std::vector<Vec3>& all) {
        const auto [low, high] = cornersOf(all);
        return Vec3{2.0 / (high.x - low.x), 2.0 / (high.y - low.y), 1.0 / high.z};
    };
    scale(vertices, half(vertices));  // rays at equal angles then meet all parts of a long tail
    DropletMesh mesh;
    mesh.vertices.push_back({0.0, 0.0, farthest(vertices, bodies.triangles(), {0.0, 0.0, 1.0})});
    for (std::uint32_t ring = 1; ring <= detail.rings; ++ring) {
        const double rise = 0.5 * std::numbers::pi * (detail.rings - ring) / detail.rings;
        for (std::uint32_t k = 0; k < detail.around; ++k) {
            const Vec2 level{std::cos(angleOf(k, detail)), std::sin(angleOf(k, detail))};
            const Vec3 direction{std::cos(rise) * level.x, std::cos(rise) * level.y, std::sin(rise)};
            if (ring < detail.rings) {
                mesh.vertices.push_back(farthest(vertices, bodies.triangles(), direction) * direction);
            } else {
                const double reach = farthestOnRim(vertices, bodies.rimVertices(), level);
                mesh.vertices.push_back({reach * level.x, reach * level.y, 0.0});
            }
        }
    }
    addRings(mesh, 0, detail);
    const Vec3 by = half(mesh.vertices);
    scale(mesh.vertices, {by.x, by.y, 1.0});
    scale(mesh.vertices,
          {1.0, 1.0, volume / volumeUnder(mesh.vertices, mesh.triangles)});  // the base at z = 0 adds nothing
    setNormals(mesh);
    // The base on the ground.
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (std::size_t ring = 0; ring <= kBaseRings; ++ring) {
        const double share = 1.0 - static_cast<double>(ring) / (1 + kBaseRings);
        for (std::uint32_t k = 0; k < detail.around; ++k) {
            mesh.vertices.push_back(share * mesh.vertices[first - detail.around + k]);
        }
    }
    mesh.vertices.emplace_back();
    for (const auto& [a, b, c] : baseTriangles(detail.around)) {
        mesh.triangles.push_back({first + a, first + b, first + c});
    }
    mesh.normals.resize(mesh.vertices.size(), {0.0, 0.0, -1.0});
    return mesh;
}

DropletFrame frameOf(const DropletPose& pose)
{
    return {zUp(vectorOf(pose.place)), zUp(turnedBy(pose.turn, {1.0, 0.0, 0.0})),
            zUp(turnedBy(pose.turn, {0.0, 0.0, -1.0})), zUp(pose.normal())};
}

std::array<float, 4> turnOf(const DropletFrame& frame)
{
    const Vec3 x = yUp(frame.ahead);
    const Vec3 y = yUp(frame.normal);
    return turnTo(x, y, cross(x, y));
}

DropletShape seatedBody(const FlowTerrain& terrain, const DropletMesh& mesh, std::size_t rim, const DropletPose& pose)
{
    const UnitFrame unit(pose);
    const std::size_t body = mesh.vertices.size() - baseVertices(rim);
    // seat() wants the rim first.
    const auto moved = [&](std::size_t v) { return (v + rim) % body; };
    std::vector<Vec3> vertices(body);
    std::vector<Vec3> normals(body);
    for (std::size_t v = 0; v < body; ++v) {
        vertices[moved(v)] = unit.toObject(mesh.vertices[v]);
        normals[moved(v)] = unit.normalToObject(mesh.normals[v]);
    }
    std::vector<Triangle> triangles;
    for (const auto& [a, b, c] : mesh.triangles) {
        if (std::max({a, b, c}) < body) {
            triangles.push_back({static_cast<std::uint32_t>(moved(a)), static_cast<std::uint32_t>(moved(b)),
                                 static_cast<std::uint32_t>(moved(c))});
        }
    }
    const std::vector<Vec3> base = seat(terrain, unit.frame(), {vertices, normals, triangles, rim});
    DropletMesh seated;
    for (std::size_t v = 0; v < body; ++v) {
        seated.vertices.push_back(unit.fromObject(vertices[moved(v)]));
    }
    for (const Vec3 p : base) {
        seated.vertices.push_back(unit.fromObject(p));
    }
    seated.triangles = mesh.triangles;
    setNormals(seated);
    for (std::size_t v = 0; v < body; ++v) {
        seated.normals[v] = unit.normalFromObject(normals[moved(v)]);
    }
    return {std::move(seated.vertices), std::move(seated.normals)};
}

DropletShape inObject(const DropletShape& shape, const DropletPose& pose)
{
    const UnitFrame unit(pose);
    DropletShape moved = shape;
    for (Vec3& p : moved.vertices) {
        p = unit.toObject(p);
    }
    for (Vec3& n : moved.normals) {
        n = unit.normalToObject(n);
    }
    return moved;
}

double rimGap(const FlowTerrain& terrain, const std::vector<Vec3>& vertices, std::size_t rim, const DropletPose& pose)
{
    const UnitFrame unit(pose);
    const std::size_t base = vertices.size() - baseVertices(rim);
    double gap = 0.0;
    for (std::size_t v = base; v < base + rim; ++v) {
        const Vec3 p = unit.toObject(vertices[v]);
        gap = std::max(gap, length(p - terrain.nearest(p).place));
    }
    return gap / static_cast<double>(std::sqrt(pose.along * pose.across));
}

DropletMesh unitBall(const BodyDetail& detail, double volume)
{
    DropletMesh mesh;
    mesh.vertices.push_back({0.0, 0.0, 1.0});
    for (std::uint32_t ring = 1; ring < detail.rings; ++ring) {
        const double tilt = std::numbers::pi * ring / detail.rings;
        for (std::uint32_t k = 0; k < detail.around; ++k) {
            mesh.vertices.push_back({std::sin(tilt) * std::cos(angleOf(k, detail)),
                                     std::sin(tilt) * std::sin(angleOf(k, detail)), std::cos(tilt)});
        }
    }
    addRings(mesh, 0, {detail.around, detail.rings - 1});
    const auto last = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.push_back({0.0, 0.0, -1.0});
    for (std::uint32_t k = 0; k < detail.around; ++k) {
        mesh.triangles.push_back({last, last - detail.around + (k + 1) % detail.around, last - detail.around + k});
    }
    setNormals(mesh);
    const double size = std::cbrt(volume / volumeUnder(mesh.vertices, mesh.triangles));
    for (Vec3& p : mesh.vertices) {
        p = size * p;
    }
    return mesh;
}

UnitDroplets unitDroplets(const DropletBodies& bodies, double volume, double gravity, std::uint32_t around)
{
    const double unit = unitVolume(bodies);
    BodyConditions conditions;
    conditions.volume = volume;
    conditions.gravity = {0.0, 0.0, -gravity};
    UnitDroplets droplets;
    droplets.resting = unitBody(bodies, conditions, {.around = around, .rings = around / 4}, unit);
    constexpr double kSlope = 0.7071067811865476;
    constexpr double kUsualLength = 1.6;  // over the width
    constexpr double kFastest = 2.0;      // [m/s]
    conditions.gravity = kSlope * Vec3{gravity, 0.0, -gravity};
    conditions.speed = 0.05;
    for (Vec2 half; conditions.speed < kFastest && half.x <= kUsualLength * half.y; conditions.speed *= 1.25) {
        half = halfSizes(bodies, conditions);
    }
    droplets.running = unitBody(bodies, conditions, {.around = around, .rings = around * 5 / 16}, unit);
    droplets.falling = unitBall({.around = around * 5 / 8, .rings = around * 3 / 8}, unit);
    return droplets;
}

}  // namespace droplet
