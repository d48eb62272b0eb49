// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/liquid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <optional>
#include <set>
#include <string>

#include "droplet/error.h"

namespace droplet {
namespace {

using ::testing::HasSubstr;

TEST(Liquids, BeginWithWaterWhichIsTheDefault)
{
    const Liquid water;
    ASSERT_FALSE(liquids().empty());
    EXPECT_EQ(liquids().front().name, water.name);
    EXPECT_EQ(liquids().front().surface_tension, water.surface_tension);
    EXPECT_EQ(liquids().front().density, water.density);
}

TEST(Liquids, HaveCapillaryLengthsOfRealLiquids)
{
    // √(σ/ρg): textbooks have 2.73 mm for water, 1.70 mm for ethanol, 1.91 mm for mercury. This finds wrong units.
    const auto capillary_length = [](const char* name) {
        return capillaryLength(liquidNamed(name), kStandardGravity).value_or(0.0);
    };
    EXPECT_NEAR(capillary_length("water"), 2.73e-3, 0.01e-3);
    EXPECT_NEAR(capillary_length("ethanol"), 1.70e-3, 0.01e-3);
    EXPECT_NEAR(capillary_length("mercury"), 1.91e-3, 0.01e-3);
    EXPECT_NEAR(capillary_length("glycerol"), 2.26e-3, 0.01e-3);
    EXPECT_NEAR(capillary_length("honey"), 1.99e-3, 0.01e-3);
}

TEST(Liquids, HaveNoCapillaryLengthWithoutWeight)
{
    EXPECT_EQ(capillaryLength({}, -kStandardGravity), capillaryLength({}, kStandardGravity));
    EXPECT_EQ(capillaryLength({}, 0.0), std::nullopt);
    EXPECT_EQ(capillaryLength({"light", 0.07, 0.0}, kStandardGravity), std::nullopt);
}

TEST(Liquids, AreValidAndFoundByTheirNames)
{
    std::set<std::string> names;
    for (const Liquid& liquid : liquids()) {
        EXPECT_NO_THROW(liquid.validate()) << liquid.name;
        EXPECT_EQ(&liquidNamed(liquid.name), &liquid);
        EXPECT_TRUE(names.insert(liquid.name).second) << liquid.name << " is in the list twice";
    }
}

TEST(Liquids, UnknownNameListsTheKnownOnes)
{
    try {
        liquidNamed("milk");
        FAIL() << "milk was found";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::InvalidArgument);
        EXPECT_THAT(error.what(), HasSubstr("milk"));
        for (const Liquid& liquid : liquids()) {
            EXPECT_THAT(error.what(), HasSubstr(liquid.name));
        }
    }
}

TEST(Liquid, ValidatesEveryField)
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double infinity = std::numeric_limits<double>::infinity();
    for (const double tension : {0.0, -0.1, nan, infinity}) {
        Liquid liquid;
        liquid.surface_tension = tension;
        EXPECT_THROW(liquid.validate(), Error) << tension;
    }
    for (const double density : {-1e-9, nan, infinity}) {
        Liquid liquid;
        liquid.density = density;
        EXPECT_THROW(liquid.validate(), Error) << density;
    }
    Liquid weightless;
    weightless.density = 0.0;
    EXPECT_NO_THROW(weightless.validate());
}

}  // namespace
}  // namespace droplet
