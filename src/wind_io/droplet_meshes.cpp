// SPDX-License-Identifier: GPL-3.0-or-later
#include "wind_io/droplet_meshes.h"

#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace droplet {
namespace {

/// Vector of the vehicle's frame, y ahead, in a frame whose front is +Z after yUp().
Vec3 halfTurned(Vec3 v)
{
    return {0.0 - v.x, 0.0 - v.y, v.z};
}

}  // namespace

DropletMesh capMesh(double angle, const CapDetail& detail)
{
    const std::uint32_t around = detail.around;
    const std::uint32_t rings = detail.rings;
    DropletMesh mesh;
    const double radius = 1.0 / std::sin(angle);
    const double centre = -radius * std::cos(angle);
    mesh.vertices.push_back({0.0, 0.0, radius + centre});
    mesh.normals.push_back({0.0, 0.0, 1.0});
    const auto turned = [&](std::uint32_t k) { return 2.0 * std::numbers::pi * (k % around) / around; };
    for (std::uint32_t ring = 1; ring <= rings; ++ring) {
        const double tilt = angle * ring / rings;
        for (std::uint32_t k = 0; k < around; ++k) {
            const Vec3 normal{std::sin(tilt) * std::cos(turned(k)), std::sin(tilt) * std::sin(turned(k)),
                              std::cos(tilt)};
            mesh.normals.push_back(normal);
            mesh.vertices.push_back(radius * normal + Vec3{0.0, 0.0, centre});
            if (ring == rings) {
                mesh.vertices.back().z = 0.0;  // exactly on the glass
            }
        }
    }
    for (std::uint32_t k = 0; k < around; ++k) {
        const std::uint32_t next = (k + 1) % around;
        mesh.triangles.push_back({0, 1 + k, 1 + next});
        for (std::uint32_t ring = 0; ring + 1 < rings; ++ring) {
            const std::uint32_t upper = 1 + ring * around;
            const std::uint32_t lower = upper + around;
            mesh.triangles.push_back({upper + k, lower + k, lower + next});
            mesh.triangles.push_back({upper + k, lower + next, upper + next});
        }
    }
    // The base on the glass.
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.push_back({0.0, 0.0, 0.0});
    mesh.normals.push_back({0.0, 0.0, -1.0});
    for (std::uint32_t k = 0; k < around; ++k) {
        mesh.vertices.push_back({std::cos(turned(k)), std::sin(turned(k)), 0.0});
        mesh.normals.push_back({0.0, 0.0, -1.0});
    }
    for (std::uint32_t k = 0; k < around; ++k) {
        mesh.triangles.push_back({first, first + 1 + (k + 1) % around, first + 1 + k});
    }
    // Chords lie below the cap: the mesh is enlarged to the cap's volume.
    const double volume = std::numbers::pi * (2.0 - 3.0 * std::cos(angle) + std::pow(std::cos(angle), 3)) /
                          (3.0 * std::pow(std::sin(angle), 3));
    double meshed = 0.0;
    for (const auto& [a, b, c] : mesh.triangles) {
        meshed += dot(mesh.vertices[a], cross(mesh.vertices[b], mesh.vertices[c])) / 6.0;
    }
    for (Vec3& position : mesh.vertices) {
        position = std::cbrt(volume / meshed) * position;
    }
    return mesh;
}

DropletMesh glassMesh(const Glass& glass)
{
    constexpr int kAcross = 64;
    constexpr int kUpward = 32;
    DropletMesh mesh;
    std::map<std::pair<int, int>, std::uint32_t> knots;
    for (int j = 0; j <= kUpward; ++j) {
        for (int i = 0; i <= kAcross; ++i) {
            if (const auto place = glass.place({glass.width() * i / kAcross, glass.height() * j / kUpward})) {
                knots[{i, j}] = static_cast<std::uint32_t>(mesh.vertices.size());
                mesh.vertices.push_back(halfTurned(place->point));
                mesh.normals.push_back(halfTurned(place->normal));
            }
        }
    }
    for (int j = 0; j < kUpward; ++j) {
        for (int i = 0; i < kAcross; ++i) {
            const auto a = knots.find({i, j});
            const auto b = knots.find({i + 1, j});
            const auto c = knots.find({i + 1, j + 1});
            const auto d = knots.find({i, j + 1});
            if (a != knots.end() && b != knots.end() && c != knots.end() && d != knots.end()) {
                // From inside x goes right and y up, so this order is counter-clockwise from outside.
                mesh.triangles.push_back({a->second, c->second, b->second});
                mesh.triangles.push_back({a->second, d->second, c->second});
            }
        }
    }
    return mesh;
}

std::size_t addGlass(Scene& scene, const DropletMesh& pane)
{
    Look look;
    look.name = "glass";
    look.colour = {0.85, 0.95, 0.92};
    look.roughness = 0.05;
    look.transmission = 0.0;
    const std::size_t material = scene.addMaterial({.look = look, .opacity = 0.15, .both_sides = true});
    const std::size_t mesh = scene.addMesh(sceneMesh(pane, "glass", material));
    return scene.addNode({"glass", mesh});
}

}  // namespace droplet
