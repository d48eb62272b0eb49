// SPDX-License-Identifier: GPL-3.0-or-later
#include "wind_io/droplet_nets.h"

#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "io/gltf_model.h"

namespace droplet {
namespace {

/// From the vehicle's frame, y ahead, to one whose front is +Z once it is +Y up.
Vec3 halfTurned(Vec3 v)
{
    return {0.0 - v.x, 0.0 - v.y, v.z};
}

}  // namespace

Net capNet(double angle, const CapDetail& detail)
{
    const std::uint32_t around = detail.around;
    const std::uint32_t rings = detail.rings;
    Net net;
    const double radius = 1.0 / std::sin(angle);
    const double centre = -radius * std::cos(angle);
    net.positions.push_back({0.0, 0.0, radius + centre});
    net.normals.push_back({0.0, 0.0, 1.0});
    const auto turned = [&](std::uint32_t k) { return 2.0 * std::numbers::pi * (k % around) / around; };
    for (std::uint32_t ring = 1; ring <= rings; ++ring) {
        const double tilt = angle * ring / rings;
        for (std::uint32_t k = 0; k < around; ++k) {
            const Vec3 normal{std::sin(tilt) * std::cos(turned(k)), std::sin(tilt) * std::sin(turned(k)),
                              std::cos(tilt)};
            net.normals.push_back(normal);
            net.positions.push_back(radius * normal + Vec3{0.0, 0.0, centre});
            if (ring == rings) {
                net.positions.back().z = 0.0;  // exactly on the glass
            }
        }
    }
    for (std::uint32_t k = 0; k < around; ++k) {
        const std::uint32_t next = (k + 1) % around;
        net.triangles.push_back({0, 1 + k, 1 + next});
        for (std::uint32_t ring = 0; ring + 1 < rings; ++ring) {
            const std::uint32_t upper = 1 + ring * around;
            const std::uint32_t lower = upper + around;
            net.triangles.push_back({upper + k, lower + k, lower + next});
            net.triangles.push_back({upper + k, lower + next, upper + next});
        }
    }
    // The base, where the droplet stands on the glass.
    const auto first = static_cast<std::uint32_t>(net.positions.size());
    net.positions.push_back({0.0, 0.0, 0.0});
    net.normals.push_back({0.0, 0.0, -1.0});
    for (std::uint32_t k = 0; k < around; ++k) {
        net.positions.push_back({std::cos(turned(k)), std::sin(turned(k)), 0.0});
        net.normals.push_back({0.0, 0.0, -1.0});
    }
    for (std::uint32_t k = 0; k < around; ++k) {
        net.triangles.push_back({first, first + 1 + (k + 1) % around, first + 1 + k});
    }
    // Chords lie below the cap: as large as makes up for it.
    const double volume = std::numbers::pi * (2.0 - 3.0 * std::cos(angle) + std::pow(std::cos(angle), 3)) /
                          (3.0 * std::pow(std::sin(angle), 3));
    double meshed = 0.0;
    for (const auto& [a, b, c] : net.triangles) {
        meshed += dot(net.positions[a], cross(net.positions[b], net.positions[c])) / 6.0;
    }
    for (Vec3& position : net.positions) {
        position = std::cbrt(volume / meshed) * position;
    }
    return net;
}

Net glassNet(const Glass& glass)
{
    constexpr int kAcross = 64;
    constexpr int kUpward = 32;
    Net net;
    std::map<std::pair<int, int>, std::uint32_t> knots;
    for (int j = 0; j <= kUpward; ++j) {
        for (int i = 0; i <= kAcross; ++i) {
            if (const auto place = glass.place({glass.width() * i / kAcross, glass.height() * j / kUpward})) {
                knots[{i, j}] = static_cast<std::uint32_t>(net.positions.size());
                net.positions.push_back(halfTurned(place->point));
                net.normals.push_back(halfTurned(place->normal));
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
                // Seen from inside x goes right and y up, so from outside this is counter-clockwise the other way
                // round.
                net.triangles.push_back({a->second, c->second, b->second});
                net.triangles.push_back({a->second, d->second, c->second});
            }
        }
    }
    return net;
}

int addNet(tinygltf::Model& model, const Net& net, const char* name, int material)
{
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.material = material;
    primitive.attributes["POSITION"] = addVertexArray(model, TINYGLTF_TYPE_VEC3, net.positions.size());
    addBounds(model.accessors.back(), net.positions);
    primitive.attributes["NORMAL"] = addVertexArray(model, TINYGLTF_TYPE_VEC3, net.normals.size());
    primitive.indices = addIndices(model, net.triangles.size(), net.positions.size());
    tinygltf::Mesh mesh;
    mesh.name = name;
    mesh.primitives.push_back(std::move(primitive));
    model.meshes.push_back(std::move(mesh));
    return static_cast<int>(model.meshes.size()) - 1;
}

void writeNet(const Net& net, ByteStream& bytes)
{
    writeVectors(net.positions, bytes);
    writeVectors(net.normals, bytes);
    writeIndices(net.triangles, net.positions.size(), bytes);
    if (net.positions.size() < kVerticesBeyond16Bit && net.triangles.size() % 2 != 0) {
        bytes.u16(0);  // to the next word
    }
}

int addGlass(tinygltf::Model& model, const Net& pane)
{
    tinygltf::Material glass;
    glass.name = "glass";
    glass.alphaMode = "BLEND";
    glass.doubleSided = true;
    glass.pbrMetallicRoughness.baseColorFactor = {0.85, 0.95, 0.92, 0.15};
    glass.pbrMetallicRoughness.metallicFactor = 0.0;
    glass.pbrMetallicRoughness.roughnessFactor = 0.05;
    model.materials.push_back(std::move(glass));
    tinygltf::Node node;
    node.name = "glass";
    node.mesh = addNet(model, pane, "glass", static_cast<int>(model.materials.size()) - 1);
    model.nodes.push_back(std::move(node));
    return static_cast<int>(model.nodes.size()) - 1;
}

}  // namespace droplet
