// SPDX-License-Identifier: GPL-3.0-or-later
// Tests of reading files as masks: paths, pipes, unreadable files, rotated photographs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <thread>

#include "image/encoded_images.h"

namespace droplet {
namespace {

using namespace encoded;
using testing::AllOf;
using testing::HasSubstr;

/// Upright place of the stored pixel (x, y) of a w × h image, by the table of EXIF 2.32, tag 0112.
std::pair<int, int> seenAt(int orientation, int x, int y, int w, int h)
{
    switch (orientation) {
        case 2:
            return {w - 1 - x, y};
        case 3:
            return {w - 1 - x, h - 1 - y};
        case 4:
            return {x, h - 1 - y};
        case 5:
            return {y, x};
        case 6:
            return {h - 1 - y, x};
        case 7:
            return {h - 1 - y, w - 1 - x};
        case 8:
            return {y, w - 1 - x};
        default:
            return {x, y};
    }
}

void expectSeen(const Mask& stored, const Mask& seen, int orientation)
{
    const bool turned = orientation >= 5 && orientation <= 8;
    ASSERT_EQ(seen.width, turned ? stored.height : stored.width);
    ASSERT_EQ(seen.height, turned ? stored.width : stored.height);
    for (int y = 0; y < stored.height; ++y) {
        for (int x = 0; x < stored.width; ++x) {
            const auto [u, v] = seenAt(orientation, x, y, stored.width, stored.height);
            ASSERT_EQ(seen.at(u, v), stored.at(x, y)) << orientation << ": " << x << ", " << y;
        }
    }
}

TEST(Orientation, PhotographsComeUprightInEveryFormat)
{
    const Bytes jpeg = encodeJpeg(fields(3, 3, 2));
    const Bytes webp = encodeWebp(noise(3, 8));
    const Bytes png = encodePng(noise(2, 16), {PNG_COLOR_TYPE_GRAY_ALPHA, false, {}, {}, nullptr});
    constexpr std::size_t kAfterPngHeader = 8 + 25;
    for (int orientation = 1; orientation <= 8; ++orientation) {
        for (const std::endian order : {std::endian::little, std::endian::big}) {
            const Bytes exif = exifBlock(orientation, order);
            for (const Channel channel : {Channel::Luma, Channel::Alpha}) {
                const Bytes turned = inserted(png, kAfterPngHeader, pngChunk("eXIf", exif));
                expectSeen(decodeMask(png, only(channel)), decodeMask(turned, only(channel)), orientation);
            }
            expectSeen(decodeMask(jpeg, only(Channel::Luma)), decodeMask(jpegWithExif(jpeg, exif), only(Channel::Luma)),
                       orientation);
            expectSeen(decodeMask(webp, only(Channel::Luma)),
                       decodeMask(webpWithExif(webp, 13, 7, exif), only(Channel::Luma)), orientation);
        }
        TiffKind kind;
        const Raster raster = noise(1, 8, 150, 70);  // larger than a tile of the rotation
        const Mask stored = decodeMask(encodeTiff(raster, kind), only(Channel::Luma));
        kind.orientation = static_cast<std::uint16_t>(orientation);
        expectSeen(stored, decodeMask(encodeTiff(raster, kind), only(Channel::Luma)), orientation);
    }
}

TEST(Orientation, InvalidValuesAreIgnored)
{
    const Bytes jpeg = encodeJpeg(fields(1, 3, 2));
    const Mask stored = decodeMask(jpeg, only(Channel::Luma));
    for (const Bytes& block : {exifBlock(0, std::endian::big), exifBlock(9, std::endian::little), bytesOf("II"),
                               bytesOf("Hello there"), Bytes()}) {
        expectSeen(stored, decodeMask(jpegWithExif(jpeg, block), only(Channel::Luma)), 1);
    }
}

TEST(ReadMask, FileGivesTheSameMaskAsItsBytes)
{
    const Folder folder;
    const Bytes png = encodePng(noise(1, 16), {});
    writeFile(folder / "mask.png", png);
    const Mask mask = readMask(folder / "mask.png");
    EXPECT_EQ(mask.coverage, decodeMask(png).coverage);
    // Larger than one piece of reading
    const Raster large = noise(1, 16, 1500, 900);
    writeFile(folder / "wrong.name", encodeWithOpenCv(large, ".pgm"));
    EXPECT_EQ(readMask(folder / "wrong.name", only(Channel::Luma)).at(1499, 899), large.at(1499, 899, 0));
}

TEST(ReadMask, PipeIsReadToItsEnd)
{
    const Folder folder;
    const std::filesystem::path pipe = folder / "pipe";
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    const Raster large = noise(1, 16, 1500, 900);
    const Bytes pgm = encodeWithOpenCv(large, ".pgm");
    std::thread writer([&] { writeFile(pipe, pgm); });
    const Mask mask = readMask(pipe, only(Channel::Luma));
    writer.join();
    EXPECT_EQ(mask.coverage, decodeMask(pgm, only(Channel::Luma)).coverage);
}

TEST(ReadMask, EndlessDeviceIsRejectedByItsFirstBytes)
{
    EXPECT_THAT(messageOf([] { readMask("/dev/zero"); }), AllOf(HasSubstr("/dev/zero"), HasSubstr("not an image")));
}

TEST(ReadMask, ErrorsNameThePathAndTheReason)
{
    const Folder folder;
    const auto message = [](const std::filesystem::path& path) { return messageOf([&] { readMask(path); }); };
    EXPECT_THAT(message(folder / "missing.png"), AllOf(HasSubstr("missing.png"), HasSubstr("No such file")));
    EXPECT_THAT(message(""), HasSubstr("No such file"));
    EXPECT_THAT(message(folder / ""), HasSubstr("Is a directory"));
    EXPECT_THAT(message(folder / "missing.png/x"), HasSubstr("No such file"));
    EXPECT_THAT(message(folder / "two\nlines"), HasSubstr(R"(two\nlines)"));
    EXPECT_THAT(message("/proc/self/mem"), HasSubstr("/proc/self/mem: Input/output error"));

    writeFile(folder / "empty.png", {});
    EXPECT_THAT(message(folder / "empty.png"), AllOf(HasSubstr("empty.png"), HasSubstr("empty")));
    writeFile(folder / "text.png", bytesOf("Dear reader,\nthis is no image.\n"));
    EXPECT_THAT(message(folder / "text.png"),
                AllOf(HasSubstr("text.png"),
                      HasSubstr("not an image this program reads (PNG, JPEG, SVG, BMP, GIF, ICO, TGA, TIFF, "
                                "WebP, PBM/PGM/PPM, JPEG 2000, OpenEXR, Radiance HDR)")));
    Bytes cut = encodePng(noise(1, 8), {});
    cut.resize(cut.size() - 20);
    writeFile(folder / "cut.png", cut);
    EXPECT_THAT(message(folder / "cut.png"), AllOf(HasSubstr("cut.png"), HasSubstr("truncated")));
}

TEST(ReadMask, FileWithoutPermissionIsNamed)
{
    const Folder folder;
    const std::filesystem::path path = folder / "secret.png";
    writeFile(path, encodePng(noise(1, 8), {}));
    std::filesystem::permissions(path, std::filesystem::perms::none);
    // The superuser may read every file.
    constexpr uid_t kNobody = 65534;
    const uid_t user = geteuid();
    if (user == 0) {
        ASSERT_EQ(seteuid(kNobody), 0);
    }
    const std::string message = messageOf([&] { readMask(path); });
    if (user == 0) {
        ASSERT_EQ(seteuid(0), 0);
    }
    EXPECT_THAT(message, AllOf(HasSubstr("secret.png"), HasSubstr("Permission denied")));
}

}  // namespace
}  // namespace droplet
