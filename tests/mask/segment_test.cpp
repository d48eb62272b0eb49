// SPDX-License-Identifier: GPL-3.0-or-later
// Tests of masks from synthetic photographs with known masks, and of pictures that are not masks.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <opencv2/core.hpp>
#include <ostream>

#include "droplet/domain/domain.h"
#include "droplet/units.h"
#include "image/encoded_images.h"
#include "support/paths.h"
#include "support/photographs.h"

namespace droplet {
namespace {

using namespace encoded;
using ::testing::HasSubstr;
using testing::Photograph;

/// Size of a picture.
struct Size {
    int width = 0;
    int height = 0;
};

using Painter = std::function<std::array<double, 3>(Vec2)>;

Raster painted(Size size, const Painter& colour)
{
    Raster raster{size.width, size.height, 3, 8, {}};
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            for (const double level : colour({(x + 0.5) / size.width, (y + 0.5) / size.height})) {
                raster.samples.push_back(static_cast<unsigned>(std::lround(255.0 * std::clamp(level, 0.0, 1.0))));
            }
        }
    }
    return raster;
}

Raster rasterOf(const Photograph& photograph)
{
    Raster raster{photograph.width, photograph.height, 3, 8, {}};
    for (const auto& pixel : photograph.rgb) {
        for (const double level : pixel) {
            raster.samples.push_back(static_cast<unsigned>(std::lround(255.0 * level)));
        }
    }
    return raster;
}

Bytes png(const Raster& raster)
{
    return encodePng(raster, {PNG_COLOR_TYPE_RGB, false, {}, {}, nullptr});
}

MaskOptions by(Segmentation segment)
{
    MaskOptions options;
    options.segment = segment;
    return options;
}

struct Shot {
    const char* name;
    testing::Light light;
    double noise = 0.004;
    double salt = 0.0;
    int jpeg_quality = 0;  ///< 0: PNG

    friend void PrintTo(const Shot& shot, std::ostream* out) { *out << shot.name; }
};

Bytes taken(const Photograph& photograph, const Shot& shot)
{
    const Raster raster = rasterOf(photograph);
    return shot.jpeg_quality > 0 ? encodeJpeg(raster, {false, true, shot.jpeg_quality, {}}) : png(raster);
}

/// Compares a mask with the truth. The picture is 20 mm wide; glints have up to 0.6 mm².
void expectTrue(const Mask& mask, const Photograph& truth)
{
    TraceOptions options;
    options.clean.fill_holes = 1e-6;
    const Outline outline = trace(mask, options);
    const Domain domain = split(outline);
    double covered = 0.0;
    std::size_t holes = 0;
    for (const Footprint& footprint : domain.droplets) {
        covered += area(footprint) / (outline.pixel_size * outline.pixel_size);
        holes += footprint.holes.size();
    }
    EXPECT_EQ(domain.droplets.size(), truth.droplets);
    EXPECT_EQ(holes, truth.holes);
    EXPECT_NEAR(covered / truth.area, 1.0, 0.02);
}

class PhotographTest : public ::testing::TestWithParam<Shot> {};

constexpr double kSide = 480.0;

TEST_P(PhotographTest, OfInkHasItsTrueMask)
{
    const Photograph photograph =
        testing::photograph(testing::inkSpill(kSide), GetParam().light, GetParam().noise, GetParam().salt);
    const Mask mask = decodeMask(taken(photograph, GetParam()));
    EXPECT_TRUE(mask.inverted);
    EXPECT_GT(mask.segment_confidence, 0.5);
    expectTrue(mask, photograph);
}

TEST_P(PhotographTest, OfClearDropletsHasItsTrueMask)
{
    const Photograph photograph =
        testing::photograph(testing::clearDroplets(kSide), GetParam().light, GetParam().noise, GetParam().salt);
    const Mask mask = decodeMask(taken(photograph, GetParam()));
    EXPECT_GT(mask.segment_confidence, 0.5);
    expectTrue(mask, photograph);
}

INSTANTIATE_TEST_SUITE_P(Lights, PhotographTest,
                         ::testing::Values(Shot{"Even", testing::evenLight()},
                                           Shot{"Gradient", testing::gradientLight()},
                                           Shot{"VignetteAndNoise", testing::vignette(), 0.04},
                                           Shot{"SoftShadow", testing::shadowLight(), 0.01},
                                           Shot{"ColouredLampJpeg", testing::lampLight(), 0.01, 0.0, 40},
                                           Shot{"ColouredLampSaltAndPepper", testing::lampLight(), 0.004, 0.02}),
                         [](const auto& shot) { return shot.param.name; });

