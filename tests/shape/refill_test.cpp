// SPDX-License-Identifier: GPL-3.0-or-later
//
// Gains per fill are compared with solutions for that amount of liquid.
#include "droplet/shape/refill.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "droplet/error.h"
#include "droplet/mesh/triangulate.h"
#include "droplet/shape/figures.h"
#include "droplet/units.h"
#include "shape/recovered_normals.h"
#include "support/grounded.h"
#include "support/heights.h"
#include "support/masks.h"

namespace droplet {
namespace {

using ::testing::HasSubstr;
using testing::heightsOf;
using testing::volumeOf;

/// Three droplets of different sizes, one with a hole.
std::vector<PlanarMesh> meshes()
{
    const testing::Inside ring = [](Vec2 p) {
        const double r = length(p - Vec2{25, 25});
        return r < 20 && r > 7;
    };
    const testing::Inside bar = testing::rectangle({70, 20}, {14, 7}, 0.4);
    const testing::Inside small = testing::disc({70, 50}, 9);
    const Mask mask = testing::smoothMask(96, 64, [=](Vec2 p) { return ring(p) || bar(p) || small(p); });
    return triangulate(split(trace(mask, {.pixel_size = 0.1 * kMillimetre})), {.triangles = 3000, .edge = {}});
}

struct Case {
    std::string name;
    SolveOptions options;
};

void PrintTo(const Case& run, std::ostream* out)
{
    *out << run.name;
}

std::vector<Case> cases()
{
    std::vector<Case> all;
    const auto add = [&](const std::string& name, FillBy by, double amount, auto change) {
        for (const FillSharing sharing : {FillSharing::Each, FillSharing::Total}) {
            SolveOptions options;
            options.fill = {by, amount, sharing};
            change(options);
            all.push_back({name + (sharing == FillSharing::Each ? "Each" : "Total"), options});
        }
    };
    add("LevelByAngle", FillBy::ContactAngle, 35 * kDegree, [](SolveOptions&) {});
    add("WeightlessByHeight", FillBy::Height, 0.4e-3, [](SolveOptions& o) { o.gravity = 0.0; });
    add("TiltedByAngle", FillBy::ContactAngle, 35 * kDegree, [](SolveOptions& o) { o.tilt = 50 * kDegree; });
    add("HangingByVolume", FillBy::Volume, 2 * kMicrolitre, [](SolveOptions& o) { o.tilt = 160 * kDegree; });
    add("OnASphere", FillBy::Volume, 2 * kMicrolitre, [](SolveOptions& o) { o.ground = BaseSurface::sphere(20e-3); });
    add("InATiltedGutter", FillBy::Volume, 3 * kMicrolitre, [](SolveOptions& o) {
        o.ground = BaseSurface::cylinder(-15e-3, 0.3);
        o.tilt = 20 * kDegree;
        o.solver = Solver::Llt;
    });
    return all;
}

class Refill : public ::testing::TestWithParam<Case> {};

INSTANTIATE_TEST_SUITE_P(Everywhere, Refill, ::testing::ValuesIn(cases()),
                         [](const auto& run) { return run.param.name; });

double largest(const std::vector<double>& values)
{
    double max = 0.0;
    for (const double value : values) {
        max = std::max(max, std::abs(value));
    }
    return max;
}

TEST_P(Refill, EqualsASolutionForThatFill)
{
    const SolveOptions& options = GetParam().options;
    const std::vector<PlanarMesh> footprints = meshes();
    const Solution solution = solve(footprints, options);
    ASSERT_TRUE(solution.report.usable());
    const std::vector<FillGain> gains = gainsPerFill(footprints, solution.droplets, options);
    ASSERT_EQ(gains.size(), footprints.size());

    std::vector<double> volumes;
    double total = 0.0;
    for (std::size_t k = 0; k < footprints.size(); ++k) {
        volumes.push_back(measure(solution.droplets[k], options).volume);
        total += volumes.back();
    }
    const bool shared = options.fill.sharing == FillSharing::Total;
    for (const double fill : {0.3, 1.0, 1.9}) {
        SCOPED_TRACE(fill);
        SolveOptions again = options;
        again.fill.by = FillBy::Volume;
        again.fill.amount = fill * total;
        const Solution together = shared ? solve(footprints, again) : Solution{};
        for (std::size_t k = 0; k < footprints.size(); ++k) {
            again.fill.amount = fill * volumes[k];
            const CapillarySurface wanted =
                shared ? together.droplets[k] : solve({footprints[k]}, again).droplets.at(0);
            const CapillarySurface& field = solution.droplets[k];
            const double height = largest(heightsOf(wanted));
            for (std::size_t v = 0; v < wanted.vertices.size(); ++v) {
                ASSERT_NEAR(field.vertices[v].z + (fill - 1) * gains[k].height[v], wanted.vertices[v].z, 1e-8 * height);
            }
            const std::vector<double> slopes = rimSlopes(field, options.ground);
            const std::vector<double> wanted_slopes = rimSlopes(wanted, options.ground);
            const double slope = largest(wanted_slopes);
            for (std::size_t v = 0; v < slopes.size(); ++v) {
                ASSERT_NEAR(slopes[v] + (fill - 1) * gains[k].rim_slope[v], wanted_slopes[v], 1e-7 * slope);
            }
            EXPECT_NEAR(field.pressure + (fill - 1) * gains[k].pressure, wanted.pressure,
                        1e-7 * std::abs(wanted.pressure));
        }
    }
}

TEST_P(Refill, GainHasTheVolumeOfOneFillAndIsZeroOnTheRim)
{
    const SolveOptions& options = GetParam().options;
    const std::vector<PlanarMesh> footprints = meshes();
    const Solution solution = solve(footprints, options);
    ASSERT_TRUE(solution.report.usable());
    const std::vector<FillGain> gains = gainsPerFill(footprints, solution.droplets, options);
    double before = 0.0;
    double gained = 0.0;
    for (std::size_t k = 0; k < footprints.size(); ++k) {
        const CapillarySurface gain = testing::fieldOn(footprints[k], gains[k].height);
        for (std::uint32_t v = 0; v < gain.rimVertexCount(); ++v) {
            EXPECT_EQ(gain.vertices[v].z, 0.0);
        }
        const double volume = measure(solution.droplets[k], options).volume;
        if (options.fill.sharing == FillSharing::Each) {
            EXPECT_NEAR(measure(gain, {}).volume / volume, 1.0, 1e-9);
        }
        before += volume;
        gained += measure(gain, {}).volume;
    }
    EXPECT_NEAR(gained / before, 1.0, 1e-9);
}

std::string refusalOf(const SolveOptions& options, std::vector<CapillarySurface> fields)
{
    try {
        gainsPerFill(meshes(), fields, options);
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

TEST(RefillRefuses, OptionsThatAreNotAffine)
{
    const SolveOptions linear;
    const std::vector<CapillarySurface> fields = solve(meshes(), linear).droplets;
    EXPECT_EQ(refusalOf(linear, fields), "");
    SolveOptions exact;
    exact.model = Model::Exact;
    EXPECT_THAT(refusalOf(exact, fields), HasSubstr("model must be linear"));
    SolveOptions above;
    above.no_penetration = true;
    EXPECT_THAT(refusalOf(above, fields), HasSubstr("no_penetration"));
    EXPECT_THAT(refusalOf(linear, {fields[0]}), HasSubstr("must have 3 entries, one per mesh, not 1"));
    EXPECT_THAT(refusalOf(linear, {fields[1], fields[0], fields[2]}), HasSubstr("field 0"));
}

TEST(RefillRefuses, DropletsWithoutLiquid)
{
    std::vector<CapillarySurface> fields = solve(meshes()).droplets;
    for (Vec3& p : fields[1].vertices) {
        p.z = 0.0;
    }
    EXPECT_THAT(refusalOf({}, fields), HasSubstr("droplet 2 of 3"));
}

TEST(FillRange, ContainsOne)
{
    EXPECT_NO_THROW((FillRange{0.0, 2.0}.validate()));
    EXPECT_NO_THROW((FillRange{1.0, 1.5}.validate()));
    EXPECT_NO_THROW((FillRange{0.5, 1.0}.validate()));
    const double infinity = std::numeric_limits<double>::infinity();
    for (const FillRange wrong : {FillRange{-0.1, 2.0}, FillRange{1.1, 2.0}, FillRange{0.0, 0.9}, FillRange{1.0, 1.0},
                                  FillRange{0.0, infinity}, FillRange{std::numeric_limits<double>::quiet_NaN(), 2.0}}) {
        EXPECT_THROW(wrong.validate(), Error) << wrong.min << " to " << wrong.max;
    }
}

}  // namespace
}  // namespace droplet
