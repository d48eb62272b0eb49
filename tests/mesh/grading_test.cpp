// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "droplet/error.h"
#include "droplet/mesh/triangulate.h"
#include "support/angles.h"
#include "support/domains.h"
#include "support/zoo.h"

namespace droplet {
namespace {

using testing::domainOf;
using testing::ellipseLoop;

constexpr int kGradings[] = {1, 2, 4, 8, 16, 32, 64};

double meanEdge(const PlanarMesh& mesh, double within)
{
    double sum = 0.0;
    std::size_t count = 0;
    for (const Triangle& t : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec2 a = mesh.vertices[t[k]];
            const Vec2 b = mesh.vertices[t[(k + 1) % 3]];
            if (length(a) < within && length(b) < within) {
                sum += length(b - a);
                ++count;
            }
        }
    }
    return sum / static_cast<double>(count);
}

TEST(Grading, MeshesAreValidAndKeepTheirAngles)
{
    for (const auto& [name, domain] : testing::zoo()) {
        for (const int grading : kGradings) {
            for (const std::size_t wanted : {400U, 5000U}) {
                SCOPED_TRACE(name + ", grading " + std::to_string(grading) + ", " + std::to_string(wanted));
                const std::vector<PlanarMesh> meshes =
                    triangulate(domain, {.triangles = wanted, .edge = {}, .grading = grading});
                ASSERT_EQ(meshes.size(), domain.droplets.size());
                for (std::size_t k = 0; k < meshes.size(); ++k) {
                    ASSERT_NO_THROW(meshes[k].validate());
                    EXPECT_THAT(testing::brokenPromises(meshes[k], domain.droplets[k]), ::testing::IsEmpty());
                    EXPECT_NEAR(area(meshes[k]) / area(domain.droplets[k]), 1.0, wanted > 1000 ? 1e-3 : 5e-3);
                }
            }
        }
    }
}

TEST(Grading, NumberOfTrianglesIsMetWithinTenPercent)
{
    const std::vector<testing::Animal> animals = testing::zoo();
    for (const std::size_t k : {0U, 1U, 2U, 7U, 8U, 9U}) {
        for (const int grading : kGradings) {
            for (const std::size_t wanted : {1000U, 5000U, 20000U}) {
                std::size_t count = 0;
                for (const PlanarMesh& mesh :
                     triangulate(animals[k].domain, {.triangles = wanted, .edge = {}, .grading = grading})) {
                    count += mesh.triangles.size();
                }
                EXPECT_NEAR(static_cast<double>(count) / static_cast<double>(wanted), 1.0, 0.1)
                    << animals[k].name << " " << grading << " " << wanted;
            }
        }
    }
}

// Two layers per level need √3·(1 + 2 + … + grading/2) edges of room, less than a fifth of this disc's radius.
TEST(Grading, EdgesInTheMiddleAreGradingTimesLonger)
{
    constexpr double kInTheMiddle = 0.1;
    for (const int grading : kGradings) {
        const double edge = kInTheMiddle / grading;
        const PlanarMesh mesh = triangulate(domainOf(ellipseLoop(1, 1)), {.edge = edge, .grading = grading})[0];
        EXPECT_NEAR(rimLength(mesh) / static_cast<double>(mesh.rimVertexCount()) / edge, 1.0, 0.03) << grading;
        EXPECT_NEAR(meanEdge(mesh, 0.5) / kInTheMiddle, 1.0, 0.03) << grading;
    }
}

TEST(Grading, TakesFewerTrianglesForTheSameRim)
{
    std::size_t last = std::numeric_limits<std::size_t>::max();
    for (const int grading : kGradings) {
        const PlanarMesh mesh = triangulate(domainOf(ellipseLoop(1, 1)), {.edge = 0.005, .grading = grading})[0];
        EXPECT_NEAR(static_cast<double>(mesh.rimVertexCount()), 400.0 * std::numbers::pi, 20.0) << grading;
        EXPECT_LT(mesh.triangles.size(), last) << grading;
        last = mesh.triangles.size();
    }
}

// Purpose of grading: with the same edges along the rim, its share of triangles falls with every halving.
TEST(Grading, TrianglesGrowWithTheRimNotWithTheArea)
{
    const Domain disc = domainOf(ellipseLoop(1, 1));
    std::size_t last = 0;
    for (const double edge : {0.02, 0.01, 0.005}) {
        const std::size_t count = triangulate(disc, {.edge = edge, .grading = 64})[0].triangles.size();
        if (last > 0) {
            EXPECT_NEAR(static_cast<double>(count) / static_cast<double>(last), 2.0, 0.2) << edge;
        }
        last = count;
    }
}

TEST(Grading, ChangesNothingIfThereIsNoRoom)
{
    // In a ring four edges wide, no point is two layers away from the rim.
    const Domain ring = domainOf(ellipseLoop(1, 1), {testing::reversed(ellipseLoop(0.8, 0.8))});
    const PlanarMesh two = triangulate(ring, {.edge = 0.05, .grading = 2})[0];
    const PlanarMesh max = triangulate(ring, {.edge = 0.05, .grading = 64})[0];
    EXPECT_EQ(two.vertices, max.vertices);
    EXPECT_EQ(two.triangles, max.triangles);
}

TEST(Grading, IsChosenByTheLayer)
{
    const Domain disc = domainOf(ellipseLoop(1, 1));
    const double edge = std::sqrt(4.0 * std::numbers::pi / (std::numbers::sqrt3 * 5000.0));
    const double few = std::sqrt(4.0 * std::numbers::pi / (std::numbers::sqrt3 * 50.0));
    EXPECT_EQ(gradingOf(disc, {.triangles = 50, .edge = {}, .grading = {}, .layer = few}), 1);  // narrow
    EXPECT_EQ(gradingOf(disc, {.triangles = 5000, .edge = {}}), 1);
    EXPECT_EQ(gradingOf(disc, {.triangles = 5000, .edge = {}, .grading = {}, .layer = 6.01 * edge}), 1);
    EXPECT_EQ(gradingOf(disc, {.triangles = 5000, .edge = {}, .grading = {}, .layer = 5.99 * edge}), 64);
    EXPECT_EQ(gradingOf(disc, {.triangles = 5000, .edge = {}, .grading = 4, .layer = edge}), 4);
    EXPECT_EQ(gradingOf(disc, {.triangles = 5000, .edge = edge, .grading = {}, .layer = edge}), 1);
}

TEST(Grading, WithinALayerTrianglesAreValidAndAsManyAsWanted)
{
    for (const auto& [name, domain] : testing::zoo()) {
        double total = 0.0;
        for (const Footprint& footprint : domain.droplets) {
            total += area(footprint);
        }
        for (const double share : {0.3, 0.05, 0.01}) {  // of the size of the footprint
            SCOPED_TRACE(name + ", layer " + std::to_string(share));
            const std::vector<PlanarMesh> meshes =
                triangulate(domain, {.triangles = 5000, .edge = {}, .grading = {}, .layer = share * std::sqrt(total)});
            ASSERT_EQ(meshes.size(), domain.droplets.size());
            for (std::size_t k = 0; k < meshes.size(); ++k) {
                ASSERT_NO_THROW(meshes[k].validate());
                EXPECT_THAT(testing::brokenPromises(meshes[k], domain.droplets[k]), ::testing::IsEmpty());
            }
        }
    }
    for (const double layer : {0.1, 0.05, 0.03, 0.02, 0.01, 0.005, 0.002}) {
        const auto mesh =
            triangulate(domainOf(ellipseLoop(1, 1)), {.triangles = 5000, .edge = {}, .grading = {}, .layer = layer});
        EXPECT_NEAR(static_cast<double>(mesh[0].triangles.size()) / 5000.0, 1.0, 0.1) << layer;
    }
}

TEST(Grading, AcceptsOnlyPowersOfTwoUpTo64)
{
    const Domain disc = domainOf(ellipseLoop(1, 1));
    for (const int grading : {0, -1, -2, 3, 6, 63, 65, 128, std::numeric_limits<int>::min()}) {
        try {
            (void)triangulate(disc, {.triangles = 100, .edge = {}, .grading = grading});
            ADD_FAILURE() << grading << " is accepted";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::InvalidArgument);
            EXPECT_NE(std::string(error.what()).find("grading " + std::to_string(grading)), std::string::npos)
                << error.what();
        }
    }
    for (const int grading : kGradings) {
        EXPECT_NO_THROW((void)triangulate(disc, {.triangles = 100, .edge = {}, .grading = grading}));
    }
}

}  // namespace
}  // namespace droplet
