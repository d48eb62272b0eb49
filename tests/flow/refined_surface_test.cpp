// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "droplet/flow/flow_surface.h"

namespace droplet {
namespace {

double areaOf(const FlowSurface& surface)
{
    double area = 0.0;
    for (const FlowSurface::Face& face : surface.faces) {
        area += 0.5 * length(cross(face.corners[1] - face.corners[0], face.corners[2] - face.corners[0]));
    }
    return area;
}

/// A tetrahedron with sides of very different lengths.
FlowSurface tetrahedron()
{
    const std::vector<Vec3> corners{{0.0, 0.0, 0.0}, {0.1, 0.0, 0.0}, {0.03, 0.02, 0.0}, {0.01, 0.01, 0.07}};
    return flowSurface(corners, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}});
}

TEST(RefinedSurface, HasNoLongEdgesAndNoGaps)
{
    const FlowSurface coarse = tetrahedron();
    for (const double longest : {0.06, 0.02, 0.004}) {
        const FlowSurface fine = refined(coarse, longest);
        EXPECT_GT(fine.faces.size(), coarse.faces.size());
        EXPECT_NEAR(areaOf(fine), areaOf(coarse), 1e-14);
        std::vector<double> areas(4, 0.0);
        for (const FlowSurface::Face& face : fine.faces) {
            for (std::size_t k = 0; k < 3; ++k) {
                EXPECT_LE(length(face.corners[(k + 1) % 3] - face.corners[k]), longest);
                EXPECT_NE(face.neighbour[k], FlowSurface::kNone);
            }
            ASSERT_LT(face.source, 4U);
            EXPECT_GT(dot(face.normal, coarse.faces[face.source].normal), 1.0 - 1e-9);
            areas[face.source] +=
                0.5 * length(cross(face.corners[1] - face.corners[0], face.corners[2] - face.corners[0]));
        }
        for (const FlowSurface::Face& face : coarse.faces) {
            EXPECT_NEAR(areas[face.source],
                        0.5 * length(cross(face.corners[1] - face.corners[0], face.corners[2] - face.corners[0])),
                        1e-14);
        }
        EXPECT_EQ(fine.report.triangles, coarse.report.triangles) << "of the mesh";
    }
}

TEST(RefinedSurface, OfNeedlesHasABoundedNumberOfFacesAndNoGaps)
{
    // A strip 40 mm wide and 2 m high of needles: to halve edges down to 4 mm would take millions of faces.
    std::vector<Vec3> vertices;
    std::vector<Triangle> triangles;
    for (std::uint32_t k = 0; k <= 40; ++k) {
        vertices.push_back({1e-3 * k, 0.0, 0.0});
        vertices.push_back({1e-3 * k, 0.0, 2.0});
    }
    for (std::uint32_t k = 0; k < 40; ++k) {
        triangles.push_back({2 * k, 2 * k + 2, 2 * k + 3});
        triangles.push_back({2 * k, 2 * k + 3, 2 * k + 1});
    }
    const FlowSurface coarse = flowSurface(vertices, triangles);
    const FlowSurface fine = refined(coarse, 4e-3, 20'000);
    EXPECT_GT(fine.faces.size(), 4000U);
    EXPECT_LE(fine.faces.size(), 20'000U);
    EXPECT_NEAR(areaOf(fine), areaOf(coarse), 1e-9);
    std::size_t boundary = 0;
    for (const FlowSurface::Face& face : fine.faces) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 middle = 0.5 * (face.corners[k] + face.corners[(k + 1) % 3]);
            const bool is_inside =
                middle.x > 1e-9 && middle.x < 0.04 - 1e-9 && middle.z > 1e-9 && middle.z < 2.0 - 1e-9;
            boundary += face.neighbour[k] == FlowSurface::kNone ? 1 : 0;
            EXPECT_TRUE(!is_inside || face.neighbour[k] != FlowSurface::kNone);
        }
    }
    EXPECT_GT(boundary, 0U);
}

TEST(RefinedSurface, IsTheSameIfNoEdgeIsLong)
{
    const FlowSurface coarse = tetrahedron();
    const FlowSurface same = refined(coarse, 1.0);
    ASSERT_EQ(same.faces.size(), coarse.faces.size());
    for (std::size_t f = 0; f < same.faces.size(); ++f) {
        EXPECT_EQ(same.faces[f].corners, coarse.faces[f].corners);
    }
}

}  // namespace
}  // namespace droplet
