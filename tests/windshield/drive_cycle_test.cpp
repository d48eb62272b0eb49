// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/windshield/drive_cycle.h"

#include <gtest/gtest.h>

#include <limits>

#include "droplet/error.h"

namespace droplet {
namespace {

TEST(DriveCycle, IsLinearBetweenItsRows)
{
    const DriveCycle cycle{{1.0, 3.0, 4.0}, {0.0, 10.0, 10.0}};
    EXPECT_EQ(cycle.speedAt(-5.0), 0.0);
    EXPECT_EQ(cycle.speedAt(1.0), 0.0);
    EXPECT_DOUBLE_EQ(cycle.speedAt(1.5), 2.5);
    EXPECT_EQ(cycle.speedAt(3.0), 10.0);
    EXPECT_EQ(cycle.speedAt(3.7), 10.0);
    EXPECT_EQ(cycle.speedAt(99.0), 10.0);
    EXPECT_EQ(constantSpeed(7.0).speedAt(1e9), 7.0);
}

TEST(DriveCycle, RejectsInvalidRows)
{
    EXPECT_NO_THROW(DriveCycle{}.validate());
    EXPECT_THROW((DriveCycle{{}, {}}.validate()), Error);
    EXPECT_THROW((DriveCycle{{0.0, 1.0}, {1.0}}.validate()), Error);
    EXPECT_THROW((DriveCycle{{0.0, 0.0}, {1.0, 1.0}}.validate()), Error);
    EXPECT_THROW(constantSpeed(-1.0).validate(), Error);
    EXPECT_THROW(constantSpeed(std::numeric_limits<double>::quiet_NaN()).validate(), Error);
}

}  // namespace
}  // namespace droplet
