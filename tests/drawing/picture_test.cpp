// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/drawing/picture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "droplet/error.h"

namespace droplet {
namespace {

// Picture in which all pixels and all channels differ.
Picture colourful(int width, int height)
{
    Picture picture{width, height, {}};
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            picture.rgb.push_back(static_cast<std::uint8_t>(5 * x));
            picture.rgb.push_back(static_cast<std::uint8_t>(255 - 7 * y));
            picture.rgb.push_back(static_cast<std::uint8_t>(3 * x + 2 * y));
        }
    }
    return picture;
}

std::string png(const Picture& picture)
{
    std::ostringstream out;
    const std::uint64_t bytes = writePng(picture, out);
    EXPECT_EQ(bytes, out.str().size());
    return out.str();
}

std::span<const std::byte> bytesOf(const auto& text)
{
    return std::as_bytes(std::span(text.data(), text.size()));
}

cv::Mat matrixOf(const Picture& picture)
{
    cv::Mat matrix(picture.height, picture.width, CV_8UC3);
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            const auto at = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                                 static_cast<std::size_t>(x));
            matrix.at<cv::Vec3b>(y, x) = {picture.rgb[at + 2], picture.rgb[at + 1], picture.rgb[at]};
        }
    }
    return matrix;
}

TEST(PictureFile, PngIsReadByOthersPixelByPixel)
{
    for (const auto& [width, height] : {std::pair{37, 23}, {1, 1}, {1, 40}, {51, 1}}) {
        const Picture picture = colourful(width, height);
        const std::string bytes = png(picture);
        const cv::Mat seen = cv::imdecode(std::vector<char>(bytes.begin(), bytes.end()), cv::IMREAD_COLOR);
        ASSERT_EQ(seen.size(), cv::Size(width, height));
        EXPECT_EQ(cv::norm(seen, matrixOf(picture), cv::NORM_INF), 0.0);
        EXPECT_EQ(decodePicture(bytesOf(bytes)), picture);
        EXPECT_EQ(png(picture), bytes);
        EXPECT_EQ(bytes.find("tIME"), std::string::npos);
    }
}

TEST(PictureFile, LeavesAStreamFailedThatTakesNothing)
{
    std::ostringstream out;
    out.setstate(std::ios::failbit);
    writePng(colourful(8, 8), out);
    EXPECT_TRUE(out.fail());
}

TEST(PictureFile, LosslessFormatsKeepEveryColour)
{
    const Picture picture = colourful(37, 23);
    for (const char* extension : {".png", ".bmp", ".tif", ".ppm", ".webp"}) {
        std::vector<std::uint8_t> bytes;
        const std::vector<int> lossless = {cv::IMWRITE_WEBP_QUALITY, 101};
        cv::imencode(extension, matrixOf(picture), bytes, lossless);
        EXPECT_EQ(decodePicture(bytesOf(bytes)), picture) << extension;
    }
}

TEST(PictureFile, JpegsKeepTheirColours)
{
    Picture picture{32, 32, {}};
    for (int i = 0; i < 32 * 32; ++i) {
        picture.rgb.insert(picture.rgb.end(), {200, 90, 30});
    }
    std::vector<std::uint8_t> bytes;
    cv::imencode(".jpg", matrixOf(picture), bytes);
    const Picture seen = decodePicture(bytesOf(bytes));
    for (std::size_t i = 0; i < picture.rgb.size(); ++i) {
        ASSERT_NEAR(seen.rgb[i], picture.rgb[i], 3);
    }
    cv::imencode(".jpg", cv::Mat(4, 4, CV_8UC1, cv::Scalar(77)), bytes);
    EXPECT_THAT(decodePicture(bytesOf(bytes)).rgb,
                ::testing::Each(::testing::AllOf(::testing::Ge(75), ::testing::Le(79))));
}

TEST(PictureFile, SixteenBitsAreRounded)
{
    cv::Mat deep(1, 3, CV_16UC3, cv::Scalar(65535, 128 * 257, 0));
    deep.at<cv::Vec3w>(0, 1) = {129, 128, 257 * 7 - 100};
    std::vector<std::uint8_t> bytes;
    cv::imencode(".png", deep, bytes);
    EXPECT_THAT(decodePicture(bytesOf(bytes)).rgb, ::testing::ElementsAre(0, 128, 255, 7, 0, 1, 0, 128, 255));
}

TEST(PictureFile, TransparentPixelsAreWhite)
{
    cv::Mat glass(1, 3, CV_8UC4, cv::Scalar(10, 20, 30, 255));
    glass.at<cv::Vec4b>(0, 1) = {10, 20, 30, 0};
    glass.at<cv::Vec4b>(0, 2) = {0, 0, 0, 128};
    std::vector<std::uint8_t> bytes;
    cv::imencode(".png", glass, bytes);
    EXPECT_THAT(decodePicture(bytesOf(bytes)).rgb, ::testing::ElementsAre(30, 20, 10, 255, 255, 255, 127, 127, 127));
}

TEST(PictureFile, RefusesFilesThatAreNotPictures)
{
    const std::string whole = png(colourful(37, 23));
    for (const std::string& broken : {std::string(), std::string("no picture"), whole.substr(0, whole.size() / 2)}) {
        EXPECT_THROW(decodePicture(bytesOf(broken)), Error);
    }
    EXPECT_THROW(decodePicture(bytesOf(whole), 37 * 23 - 1), Error);
    EXPECT_THROW(readPicture("/nonexistent.png"), Error);
    std::ostringstream out;
    for (const Picture& wrong : {Picture{}, Picture{2, 2, {1, 2, 3}}, Picture{-1, 3, {}}, Picture{0, 4, {}}}) {
        EXPECT_THROW(writePng(wrong, out), Error);
    }
    EXPECT_EQ(out.str(), "");
}

}  // namespace
}  // namespace droplet
