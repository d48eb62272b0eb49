// SPDX-License-Identifier: GPL-3.0-or-later
#include "windshield_view/water_optics.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace droplet {
namespace {

constexpr float kIor = 1.333F;

class WaterOptics : public ::testing::Test {
protected:
    float uniform() { return std::uniform_real_distribution<float>(0.0F, 1.0F)(random_); }

    /// Unit vector above the plane z = 0.
    Vec3f upward()
    {
        const float z = uniform();
        const float angle = 6.2831853F * uniform();
        const float r = std::sqrt(1.0F - z * z);
        return {r * std::cos(angle), r * std::sin(angle), z};
    }

    std::mt19937 random_{7};
};

float sineBetween(Vec3f a, Vec3f b)
{
    const Vec3f c = cross(a, b);
    return std::sqrt(dot(c, c));
}

TEST_F(WaterOptics, PaneBendsRaysBySnell)
{
    for (int k = 0; k < 1000; ++k) {
        const Vec3f direction = upward();
        const Vec3f inside = intoWater(direction, kIor);
        EXPECT_NEAR(dot(inside, inside), 1.0F, 1e-5F);
        EXPECT_NEAR(kIor * sineBetween(inside, {0, 0, 1}), sineBetween(direction, {0, 0, 1}), 1e-5F);
        EXPECT_NEAR(inside.x * direction.y - inside.y * direction.x, 0.0F, 1e-6F);
    }
}

TEST_F(WaterOptics, RaysLeaveWaterBySnellAndFresnel)
{
    int reflected = 0;
    for (int k = 0; k < 2000; ++k) {
        const Vec3f direction = upward();
        const Vec3f normal = upward();
        if (dot(direction, normal) < 0.05F) {
            continue;
        }
        const Interface found = intoAir(direction, normal, kIor);
        const Interface reference = atInterface(direction, -1.0F * normal, kIor);
        EXPECT_NEAR(found.reflected, reference.reflected, 1e-4F);
        const float sine = kIor * sineBetween(direction, normal);
        if (sine > 1.0F + 1e-4F) {
            EXPECT_EQ(found.reflected, 1.0F);
            ++reflected;
        } else if (sine < 1.0F - 1e-3F) {
            ASSERT_LT(found.reflected, 1.0F);
            EXPECT_NEAR(sineBetween(found.transmitted, normal), sine, 1e-4F);
            EXPECT_NEAR(dot(found.transmitted, cross(direction, normal)), 0.0F, 1e-5F);  // in one plane
            EXPECT_GT(dot(found.transmitted, normal), 0.0F);
        }
    }
    EXPECT_GT(reflected, 100);
}

TEST_F(WaterOptics, FlatWaterDoesNotTurnRays)
{
    for (int k = 0; k < 200; ++k) {
        const Vec3f direction = upward();
        const Interface out = intoAir(intoWater(direction, kIor), {0, 0, 1}, kIor);
        EXPECT_NEAR(out.transmitted.x, direction.x, 1e-5F);
        EXPECT_NEAR(out.transmitted.y, direction.y, 1e-5F);
    }
}

TEST_F(WaterOptics, RaysLeaveCapsulesWhereTheyMeetThem)
{
    for (int k = 0; k < 2000; ++k) {
        const float angle = 0.4F + 2.3F * uniform();
        const Capsule capsule{3.0F * uniform(), 1.0F, -std::cos(angle)};
        const float contact = std::sin(angle);
        // The point lies on the footprint.
        const float turn = 6.2831853F * uniform();
        const float far = 0.98F * contact * std::sqrt(uniform());
        const Vec3f from{capsule.half_length * (2.0F * uniform() - 1.0F) + far * std::cos(turn), far * std::sin(turn),
                         0.0F};
        const Vec3f direction = intoWater(upward(), kIor);
        const Vec3f normal = normalAtExit(capsule, from, direction);
        EXPECT_NEAR(dot(normal, normal), 1.0F, 1e-4F);
        EXPECT_GE(dot(normal, direction), -1e-3F) << "rays leave outward";
        // The points on the capsule with this normal form a line; one of them must lie on the ray.
        const float y = normal.y * capsule.radius - from.y;
        const float z = normal.z * capsule.radius + capsule.centre_height;
        const float way = (y * direction.y + z * direction.z) / (direction.y * direction.y + direction.z * direction.z);
        EXPECT_NEAR(way * direction.y, y, 2e-3F);
        EXPECT_NEAR(way * direction.z, z, 2e-3F);
        const float on_line = from.x + way * direction.x - normal.x * capsule.radius;
        EXPECT_LE(std::abs(on_line), capsule.half_length + 3e-3F);
        if (std::abs(on_line) < capsule.half_length - 3e-3F) {
            EXPECT_NEAR(normal.x, 0.0F, 1e-5F);
        }
    }
}

}  // namespace
}  // namespace droplet
