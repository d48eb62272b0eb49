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
#include <numbers>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "droplet/error.h"
#include "droplet/mesh/triangulate.h"
#include "mesh/regular_runs.h"
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

/// Corners opposite to every edge.
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

/// The zoo, coarse and fine, with and without grading.
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

// Two angles that face an edge off the rim sum to 180° at most. So no off-diagonal entry of the stiffness matrix is
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

// The circle around every triangle of the core is empty of all the mesh's vertices, and of the rim.
TEST(LatticeCore, ItsTrianglesAreDelaunayInTheWholeMesh)
{
    for (const auto& [name, domain] : testing::zoo()) {
        SCOPED_TRACE(name);
        for (const PlanarMesh& mesh : triangulate(domain, {.triangles = 2500, .edge = {}})) {
            if (mesh.lattice.runs.empty()) {
                continue;
            }
            const std::uint32_t first = mesh.lattice.runs.front().vertex;
            const double radius = mesh.lattice.edge / std::numbers::sqrt3;
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
            EXPECT_EQ(in_core, countTriangles(regionOf(mesh.lattice)));
        }
    }
}

TEST(LatticeCore, HoldsMostOfAFineMesh)
{
    double last = 0.0;
    for (const std::size_t triangles : {2000U, 8000U, 32000U}) {
        const PlanarMesh mesh = triangulate(domainOf(ellipseLoop(1, 1)), {.triangles = triangles, .edge = {}})[0];
        const auto all = static_cast<double>(mesh.triangles.size());
        const double outside = mesh.lattice.first_regular_triangle / all;
        // What is not regular is along the rim: its share falls like the edge.
        if (last > 0.0) {
            EXPECT_NEAR(outside / last, 0.5, 0.05) << triangles;
        }
        last = outside;
    }
}

