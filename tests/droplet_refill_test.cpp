// SPDX-License-Identifier: GPL-3.0-or-later
//
// Surfaces that fill and drain are compared with droplets solved for that amount of liquid.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "droplet/droplet.h"
#include "droplet/error.h"
#include "droplet/units.h"
#include "support/masks.h"

namespace droplet {
namespace {

using ::testing::HasSubstr;

/// A ring and an inclined bar.
Mask sceneMask()
{
    const testing::Inside ring = [](Vec2 p) {
        const double r = length(p - Vec2{25, 25});
        return r < 20 && r > 7;
    };
    const testing::Inside bar = testing::rectangle({70, 22}, {14, 7}, 0.4);
    return testing::smoothMask(96, 50, [=](Vec2 p) { return ring(p) || bar(p); });
}

DropletOptions options(FillSharing sharing)
{
    DropletOptions result;
    result.trace.pixel_size = 0.1 * kMillimetre;
    result.mesh.triangles = 2000;
    result.solve.model = Model::Linear;
    result.solve.fill = {FillBy::Volume, 2 * kMicrolitre, sharing};
    result.fill_range = FillRange{0.0, 2.0};
    return result;
}

std::vector<DropletOptions> kinds()
{
    std::vector<DropletOptions> all{options(FillSharing::Each), options(FillSharing::Total), options(FillSharing::Each),
                                    options(FillSharing::Total), options(FillSharing::Each)};
    all[2].solve.tilt = 60 * kDegree;
    all[3].solve.ground = BaseSurface::sphere(12e-3);
    all[3].solve.tilt = 15 * kDegree;
    all[4].open = true;
    return all;
}

class DropletRefill : public ::testing::TestWithParam<DropletOptions> {};

INSTANTIATE_TEST_SUITE_P(Everywhere, DropletRefill, ::testing::ValuesIn(kinds()));

TEST_P(DropletRefill, EqualsASolvedDropletAtEveryFill)
{
    const Surface surface = makeDroplet(sceneMask(), GetParam()).surface;
    for (const double fill : {0.25, 1.0, 2.0}) {
        DropletOptions again = GetParam();
        again.solve.fill.amount *= fill;
        const Surface wanted = makeDroplet(sceneMask(), again).surface;
        const Surface found = refilled(surface, fill);
        ASSERT_EQ(found.vertices.size(), wanted.vertices.size());
        EXPECT_EQ(found.triangles, wanted.triangles);
        double place = 0.0;
        double normal = 0.0;
        for (std::size_t v = 0; v < found.vertices.size(); ++v) {
            place = std::max(place, length(found.vertices[v] - wanted.vertices[v]));
            normal = std::max(normal, length(found.normals[v] - wanted.normals[v]));
        }
        EXPECT_LT(place, 1e-11) << "at fill " << fill;  // for sizes of a millimetre and more
        EXPECT_LT(normal, 1e-6) << "at fill " << fill;
        EXPECT_NEAR(found.mean_height / wanted.mean_height, 1.0, 1e-9);
    }
}

TEST_P(DropletRefill, VolumeIsLinearInTheFillAndTheSurfaceStaysWhole)
{
    const Surface surface = makeDroplet(sceneMask(), GetParam()).surface;
    const double unit = GetParam().solve.fill.amount * (GetParam().solve.fill.sharing == FillSharing::Each ? 2.0 : 1.0);
    for (const double fill : {0.0, 0.5, 1.3, 2.0}) {
        const Surface found = refilled(surface, fill);
        EXPECT_NO_THROW(found.validate());
        EXPECT_EQ(isClosed(found), !GetParam().open);
        EXPECT_NEAR(enclosedVolume(found), fill * unit, 1e-9 * unit);
    }
}

TEST(DropletRefill, IsOptionalAndChangesNothingElse)
{
    DropletOptions without = options(FillSharing::Each);
    without.fill_range.reset();
    const Surface plain = makeDroplet(sceneMask(), without).surface;
    const Surface filled = makeDroplet(sceneMask(), options(FillSharing::Each)).surface;
    EXPECT_FALSE(plain.refill);
    ASSERT_TRUE(filled.refill);
    EXPECT_EQ(plain.vertices, filled.vertices);
    EXPECT_EQ(plain.normals, filled.normals);
}

TEST(DropletRefill, ChangesOfNormalsStayBelowOneOnThePlane)
{
    const Surface surface = makeDroplet(sceneMask(), options(FillSharing::Each)).surface;
    for (const Vec3& change : surface.refill->states.front().normals) {
        EXPECT_LT(length(change), 1.0);
    }
}

TEST(DropletRefill, IsRefusedBeforeAnythingIsSolved)
{
    const auto refusal = [](auto change) -> std::string {
        DropletOptions wrong = options(FillSharing::Each);
        change(wrong);
        std::vector<Stage> stages;
        try {
            makeDroplet(sceneMask(), wrong, [&](Stage stage, double /*share*/) { stages.push_back(stage); });
        } catch (const Error& error) {
            EXPECT_TRUE(stages.empty());
            EXPECT_EQ(error.code(), ErrorCode::InvalidArgument);
            return error.what();
        }
        return {};
    };
    EXPECT_THAT(refusal([](DropletOptions& o) { o.solve.no_penetration = true; }), HasSubstr("no_penetration"));
    EXPECT_THAT(refusal([](DropletOptions& o) { o.fill_range->max = 0.5; }), HasSubstr("fill_range"));
}

/// Droplets that are no height fields, of the same mask.
DropletOptions hangingOptions(double degrees, FillRange range)
{
    DropletOptions result = options(FillSharing::Each);
    result.solve.model = Model::Exact;
    result.mesh.triangles = 3000;
    result.solve.fill = {FillBy::ContactAngle, degrees * kDegree, FillSharing::Each};
    result.fill_range = range;
    return result;
}

TEST(DropletRefill, HasSolvedStatesWhereTheModelIsNotAffine)
{
    for (const double degrees : {35.0, 65.0}) {
        SCOPED_TRACE(degrees);
        const Droplet droplet = makeDroplet(sceneMask(), hangingOptions(degrees, {0.4, 1.5}));
        ASSERT_TRUE(droplet.surface.refill);
        const Refill& refill = *droplet.surface.refill;
        ASSERT_EQ(refill.states.size(), 4U);
        EXPECT_EQ(refill.min, 0.4);
        EXPECT_EQ(refill.max, 1.5);
        for (const double fill : {0.4, 0.5, 0.7, 1.2, 1.5}) {
            const Surface found = refilled(droplet.surface, fill);
            EXPECT_TRUE(isClosed(found));
            const bool is_state = std::any_of(refill.states.begin(), refill.states.end(),
                                              [&](const RefillState& state) { return state.fill == fill; });
            const double wanted = fill * droplet.total.volume;
            EXPECT_NEAR(enclosedVolume(found), wanted, (is_state ? 1e-9 : 1e-2) * wanted);
            DropletOptions again = hangingOptions(degrees, {});
            again.fill_range.reset();
            for (const ShapeFigures& figures : droplet.figures) {
                again.solve.volumes.push_back(fill * figures.volume);
            }
            again.solve.fill = {};
            const Droplet solved = makeDroplet(sceneMask(), again);
            double height = 0.0;
            for (const Vec3& place : found.vertices) {
                height = std::max(height, place.z);
            }
            EXPECT_NEAR(height, solved.total.height_max, 1e-2 * height) << "at fill " << fill;
        }
    }
}

TEST(DropletRefill, KeepsToTheRangeThatExists)
{
    // With more liquid the bar would touch the ring.
    try {
        makeDroplet(sceneMask(), hangingOptions(65.0, {1.0, 8.0}));
        FAIL() << "fill 8 does not exist";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::NoSuchDroplet);
        EXPECT_THAT(error.what(), HasSubstr("fills 1 to 8 do not all exist"));
    }
    const Droplet some = makeDroplet(sceneMask(), hangingOptions(65.0, {1.0, 8.0, true}));
    ASSERT_TRUE(some.surface.refill);
    EXPECT_GT(some.surface.refill->max, 1.2);
    EXPECT_LT(some.surface.refill->max, 8.0);
    EXPECT_TRUE(isClosed(refilled(some.surface, some.surface.refill->max)));
}

TEST(DropletRefill, FillsBeyondTheRangeAndDamagedOnesAreRefused)
{
    Surface surface = makeDroplet(sceneMask(), options(FillSharing::Each)).surface;
    EXPECT_THROW(refilled(surface, 2.1), Error);
    EXPECT_THROW(refilled(surface, -0.1), Error);
    Surface none = surface;
    none.refill.reset();
    EXPECT_THROW(refilled(none, 1.0), Error);
    Surface torn = surface;
    const auto copy = static_cast<std::size_t>(
        std::find_if(torn.weld.begin(), torn.weld.end(),
                     [&](const std::uint32_t& w) { return w != static_cast<std::uint32_t>(&w - torn.weld.data()); }) -
        torn.weld.begin());
    torn.refill->states.front().vertices[copy].z += 1e-6;
    EXPECT_THROW(torn.validate(), Error);
    surface.refill->states.front().normals.pop_back();
    EXPECT_THROW(surface.validate(), Error);
}

}  // namespace
}  // namespace droplet
