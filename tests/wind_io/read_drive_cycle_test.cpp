// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/wind_io/read_drive_cycle.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "droplet/error.h"

namespace droplet {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

std::string refusalOf(const std::string& text)
{
    try {
        (void)parseDriveCycle(text, "city.csv");
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::InvalidInput);
        EXPECT_THAT(error.what(), Not(HasSubstr("\n")));
        return error.what();
    }
    return "no refusal";
}

TEST(ReadDriveCycle, UsesTheUnitsOfTheHeader)
{
    const DriveCycle cycle{{0.0, 60.0}, {0.0, 10.0}};
    EXPECT_EQ(parseDriveCycle("time_s,speed_m_per_s\n0,0\n60,10\n", "a"), cycle);
    for (const char* text : {"Time [min], Speed (km/h)\r\n0,0\r\n1,36\r\n\r\n",
                             "\xEF\xBB\xBFspeed_km_per_h,road,time_ms\n"
                             "0,\"a, \"\"b\"\"\",0\n\"+36\",b,60000"}) {
        const DriveCycle other = parseDriveCycle(text, "a");
        EXPECT_DOUBLE_EQ(other.speedAt(30.0), 5.0) << text;
        EXPECT_DOUBLE_EQ(other.speedAt(60.0), 10.0) << text;
    }
    EXPECT_DOUBLE_EQ(parseDriveCycle("time_h,speed_mph\n0,100\n", "a").speedAt(0.0), 44.704);
}

TEST(ReadDriveCycle, RejectsAmbiguousInput)
{
    const std::string head = "time_s,speed_m_per_s\n0,1\n1,2\n";
    EXPECT_THAT(refusalOf(head + "2,\n"), AllOf(StartsWith("city.csv: row 4: "), HasSubstr("gap")));
    EXPECT_THAT(refusalOf(head + "2\n"), AllOf(HasSubstr("row 4"), HasSubstr("speed"), HasSubstr("gap")));
    EXPECT_THAT(refusalOf(head + "\n3,1\n"), AllOf(HasSubstr("row 4"), HasSubstr("gap")));
    EXPECT_THAT(refusalOf(head + "2,nan\n"), AllOf(HasSubstr("row 4"), HasSubstr("'nan'")));
    EXPECT_THAT(refusalOf(head + "2,inf\n"), HasSubstr("finite"));
    EXPECT_THAT(refusalOf(head + "2,fast\n"), HasSubstr("'fast'"));
    EXPECT_THAT(refusalOf(head + "2,3 m/s\n"), HasSubstr("'3 m/s'"));
    EXPECT_THAT(refusalOf(head + "0.5,3\n"), AllOf(HasSubstr("row 4"), HasSubstr("after 1 s")));
    EXPECT_THAT(refusalOf(head + "1,3\n"), HasSubstr("after 1 s"));
    EXPECT_THAT(refusalOf(head + "2,-3\n"), AllOf(HasSubstr("row 4"), HasSubstr("-3 m/s")));
    EXPECT_THAT(refusalOf(head + "2,3,5\n"), AllOf(HasSubstr("row 4"), HasSubstr("3 cells, the header has 2")));
    EXPECT_THAT(refusalOf(head + "2,3,\n"), HasSubstr("3 cells"));
    EXPECT_THAT(refusalOf("0,1\n1,2\n"), AllOf(HasSubstr("row 1"), HasSubstr("time_s")));
    EXPECT_THAT(refusalOf("time_s,speed\n0,1\n"), HasSubstr("speed_m_per_s"));
    EXPECT_THAT(refusalOf("time_s,speed_m_per_s\n"), HasSubstr("at least one row"));
    EXPECT_THAT(refusalOf(""), HasSubstr("at least one row"));
}

TEST(ReadDriveCycle, DetectsAMissingRow)
{
    std::string text = "time_s,speed_m_per_s\n";
    for (int k = 0; k < 20; ++k) {
        text += std::to_string(k) + ",5\n";
    }
    EXPECT_EQ(parseDriveCycle(text, "a").times.size(), 20U);
    EXPECT_THAT(refusalOf(text + "21,5\n"), AllOf(HasSubstr("row 22"), HasSubstr("every 1 s"), HasSubstr("gap")));
    // A few rows by hand do not count as sampling.
    EXPECT_EQ(parseDriveCycle("time_s,speed_m_per_s\n0,0\n10,9\n20,9\n300,0\n", "a").times.size(), 4U);
}

TEST(ReadDriveCycle, NamesTheFileThatCannotBeRead)
{
    try {
        (void)readDriveCycle("/nowhere/cycle.csv");
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::InvalidInput);
        EXPECT_THAT(error.what(), HasSubstr("/nowhere/cycle.csv"));
    }
}

}  // namespace
}  // namespace droplet
