// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "droplet/domain/domain.h"
#include "droplet/mesh/planar_mesh.h"
#include "droplet/units.h"

namespace droplet::testing {

/// Angle of the liquid at every rim vertex [rad].
inline std::vector<double> rimAngles(const PlanarMesh& mesh)
{
    std::vector<double> angles(mesh.rimVertexCount());
    for (std::size_t loop = 0; loop < mesh.loopCount(); ++loop) {
        for (std::uint32_t before = mesh.loop_starts[loop]; before < mesh.loop_starts[loop + 1]; ++before) {
            const std::uint32_t v = nextOnRim(mesh, loop, before);
            const Vec2 back = mesh.vertices[before] - mesh.vertices[v];
            const Vec2 on = mesh.vertices[nextOnRim(mesh, loop, v)] - mesh.vertices[v];
            const double angle = std::atan2(cross(on, back), dot(on, back));
            angles[v] = angle > 0.0 ? angle : angle + 2.0 * std::numbers::pi;
        }
    }
    return angles;
}

/// Mean distance between neighbouring points of a footprint's loops [m].
inline double detailOf(const Footprint& footprint)
{
    std::size_t points = footprint.rim.points.size();
    for (const Loop& hole : footprint.holes) {
        points += hole.points.size();
    }
    return rimLength(footprint) / static_cast<double>(points);
}

/// Triangles below the angle that triangulate() guarantees: 20°, or near a corner of less than 40° half of the corner.
inline std::vector<std::string> brokenPromises(const PlanarMesh& mesh, const Footprint& footprint)
{
    const double reach = 2.0 * detailOf(footprint);
    const std::vector<double> angles = rimAngles(mesh);
    std::vector<std::uint32_t> sharp;
    for (std::uint32_t v = 0; v < angles.size(); ++v) {
        if (angles[v] < 40.0 * kDegree) {
            sharp.push_back(v);
        }
    }
    std::vector<std::string> broken;
    for (const Triangle& t : mesh.triangles) {
        double min = std::numbers::pi;
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec2 u = mesh.vertices[t[(k + 1) % 3]] - mesh.vertices[t[k]];
            const Vec2 v = mesh.vertices[t[(k + 2) % 3]] - mesh.vertices[t[k]];
            min = std::min(min, std::atan2(cross(u, v), dot(u, v)));
        }
        double allowed = 20.0 * kDegree;
        for (std::size_t i = 0; min < allowed && i < sharp.size(); ++i) {
            for (const std::uint32_t v : t) {
                if (length(mesh.vertices[v] - mesh.vertices[sharp[i]]) < reach) {
                    allowed = std::min(allowed, 0.5 * angles[sharp[i]]);
                }
            }
        }
        // Halving the opposite edge splits a corner; it halves the angle except for the sides' unequal lengths.
        if (min < 0.99 * allowed) {
            broken.push_back(std::to_string(min / kDegree) + " degrees, not " + std::to_string(allowed / kDegree) +
                             ", at " + std::to_string(mesh.vertices[t[0]].x) + " " +
                             std::to_string(mesh.vertices[t[0]].y));
        }
    }
    return broken;
}

}  // namespace droplet::testing
