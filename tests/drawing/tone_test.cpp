// SPDX-License-Identifier: GPL-3.0-or-later
#include "drawing/tone.h"

#include <gtest/gtest.h>

#include <cstdint>

namespace droplet {
namespace {

TEST(MixedLevel, IsTheNearestToTheMix)
{
    int wrong = 0;
    for (unsigned above = 0; above < 256; ++above) {
        for (unsigned below = 0; below < 256; ++below) {
            for (unsigned alpha = 0; alpha < 256; ++alpha) {
                const unsigned mixed = mixedLevel(static_cast<std::uint8_t>(above), static_cast<std::uint8_t>(below),
                                                  static_cast<std::uint8_t>(alpha));
                wrong += mixed == (above * alpha + below * (255U - alpha) + 127U) / 255U ? 0 : 1;
            }
        }
    }
    EXPECT_EQ(wrong, 0);
}

}  // namespace
}  // namespace droplet
