// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/wet_part.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "droplet/error.h"
#include "droplet/mesh/triangulate.h"
#include "droplet/surface/loft.h"
#include "support/domains.h"
#include "support/grounded.h"
#include "support/heights.h"
#include "support/zoo.h"

namespace droplet {
namespace {

using testing::domainOf;
using testing::ellipseLoop;
using testing::heightsOf;
using testing::liquidOn;
using testing::polygonLoop;
using testing::reversed;
using testing::volumeOf;

using IsDry = std::function<bool(std::uint32_t, Vec2)>;

/// Field over a mesh with the given dry vertices.
CapillarySurface fieldWith(const PlanarMesh& mesh, const BaseSurface& ground, const IsDry& is_dry)
{
    CapillarySurface field = liquidOn(mesh, ground, [](Vec2 p) { return 0.3 + 0.1 * p.x; });
    field.dry.assign(mesh.vertices.size(), 0);
    for (std::uint32_t v = mesh.rimVertexCount(); v < mesh.vertices.size(); ++v) {
        if (is_dry(v, mesh.vertices[v])) {
            field.dry[v] = 1;
            field.vertices[v].z = ground.at(mesh.vertices[v]).height;
        }
    }
    return field;
}

bool isGrounded(const PlanarMesh& mesh, const CapillarySurface& field, const Triangle& t)
{
    return std::all_of(t.begin(), t.end(), [&](std::uint32_t v) { return mesh.onRim(v) || field.dry[v] != 0; });
}

std::vector<CapillarySurface> partsOf(const CapillarySurface& field, const BaseSurface& ground)
{
    return wetParts(field, ground).value_or(std::vector<CapillarySurface>{field});
}

/// Checks the invariants of parts, and of the surface made of them.
void expectSound(const PlanarMesh& mesh, const CapillarySurface& field, const BaseSurface& ground)
{
    const std::vector<CapillarySurface> parts = partsOf(field, ground);
    double wet_area = 0.0;
    for (const Triangle& t : mesh.triangles) {
        wet_area += isGrounded(mesh, field, t) ? 0.0 : 0.5 * doubleArea(mesh, t);
    }
    const double volume = volumeOf(field, ground);
    if (wet_area == 0.0) {
        EXPECT_TRUE(parts.empty());
        EXPECT_THROW((void)loft({field}, {.extent = {1, 1}, .ground = ground}), Error);
        return;
    }
    double part_area = 0.0;
    double part_volume = 0.0;
    long euler = 0;
    std::size_t loops = 0;
    for (const CapillarySurface& part : parts) {
        ASSERT_NO_THROW(part.validate());
        const PlanarMesh below = footprintOf(part);
        ASSERT_NO_THROW(below.validate());
        EXPECT_EQ(part.pressure, field.pressure);
        for (std::uint32_t v = 0; v < part.vertices.size(); ++v) {
            const bool held = part.onRim(v) || part.dry[v] != 0;
            ASSERT_EQ(testing::thicknessAt(part, v, ground) == 0.0, held);
        }
        // The outer loop comes first; only this one runs counter-clockwise.
        for (std::size_t k = 0; k < below.loopCount(); ++k) {
            double enclosed = 0.0;
            for (std::uint32_t v = below.loop_starts[k]; v < below.loop_starts[k + 1]; ++v) {
                enclosed += cross(below.vertices[v], below.vertices[nextOnRim(below, k, v)]);
            }
            EXPECT_EQ(enclosed > 0.0, k == 0);
        }
        part_area += area(below);
        part_volume += volumeOf(part, ground);
        euler += 4 - 2 * static_cast<long>(below.loopCount());
        loops += below.loopCount();
    }
    EXPECT_NEAR(part_area / wet_area, 1.0, 1e-12);
    EXPECT_NEAR(part_volume / volume, 1.0, 1e-12);

    const Surface closed = loft({field}, {.extent = {1, 1}, .ground = ground});
    ASSERT_NO_THROW(closed.validate());
    const Topology found = topology(closed);
    EXPECT_TRUE(found.closed);
    EXPECT_EQ(found.components, parts.size());
    EXPECT_EQ(found.euler, euler);
    EXPECT_NEAR(enclosedVolume(closed) / volume, 1.0, 1e-9);
    EXPECT_NEAR(closed.mean_height * wet_area / volume, 1.0, 1e-12);

    const Topology open = topology(loft({field}, {.open = true, .extent = {1, 1}, .ground = ground}));
    EXPECT_TRUE(open.manifold);
    EXPECT_EQ(open.components, parts.size());
    EXPECT_EQ(open.boundary_loops, loops);
}

PlanarMesh discMesh(double edge)
{
    return triangulate(domainOf(ellipseLoop(1, 1)), {.edge = edge}).front();
}

const BaseSurface kFlat;
const BaseSurface kBowl = BaseSurface::sphere(-3.0);

// Dry sets of all kinds: single vertices, thick and thin patches, patches that touch the rim or each other at a vertex,
// and sets that leave little liquid.
TEST(WetParts, AreSoundForAnyDrySet)
{
    std::mt19937 random(5);
    std::vector<PlanarMesh> meshes{discMesh(0.12)};
    for (const auto& [name, domain] : testing::zoo()) {
        for (PlanarMesh& mesh : triangulate(domain, {.triangles = 900, .edge = {}})) {
            if (mesh.triangles.size() > 30) {
                meshes.push_back(std::move(mesh));
            }
        }
    }
    std::size_t splits = 0;
    std::size_t several = 0;
    std::size_t holes = 0;
    std::size_t pinched = 0;
    for (std::size_t m = 0; m < meshes.size(); ++m) {
        const PlanarMesh& mesh = meshes[m];
        double size = 0.0;
        for (const Vec2 p : mesh.vertices) {
            size = std::max(size, length(p));
        }
        // The ground's curvature is relative to the size of the mesh.
        const BaseSurface bowl = BaseSurface::sphere(-3.0 * size);
        for (int trial = 0; trial < 24; ++trial) {
            SCOPED_TRACE("mesh " + std::to_string(m) + ", trial " + std::to_string(trial));
            const double share =
                std::vector<double>{0.01, 0.1, 0.3, 0.6, 0.9, 0.99}[static_cast<std::size_t>(trial) % 6];
            const bool by_patch = trial % 2 == 0;
            std::vector<Vec2> middles;
            for (int k = 0; k < 6; ++k) {
                middles.push_back(mesh.vertices[random() % mesh.vertices.size()]);
            }
            const double radius = share * size * 0.5;
            const CapillarySurface field = fieldWith(mesh, trial % 4 < 2 ? kFlat : bowl, [&](std::uint32_t, Vec2 p) {
                if (by_patch) {
                    return std::any_of(middles.begin(), middles.end(),
                                       [&](Vec2 middle) { return length(p - middle) < radius; });
                }
                return random() % 1000 < static_cast<unsigned>(1000 * share);
            });
            expectSound(mesh, field, trial % 4 < 2 ? kFlat : bowl);
            const std::vector<CapillarySurface> parts = partsOf(field, trial % 4 < 2 ? kFlat : bowl);
            several += parts.size() > 1 ? 1 : 0;
            for (const CapillarySurface& part : parts) {
                holes += part.loop_starts.size() > 2 ? 1 : 0;
                std::set<std::pair<double, double>> places;
                for (const Vec3& p : part.vertices) {
                    pinched += places.emplace(p.x, p.y).second ? 0 : 1;
                }
            }
            std::size_t kept = 0;
            std::size_t made = 0;
            for (const Triangle& t : mesh.triangles) {
                kept += isGrounded(mesh, field, t) ? 0 : 1;
            }
            for (const CapillarySurface& part : parts) {
                made += part.triangles.size();
            }
            splits += made - kept;
        }
    }
    // All awkward cases occurred.
    EXPECT_GT(splits, 1000U);
    EXPECT_GT(several, 50U);
    EXPECT_GT(holes, 50U);
    EXPECT_GT(pinched, 100U);
}

TEST(WetParts, AreTheDropletIfNothingIsDry)
{
    const PlanarMesh mesh = discMesh(0.2);
    const CapillarySurface field = fieldWith(mesh, kBowl, [](std::uint32_t, Vec2) { return false; });
    const std::vector<CapillarySurface> parts = partsOf(field, kBowl);
    ASSERT_EQ(parts.size(), 1U);
    EXPECT_EQ(parts[0].vertices.size(), mesh.vertices.size());
    EXPECT_EQ(parts[0].triangles.size(), mesh.triangles.size());
    EXPECT_EQ(parts[0].loop_starts, mesh.loop_starts);
    expectSound(mesh, field, kBowl);
}

TEST(WetParts, OneDryVertexStaysAnInnerVertex)
{
    const PlanarMesh mesh = discMesh(0.2);
    std::size_t inside = 0;
    for (std::uint32_t only = mesh.rimVertexCount(); only < mesh.vertices.size(); ++only) {
        const CapillarySurface field = fieldWith(mesh, kFlat, [&](std::uint32_t v, Vec2) { return v == only; });
        expectSound(mesh, field, kFlat);
        const std::vector<CapillarySurface> parts = partsOf(field, kFlat);
        ASSERT_EQ(parts.size(), 1U);
        const bool beside_rim = std::any_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const Triangle& t) {
            return std::find(t.begin(), t.end(), only) != t.end() && isGrounded(mesh, field, t);
        });
        if (!beside_rim) {
            ++inside;
            EXPECT_EQ(parts[0].triangles.size(), mesh.triangles.size());
            EXPECT_EQ(std::count(parts[0].dry.begin(), parts[0].dry.end(), 1), 1);
        }
    }
    EXPECT_GT(inside, 20U);
}

