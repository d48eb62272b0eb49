// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/flow_io/floor.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "flow_io/box_of.h"
#include "io/file_material.h"
#include "io/vertex_normals.h"

namespace droplet {
namespace {

/// Place and width of an object, seen from above.
struct Stand {
    Vec3 middle;          ///< below it
    double width = 0.0;   ///< larger side of the box around it
    double radius = 0.0;  ///< of the circle around it about the middle
};

Stand standOf(const std::vector<Vec3>& vertices)
{
    const auto [low, high] = boxOf(vertices);
    const Vec3 size = high - low;
    const double gap = 1e-3 * std::max({size.x, size.y, size.z});  // so that no faces lie on one another
    const double least = 0.3 * size.z;
    Stand stand{
        {0.5 * (low.x + high.x), 0.5 * (low.y + high.y), low.z - gap}, std::max({size.x, size.y, least}), 0.5 * least};
    for (const Vec3& p : vertices) {
        stand.radius = std::max(stand.radius, std::hypot(p.x - stand.middle.x, p.y - stand.middle.y));
    }
    return stand;
}

struct Mesh {
    std::vector<Vec3> vertices;
    std::vector<Triangle> triangles;
};

Mesh plateBelow(const Stand& stand)
{
    const double half = 1.25 * stand.width;
    Mesh mesh;
    for (const auto& [x, y] : {Vec2{-half, -half}, {half, -half}, {half, half}, {-half, half}}) {
        mesh.vertices.push_back(stand.middle + Vec3{x, y, 0.0});
    }
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    return mesh;
}

Mesh dishBelow(const Stand& stand)
{
    constexpr std::uint32_t kAround = 96;
    constexpr std::uint32_t kRings = 24;
    constexpr double kBottom = 0.75;  // radius of the bottom, over that of the rim
    constexpr double kWall = 0.16;    // height of the rim, over its radius
    const double radius = 1.5 * stand.radius;
    Mesh mesh;
    mesh.vertices.push_back(stand.middle);
    for (std::uint32_t ring = 1; ring <= kRings; ++ring) {
        const double out = static_cast<double>(ring) / kRings;
        const double rise = std::max(out - kBottom, 0.0) / (1.0 - kBottom);
        for (std::uint32_t k = 0; k < kAround; ++k) {
            const double turn = 2.0 * std::numbers::pi * k / kAround;
            mesh.vertices.push_back(stand.middle +
                                    radius * Vec3{out * std::cos(turn), out * std::sin(turn), kWall * rise * rise});
        }
    }
    const auto at = [](std::uint32_t ring, std::uint32_t k) { return 1 + (ring - 1) * kAround + k % kAround; };
    for (std::uint32_t k = 0; k < kAround; ++k) {
        mesh.triangles.push_back({0, at(1, k), at(1, k + 1)});
        for (std::uint32_t ring = 1; ring < kRings; ++ring) {
            mesh.triangles.push_back({at(ring, k), at(ring + 1, k), at(ring + 1, k + 1)});
            mesh.triangles.push_back({at(ring, k), at(ring + 1, k + 1), at(ring, k + 1)});
        }
    }
    return mesh;
}

}  // namespace

FlowObject onFloor(FlowObject object, Floor floor)
{
    std::vector<std::vector<Vec3>> none;
    return onFloor(std::move(object), floor, none);
}

FlowObject onFloor(FlowObject object, Floor floor, std::vector<std::vector<Vec3>>& shapes)
{
    std::vector<Vec3> places = object.vertices;
    for (const std::vector<Vec3>& shape : shapes) {
        places.insert(places.end(), shape.begin(), shape.end());
    }
    const Stand stand = standOf(places);
    const Mesh mesh = floor == Floor::Dish ? dishBelow(stand) : plateBelow(stand);
    std::vector<Vec3> normals(mesh.vertices.size());
    fillNormals(mesh.vertices, mesh.triangles, firstAtPlace(mesh.vertices), normals);

    const StandLook plain{plainMaterial().look};
    if (object.materials.empty()) {
        object.materials.resize(object.triangles.size());
        object.material_names = {"object"};
    }
    object.looks.resize(object.material_names.size(), plain);
    object.images.resize(object.material_names.size());
    const auto material = static_cast<std::uint32_t>(object.material_names.size());
    object.material_names.emplace_back("floor");
    object.looks.push_back(plain);
    object.looks.back().look.colour = {0.30, 0.31, 0.33};
    object.images.emplace_back();

    const auto first = static_cast<std::uint32_t>(object.vertices.size());
    object.vertices.insert(object.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
    for (std::vector<Vec3>& shape : shapes) {
        shape.insert(shape.end(), mesh.vertices.begin(), mesh.vertices.end());
    }
    object.normals.insert(object.normals.end(), normals.begin(), normals.end());
    if (!object.weights.empty()) {
        object.weights.resize(object.vertices.size());
    }
    if (!object.uvs.empty()) {
        object.uvs.resize(object.vertices.size());
    }
    if (!object.colours.empty()) {
        object.colours.resize(object.vertices.size(), {1.0, 1.0, 1.0});
    }
    for (const auto& [a, b, c] : mesh.triangles) {
        object.triangles.push_back({first + a, first + b, first + c});
        object.materials.push_back(material);
    }
    return object;
}

}  // namespace droplet
