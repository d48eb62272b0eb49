// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/flow/leg.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace droplet {
namespace {

TEST(Leg, IsBallisticWithoutFriction)
{
    const Leg leg{2.0, {1.0, 2.0, 3.0}, {0.5, -0.25, 1.0}, {0.0, 1.0, -9.81}, 0.0};
    const Vec3 p = leg.placeAt(3.5);
    EXPECT_DOUBLE_EQ(p.x, 1.75);
    EXPECT_DOUBLE_EQ(p.y, 2.0 - 0.25 * 1.5 + 0.5 * 2.25);
    EXPECT_DOUBLE_EQ(p.z, 3.0 + 1.5 - 0.5 * 9.81 * 2.25);
    EXPECT_DOUBLE_EQ(leg.velocityAt(3.5).z, 1.0 - 9.81 * 1.5);
}

TEST(Leg, IsThePapersFormula)
{
    // v = −F/k_f + (v_i + F/k_f) e^{k_f τ/m}, and its integral, with k_f/m = −decay.
    for (const double decay : {0.5, 3.0, 40.0}) {
        const Leg leg{0.0, {}, {0.2, 0.0, 0.0}, {4.0, 0.0, 0.0}, decay};
        for (const double t : {0.01, 0.3, 2.0, 50.0}) {
            const double terminal = 4.0 / decay;
            const double rest = std::exp(-decay * t);
            EXPECT_NEAR(leg.velocityAt(t).x, terminal + (0.2 - terminal) * rest, 1e-12 * terminal);
            const double p = terminal * t + (0.2 - terminal) * (1.0 - rest) / decay;
            EXPECT_NEAR(leg.placeAt(t).x, p, 1e-12 * terminal * t);
        }
    }
}

TEST(Leg, IsContinuousInTheFriction)
{
    const auto at = [](double decay) { return Leg{0.0, {}, {0.2, 0.0, 0.0}, {4.0, 0.0, 0.0}, decay}.placeAt(0.7).x; };
    for (double decay = 1.0; decay > 1e-300; decay *= 0.37) {
        EXPECT_LE(at(decay), at(0.0));
        EXPECT_NEAR(at(decay), at(0.0), decay * 0.7 * (0.2 * 0.7 + 4.0 * 0.49));
        EXPECT_NEAR(at(decay), at(decay * (1.0 + 1e-9)), 1e-9);
    }
}

TEST(Leg, GoesOnFromAnyOfItsPlaces)
{
    const Leg whole{0.0, {1.0, 0.0, 0.0}, {0.3, -2.0, 0.1}, {1.0, 2.0, -3.0}, 2.5};
    const Leg rest{0.4, whole.placeAt(0.4), whole.velocityAt(0.4), whole.push, whole.decay};
    EXPECT_LE(length(whole.placeAt(1.9) - rest.placeAt(1.9)), 1e-14);
    EXPECT_LE(length(whole.velocityAt(1.9) - rest.velocityAt(1.9)), 1e-14);
}

TEST(Coordinate, PassesZeroFirstWhereSamplesSayIt)
{
    std::mt19937 random(5);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    int passed = 0;
    for (int i = 0; i < 4000; ++i) {
        const Coordinate s{std::abs(uniform(random)), 3.0 * uniform(random), 5.0 * uniform(random),
                           i % 3 == 0 ? 0.0 : std::exp(6.0 * uniform(random))};
        const double from = i % 2 == 0 ? 0.0 : 0.1 * std::abs(uniform(random));
        const double to = from + 2.0;
        const auto time = s.fallsBelowZero(from, to);
        double first = std::numeric_limits<double>::infinity();
        for (int k = 0; k <= 2000 && first > to; ++k) {
            const double t = from + k * 1e-3;
            if (s.placeAt(t) < 0.0 && s.velocityAt(t) < 0.0) {
                first = t;
            }
        }
        if (!time) {
            EXPECT_GT(first, to) << i;
            continue;
        }
        ++passed;
        if (*time > from && s.placeAt(from) >= 0.0) {
            EXPECT_NEAR(s.placeAt(*time), 0.0, 1e-13) << i;
            EXPECT_LE(*time, first) << i;
            EXPECT_GE(*time, first - 1.001e-3 - (first > to ? first : 0.0)) << i;
        }
    }
    EXPECT_GT(passed, 1000);
}

TEST(Coordinate, StandsStillForEver)
{
    EXPECT_FALSE((Coordinate{0.0, 0.0, 0.0, 1.0}.fallsBelowZero(0.0, 1e300)));
    EXPECT_FALSE((Coordinate{1.0, -1.0, 0.0, 2.0}.fallsBelowZero(0.0, 1e300))) << "it stops half-way";
    EXPECT_FALSE((Coordinate{0.0, 1.0, 0.0, 0.0}.fallsBelowZero(0.0, 1e300)));
}

TEST(Coordinate, FallsFromTheEdgeAtOnce)
{
    EXPECT_EQ((Coordinate{0.0, -1.0, 0.0, 0.0}.fallsBelowZero(0.0, 1.0)), 0.0);
    EXPECT_EQ((Coordinate{0.0, 0.0, -1.0, 1.0}.fallsBelowZero(0.0, 1.0)), 0.0);
    const auto back = Coordinate{0.0, 1.0, -2.0, 0.0}.fallsBelowZero(0.0, 5.0);
    ASSERT_TRUE(back);
    EXPECT_DOUBLE_EQ(*back, 1.0);
}

TEST(Coordinate, GrazesWithoutPassing)
{
    // The lowest point is 1e-9 above 0, then 1e-9 below it.
    EXPECT_FALSE((Coordinate{0.5 + 1e-9, -1.0, 1.0, 0.0}.fallsBelowZero(0.0, 9.0)));
    const auto time = Coordinate{0.5 - 1e-9, -1.0, 1.0, 0.0}.fallsBelowZero(0.0, 9.0);
    ASSERT_TRUE(time);
    EXPECT_NEAR(*time, 1.0 - std::sqrt(2e-9), 1e-8);
}

}  // namespace
}  // namespace droplet
