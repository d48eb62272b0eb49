// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/printable.h"

#include <gtest/gtest.h>

namespace droplet {
namespace {

TEST(Printable, KeepsText)
{
    for (const char* text : {"", "a b", "größer", "水滴 💧", "C:\\new", "~"}) {
        EXPECT_EQ(printable(text), text);
        EXPECT_TRUE(isPrintable(text)) << text;
    }
}

TEST(Printable, EscapesControlCharacters)
{
    EXPECT_EQ(printable("two\nlines\r\t."), "two\\nlines\\r\\t.");
    EXPECT_EQ(printable("\x1b[31mred\x7f"), "\\x1b[31mred\\x7f");
    EXPECT_EQ(printable(std::string_view("a\0b", 3)), "a\\x00b");
    EXPECT_EQ(printable("\u0085"), "\\xc2\\x85") << "next line";
    EXPECT_EQ(printable("\u2028"), "\\xe2\\x80\\xa8") << "line separator";
    EXPECT_FALSE(isPrintable("a\nb"));
}

TEST(Printable, EscapesBytesThatAreNotUtf8)
{
    EXPECT_EQ(printable("a\xff"
                        "b"),
              "a\\xffb");
    EXPECT_EQ(printable("\xc3"), "\\xc3") << "cut off";
    EXPECT_EQ(printable("\xe6\xb0"
                        "a"),
              "\\xe6\\xb0a")
        << "cut off";
    EXPECT_EQ(printable("\xc0\xaf"), "\\xc0\\xaf") << "longer than the shortest form";
    EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80") << "half of a pair of UTF-16";
    EXPECT_EQ(printable("\xf4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80") << "beyond Unicode";
    EXPECT_FALSE(isPrintable("\xff"));
}

}  // namespace
}  // namespace droplet
