// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/io/base64.h"

namespace droplet {
namespace {

// RFC 4648, section 10.
TEST(Base64, HasTheTextsOfTheStandard)
{
    EXPECT_EQ(base64(""), "");
    EXPECT_EQ(base64("f"), "Zg==");
    EXPECT_EQ(base64("fo"), "Zm8=");
    EXPECT_EQ(base64("foo"), "Zm9v");
    EXPECT_EQ(base64("foob"), "Zm9vYg==");
    EXPECT_EQ(base64("fooba"), "Zm9vYmE=");
    EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
}

TEST(Base64, TakesAllBytes)
{
    EXPECT_EQ(base64("\xff\xff\xfe"), "///+");
    EXPECT_EQ(base64(std::string(3, '\0')), "AAAA");
}

}  // namespace
}  // namespace droplet
