// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/units.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "droplet/error.h"
#include "droplet/liquid.h"

namespace droplet {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

struct Case {
    std::string text;
    Dimension dimension;
    double expected;
};

TEST(ParseQuantity, ConvertsEveryUnitToTheLastBit)
{
    const std::vector<Case> cases{
        {"7nm", Dimension::Length, 7e-9},
        {"7um", Dimension::Length, 7e-6},
        {"7mm", Dimension::Length, 7e-3},
        {"7cm", Dimension::Length, 7e-2},
        {"7m", Dimension::Length, 7.0},
        {"7in", Dimension::Length, 0.1778},
        {"30um2", Dimension::Area, 30e-12},
        {"30mm2", Dimension::Area, 30e-6},
        {"30cm2", Dimension::Area, 30e-4},
        {"30m2", Dimension::Area, 30.0},
        {"30nL", Dimension::Volume, 30e-12},
        {"30uL", Dimension::Volume, 30e-9},
        {"30mL", Dimension::Volume, 30e-6},
        {"30L", Dimension::Volume, 30e-3},
        {"30mm3", Dimension::Volume, 30e-9},
        {"30cm3", Dimension::Volume, 30e-6},
        {"30m3", Dimension::Volume, 30.0},
        {"180deg", Dimension::Angle, std::numbers::pi},
        {"45deg", Dimension::Angle, std::numbers::pi / 4},
        {"1.5rad", Dimension::Angle, 1.5},
        {"72.8mN/m", Dimension::SurfaceTension, 0.0728},
        {"0.5N/m", Dimension::SurfaceTension, 0.5},
        {"22dyn/cm", Dimension::SurfaceTension, 22e-3},
        {"998kg/m3", Dimension::Density, 998.0},
        {"13.5g/cm3", Dimension::Density, 13500.0},
        {"0.79g/mL", Dimension::Density, 790.0},
        {"9.81m/s2", Dimension::Acceleration, 9.81},
        {"5mm/s2", Dimension::Acceleration, 5e-3},
        {"2g", Dimension::Acceleration, 2 * kStandardGravity},
        {"110mm/s", Dimension::Speed, 0.11},
        {"11.3m/s", Dimension::Speed, 11.3},
        {"90km/h", Dimension::Speed, 25.0},
        {"10mph", Dimension::Speed, 4.4704},
        {"40ms", Dimension::Duration, 0.04},
        {"10s", Dimension::Duration, 10.0},
        {"2min", Dimension::Duration, 120.0},
        {"1h", Dimension::Duration, 3600.0},
        {"3.6mm/h", Dimension::Rainfall, 1e-6},
        {"1in/h", Dimension::Rainfall, 25.4 * kMillimetrePerHour},
        {"45mPa.s", Dimension::Viscosity, 0.045},
        {"0.5Pa·s", Dimension::Viscosity, 0.5},
    };
    for (const Case& c : cases) {
        EXPECT_DOUBLE_EQ(parseQuantity(c.text, c.dimension), c.expected) << c.text;
    }
}

TEST(ParseQuantity, RoundsDecimalsOnce)
{
    // Multiplying by 1e-3 would give 0.0057999999999999996 here, one bit off.
    for (const double millimetres : {5.8, 4.1, 20.0, 0.3, 72.8}) {
        std::ostringstream text;
        text << millimetres << "mm";
        EXPECT_EQ(parseQuantity(text.str(), Dimension::Length), millimetres / 1000.0) << text.str();
    }
}

TEST(ParseQuantity, ReadsUsualNotations)
{
    EXPECT_DOUBLE_EQ(parseQuantity("4 mm", Dimension::Length), 4e-3);
    EXPECT_DOUBLE_EQ(parseQuantity(".5mm", Dimension::Length), 5e-4);
    EXPECT_DOUBLE_EQ(parseQuantity("1e-3m", Dimension::Length), 1e-3);
    EXPECT_DOUBLE_EQ(parseQuantity("-2mm", Dimension::Length), -2e-3);
    EXPECT_DOUBLE_EQ(parseQuantity("0uL", Dimension::Volume), 0.0);
}

TEST(ParseQuantity, ReadsTypographicUnits)
{
    EXPECT_DOUBLE_EQ(parseQuantity("3\u00b5L", Dimension::Volume), 3e-9);  // micro sign
    EXPECT_DOUBLE_EQ(parseQuantity("3\u03bcL", Dimension::Volume), 3e-9);  // Greek mu
    EXPECT_DOUBLE_EQ(parseQuantity("3mm\u00b3", Dimension::Volume), 3e-9);
    EXPECT_DOUBLE_EQ(parseQuantity("3kg/m\u00b3", Dimension::Density), 3.0);
    EXPECT_DOUBLE_EQ(parseQuantity("3m/s\u00b2", Dimension::Acceleration), 3.0);
    EXPECT_DOUBLE_EQ(parseQuantity("90\u00b0", Dimension::Angle), std::numbers::pi / 2);
}

std::string refusal(const std::string& text, Dimension dimension)
{
    try {
        parseQuantity(text, dimension);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::InvalidArgument) << text;
        EXPECT_THAT(error.what(), Not(HasSubstr("\n")));
        return error.what();
    }
    ADD_FAILURE() << text << " was accepted";
    return "";
}