TEST(Segment, InkInUnevenLightIsReadAdaptively)
{
    const Photograph photograph = testing::photograph(testing::inkSpill(kSide), testing::lampLight());
    const Bytes picture = png(rasterOf(photograph));
    EXPECT_EQ(decodeMask(picture).segment, Segmentation::Adaptive);
    // With one threshold, the lit or the dark paper counts as liquid.
    const Mask poor = decodeMask(picture, by(Segmentation::Threshold));
    double covered = 0.0;
    for (const std::uint16_t level : poor.coverage) {
        covered += level / 65535.0;
    }
    EXPECT_GT(std::abs(covered / photograph.area - 1.0), 0.2);
}

TEST(Segment, CleanMasksAreReadByThreshold)
{
    for (const char* name : {"ampersand.png", "butterfly.jpg", "cluster.png", "handprint.jpg", "inkscape.png",
                             "letter_g_1bit.png", "ornament.png", "raindrops.png", "sakura.tif", "deer.bmp"}) {
        const std::string path = testing::inSource("data/") + name;
        const Mask decided = readMask(path);
        EXPECT_EQ(decided.segment, Segmentation::Threshold) << name;
        EXPECT_GT(decided.segment_confidence, 0.9) << name;
        EXPECT_TRUE(decided.coverage == readMask(path, by(Segmentation::Threshold)).coverage) << name;
    }
}

TEST(Segment, BlurredMaskIsAccepted)
{
    const Raster soft = painted({300, 200}, [](Vec2 p) {
        const double level = std::clamp(0.5 + 12.0 * (length(p - Vec2{0.5, 0.5}) - 0.3), 0.0, 1.0);
        return std::array{level, level, level};
    });
    EXPECT_EQ(decodeMask(png(soft)).coverage, decodeMask(png(soft), by(Segmentation::Threshold)).coverage);
}

TEST(Segment, InvertExchangesLiquidAndDryToTheBit)
{
    const Bytes picture = png(rasterOf(testing::photograph(testing::inkSpill(240.0), testing::lampLight())));
    MaskOptions options = by(Segmentation::Adaptive);
    const Mask mask = decodeMask(picture, options);
    options.invert = true;
    const Mask inverted = decodeMask(picture, options);
    for (std::size_t i = 0; i < mask.coverage.size(); ++i) {
        ASSERT_EQ(mask.coverage[i] + inverted.coverage[i], 65535);
    }
    EXPECT_NE(mask.inverted, inverted.inverted);
}

TEST(Segment, GrabCutSeparatesColoursAndIsRepeatable)
{
    testing::Scene scene = testing::inkSpill(320.0);
    scene.look = [](Vec2, double) { return std::array{0.9, 0.55, 0.2}; };
    const Photograph photograph = testing::photograph(scene, testing::gradientLight(), 0.01);
    const Bytes picture = png(rasterOf(photograph));
    Mask first;
    {
        const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
        first = decodeMask(picture, by(Segmentation::GrabCut));
    }
    expectTrue(first, photograph);
    EXPECT_EQ(first.segment, Segmentation::GrabCut);
    cv::theRNG().state = 99;
    const Mask second = decodeMask(picture, by(Segmentation::GrabCut));
    EXPECT_TRUE(first.coverage == second.coverage);
    EXPECT_EQ(cv::theRNG().state, 99U) << "OpenCV's random state must not change";
}

/// Value noise of several octaves, from 0 to 1.
double clouds(Vec2 p, double roughness)
{
    const auto corner = [](int i, int j, int k) {
        auto z = static_cast<std::uint32_t>(i) * 374761393U + static_cast<std::uint32_t>(j) * 668265263U +
                 static_cast<std::uint32_t>(k) * 2246822519U;
        z = (z ^ (z >> 13U)) * 1274126177U;
        return static_cast<double>((z ^ (z >> 16U)) & 0xffffU) / 65535.0;
    };
    double sum = 0.0;
    double weight = 0.0;
    double share = 1.0;
    for (int k = 1; k < 8; ++k, share *= roughness) {
        const Vec2 q = static_cast<double>(1 << k) * p;
        const int i = static_cast<int>(std::floor(q.x));
        const int j = static_cast<int>(std::floor(q.y));
        const auto smoothstep = [](double t) { return t * t * (3.0 - 2.0 * t); };
        const double u = smoothstep(q.x - i);
        const double v = smoothstep(q.y - j);
        sum += share * ((1 - u) * ((1 - v) * corner(i, j, k) + v * corner(i, j + 1, k)) +
                        u * ((1 - v) * corner(i + 1, j, k) + v * corner(i + 1, j + 1, k)));
        weight += share;
    }
    return sum / weight;
}

