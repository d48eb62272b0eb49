// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "droplet/surface/surface.h"

namespace droplet::testing {

/// Droplet of known shape on a disc or ring, made without the library's stages.
struct RoundDroplet {
    double inner = 0.0;   ///< radius of the hole [m]; 0: none
    double outer = 4e-3;  ///< [m]
    double height = 1e-3;
    std::uint32_t rings = 4;  ///< rings of triangles, from the hole or the centre outward
    std::uint32_t segments = 12;
    bool open = false;
    Vec2 centre = {};
};

inline constexpr double kExtent = 20e-3;  ///< extent of the imagined image, centred at the origin [m]

/// Area of the regular polygon that approximates a circle [m²].
inline double polygonArea(double radius, std::uint32_t segments)
{
    return 0.5 * segments * radius * radius * std::sin(2.0 * std::numbers::pi / segments);
}

/// Appends the vertices of another surface.
inline Surface together(Surface a, const Surface& b)
{
    const auto offset = static_cast<std::uint32_t>(a.vertices.size());
    a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
    a.normals.insert(a.normals.end(), b.normals.begin(), b.normals.end());
    a.uvs.insert(a.uvs.end(), b.uvs.begin(), b.uvs.end());
    for (const auto& [i, j, k] : b.triangles) {
        a.triangles.push_back({i + offset, j + offset, k + offset});
    }
    for (const std::uint32_t first : b.weld) {
        a.weld.push_back(first + offset);
    }
    return a;
}

/// Over a disc a paraboloid, (outer² − r²)·height/outer²; over a ring a parabola across it. Rim vertices exist twice,
/// welded; the base has the same triangles at z = 0 with reversed winding.
inline Surface roundDroplet(const RoundDroplet& wish = {})
{
    const bool ring = wish.inner > 0.0;
    Surface surface;
    surface.mean_height = wish.height / 2.0;
    std::vector<Triangle> planar;
    std::vector<bool> rim;
    const auto add = [&](double radius, double angle, bool on_rim) {
        const double c = std::cos(angle);
        const double s = std::sin(angle);
        const double middle = ring ? 0.5 * (wish.inner + wish.outer) : 0.0;
        const double half = wish.outer - middle;
        const double across = (radius - middle) / half;
        const double slope = -2.0 * wish.height * across / half;
        const Vec3 upward{-slope * c, -slope * s, 1.0};
        const Vec3 at{wish.centre.x + radius * c, wish.centre.y + radius * s,
                      on_rim ? 0.0 : wish.height * (1.0 - across * across)};
        surface.vertices.push_back(at);
        surface.normals.push_back((1.0 / length(upward)) * upward);
        surface.uvs.push_back({0.5 + at.x / kExtent, 0.5 - at.y / kExtent});
        surface.weld.push_back(static_cast<std::uint32_t>(surface.weld.size()));
        rim.push_back(on_rim);
    };
    const std::uint32_t n = wish.segments;
    const std::uint32_t first_circle = ring ? 0 : 1;
    if (!ring) {
        add(0.0, 0.0, false);
    }
    for (std::uint32_t circle = first_circle; circle <= wish.rings; ++circle) {
        const double radius = wish.inner + (wish.outer - wish.inner) * circle / wish.rings;
        for (std::uint32_t k = 0; k < n; ++k) {
            add(radius, 2.0 * std::numbers::pi * k / n, circle == wish.rings || (ring && circle == 0));
        }
    }
    const auto vertex = [&](std::uint32_t circle, std::uint32_t k) {
        return (ring ? 0U : 1U) + (circle - first_circle) * n + k % n;
    };
    for (std::uint32_t k = 0; !ring && k < n; ++k) {
        planar.push_back({0, vertex(1, k), vertex(1, k + 1)});
    }
    for (std::uint32_t circle = first_circle; circle < wish.rings; ++circle) {
        for (std::uint32_t k = 0; k < n; ++k) {
            planar.push_back({vertex(circle, k), vertex(circle + 1, k), vertex(circle + 1, k + 1)});
            planar.push_back({vertex(circle, k), vertex(circle + 1, k + 1), vertex(circle, k + 1)});
        }
    }
    surface.triangles = planar;
    if (!wish.open) {
        const auto count = static_cast<std::uint32_t>(surface.vertices.size());
        for (std::uint32_t i = 0; i < count; ++i) {
            surface.vertices.push_back({surface.vertices[i].x, surface.vertices[i].y, 0.0});
            surface.normals.push_back({0.0, 0.0, -1.0});
            surface.uvs.push_back(Vec2(surface.uvs[i]));
            surface.weld.push_back(rim[i] ? i : count + i);
        }
        for (const auto& [i, j, k] : planar) {
            surface.triangles.push_back({count + i, count + k, count + j});
        }
    }
    return surface;
}

/// The same droplet with contact angles that grow from vertex to vertex along the rim.
inline Surface withContactAngles(Surface surface)
{
    surface.contact_angle.assign(surface.vertices.size(), 0.0F);
    float angle = 0.3F;
    for (std::uint32_t v = 0; v < surface.weld.size(); ++v) {
        if (surface.weld[v] != v) {
            surface.contact_angle[surface.weld[v]] = angle += 0.01F;
        }
    }
    return surface;
}

/// The same droplet with a refill from 0 to 2, which doubles every height.
inline Surface withRefill(Surface surface)
{
    RefillState full;
    for (std::size_t v = 0; v < surface.vertices.size(); ++v) {
        const Vec3& normal = surface.normals[v];
        full.vertices.push_back({0.0, 0.0, surface.vertices[v].z});
        full.normals.push_back({normal.x, normal.y, 0.0});
    }
    surface.refill = Refill{0.0, 2.0, {full}};
    return surface;
}

/// Triangles on a given number of vertices, each at a different place.
inline Surface soup(std::vector<Triangle> triangles, std::size_t vertices)
{
    Surface surface;
    for (std::size_t i = 0; i < vertices; ++i) {
        const auto x = static_cast<double>(i);
        surface.vertices.push_back({x, x * x, x * x * x});
        surface.normals.push_back({0.0, 0.0, 1.0});
        surface.uvs.emplace_back();
        surface.weld.push_back(static_cast<std::uint32_t>(i));
    }
    surface.triangles = std::move(triangles);
    return surface;
}

/// A surface as the only droplet of it.
inline Surface asOnePart(Surface surface)
{
    SurfacePart part;
    part.vertices = surface.vertices.size();
    part.triangles = surface.triangles.size();
    part.volume = 1e-9;
    part.area = 1e-6;
    surface.parts = {part};
    return surface;
}

/// Two droplets and their parts: the first in the arrays, on the left, is droplet 1, the other one is droplet 0.
inline Surface pairOfDroplets()
{
    Surface surface = roundDroplet({.outer = 3e-3, .height = 1e-3, .rings = 8, .segments = 32, .centre = {-4e-3, 0.0}});
    const std::size_t vertices = surface.vertices.size();
    const std::size_t triangles = surface.triangles.size();
    surface = together(
        surface, roundDroplet({.outer = 3e-3, .height = 2e-3, .rings = 9, .segments = 31, .centre = {4e-3, 0.0}}));
    SurfacePart left;
    left.droplet = 1;
    left.vertices = vertices;
    left.triangles = triangles;
    left.volume = 1e-9;
    left.area = 1e-6;
    SurfacePart right;
    right.first_vertex = vertices;
    right.vertices = surface.vertices.size() - vertices;
    right.first_triangle = triangles;
    right.triangles = surface.triangles.size() - triangles;
    right.volume = 4e-9;
    right.area = 2e-6;
    surface.parts = {left, right};
    surface.mean_height = 5e-9 / 3e-6;
    return surface;
}

}  // namespace droplet::testing
