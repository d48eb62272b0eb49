// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/mesh/patch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "droplet/mesh/triangulate.h"
#include "droplet/units.h"
#include "support/domains.h"

namespace droplet {
namespace {

using testing::domainOf;
using testing::ellipseLoop;
using testing::polygonLoop;
using testing::reversed;

constexpr double kEdge = 0.05;

/// Long bar with a bump at its right end.
Footprint bar(double bump)
{
    return {polygonLoop({{0, 0}, {4, 0}, {4 + bump, 0.5}, {4, 1}, {0, 1}}), {}};
}

PlanarMesh meshOf(const Footprint& footprint)
{
    return triangulate(domainOf(footprint.rim, footprint.holes), {.edge = kEdge}).at(0);
}

/// Number of vertices that a mesh shares with others.
std::size_t sharedWith(const std::vector<const PlanarMesh*>& before, const PlanarMesh& mesh)
{
    std::set<std::pair<double, double>> places;
    for (const PlanarMesh* other : before) {
        for (const Vec2 p : other->vertices) {
            places.emplace(p.x, p.y);
        }
    }
    std::size_t count = 0;
    for (const Vec2 p : mesh.vertices) {
        count += places.contains({p.x, p.y}) ? 1 : 0;
    }
    return count;
}

void expectPatch(const std::vector<const PlanarMesh*>& before, const Footprint& footprint, double min_kept)
{
    const std::optional<PatchedMesh> patched = patch(before, footprint, kEdge);
    ASSERT_TRUE(patched);
    const PlanarMesh& mesh = patched->mesh;
    EXPECT_NO_THROW(mesh.validate());
    EXPECT_EQ(mesh.loopCount(), 1 + footprint.holes.size());
    EXPECT_GE(minAngle(mesh), 15.0 * kDegree);
    EXPECT_NEAR(area(mesh) / area(footprint), 1.0, 5e-4);
    EXPECT_GE(static_cast<double>(patched->kept), min_kept * static_cast<double>(mesh.vertices.size()));
    const std::size_t shared = sharedWith(before, mesh);
    EXPECT_GE(shared, patched->kept);
    EXPECT_LE(shared, patched->kept + patched->kept / 20) << "new lattice points may coincide with old ones";
}

TEST(Patch, KeepsTrianglesFarFromABump)
{
    const PlanarMesh before = meshOf(bar(0.3));
    expectPatch({&before}, bar(0.6), 0.8);
    expectPatch({&before}, bar(0.1), 0.8);
    expectPatch({&before}, bar(0.3), 1.0);
}

TEST(Patch, KeepsBothEndsWhenDropletsMergeOrSplit)
{
    const Loop left = polygonLoop({{-3, 0}, {-0.2, 0}, {-0.2, 1}, {-3, 1}});
    const Loop right = polygonLoop({{0.2, 0}, {3, 0}, {3, 1}, {0.2, 1}});
    const Footprint both{polygonLoop({{-3, 0}, {3, 0}, {3, 1}, {-3, 1}}), {}};
    const PlanarMesh first = meshOf({left, {}});
    const PlanarMesh second = meshOf({right, {}});
    expectPatch({&first, &second}, both, 0.7);
    const PlanarMesh whole = meshOf(both);
    expectPatch({&whole}, {left, {}}, 0.8);
    expectPatch({&whole}, {right, {}}, 0.8);
}

TEST(Patch, HolesMayAppearAndDisappear)
{
    const Loop rim = ellipseLoop(2.0, 1.5);
    const Footprint ring{rim, {reversed(ellipseLoop(0.4, 0.4))}};
    const PlanarMesh full = meshOf({rim, {}});
    expectPatch({&full}, ring, 0.7);
    const PlanarMesh holed = meshOf(ring);
    expectPatch({&holed}, {rim, {}}, 0.7);
}

TEST(Patch, IsNoneIfNothingCanBeKept)
{
    const PlanarMesh before = meshOf(bar(0.3));
    Footprint elsewhere = bar(0.3);
    for (Vec2& p : elsewhere.rim.points) {
        p = p + Vec2{9.0, 0.3};
    }
    EXPECT_FALSE(patch({&before}, elsewhere, kEdge));
    EXPECT_FALSE(patch({}, elsewhere, kEdge));
}

}  // namespace
}  // namespace droplet
