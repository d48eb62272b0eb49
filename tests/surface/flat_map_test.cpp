// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/flat_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "droplet/mesh/triangulate.h"
#include "droplet/surface/loft.h"
#include "droplet/units.h"
#include "support/domains.h"
#include "support/equilibrium.h"

namespace droplet {
namespace {

using testing::domainOf;
using testing::ellipseLoop;
using testing::polygonLoop;

CapillarySurface sheetOver(const Domain& domain, double edge, FillBy by, double amount)
{
    SolveOptions options = testing::unitOptions(Model::Exact, 0.0, 1.0);
    options.fill = {by, amount, FillSharing::Each};
    return solveSheet(triangulate(domain, {.edge = edge}).front(), options).surface;
}

CapillarySurface bead(double degrees)
{
    return sheetOver(domainOf(ellipseLoop(1, 1)), 0.1, FillBy::ContactAngle, degrees * kDegree);
}

/// Whether the rim stays, no triangle turns over, and all of them cover the footprint: with a simple boundary, the map
/// is then injective.
void expectCoversOnce(const CapillarySurface& sheet, const std::vector<Vec2>& places)
{
    ASSERT_EQ(places.size(), sheet.vertices.size());
    for (std::uint32_t v = 0; v < sheet.rimVertexCount(); ++v) {
        EXPECT_EQ(places[v], sheet.footprint->vertices[v]);
    }
    double total = 0.0;
    std::size_t turned = 0;
    for (const Triangle& t : sheet.triangles) {
        const double twice = cross(places[t[1]] - places[t[0]], places[t[2]] - places[t[0]]);
        turned += twice > 0.0 ? 0 : 1;
        total += 0.5 * twice;
    }
    EXPECT_EQ(turned, 0U);
    EXPECT_NEAR(total, area(*sheet.footprint), 1e-9 * total);
}

TEST(FlatMap, CoversTheFootprintOnce)
{
    const Loop hole = testing::reversed(polygonLoop({{.5, .65}, {.8, .65}, {.65, 1.2}}));
    const Domain letter =
        domainOf(polygonLoop({{0, 0}, {.3, 0}, {.42, .4}, {.88, .4}, {1, 0}, {1.3, 0}, {.8, 1.6}, {.5, 1.6}}), {hole});
    const Domain ring = domainOf(ellipseLoop(1, 1), {testing::reversed(ellipseLoop(0.4, 0.4))});
    const Domain u =
        domainOf(polygonLoop({{0, 0}, {1.3, 0}, {1.3, 1.5}, {0.8, 1.5}, {0.8, 0.5}, {0.5, 0.5}, {0.5, 1.5}, {0, 1.5}}));
    const Domain l = domainOf(polygonLoop({{0, 0}, {1.5, 0}, {1.5, 0.5}, {0.5, 0.5}, {0.5, 1.5}, {0, 1.5}}));
    const Domain square = domainOf(polygonLoop({{0, 0}, {1, 0}, {1, 1}, {0, 1}}));
    const std::vector<std::pair<std::string, CapillarySurface>> sheets{
        {"bead of 140", bead(140.0)},
        {"bead of 160", bead(160.0)},
        {"square", sheetOver(square, 0.05, FillBy::ContactAngle, 140.0 * kDegree)},
        {"L", sheetOver(l, 0.05, FillBy::ContactAngle, 80.0 * kDegree)},
        {"U", sheetOver(u, 0.045, FillBy::Volume, 1.0)},
        {"ring", sheetOver(ring, 0.05, FillBy::Volume, 0.7)},
        {"A", sheetOver(letter, 0.035, FillBy::ContactAngle, 55.0 * kDegree)}};
    for (const auto& [name, sheet] : sheets) {
        SCOPED_TRACE(name);
        const FlatMap map = flatMap(sheet);
        EXPECT_EQ(map.kind, TextureMap::Flat);
        expectCoversOnce(sheet, map.places);
        EXPECT_EQ(projected(sheet).kind, TextureMap::Folded);
    }
}

TEST(FlatMap, IsTheProjectionWhereNothingLeansOut)
{
    const CapillarySurface sheet = bead(70.0);
    const FlatMap map = flatMap(sheet);
    EXPECT_EQ(map.kind, TextureMap::Projection);
    EXPECT_EQ(map.places, projected(sheet).places);
    expectCoversOnce(sheet, map.places);
}

/// Around the axis of a bead, the map only changes radii, by their way along the sheet.
TEST(FlatMap, KeepsTheSymmetryOfABead)
{
    const CapillarySurface sheet = bead(140.0);
    const FlatMap map = flatMap(sheet);
    const double centre = -1.0 / std::tan(140.0 * kDegree);
    std::vector<std::pair<double, double>> radii;
    for (std::size_t v = 0; v < sheet.vertices.size(); ++v) {
        const Vec3 p = sheet.vertices[v];
        const Vec2 q = map.places[v];
        radii.emplace_back(std::atan2(std::hypot(p.x, p.y), p.z - centre), length(q));
        if (length(q) > 0.2) {
            EXPECT_LT(std::abs(cross({p.x, p.y}, q)), 0.05 * length(q) * std::hypot(p.x, p.y));
        }
    }
    std::sort(radii.begin(), radii.end());
    double largest = 0.0;
    for (const auto& [way, radius] : radii) {
        EXPECT_GT(radius, largest - 0.03);
        largest = std::max(largest, radius);
    }
}

TEST(FlatMap, LoftSaysWhichMapItTook)
{
    const CapillarySurface sheet = bead(140.0);
    Surface surface = loft({sheet}, {.extent = {4.0, 4.0}});
    EXPECT_EQ(surface.texture_map, TextureMap::Flat);
    for (const Vec2 uv : surface.uvs) {
        EXPECT_LE(length(uv - Vec2{0.5, 0.5}), 0.2505);  // the rim's vertices are a little outside of the circle
    }
    EXPECT_EQ(loft({sheet}, {.extent = {4.0, 4.0}, .flatten = false}).texture_map, TextureMap::Folded);
    Surface low = loft({bead(70.0)}, {.extent = {4.0, 4.0}});
    EXPECT_EQ(low.texture_map, TextureMap::Projection);
    append(low, surface);
    EXPECT_EQ(low.texture_map, TextureMap::Flat);
}

}  // namespace
}  // namespace droplet