TEST(ParseQuantity, RefusesNumbersWithoutUnitAndSaysWhatToWrite)
{
    EXPECT_THAT(refusal("30", Dimension::Volume),
                AllOf(HasSubstr("'30' has no unit"), HasSubstr("nL, uL, mL, L, mm3, cm3 or m3"), HasSubstr("30uL")));
    EXPECT_THAT(refusal("0", Dimension::Acceleration), HasSubstr("no unit"));
}

TEST(ParseQuantity, RefusesOtherQuantities)
{
    EXPECT_THAT(refusal("4mm", Dimension::Volume), HasSubstr("is not a volume"));
    for (const char* text : {"", "mm", "four mm", "4  mm", " 4mm", "4mm ", "4mm3", "4MM", "4km", "1,5mm", "0x4mm",
                             "4mm4mm", "--4mm", "+4mm", "4em", "4\nmm"}) {
        EXPECT_THAT(refusal(text, Dimension::Length), HasSubstr("is not a length")) << text;
    }
    EXPECT_THAT(refusal(std::string("4mm\0", 4), Dimension::Length), HasSubstr("is not a length"));
}

TEST(ParseQuantity, RefusesNumbersThatAreNotFinite)
{
    for (const char* text : {"nan", "nanmm", "inf mm", "-infmm", "infinitymm", "1e999mm"}) {
        EXPECT_THAT(refusal(text, Dimension::Length), HasSubstr("is not a finite number")) << text;
    }
    EXPECT_THAT(refusal("1e308g/cm3", Dimension::Density), HasSubstr("is not a finite number"));
}

TEST(ParseQuantity, ReportsErrorsInOneShortLine)
{
    EXPECT_LT(refusal(std::string(100'000, 'x'), Dimension::Length).size(), 200U);
}

TEST(UnitsOf, ListsUnitsThatParseQuantityReads)
{
    for (const Dimension dimension :
         {Dimension::Length, Dimension::Volume, Dimension::Angle, Dimension::SurfaceTension, Dimension::Density,
          Dimension::Acceleration, Dimension::Speed, Dimension::Duration, Dimension::Rainfall, Dimension::Viscosity}) {
        std::istringstream words(unitsOf(dimension));
        int units = 0;
        for (std::string word; words >> word;) {
            if (word.back() == ',') {
                word.pop_back();
            }
            if (word != "or") {
                EXPECT_GT(parseQuantity("1" + word, dimension), 0.0) << word;
                ++units;
            }
        }
        EXPECT_GE(units, 2);
    }
}

}  // namespace
}  // namespace droplet
