// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/lattice_core.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "droplet/error.h"
#include "droplet/mesh/triangulate.h"
#include "mesh/lattice.h"
#include "mesh/lattice_triangles.h"
#include "mesh/rim_sampling.h"
#include "support/domains.h"
#include "support/zoo.h"

namespace droplet {
namespace {

using testing::domainOf;
using testing::ellipseLoop;

using Ends = std::array<std::uint32_t, 2>;

Ends ordered(std::uint32_t a, std::uint32_t b)
{
    return {std::min(a, b), std::max(a, b)};
}

/// Corners opposite to every edge
std::map<Ends, std::vector<std::uint32_t>> oppositeCorners(const std::vector<Triangle>& triangles)
{
    std::map<Ends, std::vector<std::uint32_t>> opposite;
    for (const Triangle& t : triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            opposite[ordered(t[(k + 1) % 3], t[(k + 2) % 3])].push_back(t[k]);
        }
    }
    return opposite;
}

/// Meshes of the zoo, coarse and fine, with and without grading.
std::vector<std::pair<std::string, PlanarMesh>> zooMeshes()
{
    std::vector<std::pair<std::string, PlanarMesh>> meshes;
    for (const auto& [name, domain] : testing::zoo()) {
        for (const std::size_t triangles : {700U, 5000U, 20000U}) {
            for (const int grading : {1, 8}) {
                for (PlanarMesh& mesh : triangulate(domain, {.triangles = triangles, .edge = {}, .grading = grading})) {
                    meshes.emplace_back(
                        name + " of " + std::to_string(triangles) + ", grading " + std::to_string(grading),
                        std::move(mesh));
                }
            }
        }
    }
    return meshes;
}

// The two angles that face an edge off the rim sum to at most 180°. So no off-diagonal entry of the stiffness matrix is
// positive, and without gravity no height is negative.
TEST(LatticeCore, EveryEdgeOffTheRimIsDelaunay)
{
    for (const auto& [name, mesh] : zooMeshes()) {
        SCOPED_TRACE(name);
        const auto angle_at = [&vertices = mesh.vertices](std::uint32_t corner, const Ends& ends) {
            const Vec2 u = vertices[ends[0]] - vertices[corner];
            const Vec2 v = vertices[ends[1]] - vertices[corner];
            return std::atan2(std::abs(cross(u, v)), dot(u, v));
        };
        std::size_t inner = 0;
        double largest = 0.0;
        for (const auto& [ends, corners] : oppositeCorners(mesh.triangles)) {
            if (corners.size() == 1) {
                ASSERT_TRUE(mesh.onRim(ends[1]));
                continue;
            }
            ASSERT_EQ(corners.size(), 2U);
            ++inner;
            if (!mesh.onRim(ends[0])) {
                largest = std::max(largest, angle_at(corners[0], ends) + angle_at(corners[1], ends));
            }
        }
        EXPECT_LE(largest, std::numbers::pi + 1e-9);
        EXPECT_EQ(inner, (3 * mesh.triangles.size() - mesh.rimVertexCount()) / 2);
    }
}

// The circumcircle of every core triangle contains no vertex of the mesh and no part of the rim.
TEST(LatticeCore, ItsTrianglesAreDelaunayInTheWholeMesh)
{
    for (const auto& [name, domain] : testing::zoo()) {
        SCOPED_TRACE(name);
        for (const PlanarMesh& mesh : triangulate(domain, {.triangles = 2500, .edge = {}})) {
            if (!mesh.lattice) {
                continue;
            }
            const std::uint32_t first = mesh.lattice->grid.begin();
            const double radius = mesh.lattice->edge / std::numbers::sqrt3;
            std::size_t in_core = 0;
            for (const Triangle& t : mesh.triangles) {
                const Vec2 centre = (1.0 / 3.0) * (mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]);
                if (std::min({t[0], t[1], t[2]}) < first || length(mesh.vertices[t[0]] - centre) > 1.01 * radius) {
                    continue;
                }
                ++in_core;
                for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
                    ASSERT_GT(length(mesh.vertices[v] - centre), (1.0 - 1e-9) * radius) << v;
                }
                for (std::size_t k = 0; k < mesh.loopCount(); ++k) {
                    for (std::uint32_t v = mesh.loop_starts[k]; v < mesh.loop_starts[k + 1]; ++v) {
                        const Vec2 a = mesh.vertices[v];
                        const Vec2 along = mesh.vertices[nextOnRim(mesh, k, v)] - a;
                        const double at = std::clamp(dot(centre - a, along) / dot(along, along), 0.0, 1.0);
                        ASSERT_GT(length(a + at * along - centre), radius);
                    }
                }
            }
            EXPECT_EQ(in_core, trianglesOf(mesh.lattice->grid.region()).size());
        }
    }
}

