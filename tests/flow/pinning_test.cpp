// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/pinning.h"

#include <gtest/gtest.h>

#include <cmath>

namespace droplet {
namespace {

constexpr ContactFront kFront{{0.0123, 0.0456, 0.0789}, 1e-6, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}};

TEST(Pinning, HasItsMeanSpreadAndSeed)
{
    const PinningField field({.spread = 0.5, .length = 2e-3}, 7);
    constexpr int kPlaces = 200'000;
    double sum = 0.0;
    double logs = 0.0;
    double squares = 0.0;
    for (int k = 0; k < kPlaces; ++k) {
        const double value = field.at({0.00371 * k, 0.00113 * k, 0.00057 * k});
        ASSERT_GT(value, 0.0);
        sum += value / kPlaces;
        logs += std::log(value) / kPlaces;
        squares += std::log(value) * std::log(value) / kPlaces;
    }
    EXPECT_NEAR(std::sqrt(squares - logs * logs), 0.5, 0.01);
    EXPECT_NEAR(sum, 1.0, 0.02);
    EXPECT_NE(field.at({}), PinningField({.spread = 0.5, .length = 2e-3}, 8).at({}));
    EXPECT_EQ(PinningField({.spread = 0.0}, 7).at({0.1, 0.2, 0.3}), 1.0);
}

TEST(Pinning, IsSmooth)
{
    const PinningField field({.spread = 0.5, .length = 2e-3}, 1);
    for (int k = -200; k < 200; ++k) {
        const Vec3 p{1e-4 * k, -0.7e-4 * k, 0.3e-4 * k};
        EXPECT_NEAR(field.at(p), field.at(p + Vec3{1e-9, 1e-9, 1e-9}), 1e-5);
    }
}

TEST(Pinning, HoldsAsTheIntegralOverTheFront)
{
    const PinningField field({.spread = 0.8, .length = 2e-3}, 3);
    // Of a small droplet, what holds is the field's value, and the push aside 3/4 r times its slope.
    const auto slope = [&](Vec3 way) {
        return (field.at(kFront.middle + 1e-7 * way) - field.at(kFront.middle - 1e-7 * way)) / 2e-7;
    };
    const PinningHold hold = field.over(kFront);
    EXPECT_NEAR(hold.along, field.at(kFront.middle), 1e-3);
    EXPECT_NEAR(hold.aside / kFront.radius, -0.75 * slope(kFront.left), 0.01 * std::abs(slope(kFront.left)));
    // Mirrored, it goes the other way.
    ContactFront mirrored = kFront;
    mirrored.left = -1.0 * kFront.left;
    EXPECT_NEAR(field.over(mirrored).aside, -hold.aside, 1e-15);
    EXPECT_EQ(field.over(mirrored).along, hold.along);
}

TEST(Pinning, NeverPushesMoreThanItHolds)
{
    const PinningField field({.spread = 1.5, .length = 1e-3}, 5);
    double most = 0.0;
    for (int k = 0; k < 5000; ++k) {
        ContactFront front = kFront;
        front.middle = 1e-4 * k * Vec3{1.0, 0.3, 0.7};
        front.radius = 1e-3;
        const PinningHold hold = field.over(front);
        EXPECT_LE(std::abs(hold.aside), hold.along);
        most = std::max(most, std::abs(hold.aside) / hold.along);
    }
    EXPECT_GT(most, 0.3);
}

}  // namespace
}  // namespace droplet
