// SPDX-License-Identifier: GPL-3.0-or-later
// Tests of layers, data pictures, and pictures scaled to cover a frame.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "droplet/drawing/picture.h"
#include "droplet/error.h"

namespace droplet {
namespace {

template <typename Any>
cv::Mat decoded(const Any& picture, PngEffort effort)
{
    std::ostringstream out;
    const std::uint64_t count = writePng(picture, out, effort);
    EXPECT_EQ(count, out.str().size());
    const std::string bytes = out.str();
    return cv::imdecode(cv::Mat(1, static_cast<int>(bytes.size()), CV_8U, const_cast<char*>(bytes.data())),
                        cv::IMREAD_UNCHANGED);
}

TEST(LayerPng, AnotherReaderFindsTheSameLevels)
{
    std::mt19937 random(3);
    Layer layer{37, 11, {}};
    for (int i = 0; i < 37 * 11 * 4; ++i) {
        layer.rgba.push_back(static_cast<std::uint8_t>(random()));
    }
    DeepPicture deep{5, 7, 3, {}};
    DeepPicture grey{9, 4, 1, {}};
    for (int i = 0; i < 105; ++i) {
        deep.levels.push_back(static_cast<std::uint16_t>(random()));
    }
    for (int i = 0; i < 36; ++i) {
        grey.levels.push_back(static_cast<std::uint16_t>(random()));
    }
    for (const PngEffort effort : {PngEffort::Small, PngEffort::Fast}) {
        const cv::Mat a = decoded(layer, effort);
        ASSERT_EQ(a.type(), CV_8UC4);
        for (int y = 0; y < 11; ++y) {
            for (int x = 0; x < 37; ++x) {
                const auto pixel = a.at<cv::Vec4b>(y, x);
                const std::uint8_t* own = layer.rgba.data() + 4 * (37 * y + x);
                EXPECT_EQ(pixel, cv::Vec4b(own[2], own[1], own[0], own[3]));
            }
        }
        const cv::Mat b = decoded(deep, effort);
        ASSERT_EQ(b.type(), CV_16UC3);
        EXPECT_EQ(b.at<cv::Vec3w>(6, 2)[2], deep.levels[3 * (6 * 5 + 2)]);
        EXPECT_EQ(b.at<cv::Vec3w>(6, 2)[0], deep.levels[3 * (6 * 5 + 2) + 2]);
        const cv::Mat c = decoded(grey, effort);
        ASSERT_EQ(c.type(), CV_16UC1);
        for (int i = 0; i < 36; ++i) {
            EXPECT_EQ(c.at<std::uint16_t>(i / 9, i % 9), grey.levels[static_cast<std::size_t>(i)]);
        }
    }
}

TEST(LayerOver, MixesByAlpha)
{
    std::mt19937 random(5);
    for (int k = 0; k < 3000; ++k) {
        Layer layer{1, 1, {}};
        Picture below{1, 1, {}};
        for (int c = 0; c < 4; ++c) {
            layer.rgba.push_back(static_cast<std::uint8_t>(random()));
        }
        for (int c = 0; c < 3; ++c) {
            below.rgb.push_back(static_cast<std::uint8_t>(random()));
        }
        const Picture mixed = over(layer, below);
        for (std::size_t c = 0; c < 3; ++c) {
            const double exact = (layer.rgba[c] * layer.rgba[3] + below.rgb[c] * (255.0 - layer.rgba[3])) / 255.0;
            EXPECT_LE(std::abs(mixed.rgb[c] - exact), 0.5);
        }
    }
    EXPECT_THROW(over(Layer{1, 1, {0, 0, 0, 0}}, Picture{2, 1, {0, 0, 0, 0, 0, 0}}), Error);
    EXPECT_THROW(over(Layer{1, 1, {0, 0, 0}}, Picture{1, 1, {0, 0, 0}}), Error);
    EXPECT_THROW((DeepPicture{1, 1, 2, {0, 0}}).validate(), Error);
}

TEST(Covering, KeepsTheMiddleOfThePicture)
{
    Picture uneven{64, 36, {}};
    for (int i = 0; i < 3 * 64 * 36; ++i) {
        uneven.rgb.push_back(static_cast<std::uint8_t>(i * i % 251));
    }
    EXPECT_EQ(scaledToCover(uneven, 64, 36), uneven);
    // A plain colour does not change at any size.
    for (const auto& [w, h] : {std::pair(1, 1), std::pair(100, 3), std::pair(7, 90), std::pair(200, 150)}) {
        Picture plain{33, 21, {}};
        for (int i = 0; i < 33 * 21; ++i) {
            plain.rgb.insert(plain.rgb.end(), {200, 100, 30});
        }
        const Picture scaled = scaledToCover(plain, w, h);
        EXPECT_EQ(scaled.width, w);
        EXPECT_EQ(scaled.height, h);
        for (std::size_t i = 0; i < scaled.rgb.size(); ++i) {
            EXPECT_NEAR(scaled.rgb[i], (std::array{200, 100, 30})[i % 3], 1);
        }
    }
    // Of three stripes, a square frame keeps the middle one.
    Picture stripes{30, 10, {}};
    for (int i = 0; i < 300; ++i) {
        const int stripe = i % 30 / 10;
        for (int c = 0; c < 3; ++c) {
            stripes.rgb.push_back(c == stripe ? 255 : 0);
        }
    }
    const Picture middle = scaledToCover(stripes, 10, 10);
    for (int i = 0; i < 100; ++i) {
        EXPECT_EQ(middle.rgb[static_cast<std::size_t>(3 * i + 1)], 255);
        EXPECT_EQ(middle.rgb[static_cast<std::size_t>(3 * i)], 0);
    }
    EXPECT_THROW(scaledToCover(uneven, 0, 5), Error);
    EXPECT_THROW(scaledToCover(uneven, 5, 9000), Error);
}

// Every value is preserved exactly, whatever its size, in its channel.
TEST(FloatPicture, OpenExrHoldsItsValues)
{
    for (const int channels : {1, 3}) {
        FloatPicture picture{37, 21, channels, {}};
        for (int i = 0; i < 37 * 21 * channels; ++i) {
            picture.values.push_back((i % 2 == 0 ? 1.0F : -1.0F) *
                                     std::ldexp(1.0F + static_cast<float>(i) / 7919.0F, i % 60 - 40));
        }
        picture.values[5] = 0.0F;
        std::ostringstream out;
        const std::uint64_t count = writeExr(picture, out);
        const std::string bytes = out.str();
        EXPECT_EQ(count, bytes.size());
        const cv::Mat read = cv::imdecode(std::vector<char>(bytes.begin(), bytes.end()), cv::IMREAD_UNCHANGED);
        ASSERT_EQ(read.type(), CV_32FC(channels));
        ASSERT_EQ(read.cols, 37);
        ASSERT_EQ(read.rows, 21);
        for (int i = 0; i < 37 * 21; ++i) {
            for (int c = 0; c < channels; ++c) {
                const float value = read.ptr<float>(i / 37)[channels * (i % 37) + (channels == 3 ? 2 - c : 0)];
                EXPECT_EQ(value, picture.values[static_cast<std::size_t>(channels * i + c)]);
            }
        }
        std::ostringstream again;
        writeExr(picture, again);
        EXPECT_TRUE(again.str() == bytes) << "the same bytes";
    }
    std::ostringstream out;
    EXPECT_THROW(writeExr(FloatPicture{2, 2, 2, std::vector<float>(8)}, out), Error);
    EXPECT_THROW(writeExr(FloatPicture{2, 2, 1, {}}, out), Error);
}

}  // namespace
}  // namespace droplet
