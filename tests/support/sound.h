// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "droplet/droplet.h"

namespace droplet::testing {

/// Whether every number of a height field is finite, no height negative, and the inner ones positive.
inline void expectLiquid(const PlanarMesh& mesh, const CapillarySurface& field)
{
    ASSERT_EQ(field.vertices.size(), mesh.vertices.size());
    ASSERT_EQ(field.triangles, mesh.triangles);
    ASSERT_NO_THROW(field.validate());
    EXPECT_TRUE(std::isfinite(field.pressure));
    EXPECT_GT(field.pressure, 0.0);
    std::size_t wrong = 0;
    for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
        const double u = field.vertices[v].z;
        wrong += !std::isfinite(u) || (mesh.onRim(v) ? u != 0.0 : u <= 0.0) ? 1 : 0;
    }
    EXPECT_EQ(wrong, 0U) << "heights that are not zero on the rim and positive inside";
    EXPECT_TRUE(std::all_of(field.contact_angle.begin(), field.contact_angle.end(),
                            [](double angle) { return std::isfinite(angle); }));
}

/// Whether a sheet has its volume, and is above the ground.
inline void expectSheet(const CapillarySurface& sheet)
{
    ASSERT_NO_THROW(sheet.validate());
    EXPECT_NO_THROW(sheet.footprint->validate());
    EXPECT_TRUE(std::isfinite(sheet.pressure));
    EXPECT_TRUE(std::all_of(sheet.vertices.begin(), sheet.vertices.end(), [](const Vec3& p) { return p.z >= 0.0; }));
}

/// Whether a surface has the topology of its footprints: one component per droplet. A droplet with h holes has Euler
/// number 2 − 2h if closed; without a base it has 1 − h and h + 1 boundary loops.
inline void expectTopologyOfRims(const Droplet& droplet, bool open)
{
    long holes = 0;
    for (const PlanarMesh& mesh : droplet.meshes) {
        holes += static_cast<long>(mesh.loopCount()) - 1;
    }
    const auto count = static_cast<long>(droplet.meshes.size());
    const Topology found = topology(droplet.surface);
    EXPECT_TRUE(found.manifold);
    EXPECT_EQ(found.closed, !open);
    EXPECT_EQ(found.components, droplet.meshes.size());
    EXPECT_EQ(found.euler, open ? count - holes : 2 * (count - holes));
    EXPECT_EQ(found.boundary_loops, open ? static_cast<std::size_t>(count + holes) : 0U);
}

/// Invariants of droplets from any mask: valid meshes that cover their loops, positive heights, a manifold with the
/// right topology, and the same volume if measured, enclosed or asked for.
inline void expectSound(const Droplet& droplet, bool open = false)
{
    ASSERT_EQ(droplet.meshes.size(), droplet.domain.droplets.size());
    ASSERT_EQ(droplet.meshes.size(), droplet.solution.droplets.size());
    ASSERT_EQ(droplet.meshes.size(), droplet.figures.size());
    for (std::size_t k = 0; k < droplet.meshes.size(); ++k) {
        const PlanarMesh& mesh = droplet.meshes[k];
        ASSERT_NO_THROW(mesh.validate());
        ASSERT_EQ(mesh.loopCount(), 1 + droplet.domain.droplets[k].holes.size());
        // The triangles fill the polygon of the rim: the sum of their areas is the polygon's area.
        double around = 0.0;
        for (std::size_t loop = 0; loop < mesh.loopCount(); ++loop) {
            double enclosed = 0.0;
            for (std::uint32_t v = mesh.loop_starts[loop]; v < mesh.loop_starts[loop + 1]; ++v) {
                enclosed += 0.5 * cross(mesh.vertices[v], mesh.vertices[nextOnRim(mesh, loop, v)]);
            }
            EXPECT_EQ(enclosed > 0.0, loop == 0) << "the rim runs counter-clockwise, holes clockwise";
            around += enclosed;
        }
        // Bound of round-off: sums over all triangles of products of coordinates up to the extent.
        const double extent = droplet.domain.extent.x * droplet.domain.extent.y;
        const auto terms = static_cast<double>(mesh.triangles.size());
        EXPECT_NEAR(area(mesh), around, std::numeric_limits<double>::epsilon() * terms * extent);
        const CapillarySurface& surface = droplet.solution.droplets[k];
        if (surface.isHeightField()) {
            expectLiquid(mesh, surface);
        } else {
            expectSheet(surface);
        }
    }
    ASSERT_NO_THROW(droplet.surface.validate());
    expectTopologyOfRims(droplet, open);
    EXPECT_NEAR(enclosedVolume(droplet.surface), droplet.total.volume, 1e-9 * droplet.total.volume);
}

}  // namespace droplet::testing