TEST(LatticeCore, HoldsMostOfAFineMesh)
{
    double last = 0.0;
    for (const std::size_t triangles : {2000U, 8000U, 32000U}) {
        const PlanarMesh mesh = triangulate(domainOf(ellipseLoop(1, 1)), {.triangles = triangles, .edge = {}})[0];
        const auto all = static_cast<double>(mesh.triangles.size());
        const double outside = mesh.lattice->first_regular_triangle / all;
        // Irregular triangles lie along the rim, so their share falls like the edge length.
        if (last > 0.0) {
            EXPECT_NEAR(outside / last, 0.5, 0.05) << triangles;
        }
        last = outside;
    }
}

TEST(LatticeCore, LayersAndSeamFollowTheirDefinitions)
{
    for (const auto& [name, domain] : testing::zoo()) {
        for (const Footprint& footprint : domain.droplets) {
            const double edge = 0.06 * std::sqrt(area(footprint));
            const std::vector<RimPolygon> polygons = RimSampler(footprint, edge).sample(edge);
            const LatticeCore core(polygons, edge);
            SCOPED_TRACE(name);
            EXPECT_EQ(core.loosePoints().size() + core.fixedCount(), countClearPoints(polygons, edge));
            PlanarMesh mesh;
            core.appendTo(mesh);
            ASSERT_EQ(mesh.vertices.size(), core.fixedCount());

            // Edges of only one triangle are the boundary, and their ends belong to the seam.
            std::set<Ends> wanted;
            for (const auto& [ends, corners] : oppositeCorners(mesh.triangles)) {
                if (corners.size() == 1) {
                    wanted.insert(ends);
                }
            }
            const std::vector<std::uint32_t> seam = core.seamNumbers();
            std::set<Ends> found;
            for (const auto& [a, b] : core.boundary()) {
                EXPECT_TRUE(found.insert(ordered(seam[a], seam[b])).second) << "edge occurs twice";
            }
            EXPECT_EQ(found, wanted);

            const std::vector<Vec2> points = core.seamPoints();
            ASSERT_EQ(points.size(), seam.size());
            ASSERT_EQ(mesh.lattice != nullptr, core.fixedCount() > 0);
            const LatticeRegion fixed = mesh.lattice ? mesh.lattice->grid.region() : LatticeRegion();
            std::set<std::uint32_t> on_seam(seam.begin(), seam.end());
            for (std::size_t k = 0; k < seam.size(); ++k) {
                EXPECT_EQ(mesh.vertices[seam[k]], points[k]);
            }
            EXPECT_EQ(on_seam.size(), core.fixedCount() - eroded(fixed).size());
            for (const GridRun& run : regularRuns(mesh.lattice.get())) {
                for (std::uint32_t k = 0; k < run.count; ++k) {
                    EXPECT_FALSE(on_seam.contains(run.first + k));
                    // The neighbours are at the places that the run gives.
                    const Vec2 at = mesh.vertices[run.first + k];
                    for (const std::uint32_t other : {run.first + k - 1, run.first + k + 1, run.below + k,
                                                      run.below + k + 1, run.above + k, run.above + k + 1}) {
                        EXPECT_NEAR(length(mesh.vertices[other] - at) / edge, 1.0, 1e-9);
                    }
                    EXPECT_LT(mesh.vertices[run.below + k].y, at.y);
                    EXPECT_GT(mesh.vertices[run.above + k].y, at.y);
                }
            }
        }
    }
}

TEST(LatticeCore, GradedPointsKeepTheirDistance)
{
    for (const auto& [name, domain] : testing::zoo()) {
        SCOPED_TRACE(name);
        const Footprint& footprint = domain.droplets[0];
        const double edge = 0.03 * std::sqrt(area(footprint));
        const std::vector<RimPolygon> polygons = RimSampler(footprint, edge).sample(edge);
        EXPECT_EQ(gradedPoints(polygons, edge, 1).size(), countClearPoints(polygons, edge));
        std::size_t last = std::numeric_limits<std::size_t>::max();
        for (const int longest : {1, 2, 4, 8, 16}) {
            const std::vector<Vec2> points = gradedPoints(polygons, edge, longest);
            EXPECT_LE(points.size(), last);
            last = points.size();
            double nearest = std::numeric_limits<double>::infinity();
            for (std::size_t i = 0; i < points.size(); ++i) {
                for (std::size_t j = 0; j < i; ++j) {
                    nearest = std::min(nearest, length(points[i] - points[j]));
                }
            }
            EXPECT_GT(nearest, (1.0 - 1e-9) * edge) << longest;
        }
    }
}

/// Mesh from which every broken one below is made.
PlanarMesh wholeMesh()
{
    // The hole splits some rows into two runs.
    return triangulate(domainOf(ellipseLoop(1, 1), {testing::reversed(ellipseLoop(0.2, 0.3))}),
                       {.triangles = 3000, .edge = {}})[0];
}

struct Defect {
    const char* name;
    std::function<void(PlanarMesh&, Lattice&)> make;
    const char* complaint;
};

/// Replaces the region of the lattice's grid.
void change(Lattice& lattice, const std::function<void(std::vector<RowInterval>&)>& edit)
{
    std::vector<RowInterval> intervals = lattice.grid.region().intervals();
    edit(intervals);
    lattice.grid = LatticeGrid(LatticeRegion(std::move(intervals)), lattice.grid.begin());
}

