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
