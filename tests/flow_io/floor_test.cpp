// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/flow_io/floor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "droplet/flow/flow_surface.h"
#include "droplet/flow_io/preset_object.h"

namespace droplet {
namespace {

TEST(Floor, LiesBelowTheObjectAndIsWider)
{
    const FlowObject object = presetObject(PresetObject::Bottle);
    for (const Floor floor : {Floor::Plate, Floor::Dish}) {
        const FlowObject both = onFloor(object, floor);
        ASSERT_GT(both.triangles.size(), object.triangles.size());
        EXPECT_TRUE(std::equal(object.vertices.begin(), object.vertices.end(), both.vertices.begin()));
        EXPECT_TRUE(std::equal(object.triangles.begin(), object.triangles.end(), both.triangles.begin()));
        EXPECT_EQ(both.normals.size(), both.vertices.size());
        EXPECT_EQ(both.uvs.size(), both.vertices.size());
        EXPECT_EQ(both.materials.size(), both.triangles.size());
        EXPECT_EQ(both.material_names.back(), "floor");
        EXPECT_EQ(both.looks.size(), both.material_names.size());
        EXPECT_EQ(both.images.size(), both.material_names.size());
        double lowest = 1.0;
        double widest = 0.0;
        for (const Vec3& p : object.vertices) {
            lowest = std::min(lowest, p.z);
            widest = std::max(widest, std::abs(p.x));
        }
        double floor_lowest = 1.0;
        double floor_widest = 0.0;
        for (std::size_t v = object.vertices.size(); v < both.vertices.size(); ++v) {
            floor_lowest = std::min(floor_lowest, both.vertices[v].z);
            floor_widest = std::max(floor_widest, std::abs(both.vertices[v].x));
            EXPECT_NEAR(length(both.normals[v]), 1.0, 1e-12);
            EXPECT_GT(both.normals[v].z, 0.3) << "it faces up";
        }
        EXPECT_LT(floor_lowest, lowest);
        EXPECT_GT(floor_lowest, lowest - 0.001);
        EXPECT_GT(floor_widest, 1.4 * widest);
        const FlowSurfaceReport report = flowSurface(both.vertices, both.triangles).report;
        EXPECT_EQ(report.parts, 2U);
        EXPECT_EQ(report.turned, 0U);
    }
}

TEST(Floor, RestsBelowAllShapesOfAnObjectThatDeforms)
{
    FlowObject object;
    object.vertices = {{0.0, 0.0, 1.0}, {1.0, 0.0, 1.0}, {0.0, 1.0, 2.0}};
    object.normals.assign(3, {0.0, 0.0, 1.0});
    object.triangles = {{0, 1, 2}};
    std::vector<std::vector<Vec3>> shapes{object.vertices, {{0.0, 0.0, 0.5}, {3.0, 0.0, 1.0}, {0.0, 1.0, 2.0}}};
    const FlowObject both = onFloor(object, Floor::Plate, shapes);
    ASSERT_EQ(both.vertices.size(), 7U);
    EXPECT_EQ(shapes[0], both.vertices);
    EXPECT_EQ(shapes[1].size(), 7U);
    for (std::size_t v = 3; v < 7; ++v) {
        EXPECT_EQ(shapes[1][v], both.vertices[v]);
        EXPECT_LT(both.vertices[v].z, 0.5);
        EXPECT_GT(both.vertices[v].z, 0.49);
    }
    EXPECT_GT(both.vertices[4].x, 3.0) << "as wide as the widest";
}

TEST(Floor, StandsBelowObjectsWithoutMaterialsAndUv)
{
    FlowObject object;
    object.vertices = {{0.0, 0.0, 1.0}, {1.0, 0.0, 1.0}, {0.0, 1.0, 2.0}};
    object.normals.assign(3, {0.0, 0.0, 1.0});
    object.triangles = {{0, 1, 2}};
    const FlowObject both = onFloor(object, Floor::Plate);
    EXPECT_TRUE(both.uvs.empty());
    EXPECT_EQ(both.material_names, (std::vector<std::string>{"object", "floor"}));
    EXPECT_EQ(both.materials, (std::vector<std::uint32_t>{0, 1, 1}));
}

}  // namespace
}  // namespace droplet
