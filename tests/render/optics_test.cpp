// SPDX-License-Identifier: GPL-3.0-or-later
#include "render/optics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "render/facets.h"

namespace droplet {
namespace {

constexpr float kWaterIor = 1.333F;

/// Direction toward a surface with normal +z.
Vec3f downward(float cosine)
{
    return {std::sqrt(1.0F - cosine * cosine), 0.0F, -cosine};
}

// A film of no thickness, or of the index below it, is not there.
TEST(Film, IsAsFresnelWhereThereIsNone)
{
    for (const float cosine : {1.0F, 0.7F, 0.3F, 0.05F}) {
        for (const auto& [near, far] : {std::pair{1.0F, kWaterIor}, {kWaterIor, 1.0F}}) {
            const Interface bare = atInterface(downward(cosine), {0.0F, 0.0F, 1.0F}, near / far);
            const Vec3f no_thickness = reflectedByFilm(cosine, near, far, {2.0, 0.0});
            const Vec3f of_the_same = reflectedByFilm(cosine, near, far, {kWaterIor, 380e-9});
            EXPECT_NEAR(no_thickness.x, bare.reflected, 1e-5);
            EXPECT_NEAR(no_thickness.z, bare.reflected, 1e-5);
            EXPECT_NEAR(of_the_same.y, bare.reflected, 1e-5);
        }
    }
}

// Light takes the same way in both directions (G. G. Stokes, 1849).
TEST(Film, ReflectsAsMuchFromBelow)
{
    const ThinFilm film{1.8, 250e-9};
    for (const float cosine : {1.0F, 0.7F, 0.3F}) {
        const float below = std::sqrt(1.0F - (1.0F - cosine * cosine) / (kWaterIor * kWaterIor));
        const Vec3f down = reflectedByFilm(cosine, 1.0F, kWaterIor, film);
        const Vec3f up = reflectedByFilm(below, kWaterIor, 1.0F, film);
        EXPECT_NEAR(down.x, up.x, 1e-4);
        EXPECT_NEAR(down.y, up.y, 1e-4);
        EXPECT_NEAR(down.z, up.z, 1e-4);
    }
    EXPECT_EQ(reflectedByFilm(0.3F, kWaterIor, 1.0F, film).x, 1.0F) << "beyond the critical angle";
}

// The coating of lenses: a quarter of a wave of the index between both, in the middle of the green band.
TEST(Film, OfAQuarterWaveTakesTheReflectionAway)
{
    const double index = std::sqrt(1.52);
    const Vec3f coated = reflectedByFilm(1.0F, 1.0F, 1.52F, {index, 549e-9 / (4.0 * index)});
    // At the edge of the band the wave is off by 22.5 of 549 nm: sin²(π/2 · 22.5/549) of the 0.0426 of bare glass.
    EXPECT_LT(coated.y, 1.8e-4);
    EXPECT_GT(coated.z, 4.0F * coated.y);
    EXPECT_GT(coated.x, 4.0F * coated.y);
}

TEST(Film, HasOtherColoursAtOtherAngles)
{
    const ThinFilm film{2.0, 380e-9};
    const Vec3f upright = reflectedByFilm(1.0F, 1.0F, 1.47F, film);
    const Vec3f slanted = reflectedByFilm(0.5F, 1.0F, 1.47F, film);
    EXPECT_GT(std::abs(upright.x / upright.y - slanted.x / slanted.y), 0.3F);
}

std::vector<Vec3f> facetsOf(Vec3f direction, double roughness, std::uint32_t count)
{
    std::vector<Vec3f> facets;
    for (std::uint32_t k = 0; k < count; ++k) {
        facets.push_back(facetNormal(direction, {0.0F, 0.0F, 1.0F}, roughness, facetChoice(k, 12345U)));
    }
    return facets;
}

// From above, the share of facets that are seen and tilt by less than t is tan²t / (α² + tan²t): the integral of the
// distribution of B. Walter et al. (2007), equation 33, times the cosine.
TEST(Facets, TiltAsTheirDistributionSays)
{
    constexpr std::uint32_t kCount = 4096;
    for (const double roughness : {0.2, 0.5, 1.0}) {
        const double width2 = std::pow(roughness, 4.0);
        const std::vector<Vec3f> facets = facetsOf({0.0F, 0.0F, -1.0F}, roughness, kCount);
        for (const double tilt2 : {0.1 * width2, width2, 10.0 * width2}) {
            const auto below = std::count_if(facets.begin(), facets.end(), [&](Vec3f facet) {
                return static_cast<double>(facet.x * facet.x + facet.y * facet.y) <
                       tilt2 * static_cast<double>(facet.z * facet.z);
            });
            EXPECT_NEAR(static_cast<double>(below) / kCount, tilt2 / (width2 + tilt2), 0.01) << roughness;
        }
    }
}

TEST(Facets, AreThoseThatARaySees)
{
    for (const float cosine : {1.0F, 0.5F, 0.05F}) {
        for (const Vec3f& facet : facetsOf(downward(cosine), 0.7, 256)) {
            EXPECT_GE(-dot(facet, downward(cosine)), -1e-5F);
            EXPECT_GT(facet.z, 0.0F);
            EXPECT_NEAR(dot(facet, facet), 1.0F, 1e-5F);
        }
    }
}

TEST(Facets, LieFlatOnSmoothMatter)
{
    for (const Vec3f& facet : facetsOf(downward(0.6F), 0.01, 64)) {
        EXPECT_NEAR(facet.z, 1.0F, 1e-4F);
    }
}

}  // namespace
}  // namespace droplet
