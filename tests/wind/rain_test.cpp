// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/wind/rain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "droplet/error.h"
#include "droplet/units.h"

namespace droplet {
namespace {

constexpr double kUnbounded = 1.0;  // [m]: no raindrop is that large

class Uniform {
public:
    explicit Uniform(std::uint64_t seed) : bits_(seed) {}
    double operator()() { return static_cast<double>(bits_() >> 11U) * 0x1p-53; }

private:
    std::mt19937_64 bits_;
};

/// Simpson's rule, with intervals so short that a kink affects only one of them.
template <class Function>
double integralOf(const Function& f, double from, double to)
{
    constexpr int kPieces = 10'000;
    const double h = (to - from) / kPieces;
    double sum = 0.0;
    for (int k = 0; k < kPieces; ++k) {
        const double x = from + h * k;
        sum += h / 6.0 * (f(x) + 4.0 * f(x + 0.5 * h) + f(x + h));
    }
    return sum;
}

struct Row {
    double rainfall;  // [mm/h]
    double slope;     // Λ [1/mm]
    double drops;     // raindrops in a cubic metre
    double large;     // raindrops over 1 mm in a cubic metre
    double water;     // [g/m³]
    double hits[3];   // impacts of the large ones per m² and s on a glass at 30°
};

// Values are compared to their given digits.
TEST(Rain, HasTheReferenceValues)
{
    const Row rows[] = {{1.0, 4.10, 1951, 32, 0.089, {132, 357, 582}},
                        {5.0, 2.92, 2736, 147, 0.344, {631, 1652, 2674}},
                        {25.0, 2.09, 3836, 477, 1.329, {2171, 5483, 8796}}};
    const double speeds[] = {0.0, 13.9, 27.8};
    for (const Row& row : rows) {
        SCOPED_TRACE(row.rainfall);
        const RaindropSizes sizes = raindropSizes(row.rainfall * kMillimetrePerHour);
        EXPECT_NEAR(1e-3 * sizes.slope, row.slope, 0.005);
        EXPECT_NEAR(sizes.largerThan(0.0), row.drops, 0.5);
        EXPECT_NEAR(sizes.largerThan(1e-3), row.large, 0.5);
        EXPECT_NEAR(1e6 * sizes.waterContent(), row.water, 0.0005);
        for (int k = 0; k < 3; ++k) {
            const RainImpacts impacts{sizes, {1e-4, kUnbounded}, speeds[k]};
            EXPECT_NEAR(impacts.rate(1e-3, Exposure::ofSlope(30.0 * kDegree)), row.hits[k], 0.5);
        }
    }
}

TEST(Rain, HasTheDensityOfMarshallAndPalmer)
{
    const RaindropSizes sizes = raindropSizes(kMillimetrePerHour);
    EXPECT_DOUBLE_EQ(sizes.density(0.0), 8000.0 / kMillimetre);  // per m³ and mm
    EXPECT_NEAR(sizes.density(2e-3) / sizes.density(1e-3), std::exp(-4.1), 1e-12);
    EXPECT_NEAR(integralOf([&](double d) { return sizes.density(d); }, 1e-3, 30e-3), sizes.largerThan(1e-3), 1e-6);
}

TEST(Rain, FallsAsAtlasMeasured)
{
    EXPECT_EQ(terminalSpeed(0.0), 0.0);
    EXPECT_EQ(terminalSpeed(0.1086e-3), 0.0);
    EXPECT_GT(terminalSpeed(0.1087e-3), 0.0);
    EXPECT_NEAR(terminalSpeed(1e-3), 9.65 - 10.3 * std::exp(-0.6), 1e-12);
    EXPECT_NEAR(terminalSpeed(1.0), 9.65, 1e-12);
}

TEST(Rain, HasNoRaindropsWithoutRainfall)
{
    const RainImpacts impacts{raindropSizes(0.0), {}, 20.0};
    EXPECT_EQ(impacts.bound(), 0.0);
    EXPECT_EQ(impacts.rate(1e-3, Exposure::ofSlope(0.5)), 0.0);
    EXPECT_EQ(impacts.sizes.waterContent(), 0.0);
}

// The shares of omitted water in the docstring of RaindropRange.
TEST(Rain, HasTheRainfallOfItsDensity)
{
    const RainImpacts impacts{raindropSizes(25.0 * kMillimetrePerHour), {0.5e-3, 4e-3}, 0.0};
    double sum = 0.0;
    constexpr int kSteps = 20000;
    for (int k = 0; k < kSteps; ++k) {
        const double d = 0.5e-3 + (k + 0.5) * 3.5e-3 / kSteps;
        sum += impacts.density(d, {}) * std::numbers::pi / 6.0 * d * d * d * 3.5e-3 / kSteps;
    }
    EXPECT_NEAR(impacts.rainfall(), sum, 1e-7 * sum);
}

TEST(Rain, LeavesOutLittleWater)
{
    const RaindropRange range;
    const auto lost = [&](double rainfall, double from, double to) {
        return raindropSizes(rainfall * kMillimetrePerHour).waterShare(from, to);
    };
    EXPECT_NEAR(lost(1.0, 0.0, range.min), 1.2e-3, 0.05e-3);
    EXPECT_LT(lost(25.0, 0.0, range.min), 0.2e-3);
    EXPECT_NEAR(lost(25.0, range.max, kUnbounded), 0.05e-3, 0.01e-3);
    EXPECT_NEAR(lost(100.0, range.max, kUnbounded), 1.6e-3, 0.05e-3);
}

class AnySurface : public ::testing::TestWithParam<Exposure> {};

TEST_P(AnySurface, RateIsTheIntegralOfTheDensity)
{
    const Exposure exposure = GetParam();
    for (const double speed : {0.0, 3.0, 30.0}) {
        for (const double rainfall : {0.5, 25.0}) {
            const RainImpacts impacts{raindropSizes(rainfall * kMillimetrePerHour), {0.05e-3, 7e-3}, speed};
            for (const double min : {0.0, 0.7e-3}) {
                const double from = std::max(min, impacts.range.min);
                const double sum = integralOf([&](double d) { return impacts.density(d, exposure); }, from,
                                              std::nextafter(impacts.range.max, 0.0));
                EXPECT_NEAR(impacts.rate(min, exposure), sum, 1e-6 * impacts.bound());
            }
            EXPECT_LE(impacts.rate(0.0, exposure), impacts.bound());
        }
    }
}

TEST_P(AnySurface, KeepsTheShareOfRaindropsThatMeetIt)
{
    const Exposure exposure = GetParam();
    const RainImpacts impacts{raindropSizes(5.0 * kMillimetrePerHour), {}, 12.0};
    for (double d = 0.2e-3; d < 6e-3; d += 0.3e-3) {
        const double all = impacts.sizes.density(d) * (terminalSpeed(d) + impacts.speed);
        EXPECT_NEAR(impacts.kept(d, exposure) * all, impacts.density(d, exposure), 1e-9 * all);
        EXPECT_LE(impacts.kept(d, exposure), 1.0);
    }
}

// Kolmogorov–Smirnov test: with n independent draws, the largest difference of the distribution functions exceeds
// 1.95/√n once in a thousand tests.
TEST_P(AnySurface, DrawsFromItsDensity)
{
    const Exposure exposure = GetParam();
    for (const double speed : {2.0, 25.0}) {
        const RainImpacts impacts{raindropSizes(5.0 * kMillimetrePerHour), {}, speed};
        const double all = impacts.rate(0.0, exposure);
        const RaindropSampler sampler(impacts);
        Uniform uniform(7);
        std::vector<double> drawn;
        constexpr int kTries = 20'000;
        for (int k = 0; k < kTries; ++k) {
            const double which = uniform();
            const double diameter = sampler.diameter(which, uniform());
            ASSERT_GE(diameter, impacts.range.min);
            ASSERT_LE(diameter, impacts.range.max);
            if (uniform() < impacts.kept(diameter, exposure)) {
                drawn.push_back(diameter);
            }
        }
        const double share = all / impacts.bound();
        const auto count = static_cast<double>(drawn.size());
        EXPECT_NEAR(count / kTries, share, 4.0 * std::sqrt(share * (1.0 - share) / kTries));
        if (share == 0.0) {
            continue;
        }
        std::sort(drawn.begin(), drawn.end());
        double farthest = 0.0;
        for (std::size_t k = 0; k < drawn.size(); ++k) {
            const double below = 1.0 - impacts.rate(drawn[k], exposure) / all;
            farthest = std::max(
                {farthest, below - static_cast<double>(k) / count, static_cast<double>(k + 1) / count - below});
        }
        EXPECT_LT(farthest, 1.95 / std::sqrt(count));
    }
}

INSTANTIATE_TEST_SUITE_P(Slopes, AnySurface,
                         ::testing::Values(Exposure{1.0, 0.0}, Exposure::ofSlope(30.0 * kDegree),
                                           Exposure::ofSlope(45.0 * kDegree), Exposure{0.0, 1.0}, Exposure{0.6, -0.1},
                                           Exposure{-0.2, 0.9}, Exposure{-0.7, -0.3}));

TEST(RaindropSampler, InvertsTheDistributionsOfFloorAndWall)
{
    const RainImpacts impacts{raindropSizes(10.0 * kMillimetrePerHour), {}, 10.0};
    const RaindropSampler sampler(impacts);
    const auto below = [&](double diameter, const Exposure& exposure) {
        return 1.0 - impacts.rate(diameter, exposure) / impacts.rate(0.0, exposure);
    };
    for (double u = 0.0; u < 1.0; u += 1.0 / 64.0) {
        EXPECT_NEAR(below(sampler.diameter(0.0, u), {1.0, 0.0}), u, 1e-7);
        EXPECT_NEAR(below(sampler.diameter(std::nextafter(1.0, 0.0), u), {0.0, 1.0}), u, 1e-12);
    }
    EXPECT_LE(sampler.diameter(0.0, std::nextafter(1.0, 0.0)), impacts.range.max);
}

TEST(Rain, RejectsInvalidArguments)
{
    for (const double rainfall :
         {-1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        EXPECT_THROW((void)raindropSizes(rainfall), Error);
    }
    EXPECT_THROW((RaindropRange{0.0, 1e-3}.validate()), Error);
    EXPECT_THROW((RaindropRange{2e-3, 1e-3}.validate()), Error);
    EXPECT_THROW((RaindropRange{1e-4, std::numeric_limits<double>::infinity()}.validate()), Error);
}

}  // namespace
}  // namespace droplet
