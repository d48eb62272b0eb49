// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/rim_sampling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "support/domains.h"
#include "support/zoo.h"

namespace droplet {
namespace {

double areaOf(const std::vector<Vec2>& polygon)
{
    double twice = 0.0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        twice += cross(polygon[i] - polygon[0], polygon[(i + 1) % polygon.size()] - polygon[0]);
    }
    return 0.5 * twice;
}

// A sampler skips local widths where the liquid is certainly wide enough. It always computes them if it is called with
// longer edges than it was made for. Both ways must give the same samples.
TEST(RimSampler, SamplesAreTheSameWithAndWithoutLocalWidths)
{
    for (const auto& [name, domain] : testing::zoo()) {
        for (const Footprint& footprint : domain.droplets) {
            const double finest = RimSampler(footprint, 1e9).finest();
            for (const double multiple : {1.0, 2.0, 5.0, 12.0, 30.0, 80.0, 250.0}) {
                const double edge = multiple * finest;
                SCOPED_TRACE(name + ", " + std::to_string(multiple) + " times its detail");
                const std::vector<RimPolygon> looked = RimSampler(footprint, 0.5 * edge).sample(edge);
                EXPECT_EQ(RimSampler(footprint, 1e9).sample(edge), looked);
                EXPECT_EQ(RimSampler(footprint, 1.0001 * edge).sample(edge), looked);
                EXPECT_EQ(RimSampler(footprint, edge).sample(edge), looked);
                EXPECT_EQ(RimSampler(footprint, 3.0 * edge).sample(edge), looked);
            }
        }
    }
}

TEST(RimSampler, PolygonsKeepTheLoopsAreaAndTheirOrder)
{
    for (const auto& [name, domain] : testing::zoo()) {
        SCOPED_TRACE(name);
        for (const Footprint& footprint : domain.droplets) {
            const double edge = 0.05 * std::sqrt(area(footprint));
            const std::vector<RimPolygon> polygons = RimSampler(footprint, edge).sample(edge);
            ASSERT_EQ(polygons.size(), 1 + footprint.holes.size());
            double sum = 0.0;
            for (std::size_t k = 0; k < polygons.size(); ++k) {
                EXPECT_GE(polygons[k].size(), 3U);
                EXPECT_EQ(areaOf(polygons[k]) > 0.0, k == 0);
                sum += areaOf(polygons[k]);
                for (std::size_t i = 0; i < polygons[k].size(); ++i) {
                    // Pieces between corners are cut into equal parts, so an edge may be slightly longer than
                    // requested.
                    EXPECT_LT(length(polygons[k][(i + 1) % polygons[k].size()] - polygons[k][i]), 1.5 * edge);
                }
            }
            EXPECT_NEAR(sum / area(footprint), 1.0, 5e-3);
        }
    }
}

// A side between two corners is an edge, whatever length is asked for. Next to it, edges grow little by little: in the
// triangles between a long edge and much shorter ones, liquid that leans out found no equilibrium.
TEST(RimSampler, EdgesGrowFromShortSides)
{
    constexpr double kSide = 0.02;
    const Loop notched = testing::polygonLoop(
        {{0, 0}, {2, 0}, {2, 1}, {1 + kSide, 1}, {1 + kSide, 1 - kSide}, {1, 1 - kSide}, {1, 1}, {0, 1}});
    const RimPolygon polygon = RimSampler({.rim = notched, .holes = {}}, 0.2).sample(0.2).front();
    const auto edge = [&](std::size_t i) {
        return length(polygon[(i + 1) % polygon.size()] - polygon[i % polygon.size()]);
    };
    double shortest = 1.0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        shortest = std::min(shortest, edge(i));
        EXPECT_LT(edge(i + 1), 2.2 * edge(i)) << i;
        EXPECT_GT(edge(i + 1), edge(i) / 2.2) << i;
        EXPECT_LT(edge(i), 0.3);
    }
    EXPECT_NEAR(shortest, kSide, 1e-12);
}

}  // namespace
}  // namespace droplet
