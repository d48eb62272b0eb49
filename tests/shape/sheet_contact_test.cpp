// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape/sheet_contact.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "shape/sheet_path.h"
#include "support/domains.h"
#include "support/equilibrium.h"

namespace droplet {
namespace {

/// Cap of 140° on a disc of radius 1: it reaches out by 1/sin 140° = 1.556.
CapillarySurface cap()
{
    const double angle = 140.0 * std::numbers::pi / 180.0;
    return fillSheet(testing::discMeshes(0.15).front(), {FillBy::ContactAngle, angle}, {{}, 0.3, 0.3}).mesh;
}

CapillarySurface moved(CapillarySurface sheet, double x)
{
    for (Vec3& place : sheet.vertices) {
        place.x += x;
    }
    return sheet;
}

TEST(SheetContact, FindsNeighboursThatTouch)
{
    const CapillarySurface one = cap();
    const double reach = 1.0 / std::sin(140.0 * std::numbers::pi / 180.0);
    const CapillarySurface far = moved(one, 2.05 * reach);
    EXPECT_FALSE(firstContact({&one, &far}));
    const CapillarySurface near = moved(one, 1.95 * reach);
    const std::optional<SheetContact> contact = firstContact({&one, &near});
    EXPECT_TRUE(firstContact({&one, &near}, {0, 1}));
    EXPECT_FALSE(firstContact({&one, &near}, {0, 0})) << "one cluster";
    EXPECT_TRUE(firstContact({&one, &near, &far}, {0, 2, 0})) << "near is of another cluster";
    ASSERT_TRUE(contact);
    EXPECT_EQ(contact->first, 0U);
    EXPECT_EQ(contact->second, 1U);
    EXPECT_NEAR(contact->place.x, 0.975 * reach, 0.2);
    EXPECT_NEAR(contact->place.y, 0.0, 0.5);
}

// A needle that faces up everywhere stands below an overhang: its tip is under it, within it, or above all of it.
TEST(SheetContact, FindsWhatStandsBelowAnOverhang)
{
    const CapillarySurface bead = cap();
    const PlanarMesh disc = testing::discMeshes(0.3).front();
    for (const double height : {0.05, 0.7, 5.0}) {
        for (const double x : {1.25, 2.0}) {
            CapillarySurface needle{.triangles = disc.triangles, .loop_starts = disc.loop_starts};
            for (const Vec2 p : disc.vertices) {
                needle.vertices.push_back({x + 0.1 * p.x, 0.1 * p.y, height * std::max(0.0, 1.0 - length(p))});
            }
            EXPECT_FALSE(firstContact({&needle}));
            EXPECT_EQ(firstContact({&bead, &needle}).has_value(), x < 1.5 && height > 0.1) << x << ' ' << height;
        }
    }
}

TEST(SheetContact, FindsASheetThatCrossesItself)
{
    CapillarySurface sheet = cap();
    EXPECT_FALSE(firstContact({&sheet}));
    // A vertex of the side is pushed through the other side.
    std::size_t side = sheet.rimVertexCount();
    for (std::size_t v = sheet.rimVertexCount(); v < sheet.vertices.size(); ++v) {
        side = sheet.vertices[v].x > sheet.vertices[side].x ? v : side;
    }
    sheet.vertices[side].x = -2.0;
    const std::optional<SheetContact> contact = firstContact({&sheet});
    ASSERT_TRUE(contact);
    EXPECT_EQ(contact->first, contact->second);
}

}  // namespace
}  // namespace droplet
