// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures one behind the other in a stream.
#include "cli/picture_stream.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "droplet/drawing/picture.h"
#include "droplet/error.h"

namespace {

using cli::PictureStream;
using droplet::Error;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

std::string png()
{
    droplet::DeepPicture picture;
    picture.width = 3;
    picture.height = 2;
    picture.channels = 1;
    picture.levels = {0, 1, 2, 3, 4, 65535};
    std::ostringstream out;
    writePng(picture, out);
    return out.str();
}

const std::string kPgm = "P5 # a comment\n2 2\n255\nabcd";
const std::string kDeepPgm = "P5\n2 1 65535\nabcd";
const std::string kPpm = "P6\n1 2\n255\nP5 \n\n\n";  // its pixels look like a header

std::vector<std::string> picturesOf(const std::string& bytes)
{
    std::istringstream in(bytes);
    PictureStream stream(in);
    std::vector<std::string> pictures;
    while (const auto picture = stream.next()) {
        pictures.emplace_back(reinterpret_cast<const char*>(picture->data()), picture->size());
    }
    return pictures;
}

TEST(PictureStream, SeparatesPicturesOfAllFormats)
{
    EXPECT_THAT(picturesOf(png() + kPgm + kPpm + kDeepPgm + png() + kPgm),
                ElementsAre(png(), kPgm, kPpm, kDeepPgm, png(), kPgm));
    EXPECT_THAT(picturesOf(""), testing::IsEmpty());
}

TEST(PictureStream, RefusesPicturesThatAreCutOffAnywhere)
{
    for (const std::string& picture : {png(), kPgm, kDeepPgm, kPpm}) {
        for (std::size_t size = 1; size < picture.size(); ++size) {
            EXPECT_THAT([&] { picturesOf(kPgm + picture.substr(0, size)); }, ThrowsMessage<Error>(HasSubstr("cut off")))
                << picture.substr(0, 2) << " " << size;
        }
    }
}

TEST(PictureStream, RefusesForeignBytes)
{
    const auto expectRefused = [](const std::string& bytes, const std::string& message) {
        EXPECT_THAT([&] { picturesOf(bytes); }, ThrowsMessage<Error>(HasSubstr(message))) << bytes;
    };
    expectRefused("GIF89a and more", "is neither PNG nor binary PGM or PPM");
    expectRefused(kPgm + "\n" + kPgm, "is neither PNG nor binary PGM or PPM");
    expectRefused("P2\n1 1\n255\n7\n", "is neither PNG nor binary PGM or PPM");
    expectRefused("P7\nWIDTH 1\nHEIGHT 1\nDEPTH 1\nMAXVAL 255\nENDHDR\na", "is PAM, which is not read");
    expectRefused("P5\n2 x\n255\nabcd", "header is damaged");
    expectRefused("P5\n2 0\n255\n", "is empty");
    expectRefused("P5\n999999999 999999999\n255\n", "more than a gigabyte");
    // A chunk that claims to have two gigabytes.
    expectRefused(png().substr(0, 8) + "\x7f\xff\xff\xff" + "IDAT", "more than a gigabyte");
}

}  // namespace
