// SPDX-License-Identifier: GPL-3.0-or-later
#include "byte_stream.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <sstream>
#include <string>

#include "support/pieces.h"

namespace droplet {
namespace {

using testing::Pieces;

TEST(ByteStream, NumbersAreLittleEndian)
{
    std::ostringstream out;
    ByteStream bytes(out);
    bytes.u8(0x01, 0x80, 'a');
    bytes.u16(0x0102, 0xfffe);
    bytes.u32(0x01020304U, std::uint64_t{0xfffefdfc});
    bytes.f32(1.0, -0.5);
    EXPECT_EQ(bytes.finish(), 23U);
    EXPECT_EQ(out.str(), std::string("\x01\x80"
                                     "a\x02\x01\xfe\xff\x04\x03\x02\x01\xfc\xfd\xfe\xff\0\0\x80\x3f\0\0\0\xbf",
                                     23));
}

TEST(ByteStream, DigitsAreText)
{
    std::ostringstream out;
    ByteStream bytes(out);
    bytes.digits(std::numeric_limits<std::uint64_t>::max());
    bytes.u8(' ');
    bytes.digits(-std::numeric_limits<double>::max(), std::chars_format::general, 17);
    bytes.u8(' ');
    bytes.digits(1.0 / 3.0, std::chars_format::general, 3);
    bytes.finish();
    EXPECT_EQ(out.str(), "18446744073709551615 -1.7976931348623157e+308 0.333");
}

TEST(ByteStream, RefusesNumbersBeyondFloat)
{
    std::ostringstream out;
    ByteStream bytes(out);
    const double max = std::numeric_limits<float>::max();
    bytes.f32(max, -max, 1e-300);
    for (const double wrong :
         {1e39, -1e39, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
        EXPECT_THROW(bytes.f32(wrong), Error);
        EXPECT_THROW(bytes.f32(0.0, wrong), Error);
    }
    EXPECT_EQ(bytes.finish(), 12U);
}

TEST(ByteStream, WritesEveryByteOnceInPiecesOfLimitedSize)
{
    Pieces pieces;
    std::ostream out(&pieces);
    ByteStream bytes(out);
    std::string expected;
    std::size_t steps = 0;
    for (const std::size_t length :
         {std::size_t{1}, std::size_t{65'535}, std::size_t{65'536}, std::size_t{65'537}, std::size_t{200'000}}) {
        for (; expected.size() % 7919 != 0 || expected.empty(); ++steps) {
            bytes.u8(steps % 256, steps / 256 % 256, 7);
            expected += {static_cast<char>(steps % 256), static_cast<char>(steps / 256 % 256), 7};
        }
        std::string text(length, ' ');
        std::generate(text.begin(), text.end(), [n = 0]() mutable { return static_cast<char>('0' + n++ % 73); });
        bytes.text(text);
        expected += text;
    }
    EXPECT_EQ(bytes.finish(), expected.size());
    EXPECT_EQ(pieces.taken(), expected);
    EXPECT_LE(pieces.largest(), 65'536U);
}

TEST(ByteStream, LeavesAStreamFailedThatDoesNotTakeEverything)
{
    std::ostream out(nullptr);
    ByteStream bytes(out);
    bytes.u8(1);
    bytes.finish();
    EXPECT_TRUE(out.fail());
}

}  // namespace
}  // namespace droplet