TEST(LatticeCore, LayersAndSeamAreWhatTheyAreCalled)
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

            // Edges of one triangle only are the boundary, and their ends belong to the seam.
            std::set<Ends> wanted;
            for (const auto& [ends, corners] : oppositeCorners(mesh.triangles)) {
                if (corners.size() == 1) {
                    wanted.insert(ends);
                }
            }
            const std::vector<std::uint32_t> seam = core.seamNumbers();
            std::set<Ends> found;
            for (const auto& [a, b] : core.boundary()) {
                EXPECT_TRUE(found.insert(ordered(seam[a], seam[b])).second) << "an edge twice";
            }
            EXPECT_EQ(found, wanted);

            ASSERT_EQ(core.seam().size(), seam.size());
            const LatticeRegion fixed = regionOf(mesh.lattice);
            std::set<std::uint32_t> on_seam(seam.begin(), seam.end());
            for (std::size_t k = 0; k < seam.size(); ++k) {
                const auto [row, column] = core.seam()[k];
                EXPECT_EQ(mesh.vertices[seam[k]], latticePoint(edge, row, column));
            }
            EXPECT_EQ(on_seam.size(), core.fixedCount() - eroded(fixed).size());
            for (const RegularRun& run : regularRuns(mesh.lattice)) {
                for (std::uint32_t k = 0; k < run.count; ++k) {
                    EXPECT_FALSE(on_seam.contains(run.first + k));
                    // The neighbours are where the run says they are.
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

/// The mesh that every broken one below is made of.
PlanarMesh wholeMesh()
{
    // The hole parts some rows in two runs.
    return triangulate(domainOf(ellipseLoop(1, 1), {testing::reversed(ellipseLoop(0.2, 0.3))}),
                       {.triangles = 3000, .edge = {}})[0];
}

struct Defect {
    const char* name;
    std::function<void(PlanarMesh&)> make;
    const char* complaint;
};

TEST(PlanarMesh, ValidateRefusesABrokenLattice)
{
    const PlanarMesh whole = wholeMesh();
    ASSERT_NO_THROW(whole.validate());
    const Lattice& lattice = whole.lattice;
    ASSERT_GT(lattice.runs.size(), 10U);
    // Where one row has two runs.
    const auto second = std::adjacent_find(lattice.runs.begin(), lattice.runs.end(),
                                           [](const LatticeRun& a, const LatticeRun& b) { return a.row == b.row; });
    ASSERT_NE(second, lattice.runs.end());
    const auto parted = static_cast<std::size_t>(second - lattice.runs.begin());
    const std::uint32_t first_regular = lattice.first_regular_triangle;
    constexpr const char* kRuns = "must follow the one before";
    constexpr const char* kPlace = "must be at its lattice point";
    constexpr const char* kLast = "must hold its last vertices";
    constexpr const char* kRegular = "first_regular_triangle";
    constexpr const char* kTriangles = "must form triangles";
    constexpr const char* kEdge = "lattice.edge";
    const std::vector<Defect> defects{
        {"edge not a number", [](PlanarMesh& m) { m.lattice.edge = std::nan(""); }, kEdge},
        {"edge 0", [](PlanarMesh& m) { m.lattice.edge = 0.0; }, kEdge},
        {"edge infinite", [](PlanarMesh& m) { m.lattice.edge = std::numeric_limits<double>::infinity(); }, kEdge},
        {"edge of another lattice", [](PlanarMesh& m) { m.lattice.edge *= 1.0 + 1e-9; }, kPlace},
        {"a vertex off by one bit",
         [](PlanarMesh& m) { m.vertices.back().x = std::nextafter(m.vertices.back().x, 9.0); }, kPlace},
        {"a vertex in the middle off by one bit",
         [](PlanarMesh& m) {
             Vec2& p = m.vertices[m.lattice.runs[5].vertex + 1];
             p.y = std::nextafter(p.y, 9.0);
         },
         kPlace},
        {"a run a column further", [](PlanarMesh& m) { ++m.lattice.runs.back().column; }, kPlace},
        {"rows descending", [](PlanarMesh& m) { m.lattice.runs[4].row = m.lattice.runs[3].row - 1; }, kRuns},
        {"runs swapped", [](PlanarMesh& m) { std::swap(m.lattice.runs[3], m.lattice.runs[4]); }, kRuns},
        {"runs of one row swapped",
         [=](PlanarMesh& m) { std::swap(m.lattice.runs[parted], m.lattice.runs[parted + 1]); }, kRuns},
        {"one run in two, without a gap",
         [](PlanarMesh& m) {
             LatticeRun rest = m.lattice.runs[4];
             m.lattice.runs[4].count = 1;
             rest.column += 1;
             rest.vertex += 1;
             rest.count -= 1;
             m.lattice.runs.insert(m.lattice.runs.begin() + 5, rest);
         },
         kRuns},
        {"a run of nothing",
         [](PlanarMesh& m) {
             LatticeRun none = m.lattice.runs.back();
             none.vertex += none.count;
             none.row += 1;
             none.count = 0;
             m.lattice.runs.push_back(none);
         },
         kRuns},
        {"a run left out", [](PlanarMesh& m) { m.lattice.runs.erase(m.lattice.runs.begin() + 4); }, kRuns},
        {"a run that goes on beyond the vertices", [](PlanarMesh& m) { ++m.lattice.runs.back().count; }, kRuns},
        {"the last run left out", [](PlanarMesh& m) { m.lattice.runs.pop_back(); }, kLast},
        {"the last run too short", [](PlanarMesh& m) { --m.lattice.runs.back().count; }, kLast},
        {"a rim vertex in a run",
         [](PlanarMesh& m) {
             m.lattice.runs = {{0, 0, 0, 1}};
         },
         kRuns},
        {"regular from too early on", [](PlanarMesh& m) { --m.lattice.first_regular_triangle; }, kRegular},
        {"regular from too late on", [](PlanarMesh& m) { ++m.lattice.first_regular_triangle; }, kRegular},
        {"regular never",
         [](PlanarMesh& m) { m.lattice.first_regular_triangle = static_cast<std::uint32_t>(m.triangles.size()); },
         kRegular},
        {"a regular triangle among the others",
         [=](PlanarMesh& m) { std::swap(m.triangles[0], m.triangles[first_regular]); }, kRegular},
        {"a regular triangle missing", [](PlanarMesh& m) { m.triangles.pop_back(); }, kTriangles},
        {"a triangle at the seam missing",
         [=](PlanarMesh& m) {
             m.triangles.erase(m.triangles.begin() + first_regular - 1);
             --m.lattice.first_regular_triangle;
         },
         kTriangles},
        {"a triangle twice", [](PlanarMesh& m) { m.triangles.push_back(m.triangles.back()); }, kTriangles}};
    for (const Defect& defect : defects) {
        PlanarMesh broken = whole;
        defect.make(broken);
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

TEST(PlanarMesh, ALatticeMayBeForgotten)
{
    PlanarMesh mesh = wholeMesh();
    mesh.lattice = {};
    EXPECT_NO_THROW(mesh.validate());
}

}  // namespace
}  // namespace droplet