TEST(PlanarMesh, ValidateRejectsABrokenLattice)
{
    const PlanarMesh whole = wholeMesh();
    ASSERT_NO_THROW(whole.validate());
    ASSERT_TRUE(whole.lattice);
    ASSERT_GT(whole.lattice->grid.region().intervals().size(), 10U);
    const std::uint32_t first_regular = whole.lattice->first_regular_triangle;
    constexpr const char* kPlace = "must be at its lattice point";
    constexpr const char* kLast = "must hold its last vertices";
    constexpr const char* kRegular = "first_regular_triangle";
    constexpr const char* kTriangles = "must form triangles";
    constexpr const char* kEdge = "lattice.edge";
    const std::vector<Defect> defects{
        {"edge not a number", [](PlanarMesh&, Lattice& l) { l.edge = std::nan(""); }, kEdge},
        {"edge 0", [](PlanarMesh&, Lattice& l) { l.edge = 0.0; }, kEdge},
        {"edge infinite", [](PlanarMesh&, Lattice& l) { l.edge = std::numeric_limits<double>::infinity(); }, kEdge},
        {"edge of another lattice", [](PlanarMesh&, Lattice& l) { l.edge *= 1.0 + 1e-9; }, kPlace},
        {"a vertex off by one bit",
         [](PlanarMesh& m, Lattice&) { m.vertices.back().x = std::nextafter(m.vertices.back().x, 9.0); }, kPlace},
        {"a vertex in the middle off by one bit",
         [](PlanarMesh& m, Lattice& l) {
             Vec2& p = m.vertices[l.grid.at(l.grid.region().intervals()[5].first()) + 1];
             p.y = std::nextafter(p.y, 9.0);
         },
         kPlace},
        {"an interval a column further",
         [](PlanarMesh&, Lattice& l) {
             change(l, [](std::vector<RowInterval>& intervals) {
                 ++intervals.back().begin;
                 ++intervals.back().end;
             });
         },
         kPlace},
        {"an interval in another row",
         [](PlanarMesh&, Lattice& l) {
             change(l, [](std::vector<RowInterval>& intervals) { intervals.back().row += 2; });
         },
         kPlace},
        {"an interval left out",
         [](PlanarMesh&, Lattice& l) {
             change(l, [](std::vector<RowInterval>& intervals) { intervals.erase(intervals.begin() + 4); });
         },
         kLast},
        {"the last interval too long",
         [](PlanarMesh&, Lattice& l) {
             change(l, [](std::vector<RowInterval>& intervals) { ++intervals.back().end; });
         },
         kLast},
        {"the last interval too short",
         [](PlanarMesh&, Lattice& l) {
             change(l, [](std::vector<RowInterval>& intervals) { --intervals.back().end; });
         },
         kLast},
        {"no points", [](PlanarMesh&, Lattice& l) { l.grid = {}; }, kLast},
        {"vertices of the rim",
         [](PlanarMesh& m, Lattice& l) {
             const auto count = static_cast<std::int32_t>(m.vertices.size());
             l.grid = LatticeGrid(LatticeRegion({{0, 0, count}}), 0);
         },
         kLast},
        {"regular from too early on", [](PlanarMesh&, Lattice& l) { --l.first_regular_triangle; }, kRegular},
        {"regular from too late on", [](PlanarMesh&, Lattice& l) { ++l.first_regular_triangle; }, kRegular},
        {"regular never",
         [](PlanarMesh& m, Lattice& l) { l.first_regular_triangle = static_cast<std::uint32_t>(m.triangles.size()); },
         kRegular},
        {"a regular triangle among the others",
         [=](PlanarMesh& m, Lattice&) { std::swap(m.triangles[0], m.triangles[first_regular]); }, kRegular},
        {"a regular triangle missing", [](PlanarMesh& m, Lattice&) { m.triangles.pop_back(); }, kTriangles},
        {"a triangle at the seam missing",
         [=](PlanarMesh& m, Lattice& l) {
             m.triangles.erase(m.triangles.begin() + first_regular - 1);
             --l.first_regular_triangle;
         },
         kTriangles},
        {"a triangle twice", [](PlanarMesh& m, Lattice&) { m.triangles.push_back(m.triangles.back()); }, kTriangles}};
    for (const Defect& defect : defects) {
        PlanarMesh broken = whole;
        Lattice lattice = *whole.lattice;
        defect.make(broken, lattice);
        broken.lattice = std::make_shared<const Lattice>(std::move(lattice));
        try {
            broken.validate();
            ADD_FAILURE() << defect.name << " passes";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::InvalidArgument);
            EXPECT_NE(std::string(error.what()).find(defect.complaint), std::string::npos)
                << defect.name << ": " << error.what();
        }
    }
}

TEST(PlanarMesh, MayHaveNoLattice)
{
    PlanarMesh mesh = wholeMesh();
    mesh.lattice = {};
    EXPECT_NO_THROW(mesh.validate());
}

}  // namespace
}  // namespace droplet
