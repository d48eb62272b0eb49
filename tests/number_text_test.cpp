// SPDX-License-Identifier: GPL-3.0-or-later
#include "number_text.h"

#include <gtest/gtest.h>

#include <limits>

namespace droplet {
namespace {

TEST(NumberText, IsShortAndNeverMinusZero)
{
    EXPECT_EQ(numberText(40.0), "40");
    EXPECT_EQ(numberText(0.1 + 0.2), "0.3");
    EXPECT_EQ(numberText(2e-9), "2e-09");
    EXPECT_EQ(numberText(-0.0), "0");
    EXPECT_EQ(numberText(-1.5), "-1.5");
    EXPECT_EQ(numberText(3.14159, 3), "3.14");
    EXPECT_EQ(numberText(std::numeric_limits<double>::infinity()), "inf");
}

}  // namespace
}  // namespace droplet