TEST(WetParts, OneWetVertexKeepsItsTriangles)
{
    const PlanarMesh mesh = discMesh(0.2);
    for (std::uint32_t only = mesh.rimVertexCount(); only < mesh.vertices.size(); only += 7) {
        const CapillarySurface field = fieldWith(mesh, kBowl, [&](std::uint32_t v, Vec2) { return v != only; });
        expectSound(mesh, field, kBowl);
        const std::vector<CapillarySurface> parts = partsOf(field, kBowl);
        ASSERT_EQ(parts.size(), 1U);
        EXPECT_EQ(parts[0].vertices.size(), parts[0].rimVertexCount() + 1U);
        EXPECT_EQ(parts[0].triangles.size(), parts[0].rimVertexCount());
    }
    expectSound(mesh, fieldWith(mesh, kFlat, [](std::uint32_t, Vec2) { return true; }), kFlat);
}

TEST(WetParts, ADryBarLeavesTwoDroplets)
{
    const PlanarMesh mesh =
        triangulate(domainOf(polygonLoop({{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})), {.edge = 0.1}).front();
    const CapillarySurface field = fieldWith(mesh, kFlat, [](std::uint32_t, Vec2 p) { return std::abs(p.x) < 0.25; });
    expectSound(mesh, field, kFlat);
    EXPECT_EQ(partsOf(field, kFlat).size(), 2U);
}

TEST(WetParts, ADryPatchInsideIsAHoleOfTheSameArea)
{
    const PlanarMesh mesh = discMesh(0.05);
    const CapillarySurface field = fieldWith(mesh, kFlat, [](std::uint32_t, Vec2 p) { return length(p) < 0.4; });
    const std::vector<CapillarySurface> parts = partsOf(field, kFlat);
    ASSERT_EQ(parts.size(), 1U);
    EXPECT_EQ(parts[0].loop_starts.size(), 3U);
    EXPECT_EQ(parts[0].triangles.size(),
              mesh.triangles.size() - static_cast<std::size_t>(std::count_if(
                                          mesh.triangles.begin(), mesh.triangles.end(),
                                          [&](const Triangle& t) { return isGrounded(mesh, field, t); })));
    expectSound(mesh, field, kFlat);
}

// Two dry patches share a vertex: the liquid has two copies of it.
TEST(WetParts, PatchesThatTouchDiagonallyPinch)
{
    // A square of four triangles around its middle, in a ring of others; two opposite ones are dry.
    PlanarMesh mesh;
    const auto add = [&](double x, double y) { mesh.vertices.push_back({x, y}); };
    for (int k = 0; k < 8; ++k) {
        add(3 * std::cos(k * 0.7853981633974483), 3 * std::sin(k * 0.7853981633974483));
    }
    for (int k = 0; k < 8; ++k) {
        add(2 * std::cos(k * 0.7853981633974483), 2 * std::sin(k * 0.7853981633974483));
    }
    for (int k = 0; k < 8; ++k) {
        add(std::cos(k * 0.7853981633974483), std::sin(k * 0.7853981633974483));
    }
    add(0, 0);
    mesh.loop_starts = {0, 8};
    for (std::uint32_t k = 0; k < 8; ++k) {
        const std::uint32_t next = (k + 1) % 8;
        for (const std::uint32_t ring : {0U, 8U}) {
            mesh.triangles.push_back({ring + k, ring + next, ring + 8 + next});
            mesh.triangles.push_back({ring + k, ring + 8 + next, ring + 8 + k});
        }
        mesh.triangles.push_back({16 + k, 16 + next, 24});
    }
    ASSERT_NO_THROW(mesh.validate());
    const BaseSurface bowl = BaseSurface::sphere(-9.0);
    const std::set<std::uint32_t> dry{16, 17, 20, 21, 24};
    const CapillarySurface field = fieldWith(mesh, bowl, [&](std::uint32_t v, Vec2) { return dry.contains(v); });
    expectSound(mesh, field, bowl);
    const std::vector<CapillarySurface> parts = partsOf(field, bowl);
    ASSERT_EQ(parts.size(), 1U);
    // Both holes are one loop that passes the middle twice.
    EXPECT_EQ(parts[0].loop_starts, (std::vector<std::uint32_t>{0, 8, 14}));
    EXPECT_EQ(std::count_if(parts[0].vertices.begin(), parts[0].vertices.end(),
                            [](const Vec3& p) { return p.x == 0.0 && p.y == 0.0; }),
              2);
}

// The surface and the base must not share an inner edge from a dry patch to the rim.
TEST(WetParts, EdgesAcrossTheLiquidAreSplit)
{
    const PlanarMesh mesh = discMesh(0.1);
    std::size_t middles = 0;
    for (double radius = 0.4; radius < 0.95; radius += 0.01) {
        const CapillarySurface field =
            fieldWith(mesh, kBowl, [&](std::uint32_t, Vec2 p) { return length(p) < radius; });
        expectSound(mesh, field, kBowl);
        for (const CapillarySurface& part : partsOf(field, kBowl)) {
            for (std::uint32_t v = part.rimVertexCount(); v < part.vertices.size(); ++v) {
                const Vec2 p{part.vertices[v].x, part.vertices[v].y};
                if (std::find(mesh.vertices.begin(), mesh.vertices.end(), p) == mesh.vertices.end()) {
                    ++middles;
                    EXPECT_EQ(part.dry[v], 1);
                    EXPECT_EQ(part.vertices[v].z, kBowl.at(p).height);
                }
            }
        }
    }
    EXPECT_GT(middles, 10U);
}

TEST(WetParts, LieOnTheGroundAlongANewRim)
{
    const PlanarMesh mesh = discMesh(0.1);
    CapillarySurface field = fieldWith(mesh, kBowl, [](std::uint32_t, Vec2 p) {
        return length(p - Vec2{0.5, 0}) < 0.4;
    });
    std::fill(field.contact_angle.begin(), field.contact_angle.end(), 0.7);
    const std::vector<CapillarySurface> parts = partsOf(field, kBowl);
    ASSERT_EQ(parts.size(), 1U);
    const PlanarMesh part = footprintOf(parts[0]);
    std::size_t is_new = 0;
    for (std::uint32_t v = 0; v < part.rimVertexCount(); ++v) {
        const auto rim_end = mesh.vertices.begin() + mesh.rimVertexCount();
        const bool is_old = std::find(mesh.vertices.begin(), rim_end, part.vertices[v]) != rim_end;
        is_new += is_old ? 0 : 1;
        EXPECT_EQ(parts[0].contact_angle[v], is_old ? 0.7 : 0.0);
    }
    EXPECT_GT(is_new, 10U);
    // So normals there are the reversed normals of the base.
    const Surface surface = loft({field}, {.extent = {1, 1}, .ground = kBowl});
    std::size_t compared = 0;
    for (std::uint32_t v = 0; v < surface.vertices.size(); ++v) {
        const std::uint32_t first = surface.weld[v];
        if (first != v && surface.contact_angle[first] == 0.0F) {
            ++compared;
            EXPECT_LT(length(surface.normals[first] + surface.normals[v]), 1e-12);
        }
    }
    EXPECT_EQ(compared, is_new);
}

/// The same liquid as a sheet.
CapillarySurface sheetOf(const PlanarMesh& mesh, CapillarySurface field)
{
    field.footprint = mesh;
    return field;
}

TEST(WetParts, OfADrySheetAreNone)
{
    const PlanarMesh mesh = discMesh(0.2);
    const CapillarySurface wet = sheetOf(mesh, fieldWith(mesh, kFlat, [](std::uint32_t, Vec2) { return false; }));
    EXPECT_FALSE(wetParts(wet, kFlat));
    const CapillarySurface dry = sheetOf(mesh, fieldWith(mesh, kFlat, [](std::uint32_t, Vec2) { return true; }));
    ASSERT_TRUE(wetParts(dry, kFlat));
    EXPECT_TRUE(wetParts(dry, kFlat)->empty());
    EXPECT_THROW((void)loft({dry}, {.extent = {1, 1}}), Error);
}

// Dry sets of all kinds, as above. What would make a rim pass a place twice stays.
TEST(WetParts, OfSheetsAreSoundForAnyDrySet)
{
    std::mt19937 random(7);
    std::size_t several = 0;
    std::size_t holes = 0;
    std::size_t removed = 0;
    for (const auto& [name, domain] : testing::zoo()) {
        const PlanarMesh mesh = triangulate(domain, {.triangles = 900, .edge = {}}).front();
        if (mesh.triangles.size() < 30) {
            continue;
        }
        double size = 0.0;
        for (const Vec2 p : mesh.vertices) {
            size = std::max(size, length(p));
        }
        for (int trial = 0; trial < 24; ++trial) {
            SCOPED_TRACE(name + ", trial " + std::to_string(trial));
            const double share =
                std::vector<double>{0.01, 0.1, 0.3, 0.6, 0.9, 0.99}[static_cast<std::size_t>(trial) % 6];
            std::vector<Vec2> middles;
            for (int k = 0; k < 6; ++k) {
                middles.push_back(mesh.vertices[random() % mesh.vertices.size()]);
            }
            const CapillarySurface field = fieldWith(mesh, kFlat, [&](std::uint32_t, Vec2 p) {
                if (trial % 2 == 0) {
                    return std::any_of(middles.begin(), middles.end(),
                                       [&](Vec2 middle) { return length(p - middle) < 0.5 * share * size; });
                }
                return random() % 1000 < static_cast<unsigned>(1000 * share);
            });
            const double volume = volumeOf(field, kFlat);
            if (volume == 0.0) {
                continue;
            }
            const CapillarySurface sheet = sheetOf(mesh, field);
            const std::vector<CapillarySurface> parts =
                wetParts(sheet, kFlat).value_or(std::vector<CapillarySurface>{});
            several += parts.size() > 1 ? 1 : 0;
            long euler = 0;
            for (const CapillarySurface& part : parts) {
                ASSERT_NO_THROW(part.validate());
                euler += 4 - 2 * static_cast<long>(part.footprint->loopCount());
                holes += part.footprint->loopCount() > 1 ? 1 : 0;
                std::set<std::pair<double, double>> places;
                for (std::uint32_t v = 0; v < part.rimVertexCount(); ++v) {
                    EXPECT_EQ(part.vertices[v].z, 0.0);
                    EXPECT_TRUE(places.emplace(part.vertices[v].x, part.vertices[v].y).second);
                }
            }
            const LoftOptions options{.extent = {1, 1}};
            const Surface surface = loft({sheet}, options);
            ASSERT_NO_THROW(surface.validate());
            const Topology found = topology(surface);
            EXPECT_TRUE(found.closed);
            EXPECT_EQ(found.components, std::max<std::size_t>(parts.size(), 1));
            if (!parts.empty()) {
                EXPECT_EQ(found.euler, euler);
            }
            EXPECT_NEAR(enclosedVolume(surface) / volume, 1.0, 1e-9);
            EXPECT_EQ(surface.parts.size(), 1U);
            LoftOptions whole = options;
            whole.keeps_dry = true;
            removed += loft({sheet}, whole).triangles.size() > surface.triangles.size() ? 1 : 0;
        }
    }
    // All awkward cases occurred.
    EXPECT_GT(several, 20U);
    EXPECT_GT(holes, 20U);
    EXPECT_GT(removed, 50U);
}

}  // namespace
}  // namespace droplet
