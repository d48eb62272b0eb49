// SPDX-License-Identifier: GPL-3.0-or-later
// Frames and their reports as bytes: an interrupted sequence goes on as if nothing had happened.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "droplet/error.h"
#include "droplet/sequence/sequence.h"
#include "droplet/sequence/sequence_report.h"
#include "droplet/units.h"
#include "support/masks.h"

namespace droplet {
namespace {

using testing::disc;
using ::testing::HasSubstr;
using testing::Inside;
using testing::smoothMask;

constexpr double kPixel = 0.1 * kMillimetre;

Outline outlineOf(const Inside& inside)
{
    return trace(smoothMask(96, 64, inside), {.pixel_size = kPixel, .allow_dry = true});
}

/// Two discs that grow until they touch, then a larger one.
std::vector<Outline> outlines()
{
    std::vector<Outline> all;
    for (const double radius : {12.0, 13.0, 15.0, 18.5, 19.0}) {
        all.push_back(outlineOf([=](Vec2 p) { return disc({30, 32}, radius)(p) || disc({66, 32}, radius)(p); }));
    }
    all.push_back(outlineOf([](Vec2) { return false; }));
    all.push_back(outlineOf(disc({48, 32}, 24)));
    return all;
}

/// Height fields that keep vertices, beads that follow their rims, and one amount for all.
std::vector<SequenceOptions> kinds()
{
    SequenceOptions options;
    options.droplet.mesh.triangles = 1200;
    options.volume_mode = VolumeMode::Track;
    options.droplet.solve.model = Model::Linear;
    std::vector<SequenceOptions> all{options};
    options.volume_mode = VolumeMode::Fill;
    options.droplet.solve.model = Model::Auto;
    options.droplet.solve.fill.amount = 110.0 * kDegree;
    all.push_back(options);
    options.volume_mode = VolumeMode::Total;
    options.droplet.solve.fill = {FillBy::Volume, 4 * kMicrolitre, FillSharing::Total};
    all.push_back(options);
    return all;
}

TEST(FrameBytes, TheNextFrameIsTheSameToTheLastBit)
{
    for (const SequenceOptions& options : kinds()) {
        SCOPED_TRACE(static_cast<int>(options.volume_mode));
        std::optional<Frame> before;
        for (const Outline& outline : outlines()) {
            if (!before) {
                before = firstFrame(outline, options);
                continue;
            }
            const std::string bytes = bytesOf(*before);
            const Frame restored = frameFromBytes(bytes, "state");
            EXPECT_EQ(bytesOf(restored), bytes);
            const Frame next = nextFrame(*before, outline, options);
            const Frame same = nextFrame(restored, outline, options);
            EXPECT_EQ(bytesOf(next), bytesOf(same));
            EXPECT_EQ(next.droplet.surface.vertices, same.droplet.surface.vertices);
            EXPECT_EQ(next.droplet.surface.triangles, same.droplet.surface.triangles);
            EXPECT_EQ(next.continues, same.continues);
            EXPECT_EQ(next.vertices_kept, same.vertices_kept);
            EXPECT_EQ(next.volume_lost, same.volume_lost);
            before = next;
        }
    }
}

// Where a footprint is too narrow for the amount, the droplets of the frame before stay, and the film goes on from
// them.
TEST(FrameBytes, AFrameWithoutADropletIsHeldAlsoAfterARestart)
{
    SequenceOptions options = kinds().back();
    const auto bar = [](double half) {
        return outlineOf([=](Vec2 p) { return std::abs(p.x - 48) < 36 && std::abs(p.y - 32) < half; });
    };
    options.droplet.solve.fill.amount = 40 * kMicrolitre;
    const Frame before = firstFrame(bar(20), options);
    EXPECT_TRUE(before.held.empty());
    EXPECT_THROW(nextFrame(before, bar(1.5), options), Error);
    options.hold = true;
    const Frame held = nextFrame(frameFromBytes(bytesOf(before), "state"), bar(1.5), options);
    EXPECT_THAT(held.held, HasSubstr("no stable droplet"));
    EXPECT_TRUE(held.continues);
    EXPECT_EQ(held.vertices_kept, 1.0);
    EXPECT_EQ(held.droplet.surface.vertices, before.droplet.surface.vertices);
    EXPECT_EQ(held.droplet.surface.normals, before.droplet.surface.normals);
    EXPECT_EQ(held.droplet.surface.weld, before.droplet.surface.weld);
    const FrameReport report = reportOf(held, options);
    EXPECT_TRUE(report.held);
    EXPECT_EQ(report.total.volume, before.droplet.total.volume);
    EXPECT_EQ(report.ancestry.front().from, std::vector<std::size_t>{before.droplets.front().id});
    const Frame after = nextFrame(held, bar(20), options);
    EXPECT_TRUE(after.held.empty());
    EXPECT_TRUE(after.continues);
    EXPECT_NEAR(after.droplet.total.volume / before.droplet.total.volume, 1.0, 1e-9);
    const Frame dry = nextFrame(before, outlineOf([](Vec2) { return false; }), options);
    EXPECT_THROW(nextFrame(dry, bar(1.5), options), Error) << "there is nothing to hold";
}

TEST(FrameBytes, ReportsComeBack)
{
    const SequenceOptions options = kinds().front();
    const Frame frame = firstFrame(outlines().front(), options);
    std::vector<FrameReport> reports{reportOf(frame, options), {}};
    reports[0].input = "a picture, ä";
    reports[0].output = "out/1.glb";
    reports[0].held = true;
    reports[0].droplets[0].colour = CssColour{1, 200, 3};
    const std::string bytes = bytesOf(reports);
    const std::vector<FrameReport> same = frameReportsFromBytes(bytes, "state");
    EXPECT_EQ(bytesOf(same), bytes);
    ASSERT_EQ(same.size(), 2);
    EXPECT_EQ(same[0].input, reports[0].input);
    EXPECT_TRUE(same[0].held);
    EXPECT_FALSE(same[1].held);
    EXPECT_EQ(same[0].droplets.size(), 2);
    EXPECT_EQ(same[0].total.height_bound, reports[0].total.height_bound);
    EXPECT_EQ(same[1].output, std::nullopt);
}

TEST(FrameBytes, DamageIsRefused)
{
    const std::string bytes = bytesOf(firstFrame(outlines().front(), kinds().front()));
    const auto expect_refused = [](const std::string& damaged, const char* why) {
        try {
            (void)frameFromBytes(damaged, "the state");
            FAIL() << why;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::InvalidInput);
            EXPECT_THAT(error.what(), HasSubstr(why));
            EXPECT_THAT(error.what(), HasSubstr("the state"));
        }
    };
    expect_refused("", "is not a state of this program's version");
    expect_refused(bytesOf(std::vector<FrameReport>{}), "is not a state of this program's version");
    expect_refused(bytes + " ", "is damaged");
    for (std::size_t length = 30; length < bytes.size(); length += bytes.size() / 50) {
        expect_refused(bytes.substr(0, length), "is cut off");
    }
    // Any other value either makes a frame or is refused; it is never read beyond its bytes.
    for (std::size_t at = 24; at < bytes.size(); at += bytes.size() / 400 + 1) {
        std::string damaged = bytes;
        damaged[at] = static_cast<char>(damaged[at] ^ 0x81);
        try {
            (void)frameFromBytes(damaged, "state");
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::InvalidInput);
        }
    }
}

}  // namespace
}  // namespace droplet
