// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow_io/trail_section.h"

#include <gtest/gtest.h>

#include <cmath>

#include "droplet/liquid.h"

namespace droplet {
namespace {

constexpr Passage kPassage{0.0, 4e-3, 0.1};
constexpr TrailFilm kLasting{.thickness = 20e-6, .kinematic_viscosity = 1e3};

/// Mean of the liquid for each length over many places [m²], and how many of them are wet.
struct Along {
    double section = 0.0;
    double width = 0.0;
    double wet = 0.0;
};

Along along(const TrailFilm& film, double age)
{
    constexpr int kPlaces = 20'000;
    Along mean;
    for (int k = 0; k < kPlaces; ++k) {
        const TrailSection s = trailSection(film, kPassage, {0.013 * k, 0.0031 * k, 0.0}, age);
        mean.section += 4.0 / 3.0 * s.half_width * s.height / kPlaces;
        mean.width += 2.0 * s.half_width / kPlaces;
        mean.wet += s.half_width > 0.0 ? 1.0 / kPlaces : 0.0;
    }
    return mean;
}

TEST(TrailSection, BeginsAsWideAsTheDropletWithTheWholeFilm)
{
    const TrailSection s = trailSection(kLasting, kPassage, {0.3, 0.1, 0.2}, 0.0);
    EXPECT_DOUBLE_EQ(s.half_width, 2e-3);
    EXPECT_DOUBLE_EQ(s.at(0.0), 30e-6);
    EXPECT_DOUBLE_EQ(s.at(1e-3), 22.5e-6);
    EXPECT_EQ(s.at(2e-3), 0.0);
    EXPECT_EQ(s.at(3e-3), 0.0);
}

TEST(TrailSection, DrawsTogetherAndKeepsTheLiquid)
{
    // Two widths behind, it is narrow, has not broken up, and is as uneven as its widths are.
    const Along early = along(kLasting, 2.0 * kPassage.width / kPassage.speed);
    EXPECT_NEAR(early.width / kPassage.width, 0.43, 0.03);
    EXPECT_GT(early.wet, 0.99);
    EXPECT_NEAR(early.section / (20e-6 * 4e-3), 1.0, 0.05);
    const Along broken = along(kLasting, 20.0 * kPassage.width / kPassage.speed);
    EXPECT_GT(broken.wet, 0.2);
    EXPECT_LT(broken.wet, 0.5);
}

TEST(TrailSection, IsBeadsOrDriesInTheEnd)
{
    TrailFilm film = kLasting;
    film.becomes_beads = true;
    const double end = lifetime(film, kPassage);
    EXPECT_DOUBLE_EQ(end, 6.0 * kPassage.width / kPassage.speed);
    EXPECT_GT(along(film, 0.5 * end).wet, 0.5);
    EXPECT_EQ(along(film, 1.0001 * end).wet, 0.0);
    film = kLasting;
    EXPECT_TRUE(std::isinf(lifetime(film, kPassage)));
    film.drying = 3.0;
    EXPECT_EQ(lifetime(film, kPassage), 3.0);
    const Passage still{0.0, 4e-3, 0.0};
    EXPECT_NEAR(trailSection(film, still, {}, 1.5).height, 15e-6, 1e-12);
    EXPECT_EQ(trailSection(film, still, {}, 3.0).half_width, 0.0);
}

// Jeffreys (1930): h² t → ν l / g, whatever the film was, where l is ten widths.
TEST(TrailSection, DrainsAsAFilmOnAWall)
{
    const Passage still{0.0, 4e-3, 0.0};
    for (const double thickness : {20e-6, 100e-6}) {
        const TrailFilm film{.thickness = thickness, .kinematic_viscosity = 1e-6};
        const double t = 1e4;
        const double h = trailSection(film, still, {}, t).height;
        EXPECT_NEAR(h * h * t / (1e-6 * 0.04 / kStandardGravity), 1.0, 0.01);
    }
}

}  // namespace
}  // namespace droplet
