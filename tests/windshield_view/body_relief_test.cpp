// SPDX-License-Identifier: GPL-3.0-or-later
#include "windshield_view/body_relief.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "droplet/error.h"
#include "droplet/units.h"
#include "droplet/windshield_view/glass_maps.h"
#include "windshield_view/water_optics.h"

namespace droplet {
namespace {

constexpr double kVolume = 20e-9;

ForceModel modelOf(double angle)
{
    ForceModel model;
    model.wetting.contact_angle = angle;
    return model;
}

TEST(BodyRelief, IsTheSphericalCapWithoutGravity)
{
    for (const double angle : {40.0 * kDegree, 70.0 * kDegree, 95.0 * kDegree}) {
        const CapSize cap = capOf(kVolume, angle);
        const BodyRelief relief(DropletBodies(BodyShape::Capillary, modelOf(angle)),
                                BodyConditions{kVolume, 0.0, {}, false});
        const double centre = -cap.radius * std::cos(angle);
        const double outline = centre > 0.0 ? cap.radius : cap.contact_radius;
        for (int k = 0; k < 400; ++k) {
            const double distance = outline * k / 400.0;
            const double turn = 2.4 * k;
            const Vec2 p{distance * std::cos(turn), distance * std::sin(turn)};
            const Vec2f place{static_cast<float>(p.x), static_cast<float>(p.y)};
            EXPECT_NEAR(relief.inside(place), outline - distance, 0.015 * outline);
            const BodyRelief::Point point = relief.at(place);
            const double above_centre = std::sqrt(cap.radius * cap.radius - distance * distance);
            // Where the surface is steep, a percent of the radius is up to a seventh of the height.
            EXPECT_NEAR(point.height, centre + above_centre, (k < 360 ? 0.02 : 0.15) * cap.height);
            // Between seven rings of vertices, within 1.4°.
            EXPECT_NEAR(point.normal.x, p.x / cap.radius, 1.0 / 40.0);
            EXPECT_NEAR(point.normal.y, p.y / cap.radius, 1.0 / 40.0);
        }
    }
}

TEST(BodyRelief, RaysLeaveACapAsTheyLeaveASphere)
{
    constexpr double kAngle = 70.0 * kDegree;
    const CapSize cap = capOf(kVolume, kAngle);
    const BodyRelief relief(DropletBodies(BodyShape::Capillary, modelOf(kAngle)),
                            BodyConditions{kVolume, 0.0, {}, false});
    const Capsule sphere{0.0F, static_cast<float>(cap.radius), static_cast<float>(-cap.radius * std::cos(kAngle))};
    for (int k = 0; k < 300; ++k) {
        const auto distance = static_cast<float>(0.95 * cap.contact_radius * std::sqrt(k / 300.0));
        const float turn = 2.4F * static_cast<float>(k);
        const Vec2f from{distance * std::cos(turn), distance * std::sin(turn)};
        const float slant = 0.7F * static_cast<float>(k % 10) / 10.0F;  // up to the steepest in water
        const float heading = 1.7F * static_cast<float>(k);
        const Vec3f direction{slant * std::cos(heading), slant * std::sin(heading), std::sqrt(1.0F - slant * slant)};
        const Vec3f found = relief.normalAtExit(from, direction);
        const Vec3f exact = normalAtExit(sphere, {from.x, from.y, 0.0F}, direction);
        // Within 3°: the normals of seven rings, and the exit's place.
        EXPECT_NEAR(dot(found, exact), 1.0F, 1.4e-3F) << k;
    }
}

TEST(BodyRelief, RunningDropletsHaveATailAndTheirVolume)
{
    const DropletBodies bodies(BodyShape::Capillary, modelOf(70.0 * kDegree));
    const BodyRelief relief(bodies, BodyConditions{kVolume, 0.3, {2.0, 0.0, -9.0}, false});
    constexpr int kCells = 400;
    const float width = relief.high.x - relief.low.x;
    const float height = relief.high.y - relief.low.y;
    EXPECT_GT(width, 1.2F * height);
    double volume = 0.0;
    for (int i = 0; i < kCells; ++i) {
        for (int j = 0; j < kCells; ++j) {
            const Vec2f place{relief.low.x + width * (static_cast<float>(i) + 0.5F) / kCells,
                              relief.low.y + height * (static_cast<float>(j) + 0.5F) / kCells};
            if (relief.inside(place) > 0.0F) {
                volume += static_cast<double>(relief.at(place).height);
            }
        }
    }
    volume *= static_cast<double>(width * height) / (kCells * kCells);
    EXPECT_NEAR(volume, kVolume, 0.01 * kVolume);
    // The head is wider than the tail, at equal distances from the ends.
    const auto width_at = [&](float x) {
        int cells = 0;
        for (int j = 0; j < kCells; ++j) {
            cells += relief.inside({x, relief.low.y + height * (static_cast<float>(j) + 0.5F) / kCells}) > 0.0F;
        }
        return cells;
    };
    EXPECT_GT(width_at(relief.high.x - 0.15F * width), 1.1 * width_at(relief.low.x + 0.15F * width));
}

TEST(BodyRelief, MapsHoldTheWaterOfRunningDroplets)
{
    const Glass glass;
    WindshieldState state;
    RunningDroplet droplet;
    droplet.id = 1;
    droplet.position = {0.5 * glass.width(), 0.5 * glass.height()};
    droplet.velocity = {0.1, 0.4};
    droplet.volume = kVolume;
    state.droplets.push_back(droplet);
    GlassMapOptions options;
    options.body = BodyShape::Capillary;
    const GlassFloatMaps maps = glassFloatMaps(glass, state, options);
    double sum = 0.0;
    for (const float thickness : maps.thickness.values) {
        sum += static_cast<double>(thickness);
    }
    const double pixel = glass.width() / maps.thickness.width * glass.height() / maps.thickness.height;
    EXPECT_NEAR(sum * pixel, kVolume, 1e-6 * kVolume);
    options.body = BodyShape::Springs;
    EXPECT_THROW(glassFloatMaps(glass, state, options), Error);
}

}  // namespace
}  // namespace droplet
