// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/hollow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "droplet/flow/flow.h"
#include "droplet/units.h"

namespace droplet {
namespace {

constexpr double kRadius = 0.02;
constexpr double kDepth = 0.01;
constexpr std::uint32_t kAround = 48;

/// A cone with its tip below, in a plate around it that slopes down outward. A notch lowers the brim at +x.
FlowSurface cone(double notch, double plate_slope = 0.3)
{
    std::vector<Vec3> vertices{{0.0, 0.0, -kDepth}};
    std::vector<Triangle> triangles;
    for (const double out : {1.0, 3.0}) {
        for (std::uint32_t k = 0; k < kAround; ++k) {
            const double angle = 2.0 * std::numbers::pi * k / kAround;
            const double low = k == 0 ? notch : 0.0;
            vertices.push_back({out * kRadius * std::cos(angle), out * kRadius * std::sin(angle),
                                -plate_slope * (out - 1.0) * kRadius - low});
        }
    }
    for (std::uint32_t k = 0; k < kAround; ++k) {
        const std::uint32_t next = (k + 1) % kAround;
        triangles.push_back({0, 1 + k, 1 + next});
        triangles.push_back({1 + k, 1 + kAround + k, 1 + kAround + next});
        triangles.push_back({1 + k, 1 + kAround + next, 1 + next});
    }
    return flowSurface(vertices, triangles);
}

/// Volume of the cone of kAround sides, up to its brim.
double coneVolume()
{
    const double area = 0.5 * kAround * kRadius * kRadius * std::sin(2.0 * std::numbers::pi / kAround);
    return area * kDepth / 3.0;
}

std::uint32_t faceAt(const FlowTerrain& terrain, Vec3 place)
{
    return terrain.nearest(place).face;
}

constexpr Vec3 kUp{0.0, 0.0, 1.0};
constexpr Vec3 kTip{0.0, 0.0, -kDepth};

RestingLiquid liquidAt(const FlowTerrain& terrain, Vec3 place, double volume)
{
    return {faceAt(terrain, place), place, volume, 4e-3, 90.0 * kDegree, 0.0};
}

std::optional<Brim> brimOf(const FlowSurface& surface, Vec3 up, const RestingLiquid& liquid)
{
    const Hollow hollow = hollowAround(surface, up, liquid);
    EXPECT_TRUE(hollow.brim || hollow.held >= liquid.volume);
    return hollow.brim;
}

/// The outer side of an open box: its floor is the lowest ground, and walls rise around it, but on the other side.
TEST(Hollow, LiquidBelowItsGroundLiesInNone)
{
    constexpr double kHalf = 0.025;
    std::vector<Vec3> vertices;
    for (const double z : {0.0, 0.03}) {
        for (const auto& [x, y] : {std::pair{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}}) {
            vertices.push_back({kHalf * x, kHalf * y, z});
        }
    }
    std::vector<Triangle> triangles{{0, 2, 1}, {0, 3, 2}};
    for (std::uint32_t k = 0; k < 4; ++k) {
        const std::uint32_t next = (k + 1) % 4;
        triangles.push_back({k, next, 4 + next});
        triangles.push_back({k, 4 + next, 4 + k});
    }
    const FlowTerrain terrain(flowSurface(vertices, triangles));
    const RestingLiquid below{
        faceAt(terrain, {0.005, 0.003, 0.0}), {0.005, 0.003, 0.0}, 5e-9, 1.2e-3, 90.0 * kDegree, 4e-3};
    ASSERT_LT(terrain.surface().faces[below.face].normal.z, 0.0);
    EXPECT_FALSE(brimOf(terrain.surface(), kUp, below));
    EXPECT_FALSE(pondAround(terrain.surface(), kUp, below));
}

TEST(Hollow, HoldsAConesVolume)
{
    const FlowTerrain terrain(cone(0.0));
    const auto over = brimOf(terrain.surface(), kUp, liquidAt(terrain, kTip, 1.001 * coneVolume()));
    ASSERT_TRUE(over);
    EXPECT_NEAR(over->capacity / coneVolume(), 1.0, 1e-9);
    EXPECT_NEAR(std::hypot(over->place.x, over->place.y), kRadius * std::cos(std::numbers::pi / kAround), 1e-9)
        << "the middle of a level edge";
    EXPECT_NEAR(over->place.z, 0.0, 1e-12);
    EXPECT_FALSE(over->is_open);
    EXPECT_LT(over->ahead.z, 0.0) << "downward";
    EXPECT_GT(dot(over->ahead, over->place), 0.0) << "away from the tip";
    EXPECT_FALSE(brimOf(terrain.surface(), kUp, liquidAt(terrain, kTip, 0.999 * coneVolume())));
}

// So that it is not asked for at every step of rain.
TEST(Hollow, TellsWhatItHolds)
{
    const FlowTerrain terrain(cone(0.0));
    const double held = hollowAround(terrain.surface(), kUp, liquidAt(terrain, kTip, 0.9 * coneVolume())).held;
    EXPECT_NEAR(held / coneVolume(), 1.0, 1e-9);
    EXPECT_FALSE(brimOf(terrain.surface(), kUp, liquidAt(terrain, kTip, 0.999 * held)));
    EXPECT_TRUE(brimOf(terrain.surface(), kUp, liquidAt(terrain, kTip, 1.001 * held)));
}

TEST(Hollow, RunsOverAtTheLowestPlaceOfItsBrim)
{
    const FlowTerrain terrain(cone(0.004));
    const auto over = brimOf(terrain.surface(), kUp, liquidAt(terrain, kTip, coneVolume()));
    ASSERT_TRUE(over);
    EXPECT_NEAR(over->place.x, kRadius, 1e-9);
    EXPECT_NEAR(over->place.z, -0.004, 1e-9);
    // What is left of the cone's depth, cubed; the notch's own faces lean a little.
    EXPECT_NEAR(over->capacity / coneVolume(), 0.6 * 0.6 * 0.6, 0.03);
}

TEST(Hollow, SurfaceTensionHoldsMoreThanItsVolume)
{
    const FlowTerrain terrain(cone(0.0));
    RestingLiquid liquid = liquidAt(terrain, kTip, 0.0);
    liquid.puddle = 1e-3;
    const double area = 3.0 * coneVolume() / kDepth;
    liquid.volume = coneVolume() + 0.999 * area * liquid.puddle;
    EXPECT_FALSE(brimOf(terrain.surface(), kUp, liquid));
    liquid.volume = coneVolume() + 1.001 * area * liquid.puddle;
    EXPECT_TRUE(brimOf(terrain.surface(), kUp, liquid));
    liquid.puddle = 1.0;  // then it is a cap, here half a ball
    liquid.volume = coneVolume() + 0.9 * 2.0 / 3.0 * std::numbers::pi * std::pow(kRadius, 3);
    EXPECT_FALSE(brimOf(terrain.surface(), kUp, liquid));
    liquid.volume = coneVolume() + 1.1 * 2.0 / 3.0 * std::numbers::pi * std::pow(kRadius, 3);
    EXPECT_TRUE(brimOf(terrain.surface(), kUp, liquid));
}

TEST(Hollow, SlopesAndPlatesHoldWhatLiesOnThem)
{
    const FlowTerrain terrain(cone(0.0));
    EXPECT_FALSE(brimOf(terrain.surface(), kUp, liquidAt(terrain, {2.0 * kRadius, 0.0, -0.3 * kRadius}, 1.0)))
        << "on the plate's slope";
    // A puddle on a plate runs over its edge where it is nearest.
    constexpr double kHalf = 0.03;
    const FlowTerrain plate(
        flowSurface({{-kHalf, -kHalf, 0.0}, {kHalf, -kHalf, 0.0}, {kHalf, kHalf, 0.0}, {-kHalf, kHalf, 0.0}},
                    {{0, 1, 2}, {0, 2, 3}}));
    RestingLiquid puddle = liquidAt(plate, {0.02, 0.001, 0.0}, 0.0);
    puddle.puddle = 4e-3;
    const double held = 4.0 * kHalf * kHalf * puddle.puddle;
    puddle.volume = 0.999 * held;
    EXPECT_FALSE(brimOf(plate.surface(), kUp, puddle));
    puddle.volume = 1.001 * held;
    const auto over = brimOf(plate.surface(), kUp, puddle);
    ASSERT_TRUE(over);
    EXPECT_TRUE(over->is_open);
    EXPECT_NEAR(over->place.x, kHalf, 1e-12);
    EXPECT_NEAR(over->ahead.x, 1.0, 1e-9);
    EXPECT_EQ(over->capacity, 0.0);
}

TEST(Hollow, OpenEdgesAreBrims)
{
    FlowSurface surface = cone(0.0, -0.3);  // a bowl with a wide rim that ends high
    const FlowTerrain terrain(std::move(surface));
    const auto over = brimOf(terrain.surface(), kUp, liquidAt(terrain, kTip, 1.0));
    ASSERT_TRUE(over);
    EXPECT_TRUE(over->is_open);
    EXPECT_NEAR(std::hypot(over->place.x, over->place.y), 3.0 * kRadius * std::cos(std::numbers::pi / kAround), 1e-9);
    EXPECT_GT(dot(over->ahead, over->place), 0.0) << "outward";
}

TEST(Hollow, FillsAndRunsOver)
{
    const FlowTerrain terrain(cone(0.004));
    FlowParameters parameters;
    parameters.forces.wetting.contact_angle = 60.0 * kDegree;
    parameters.forces.wetting.hysteresis = 0.02;
    parameters.pinning.spread = 0.0;
    parameters.emitters = {{{0.25 * kRadius, 0.1 * kRadius, 0.03}, 1e-6, {50e-9, 0.0}}};
    FlowState state = startFlow(terrain, parameters, {});
    double largest = 0.0;
    for (int k = 1; k <= 60; ++k) {
        state = advanceFlow(std::move(state), terrain, parameters, 0.2 * k);
        for (const FlowDroplet& d : state.droplets) {
            largest = std::max(largest, d.volume);
        }
    }
    EXPECT_GT(state.counts.overflows, 0U);
    EXPECT_GT(state.counts.left, 0U) << "the plate ends";
    EXPECT_LT(std::abs(balanceOf(state).residual()), 1e-12);
    const double capacity = 0.216 * coneVolume();
    EXPECT_GT(largest, capacity);
    EXPECT_LT(balanceOf(state).still + balanceOf(state).running, 4.0 * capacity) << "12 mL came";
}

/// A trough of 120 × 16 mm, 8 mm deep, with a lower brim of 5 mm at its end +x, on a high foot.
FlowSurface trough()
{
    constexpr double kLong = 60e-3;
    constexpr double kWide = 8e-3;
    constexpr double kHigh = 8e-3;
    constexpr double kLow = 5e-3;
    std::vector<Vec3> vertices;
    for (const auto& [out, left, right] :
         {Vec3{0.0, 0.0, 0.0}, {1e-6, kHigh, kLow}, {1e-3, kHigh, kLow}, {1e-3, -kHigh, -kHigh}}) {
        for (const Vec2 side : {Vec2{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}}) {
            vertices.push_back({side.x * (kLong + out), side.y * (kWide + out), side.x < 0.0 ? left : right});
        }
    }
    std::vector<Triangle> triangles{{0, 1, 2}, {0, 2, 3}};
    for (std::uint32_t ring = 0; ring < 3; ++ring) {
        for (std::uint32_t k = 0; k < 4; ++k) {
            const std::uint32_t a = 4 * ring + k;
            const std::uint32_t b = 4 * ring + (k + 1) % 4;
            triangles.push_back({a, a + 4, b + 4});
            triangles.push_back({a, b + 4, b});
        }
    }
    return refined(flowSurface(vertices, triangles), 4e-3);
}

// Liquid that comes to both ends of a long trough is one pond: it holds no more than to its lowest brim and a puddle's
// height, from what the lip holds to all of the trough, whose side walls rise to the other end.
TEST(Hollow, HoldsItsVolumeOnceWhereverItIsFilled)
{
    const FlowTerrain terrain(trough());
    FlowParameters parameters;
    parameters.forces.wetting.contact_angle = 60.0 * kDegree;
    parameters.forces.wetting.hysteresis = 0.02;
    parameters.pinning.spread = 0.0;
    parameters.emitters = {{{-55e-3, 0.0, 0.03}, 1e-6, {50e-9, 0.0}}, {{55e-3, 0.0, 0.03}, 1e-6, {50e-9, 0.0}}};
    const double area = 120e-3 * 16e-3;
    const double puddle = 2.0 * std::sqrt(0.0728 / (998.2 * kStandardGravity)) * std::sin(30.0 * kDegree);
    const double lip = 1e-3 * 18e-3;
    const double held = area * (5e-3 + puddle) + lip * puddle;
    FlowState state = startFlow(terrain, parameters, {});
    double most = 0.0;
    for (int k = 1; k <= 60; ++k) {
        state = advanceFlow(std::move(state), terrain, parameters, 0.2 * k);
        double in = 0.0;
        for (const FlowDroplet& d : state.droplets) {
            const Vec3 p = d.leg.placeAt(state.time);
            in += d.contact != FlowContact::Air && p.z > -1e-9 && std::abs(p.x) < 60e-3 ? d.volume : 0.0;
        }
        most = std::max(most, in);
    }
    EXPECT_GT(state.counts.overflows, 0U);
    EXPECT_GT(most, 0.98 * held);
    EXPECT_LT(most, 1.03 * held) << "24 mL came";
    EXPECT_LT(std::abs(balanceOf(state).residual()), 1e-12);
}

}  // namespace
}  // namespace droplet
