// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/flow/object_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "droplet/error.h"

namespace droplet {
namespace {

ObjectPose poseOf(Vec3 place, Vec3 axis, double angle)
{
    return {place, (std::sin(0.5 * angle) / length(axis)) * axis, std::cos(0.5 * angle)};
}

void expectNear(Vec3 a, Vec3 b, double tolerance)
{
    EXPECT_NEAR(a.x, b.x, tolerance);
    EXPECT_NEAR(a.y, b.y, tolerance);
    EXPECT_NEAR(a.z, b.z, tolerance);
}

Vec3 worldOf(const ObjectMotion& motion, double time, Vec3 point)
{
    const ObjectPose pose = motion.at(time);
    return pose.place + pose.toWorld(point);
}

/// The apparent acceleration is the negative of what accelerates a free point's world path.
void expectAccelerationOfPath(const ObjectMotion& motion, double time)
{
    const Vec3 place{0.3, -0.2, 0.5};
    const Vec3 velocity{-0.4, 0.7, 0.1};
    constexpr double kStep = 1e-3;
    const auto path = [&](double dt) { return worldOf(motion, time + dt, place + dt * velocity); };
    // Fourth order, so the error of rounding dominates.
    const Vec3 second =
        (1.0 / (12.0 * kStep * kStep)) * (-1.0 * path(-2 * kStep) + 16.0 * path(-kStep) + -30.0 * path(0.0) +
                                          16.0 * path(kStep) + -1.0 * path(2 * kStep));
    expectNear(motion.apparentAcceleration(time, place, velocity), -1.0 * motion.at(time).toObject(second), 1e-7);
}

TEST(ObjectMotion, RestsByDefault)
{
    const ObjectMotion motion;
    EXPECT_TRUE(motion.rests());
    EXPECT_EQ(motion.at(3.0), ObjectPose{});
    EXPECT_EQ(motion.apparentAcceleration(1.0, {1.0, 2.0, 3.0}, {1.0, 0.0, 0.0}), Vec3{});
}

TEST(ObjectMotion, SpinsAboutThePivot)
{
    ObjectMotion motion;
    motion.spin = {0.0, 0.0, 0.5 * std::numbers::pi};
    EXPECT_FALSE(motion.rests());
    expectNear(motion.at(1.0).toWorld({1.0, 0.0, 0.0}), {0.0, 1.0, 0.0}, 1e-15);
    expectNear(motion.at(1.0).toObject({0.0, 1.0, 0.0}), {1.0, 0.0, 0.0}, 1e-15);
    EXPECT_EQ(motion.at(1.0).place, Vec3{});
    // ω² r outwards.
    expectNear(motion.apparentAcceleration(0.7, {2.0, 0.0, 5.0}, {}),
               {0.5 * std::numbers::pi * std::numbers::pi, 0.0, 0.0}, 1e-14);
    motion.pivot = {1.0, 2.0, 3.0};
    expectNear(worldOf(motion, 0.9, motion.pivot), motion.pivot, 1e-15);
    motion.spin = {0.4, -1.3, 2.0};
    for (const double time : {0.1, 1.7, 30.0}) {
        expectAccelerationOfPath(motion, time);
    }
}

TEST(ObjectMotion, TurnsAndMovesSteadilyBetweenKeys)
{
    ObjectMotion motion;
    motion.keys = {{1.0, poseOf({0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, 0.0)},
                   {3.0, poseOf({2.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, 1.0)},
                   {4.0, poseOf({2.0, 1.0, 0.0}, {1.0, 1.0, 0.0}, 2.5)}};
    motion.keys[2].pose.axis = -1.0 * motion.keys[2].pose.axis;  // the same rotation
    motion.keys[2].pose.real *= -1.0;
    motion.validate();
    EXPECT_FALSE(motion.rests());
    expectNear(motion.at(2.0).place, {1.0, 0.0, 0.0}, 1e-15);
    expectNear(motion.at(2.0).toWorld({1.0, 0.0, 0.0}), {std::cos(0.5), std::sin(0.5), 0.0}, 1e-15);
    for (const double time : {0.0, 1.0, 4.0, 9.0}) {
        const ObjectPose& key = time <= 1.0 ? motion.keys.front().pose : motion.keys.back().pose;
        EXPECT_EQ(motion.at(time), key) << time;
    }
    EXPECT_EQ(motion.apparentAcceleration(0.5, {1.0, 0.0, 0.0}, {}), Vec3{});
    EXPECT_EQ(motion.apparentAcceleration(4.0, {1.0, 0.0, 0.0}, {}), Vec3{});
    // From both sides of a key.
    const Vec3 point{1.0, -2.0, 3.0};
    expectNear(worldOf(motion, std::nextafter(3.0, 0.0), point), worldOf(motion, 3.0, point), 1e-14);
    motion.pivot = {0.5, 0.0, -1.0};
    for (const double time : {1.5, 2.9, 3.4}) {
        expectAccelerationOfPath(motion, time);
        expectNear(worldOf(motion, 2.0, motion.pivot),
                   0.5 * (worldOf(motion, 1.0, motion.pivot) + worldOf(motion, 3.0, motion.pivot)), 1e-15);
    }
}

TEST(ObjectMotion, JumpsWhereTwoKeysHaveOneTime)
{
    ObjectMotion motion;
    const ObjectPose moved{{0.0, 0.0, 5.0}, {}, 1.0};
    motion.keys = {{0.0, {}}, {1.0, {}}, {1.0, moved}, {2.0, moved}};
    motion.validate();
    EXPECT_EQ(motion.at(0.999), ObjectPose{});
    EXPECT_EQ(motion.at(1.0), moved);
    motion.keys = {{0.0, moved}, {1.0, moved}};
    EXPECT_FALSE(motion.rests());
    motion.keys = {{0.0, {}}, {1.0, {}}};
    EXPECT_TRUE(motion.rests());
}

TEST(ObjectMotion, RejectsBadKeys)
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const ObjectPose still;
    for (const ObjectMotion& motion :
         {ObjectMotion{{nan, 0.0, 0.0}, {}, {}}, ObjectMotion{{}, {{1.0, still}, {0.5, still}}, {}},
          ObjectMotion{{}, {{nan, still}}, {}}, ObjectMotion{{}, {{0.0, {{nan, 0.0, 0.0}, {}, 1.0}}}, {}},
          ObjectMotion{{}, {{0.0, {{}, {}, 0.9}}}, {}}, ObjectMotion{{}, {}, {0.0, nan, 0.0}}}) {
        EXPECT_THROW(motion.validate(), Error);
    }
}

}  // namespace
}  // namespace droplet
