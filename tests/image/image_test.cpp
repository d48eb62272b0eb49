// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/image.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace droplet {
namespace {

/// Stores every pixel of a run separately.
template <class Sample>
Image putOneByOne(const Image& blank, const PixelRun& run, const std::vector<Sample>& samples)
{
    Image image = blank;
    const auto channels = static_cast<std::size_t>(run.channels);
    for (std::size_t i = 0; i * channels < samples.size(); ++i) {
        putPixels(image, {run.first + i * run.step, 1, run.channels},
                  std::span<const Sample>(samples.data() + i * channels, channels));
    }
    return image;
}

template <class Sample>
class ImageOf : public ::testing::Test {
};
using Samples = ::testing::Types<std::uint8_t, std::uint16_t>;
TYPED_TEST_SUITE(ImageOf, Samples);

// Runs of one colour are converted once. The check for one colour must not miss another pixel, wherever in the run and
// in whichever channel it differs.
TYPED_TEST(ImageOf, RunsAreStoredLikeSinglePixels)
{
    for (const int channels : {1, 2, 3, 4}) {
        for (const std::size_t pixels : {1U, 2U, 63U, 64U, 65U, 128U, 130U}) {
            for (const std::size_t step : {1U, 2U}) {
                const Image blank = blankImage({ImageFormat::Png, 300, 1}, channels % 2 == 0);
                const PixelRun run{3, step, channels};
                const std::size_t count = pixels * static_cast<std::size_t>(channels);
                for (std::size_t odd = 0; odd < count; ++odd) {
                    std::vector<TypeParam> samples(count, TypeParam{200});
                    samples[odd] = TypeParam{100};
                    Image image = blank;
                    putPixels(image, run, std::span<const TypeParam>(samples));
                    const Image expected = putOneByOne(blank, run, samples);
                    ASSERT_EQ(image.luma, expected.luma) << channels << " channels, sample " << odd << " of " << count;
                    ASSERT_EQ(image.alpha, expected.alpha) << channels << " channels, sample " << odd;
                    ASSERT_NE(image.luma[3], blank.luma[3]);
                }
            }
        }
    }
}

}  // namespace
}  // namespace droplet
