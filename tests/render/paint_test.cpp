// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/render/paint.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <tuple>

#include "droplet/error.h"
#include "droplet/units.h"
#include "support/surfaces.h"

namespace droplet {
namespace {

using testing::roundDroplet;
using testing::withContactAngles;

TEST(RoundStep, IsOneTwoOrFiveTimesAPowerOfTen)
{
    EXPECT_DOUBLE_EQ(roundStep(10.0, 10.0), 1.0);
    EXPECT_DOUBLE_EQ(roundStep(19.0, 10.0), 2.0);
    EXPECT_DOUBLE_EQ(roundStep(40.0, 10.0), 5.0);
    EXPECT_DOUBLE_EQ(roundStep(80.0, 10.0), 10.0);
    EXPECT_NEAR(roundStep(3e-4, 12.0), 2e-5, 1e-12);
    for (double span = 1e-7; span < 1e3; span *= 1.07) {
        const double parts = span / roundStep(span, 12.0);
        EXPECT_GT(parts, 7.5) << span;
        EXPECT_LT(parts, 19.0) << span;
    }
}

TEST(HeightPaint, CountsFromTheGroundInRoundSteps)
{
    for (const double height : {3.3e-6, 0.4e-3, 1.7e-3, 12e-3}) {
        const Surface surface = roundDroplet({.height = height});
        const Paint paint = heightPaint(surface);
        paint.validate(surface.vertices.size());
        for (std::size_t v = 0; v < surface.vertices.size(); ++v) {
            EXPECT_DOUBLE_EQ(paint.values[v], surface.vertices[v].z);
        }
        EXPECT_EQ(paint.low, 0.0);
        EXPECT_GE(paint.high, height * (1.0 - 1e-9));
        EXPECT_NEAR(std::remainder(paint.high, paint.line_spacing.value()), 0.0, 1e-9 * height);
        EXPECT_EQ(paint.unit, height < 1e-3 ? 1e-6 : 1e-3);
    }
}

TEST(DifferencePaint, ShowsOutsideAndInsideAlike)
{
    const Surface surface = roundDroplet();
    Surface lower = surface;
    for (Vec3& p : lower.vertices) {
        p.z -= 3e-6;
    }
    for (const auto& [one, other, sign] : {std::tuple(surface, lower, 1.0), {lower, surface, -1.0}}) {
        const Paint paint = differencePaint(one, other);
        paint.validate(one.vertices.size());
        EXPECT_NEAR(paint.values[0], sign * 3e-6, 1e-8) << "the top, or what of a facet is nearer";
        EXPECT_EQ(paint.low, -paint.high);
        EXPECT_GE(paint.high, 3e-6);
        EXPECT_LT(paint.high, 4.1e-6);
        EXPECT_EQ(paint.unit, 1e-6);
    }
    differencePaint(surface, surface).validate(surface.vertices.size());
}

TEST(ContactAnglePaint, ShowsAnglesAlongTheRimAlone)
{
    const Surface surface = withContactAngles(roundDroplet({.rings = 12, .segments = 48}));
    const Paint paint = contactAnglePaint(surface);
    paint.validate(surface.vertices.size());
    int rim = 0;
    for (std::size_t v = 0; v < surface.vertices.size(); ++v) {
        if (surface.contact_angle[v] != 0.0F) {
            EXPECT_DOUBLE_EQ(paint.values[v], static_cast<double>(surface.contact_angle[v]));
            EXPECT_EQ(paint.share[v], 1.0);
            EXPECT_LE(paint.low, paint.values[v]);
            EXPECT_GE(paint.high, paint.values[v]);
            ++rim;
        } else if (std::hypot(surface.vertices[v].x, surface.vertices[v].y) < 2e-3) {
            EXPECT_EQ(paint.share[v], 0.0);
        }
    }
    EXPECT_EQ(rim, 48);
    EXPECT_THROW(contactAnglePaint(roundDroplet()), Error);
}

TEST(ContactAnglePaint, EqualAnglesHaveASpan)
{
    Surface surface = roundDroplet();
    surface.contact_angle.assign(surface.vertices.size(), 0.0F);
    for (std::size_t v = 0; v < surface.weld.size(); ++v) {
        if (surface.weld[v] != v) {
            surface.contact_angle[surface.weld[v]] = 0.7F;
        }
    }
    contactAnglePaint(surface).validate(surface.vertices.size());
}

TEST(Paint, RefusesInvalidValues)
{
    const Surface surface = roundDroplet();
    const std::size_t n = surface.vertices.size();
    const auto refused = [&](const auto& change) {
        Paint paint = heightPaint(surface);
        change(paint);
        EXPECT_THROW(paint.validate(n), Error);
    };
    refused([](Paint& p) { p.values.pop_back(); });
    refused([](Paint& p) { p.values[1] = std::numeric_limits<double>::infinity(); });
    refused([](Paint& p) { p.share = {1.0}; });
    refused([n](Paint& p) { p.share.assign(n, 1.5); });
    refused([](Paint& p) { p.scale.resize(1); });
    refused([](Paint& p) { p.scale[0].x = 1.1; });
    refused([](Paint& p) { p.high = p.low; });
    refused([](Paint& p) { p.unit = 0.0; });
    refused([](Paint& p) { p.line_spacing = 0.0; });
}

}  // namespace
}  // namespace droplet
