// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

#include "droplet/surface/textured_mesh.h"
#include "droplet/vector.h"

namespace droplet::testing {

/// Adds a fine ball, with all uvs 0.
inline void addBall(TexturedMesh& mesh, double radius, Vec3 middle)
{
    constexpr std::uint32_t kRings = 64;
    constexpr std::uint32_t kAround = 128;
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (std::uint32_t ring = 0; ring <= kRings; ++ring) {
        for (std::uint32_t k = 0; k < kAround; ++k) {
            const double tilt = std::numbers::pi * ring / kRings;
            const double turn = 2.0 * std::numbers::pi * k / kAround;
            const Vec3 normal{std::sin(tilt) * std::cos(turn), std::sin(tilt) * std::sin(turn), std::cos(tilt)};
            mesh.normals.push_back(normal);
            mesh.vertices.push_back(radius * normal + middle);
            if (ring < kRings) {
                const std::uint32_t a = first + ring * kAround + k;
                const std::uint32_t b = first + ring * kAround + (k + 1) % kAround;
                mesh.triangles.push_back({a, a + kAround, b + kAround});
                mesh.triangles.push_back({a, b + kAround, b});
            }
        }
    }
    mesh.uvs.resize(mesh.vertices.size());
}

}  // namespace droplet::testing
