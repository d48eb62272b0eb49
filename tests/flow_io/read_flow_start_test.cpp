// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/flow_io/read_flow_start.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <string>

#include "droplet/error.h"
#include "droplet/flow_io/read_object_motion.h"

namespace droplet {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::SizeIs;
using ::testing::StartsWith;

std::string refusalOf(const std::function<void()>& read)
{
    try {
        read();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::InvalidInput);
        EXPECT_THAT(error.what(), Not(HasSubstr("\n")));
        return error.what();
    }
    return "no refusal";
}

std::string startRefusal(const std::string& text)
{
    return refusalOf([&] { (void)parseFlowStart(text, "drops.csv"); });
}

std::string motionRefusal(const std::string& text)
{
    return refusalOf([&] { (void)parseObjectMotion(text, "turn.csv"); });
}

TEST(ReadFlowStart, FindsColumnsByTheirHeadings)
{
    const auto starts = parseFlowStart("x_m,y_m,z_m,volume_m3\n1,2,3,4e-9\n-1,0,0.5,1e-9\n\n", "a");
    ASSERT_THAT(starts, SizeIs(2));
    EXPECT_EQ(starts[0].place, (Vec3{1.0, -3.0, 2.0}));  // y up to z up
    EXPECT_EQ(starts[0].volume, 4e-9);
    EXPECT_EQ(starts[0].velocity, Vec3{});
    const auto moving = parseFlowStart(
        "volume_m3,name,velocity_z_m_per_s, velocity_y_m_per_s ,velocity_x_m_per_s,z_m,"
        "y_m,x_m\r\n4e-9,\"a,b\",7,8,9,3,2,+1\r\n",
        "a");
    ASSERT_THAT(moving, SizeIs(1));
    EXPECT_EQ(moving[0].place, (Vec3{1.0, -3.0, 2.0}));
    EXPECT_EQ(moving[0].velocity, (Vec3{9.0, -7.0, 8.0}));
}

TEST(ReadFlowStart, NamesRowAndColumnOfWhatIsWrong)
{
    const std::string head = "x_m,y_m,z_m,volume_m3\n1,2,3,4e-9\n";
    EXPECT_THAT(startRefusal(head + "1,2,wet,4\n"),
                AllOf(StartsWith("drops.csv: row 3: z_m is 'wet'"), HasSubstr("must be a finite number")));
    EXPECT_THAT(startRefusal(head + "1,,3,4\n"), HasSubstr("row 3: has no y_m"));
    EXPECT_THAT(startRefusal(head + "1,2,3,0\n"), HasSubstr("row 3: volume_m3 is 0; it must be more than 0"));
    EXPECT_THAT(startRefusal(head + "1,2,inf,1\n"), HasSubstr("'inf'"));
    EXPECT_THAT(startRefusal(head + "\n1,2,3,1\n"), HasSubstr("row 3: is empty"));
    EXPECT_THAT(startRefusal(head + "1,2,3,4,5\n"), HasSubstr("5 cells"));
    EXPECT_THAT(startRefusal("x_m,y_m,volume_m3\n"), HasSubstr("x_m, y_m, z_m"));
    EXPECT_THAT(startRefusal("x_m,y_m,z_m\n1,2,3\n"), HasSubstr("volume_m3"));
    EXPECT_THAT(startRefusal("x_m,y_m,z_m,volume_m3,velocity_x_m_per_s\n1,2,3,4,5\n"), HasSubstr("velocity_y_m_per_s"));
    EXPECT_THAT(startRefusal("x_m,y_m,z_m,volume_m3\n"), HasSubstr("at least one row"));
    EXPECT_THAT(startRefusal(""), HasSubstr("at least one row"));
    EXPECT_THAT(refusalOf([] { (void)readFlowStart("/nowhere/drops.csv"); }), HasSubstr("/nowhere/drops.csv"));
}

TEST(ReadObjectMotion, HasPlacesAndQuaternions)
{
    const ObjectMotion motion = parseObjectMotion(
        "time_s,x_m,y_m,z_m,rotation_x,rotation_y,rotation_z,rotation_w\n0,0,0,0,0,0,0,1\n2,1,2,3,0,5,0,5\n", "a");
    motion.validate();
    // A quarter turn about the file's y axis, which is z here.
    const ObjectPose end = motion.at(2.0);
    EXPECT_EQ(end.place, (Vec3{1.0, -3.0, 2.0}));
    EXPECT_NEAR(end.toWorld({1.0, 0.0, 0.0}).y, 1.0, 1e-15);
    EXPECT_NEAR(motion.apparentAcceleration(1.0, {1.0, 0.0, 0.0}, {}).x, std::pow(std::numbers::pi / 4.0, 2), 1e-15);
    EXPECT_EQ(parseObjectMotion("x_m,time_s,z_m,y_m\n4,1,6,5\n", "a").at(0.0).place, (Vec3{4.0, -6.0, 5.0}));
    EXPECT_FALSE(
        parseObjectMotion("time_s,rotation_w,rotation_x,rotation_y,rotation_z\n0,1,0,0,0\n1,0,1,0,0\n", "a").rests());
}

TEST(ReadObjectMotion, NamesRowAndColumnOfWhatIsWrong)
{
    const std::string head = "time_s,x_m,y_m,z_m\n1,2,3,4\n";
    EXPECT_THAT(motionRefusal(head + "1,2,3,4\n"),
                AllOf(StartsWith("turn.csv: row 3: time_s is 1"), HasSubstr("more than 1")));
    EXPECT_THAT(motionRefusal(head + "2,2,b,4\n"), HasSubstr("row 3: y_m is 'b'"));
    EXPECT_THAT(motionRefusal("time_s\n1\n"), HasSubstr("rotation_x"));
    EXPECT_THAT(motionRefusal("time_s,x_m,y_m\n1,2,3\n"), HasSubstr("z_m"));
    EXPECT_THAT(motionRefusal("time_s,rotation_w,rotation_x,rotation_y,rotation_z\n0,0,0,0,0\n"),
                AllOf(HasSubstr("row 2"), HasSubstr("length 0")));
    EXPECT_THAT(motionRefusal("time_s,x_m,y_m,z_m\n"), HasSubstr("at least one row"));
}

}  // namespace
}  // namespace droplet
