// SPDX-License-Identifier: GPL-3.0-or-later
//
// Nested iteration against spherical caps and against the path on the finest mesh; what a division keeps.
#include "shape/sheet_levels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "droplet/mesh/triangulate.h"
#include "droplet/shape/sheet.h"
#include "droplet/units.h"
#include "mesh/round_inward.h"
#include "shape/sheet_divide.h"
#include "shape/sheet_energy.h"
#include "shape/sheet_newton.h"
#include "shape/sheet_remesh.h"
#include "support/domains.h"
#include "support/equilibrium.h"

namespace droplet {
namespace {

using testing::discMeshes;
using testing::domainOf;
using testing::ellipseLoop;
using testing::polygonLoop;
using testing::reversed;

constexpr double kPi = std::numbers::pi;

/// Spherical cap over the unit disc.
struct Cap {
    double angle;

    [[nodiscard]] double radius() const { return 1.0 / std::sin(angle); }
    [[nodiscard]] Vec3 centre() const { return {0.0, 0.0, -radius() * std::cos(angle)}; }
    [[nodiscard]] double rise() const { return radius() * (1.0 - std::cos(angle)); }
    [[nodiscard]] double volume() const { return kPi / 6.0 * rise() * (3.0 + rise() * rise()); }
};

PlanarMesh rounded(const Domain& domain, double edge)
{
    const PlanarMesh mesh = triangulate(domain, {.edge = edge}).front();
    return roundInward(mesh, 0.5 * edge, edge).value_or(mesh);
}

CapillarySurface filled(const PlanarMesh& footprint, double edge, double volume)
{
    const FilledSheet sheet = fillSheet(footprint, {FillBy::Volume, volume}, {{}, edge, edge, 0});
    EXPECT_EQ(sheet.end, SheetEnd::Reached);
    return sheet.mesh;
}

/// Checks that the boundary is the footprint's rim, on the ground, and that every other edge has two triangles.
void expectSheetOver(const PlanarMesh& footprint, const CapillarySurface& sheet)
{
    ASSERT_EQ(sheet.rimVertexCount(), footprint.rimVertexCount());
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (const Triangle& t : sheet.triangles) {
        EXPECT_FALSE(std::all_of(t.begin(), t.end(), [&](std::uint32_t v) { return v < sheet.rimVertexCount(); }));
        EXPECT_GT(length(areaVector(sheet.vertices, t)), 0.0);
        for (std::size_t a = 0; a < 3; ++a) {
            ++edges[{t[a], t[(a + 1) % 3]}];
        }
    }
    std::set<std::pair<std::uint32_t, std::uint32_t>> rim;
    for (std::size_t loop = 0; loop < footprint.loopCount(); ++loop) {
        for (std::uint32_t v = footprint.loop_starts[loop]; v < footprint.loop_starts[loop + 1]; ++v) {
            rim.insert({v, nextOnRim(footprint, loop, v)});
            EXPECT_EQ(sheet.vertices[v].x, footprint.vertices[v].x);
            EXPECT_EQ(sheet.vertices[v].y, footprint.vertices[v].y);
            EXPECT_EQ(sheet.vertices[v].z, 0.0);
        }
    }
    for (const auto& [edge, count] : edges) {
        EXPECT_EQ(count, 1);
        const bool is_shared = edges.count({edge.second, edge.first}) == 1;
        EXPECT_NE(is_shared, rim.count(edge) == 1);
    }
    EXPECT_EQ(std::count_if(edges.begin(), edges.end(), [&](const auto& e) { return rim.count(e.first) == 1; }),
              static_cast<std::ptrdiff_t>(rim.size()));
}

TEST(SheetDivide, KeepsTheTopologyAndTakesTheFineRim)
{
    const std::vector<Domain> domains{
        domainOf(polygonLoop({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}})),
        domainOf(ellipseLoop(1.0, 0.8), {reversed(ellipseLoop(0.3, 0.3))}),
        domainOf(polygonLoop({{0, 0}, {3, 0}, {3, 2}, {0, 2}}),
                 {reversed(polygonLoop({{0.4, 0.4}, {1.4, 0.5}, {0.8, 1.5}})),
                  reversed(polygonLoop({{1.8, 0.5}, {2.6, 0.5}, {2.2, 1.4}}))}),
    };
    for (const Domain& domain : domains) {
        const PlanarMesh coarse = rounded(domain, 0.1);
        const PlanarMesh fine = rounded(domain, 0.05);
        const CapillarySurface sheet = filled(coarse, 0.1, 0.2 * area(coarse));
        const std::optional<CapillarySurface> divided = divide(sheet, coarse, fine);
        ASSERT_TRUE(divided);
        expectSheetOver(fine, *divided);
        EXPECT_NEAR(static_cast<double>(divided->triangles.size()), 4.0 * static_cast<double>(sheet.triangles.size()),
                    0.02 * static_cast<double>(divided->triangles.size()));
        const double volume = integrate(sheet, {}).volume;
        EXPECT_NEAR(integrate(*divided, {}).volume, volume, 0.01 * volume);
    }
}

TEST(SheetDivide, FindsHolesInAnyOrder)
{
    const Loop outer = polygonLoop({{0, 0}, {3, 0}, {3, 2}, {0, 2}});
    const Loop left = reversed(ellipseLoop(0.3, 0.3));
    const auto shifted = [&](double x) {
        Loop loop = left;
        for (Vec2& p : loop.points) {
            p = p + Vec2{x, 1.0};
        }
        return loop;
    };
    const PlanarMesh coarse = rounded(domainOf(outer, {shifted(0.8), shifted(2.2)}), 0.1);
    const PlanarMesh fine = rounded(domainOf(outer, {shifted(2.2), shifted(0.8)}), 0.05);
    const std::optional<CapillarySurface> divided = divide(filled(coarse, 0.1, 0.5), coarse, fine);
    ASSERT_TRUE(divided);
    expectSheetOver(fine, *divided);
    EXPECT_FALSE(divide(filled(coarse, 0.1, 0.5), coarse, rounded(domainOf(outer, {shifted(0.8)}), 0.05)));
}

// New vertices lie on curves with the sheet's tangents: on a sphere by the third power of the edge.
TEST(SheetDivide, StaysOnASphere)
{
    const Cap cap{120.0 * kDegree};
    std::vector<double> errors;
    for (const double edge : {0.2, 0.1, 0.05}) {
        const PlanarMesh coarse = discMeshes(edge).front();
        CapillarySurface sheet = filled(coarse, edge, cap.volume());
        for (std::size_t v = sheet.rimVertexCount(); v < sheet.vertices.size(); ++v) {
            const Vec3 arm = sheet.vertices[v] - cap.centre();
            sheet.vertices[v] = cap.centre() + (cap.radius() / length(arm)) * arm;
        }
        const std::optional<CapillarySurface> divided = divide(sheet, coarse, discMeshes(0.5 * edge).front());
        ASSERT_TRUE(divided);
        double error = 0.0;
        for (const Vec3& p : divided->vertices) {
            error = std::max(error, std::abs(length(p - cap.centre()) - cap.radius()));
        }
        errors.push_back(error);
    }
    EXPECT_GT(testing::meanOrder(errors), 1.8);  // at the rim, half of a middle's way is known
    EXPECT_LT(errors.back(), 1e-3);
}

std::vector<SheetLevel> levelsOf(const Domain& domain, const std::vector<double>& edges)
{
    std::vector<SheetLevel> levels;
    for (const double edge : edges) {
        SheetLevel& level = levels.emplace_back();
        level.footprint = rounded(domain, edge);
        level.options.edge = 1.5 * edge;
        level.options.path_edge = 2.0 * edge;
        level.options.triangles = static_cast<std::size_t>(area(level.footprint) / (0.433 * edge * edge));
    }
    return levels;
}

TEST(SheetLevels, CapsConvergeAtSecondOrder)
{
    const Cap cap{120.0 * kDegree};
    const Domain disc = domainOf(ellipseLoop(1, 1));
    std::vector<double> pressures;
    std::vector<double> heights;
    for (const double edge : {0.05, 0.025}) {
        double work = 0.0;
        const std::optional<FilledSheet> sheet =
            fillByLevels(levelsOf(disc, {2.0 * edge, edge}), {FillBy::Volume, cap.volume()}, work);
        ASSERT_TRUE(sheet);
        EXPECT_EQ(sheet->work, work);
        EXPECT_LT(sheet->residual, 1e-9);
        EXPECT_NEAR(sheet->volume, cap.volume(), 1e-10 * cap.volume());
        pressures.push_back(std::abs(sheet->pressure * cap.radius() / 2.0 - 1.0));
        heights.push_back(std::abs(sheet->height / cap.rise() - 1.0));
    }
    EXPECT_GT(testing::meanOrder(pressures), 1.7);
    EXPECT_LT(heights.back(), 1e-3);
}

// The same droplet as along the whole path on the finest mesh.
TEST(SheetLevels, AgreeWithThePathOnTheFinestMesh)
{
    const Domain el = domainOf(polygonLoop({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}));
    constexpr double kEdge = 0.04;
    const std::vector<SheetLevel> levels = levelsOf(el, {2.0 * kEdge, kEdge});
    const SheetTarget target{FillBy::ContactAngle, 80.0 * kDegree};
    double work = 0.0;
    const std::optional<FilledSheet> nested = fillByLevels(levels, target, work);
    ASSERT_TRUE(nested);
    const FilledSheet whole = fillSheet(levels.back().footprint, target, levels.back().options);
    ASSERT_EQ(whole.end, SheetEnd::Reached);
    EXPECT_NEAR(nested->angle, target.amount, 1e-8);
    EXPECT_LT(work, whole.work);
    const CapillarySurface made =
        fillSheet(levels.back().footprint, {FillBy::Volume, nested->volume}, levels.back().options).mesh;
    const double energy = integrate(made, {}).area;
    EXPECT_NEAR(integrate(nested->mesh, {}).area, energy, kEdge * kEdge * energy);
    EXPECT_NEAR(nested->volume, whole.volume, 0.02 * whole.volume);
    const std::vector<double> narrow = minAngles(nested->mesh);
    EXPECT_GT(*std::min_element(narrow.begin(), narrow.end()), 15.0 * kDegree);
}

// Steps with the factors of the last one end at the same place.
TEST(SheetLevels, ChordStepsFindTheSameEquilibrium)
{
    const PlanarMesh mesh = discMeshes(0.1).front();
    const CapillarySurface start = filled(mesh, 0.1, 1.0);
    const auto solved = [&](double chord) {
        CapillarySurface sheet = start;
        SheetSolver solver(sheet, {});
        double pressure = 2.0;
        const NewtonResult result = solver.solve(sheet, 1.05, pressure, {.chord = chord});
        EXPECT_TRUE(result.converged);
        return std::pair(sheet, result);
    };
    const auto [full, full_result] = solved(0.0);
    const auto [chord, chord_result] = solved(1e-2);
    EXPECT_LT(chord_result.factorisations, full_result.factorisations);
    for (std::size_t v = 0; v < full.vertices.size(); ++v) {
        EXPECT_LT(length(full.vertices[v] - chord.vertices[v]), 1e-7);
    }
}

}  // namespace
}  // namespace droplet