/// Head and shoulders in light from the left, in front of a wall.
std::array<double, 3> portrait(Vec2 p)
{
    const double grain = clouds({10.0 * p.x, 13.0 * p.y}, 0.7);
    const auto within = [&](Vec2 centre, Vec2 half) {
        const Vec2 d = p - centre;
        return d.x * d.x / (half.x * half.x) + d.y * d.y / (half.y * half.y);
    };
    const double face = within({0.5, 0.43}, {0.18, 0.23});
    if (face < 1.0) {
        const bool in_eye = within({0.42, 0.4}, {0.025, 0.02}) < 1.0 || within({0.58, 0.4}, {0.025, 0.02}) < 1.0;
        const double level = (0.75 + 1.5 * (0.5 - p.x) - 0.25 * face) * (in_eye ? 0.3 : 1.0);
        return {level, 0.78 * level, 0.66 * level};
    }
    if (within({0.5, 0.38}, {0.24, 0.27}) < 1.0) {
        const double level = 0.12 + 0.25 * grain;
        return {level, 0.8 * level, 0.6 * level};
    }
    if (within({0.5, 1.05}, {0.42, 0.35}) < 1.0) {
        const double level = 0.25 + 0.3 * grain + 0.15 * (p.x - 0.5);
        return {0.6 * level, 0.7 * level, level};
    }
    const double wall = 0.45 + 0.35 * p.x + 0.1 * (p.y - 0.5) + 0.03 * grain;
    return {0.9 * wall, 0.95 * wall, wall};
}

struct NoMask {
    const char* name;
    Size size;
    Painter colour;

    friend void PrintTo(const NoMask& picture, std::ostream* out) { *out << picture.name; }
};

class NoMaskTest : public ::testing::TestWithParam<NoMask> {};

TEST_P(NoMaskTest, IsRejectedUnlessInsistIsSet)
{
    const Bytes picture = png(painted(GetParam().size, GetParam().colour));
    EXPECT_THAT(messageOf(picture),
                ::testing::AllOf(HasSubstr("does not look like a footprint"), HasSubstr("segmentation method")));
    MaskOptions options;
    options.accept_any = true;
    EXPECT_LT(decodeMask(picture, options).segment_confidence, 0.3);
    EXPECT_NO_THROW(decodeMask(picture, by(Segmentation::Threshold)));
}

INSTANTIATE_TEST_SUITE_P(
    Pictures, NoMaskTest,
    ::testing::Values(NoMask{"Glow",
                             {400, 300},
                             [](Vec2 p) {
                                 const double r = length(p - Vec2{0.5, 0.4});
                                 return std::array{1.0 - r, 0.8 - r, 0.6 - 0.5 * r};
                             }},
                      NoMask{"Sky",
                             {400, 300},
                             [](Vec2 p) {
                                 const double level = 0.5 + 1.6 * (clouds({1.3 * p.x, p.y}, 0.5) - 0.5);
                                 return std::array{0.8 * level + 0.2, 0.9 * level + 0.1, 0.5 + 0.5 * level};
                             }},
                      NoMask{"Leaves",
                             {400, 300},
                             [](Vec2 p) {
                                 const double level = 0.5 + 2.2 * (clouds({6.0 * p.x, 5.0 * p.y}, 0.8) - 0.5);
                                 return std::array{0.6 * level, level, 0.4 * level};
                             }},
                      NoMask{"Portrait", {300, 400}, portrait}),
    [](const auto& picture) { return picture.param.name; });

TEST(Segment, PhotographOfALeafWithRainIsRejected)
{
    EXPECT_THAT(messageOf([] { readMask(testing::inSource("data/raindrops.jpg")); }),
                HasSubstr("does not look like a footprint"));
}

TEST(Segment, FlatAndTinyPicturesHoldNoLiquid)
{
    for (const Segmentation segment : {Segmentation::Adaptive, Segmentation::GrabCut}) {
        for (const Size size : {Size{1, 1}, Size{3, 1}, Size{1, 9}, Size{5, 4}, Size{40, 30}}) {
            const Bytes flat = png(painted(size, [](Vec2) { return std::array{0.7, 0.7, 0.7}; }));
            EXPECT_THAT(messageOf(flat, by(segment)), HasSubstr("no edge")) << size.width;
            const Bytes half = png(painted(size, [](Vec2 p) {
                const double level = p.x < 0.5 ? 0.1 : 0.9;
                return std::array{level, level, level};
            }));
            try {
                decodeMask(half, by(segment)).validate();
            } catch (const Error& error) {
                EXPECT_EQ(error.code(), ErrorCode::InvalidInput);
            }
        }
    }
}

TEST(Segment, PictureWithoutAnEdgeMayGiveADryFrame)
{
    const Bytes paper = png(painted({200, 150}, [](Vec2 p) {
        const double level = 0.95 - 0.6 * p.x;
        return std::array{level, level, level};
    }));
    EXPECT_THAT(messageOf(paper), HasSubstr("does not look like a footprint"));
    for (const Segmentation segment : {Segmentation::Auto, Segmentation::Adaptive, Segmentation::GrabCut}) {
        for (const bool invert : {false, true}) {
            MaskOptions options = by(segment);
            options.allow_dry = true;
            options.invert = invert;
            const Mask mask = decodeMask(paper, options);
            mask.validate();
            EXPECT_THAT(mask.coverage, ::testing::Each(invert ? 65535 : 0));
            EXPECT_FALSE(mask.found);
        }
    }
}

}  // namespace
}  // namespace droplet
