// SPDX-License-Identifier: GPL-3.0-or-later
// Tests that the torture detects failures.
#include "torture/trial.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>

#include "support/heights.h"
#include "support/masks.h"
#include "torture/corpus.h"

namespace droplet::torture {
namespace {

using ::testing::HasSubstr;

Mask ring()
{
    return testing::hardMask(40, 40, [](Vec2 p) {
        const double r = length(p - Vec2{20.0, 20.0});
        return r < 16.0 && r > 7.0;
    });
}

TEST(Trial, AcceptsGoodPicturesByLibraryAndCommand)
{
    const Item item = greymapItem("ring.pgm", ring());
    for (std::size_t turn = 0; turn < kFills; ++turn) {
        const Verdict verdict = tryLibrary(item, fillOf(turn));
        EXPECT_TRUE(verdict.outcome == Outcome::Droplets) << verdict.message;
        EXPECT_EQ(verdict.droplets, 1U);
        EXPECT_NEAR(static_cast<double>(verdict.triangles), 5'000.0, 500.0);
        EXPECT_GT(verdict.seconds, 0.0);
    }
    const Verdict command = tryCommand(item);
    EXPECT_TRUE(command.outcome == Outcome::Droplets) << command.message;
    EXPECT_GT(command.seconds, 0.0);
}

TEST(Trial, RecognisesRefusalsByLibraryAndCommand)
{
    const Item blank = greymapItem("blank.pgm", testing::hardMask(9, 9, [](Vec2) { return false; }));
    EXPECT_TRUE(tryLibrary(blank, {}).outcome == Outcome::Refused);
    EXPECT_THAT(tryLibrary(blank, {}).message, HasSubstr("no liquid"));
    EXPECT_TRUE(tryCommand(blank).outcome == Outcome::Refused);
    EXPECT_THAT(tryCommand(blank).message, HasSubstr("no liquid"));

    const Item no_picture{"nothing.png", {std::byte{1}, std::byte{2}}};
    EXPECT_TRUE(tryLibrary(no_picture, {}).outcome == Outcome::Refused);
    EXPECT_TRUE(tryCommand(no_picture).outcome == Outcome::Refused);
}

TEST(Trial, CallsEveryOtherErrorAFailure)
{
    Fill bottomless;
    bottomless.amount = -1.0;
    EXPECT_TRUE(tryLibrary(greymapItem("ring.pgm", ring()), bottomless).outcome == Outcome::Failed);
}

TEST(Trial, DetectsFlaws)
{
    const Mask mask = ring();
    const Droplet good = makeDroplet(mask);
    ASSERT_EQ(flawsOf(good, mask, {}), "");
    const auto flaws = [&](const std::function<void(Droplet&)>& spoil) {
        Droplet droplet = good;
        spoil(droplet);
        return flawsOf(droplet, mask, {});
    };
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_NE(flaws([](Droplet& d) { d.solution.droplets[0].vertices.back().z = kNan; }), "");
    EXPECT_NE(flaws([](Droplet& d) { d.solution.droplets[0].vertices.back().z *= -1.0; }), "");
    EXPECT_NE(flaws([](Droplet& d) { d.total.gravity_energy = kNan; }), "");
    EXPECT_NE(flaws([](Droplet& d) { d.figures[0].contact_angle.mean *= 1.001; }), "");
    EXPECT_NE(flaws([](Droplet& d) { d.total.volume *= 1.001; }), "");
    EXPECT_NE(flaws([](Droplet& d) { d.surface.triangles.pop_back(); }), "");
    EXPECT_NE(flaws([](Droplet& d) { std::swap(d.meshes[0].triangles[0][0], d.meshes[0].triangles[0][1]); }), "");
    EXPECT_NE(flaws([](Droplet& d) { ++d.outline.specks_dropped; }), "");
    EXPECT_NE(flawsOf(good, mask, fillOf(1)), "");
}

}  // namespace
}  // namespace droplet::torture
