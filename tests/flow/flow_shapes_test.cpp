// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/flow/flow_shapes.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "droplet/error.h"
#include "droplet/units.h"
#include "flow/following.h"
#include "support/flow_scenes.h"

namespace droplet {
namespace {

using Places = std::vector<Vec3>;
using testing::everything;
using testing::many;

/// A square plate that slopes down to -y, cut into n x n cells.
struct Plate {
    Plate(double size, double slope, std::uint32_t n)
    {
        for (std::uint32_t j = 0; j <= n; ++j) {
            for (std::uint32_t i = 0; i <= n; ++i) {
                const double y = size * j / n;
                vertices.push_back({size * i / n, y, std::tan(slope) * y});
            }
        }
        for (std::uint32_t j = 0; j < n; ++j) {
            for (std::uint32_t i = 0; i < n; ++i) {
                const std::uint32_t a = j * (n + 1) + i;
                triangles.insert(triangles.end(), {{a, a + 1, a + n + 2}, {a, a + n + 2, a + n + 1}});
            }
        }
    }

    Places vertices;
    std::vector<Triangle> triangles;
};

/// The plate's shapes, as its points move.
/// @param at  place of a point of the plate at a time
FlowShapes shapesOf(const Plate& plate, double duration, double rate, const std::function<Vec3(Vec3, double)>& at,
                    double longest = 1.0)
{
    std::vector<Places> shapes;
    for (int k = 0; k <= std::lround(duration * rate); ++k) {
        Places& places = shapes.emplace_back();
        for (const Vec3 p : plate.vertices) {
            places.push_back(at(p, k / rate));
        }
    }
    FlowSurface surface = refined(flowSurface(shapes.front(), plate.triangles), longest);
    return {std::move(surface), plate.triangles, std::move(shapes), rate};
}

Vec3 still(Vec3 p, double /*time*/)
{
    return p;
}

/// Waves run over the plate.
Vec3 waving(Vec3 p, double time)
{
    const double phase = 2.0 * std::numbers::pi * (3.0 * time - p.y / 0.15);
    return p + Vec3{0.0, 0.0, 0.01 * std::sin(phase)};
}

TEST(FlowShapes, EqualShapesGiveTheBytesOfARigidSurface)
{
    const Plate plate(0.2, 40.0 * kDegree, 12);
    const FlowParameters parameters = everything();
    FlowShapes shapes = shapesOf(plate, 1.0, 24.0, still, 0.01);
    const FlowTerrain rigid(refined(flowSurface(plate.vertices, plate.triangles), 0.01));
    FlowState state = startFlow(shapes.first(), parameters, many(60, 40.0 * kDegree));
    FlowState expected = startFlow(rigid, parameters, many(60, 40.0 * kDegree));
    for (int frame = 1; frame <= 24; ++frame) {
        state = advanceFlow(std::move(state), shapes, parameters, frame / 24.0);
        expected = advanceFlow(std::move(expected), rigid, parameters, frame / 24.0);
        EXPECT_EQ(state.tracks.size(), expected.tracks.size());
    }
    EXPECT_EQ(bytesOf(state), bytesOf(expected));
    EXPECT_GT(state.counts.crossings, 100U);
}

/// Largest difference of droplets on a plate that moves steadily from those on one that rests, relative to it.
double offSteady(double pinning, double film)
{
    const Plate plate(0.2, 40.0 * kDegree, 12);
    const Vec3 velocity{0.7, -0.4, 0.5};
    FlowParameters parameters;
    parameters.forces.wetting.hysteresis = 0.1;
    parameters.streaks.film = film;
    parameters.pinning.spread = pinning;
    parameters.merges = film == 0.0;
    FlowShapes shapes = shapesOf(
        plate, 1.0, 25.0, [&](Vec3 p, double time) { return p + time * velocity; }, 0.01);
    const FlowTerrain rigid(refined(flowSurface(plate.vertices, plate.triangles), 0.01));
    FlowState state = startFlow(shapes.first(), parameters, many(60, 40.0 * kDegree));
    FlowState expected = startFlow(rigid, parameters, many(60, 40.0 * kDegree));
    std::size_t airborne = 0;
    double largest = 0.0;
    for (int frame = 1; frame <= 25; ++frame) {
        const double time = frame / 25.0;
        state = advanceFlow(std::move(state), shapes, parameters, time);
        expected = advanceFlow(std::move(expected), rigid, parameters, time);
        const std::vector<FlowSample> moved = sampleFlow(state, shapes, parameters);
        const std::vector<FlowSample> rested = sampleFlow(expected, rigid, parameters);
        EXPECT_EQ(moved.size(), rested.size());
        for (std::size_t i = 0; i < std::min(moved.size(), rested.size()); ++i) {
            EXPECT_EQ(moved[i].contact, rested[i].contact) << frame;
            EXPECT_EQ(moved[i].id, rested[i].id) << frame;
            const bool flies = moved[i].contact == FlowContact::Air;
            airborne += flies ? 1 : 0;
            const Vec3 speed = moved[i].velocity - (flies ? 1.0 : 0.0) * velocity;
            largest = std::max({largest, length(moved[i].place - time * velocity - rested[i].place),
                                1e-3 * length(speed - rested[i].velocity)});
        }
    }
    EXPECT_GT(airborne, 10U);
    EXPECT_EQ(state.counts.beads > 0, film > 0.0);
    return largest;
}

TEST(FlowShapes, SteadyMotionChangesNothingOnTheSurface)
{
    EXPECT_LT(offSteady(0.0, 5e-6), 1e-9);
    // With pinning, what holds a droplet is found anew at the edges of faces, too. Were pinning fixed in space,
    // droplets would rest at other places.
    EXPECT_LT(offSteady(0.5, 0.0), 3e-3);
}

/// Largest distance of droplets on a plate that turns, with meshes and with a motion, in its frame.
double offTurning(double rate, Vec3 spin)
{
    const double angle = 20.0 * kDegree;
    const Plate plate(0.2, angle, 8);
    FlowParameters parameters;
    parameters.model = FlowModel::Paper;
    parameters.friction = 1e-4;
    parameters.merges = false;
    parameters.step = 1.0 / 3840.0;
    ObjectMotion motion;
    motion.spin = spin;
    FlowShapes shapes = shapesOf(plate, 0.5, rate, [&](Vec3 p, double time) {
        const ObjectPose pose = motion.at(time);
        return pose.place + pose.toWorld(p);
    });
    FlowParameters moving = parameters;
    moving.motion = motion;
    const FlowTerrain rigid(flowSurface(plate.vertices, plate.triangles));
    std::vector<FlowStart> starts;
    for (int k = 0; k < 5; ++k) {
        const double y = 0.1 + 0.01 * k;
        starts.push_back({{0.05 + 0.01 * k, y, std::tan(angle) * y}, (5.0 + 5.0 * k) * 1e-9, {}});
    }
    FlowState state = startFlow(shapes.first(), parameters, starts);
    FlowState expected = startFlow(rigid, moving, starts);
    state = advanceFlow(std::move(state), shapes, parameters, 0.2);
    expected = advanceFlow(std::move(expected), rigid, moving, 0.2);
    const std::vector<FlowSample> turned = sampleFlow(state, shapes, parameters);
    const std::vector<FlowSample> reference = sampleFlow(expected, rigid, moving);
    double largest = 0.0;
    for (std::size_t i = 0; i < reference.size(); ++i) {
        EXPECT_NE(turned[i].contact, FlowContact::Air);
        const Vec3 place = motion.at(0.2).toObject(turned[i].place);
        largest = std::max(largest, length(place - reference[i].place));
    }
    return largest;
}

TEST(FlowShapes, ATurnIsThatOfAMotionToSecondOrder)
{
    // About the vertical, centrifugal and Coriolis' accelerations act; about another axis gravity turns as well.
    for (const Vec3 spin : {Vec3{0.0, 0.0, 4.0}, Vec3{1.5, 1.0, 2.0}}) {
        const double coarse = offTurning(20.0, spin);
        const double middle = offTurning(40.0, spin);
        const double fine = offTurning(80.0, spin);
        EXPECT_GT(std::log2(coarse / middle), 1.7) << coarse << " " << middle;
        EXPECT_GT(std::log2(middle / fine), 1.7) << middle << " " << fine;
        EXPECT_LT(fine, 2e-4);
    }
}

TEST(FlowShapes, BytesDependOnNeitherFramesNorThreads)
{
    const Plate plate(0.2, 40.0 * kDegree, 12);
    const FlowParameters parameters = everything();
    const auto run = [&](int calls, std::size_t threads) {
        const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
        FlowShapes shapes = shapesOf(plate, 1.0, 24.0, waving, 0.01);
        FlowState state = startFlow(shapes.first(), parameters, many(60, 40.0 * kDegree));
        for (int k = 1; k <= calls; ++k) {
            state = advanceFlow(std::move(state), shapes, parameters, 1.0 * k / calls);
            sampleFlow(state, shapes, parameters);
        }
        return bytesOf(state);
    };
    const std::string once = run(1, 1);
    EXPECT_EQ(run(24, 2), once);
    EXPECT_EQ(run(37, 4), once);
}

TEST(FlowShapes, AccountsForAllLiquidAndKeepsDropletsOnTheSurface)
{
    const Plate plate(0.2, 40.0 * kDegree, 12);
    const FlowParameters parameters = everything();
    FlowShapes shapes = shapesOf(plate, 2.0, 25.0, waving, 0.01);
    FlowState state = startFlow(shapes.first(), parameters, many(100, 40.0 * kDegree));
    for (int frame = 1; frame <= 50; ++frame) {
        state = advanceFlow(std::move(state), shapes, parameters, frame / 25.0);
        EXPECT_LT(std::abs(balanceOf(state).residual()), 1e-12);
        ASSERT_EQ(shapes.of(state, parameters.step), static_cast<std::size_t>(frame));
        const std::shared_ptr<const FlowTerrain> terrain = shapes.at(static_cast<std::size_t>(frame));
        for (const FlowSample& sample : sampleFlow(state, shapes, parameters)) {
            if (sample.face) {
                const FlowSurface::Face& face = terrain->surface().faces[*sample.face];
                const auto weights = weightsOn(face.corners, sample.place);
                EXPECT_LT(std::abs(dot(sample.place - face.corners[0], face.normal)), 1e-9);
                EXPECT_GT(*std::min_element(weights.begin(), weights.end()), -1e-6);
                EXPECT_EQ(sample.normal, face.normal);
            }
        }
        for (const FlowTrack& track : state.tracks) {  // on the first shape
            const FlowSurface::Face& face = shapes.first().surface().faces[track.face];
            EXPECT_LT(std::abs(dot(track.to - face.corners[0], face.normal)), 1e-9);
        }
    }
    EXPECT_GT(state.counts.merged, 10U);
    EXPECT_GT(state.counts.beads, 10U);
    EXPECT_EQ(state.counts.stuck, 0U);
}

TEST(FlowShapes, ADropletThatRestsKeepsItsPlaceOnItsFace)
{
    const Plate plate(0.2, 0.0, 4);
    const FlowParameters parameters;
    FlowShapes shapes = shapesOf(plate, 1.0, 30.0, [](Vec3 p, double time) {
        return Vec3{(1.0 + 0.2 * time) * p.x, p.y + 0.1 * time * p.x, 0.3 * time * p.x * p.y};
    });
    FlowState state = startFlow(shapes.first(), parameters, {{{0.06, 0.11, 0.0}, 2e-9, {}}});
    const FlowSample before = sampleFlow(state, shapes, parameters).front();
    state = advanceFlow(std::move(state), shapes, parameters, 1.0);
    const FlowSample after = sampleFlow(state, shapes, parameters).front();
    ASSERT_EQ(after.contact, FlowContact::Still);
    ASSERT_EQ(after.face, before.face);
    const auto expected = weightsOn(shapes.first().surface().faces[*before.face].corners, before.place);
    const auto weights = weightsOn(shapes.at(30)->surface().faces[*after.face].corners, after.place);
    for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_NEAR(weights[k], expected[k], 1e-12);
    }
    EXPECT_GT(length(after.place - before.place), 0.01);
}

TEST(FlowShapes, ShakingThrowsDropletsOffWithTheVelocityOfTheGround)
{
    // Up and down; at its highest the plate accelerates down by 85 m/s2, which adhesion does not hold.
    const Plate plate(0.2, 0.0, 8);
    const double turn = 2.0 * std::numbers::pi * 6.0;
    const auto height = [&](double time) { return 0.06 * (1.0 - std::cos(turn * time)); };
    const FlowParameters parameters;
    FlowShapes shapes = shapesOf(plate, 0.25, 120.0, [&](Vec3 p, double time) {
        return p + Vec3{0.0, 0.0, height(time)};
    });
    FlowState state = startFlow(shapes.first(), parameters, {{{0.1, 0.1, 0.0}, 20e-9, {}}});
    std::vector<FlowSample> flight;
    for (int frame = 1; frame <= 24; ++frame) {
        state = advanceFlow(std::move(state), shapes, parameters, frame / 120.0);
        const std::vector<FlowSample> samples = sampleFlow(state, shapes, parameters);
        ASSERT_EQ(samples.size(), 1U);
        const FlowSample& sample = samples.front();
        if (sample.contact == FlowContact::Air) {
            flight.push_back(sample);
        } else {
            EXPECT_NEAR(sample.place.z, height(frame / 120.0), 1e-9);
            EXPECT_TRUE(flight.empty());
        }
    }
    ASSERT_GT(flight.size(), 8U);
    EXPECT_GT(flight.front().velocity.z, 1.0);  // the ground has at most 2.3 m/s
    for (std::size_t k = 1; k < flight.size(); ++k) {
        const double passed = 1.0 / 120.0;
        const Vec3 gained = flight[k].velocity - flight[k - 1].velocity;
        EXPECT_NEAR(gained.z, -kStandardGravity * passed, 1e-9);
        EXPECT_NEAR(flight[k].place.z - flight[k - 1].place.z,
                    0.5 * passed * (flight[k].velocity.z + flight[k - 1].velocity.z), 1e-9);
        EXPECT_NEAR(flight[k].place.x, 0.1, 1e-12);
    }
}

TEST(FlowShapes, GentleShakingHoldsDroplets)
{
    const Plate plate(0.2, 0.0, 8);
    FlowParameters parameters;
    parameters.forces.wetting.hysteresis = 0.2;
    const auto shaken = [&](double amplitude) {
        FlowShapes shapes = shapesOf(plate, 1.0, 60.0, [&](Vec3 p, double time) {
            return p + Vec3{amplitude * std::sin(2.0 * std::numbers::pi * 2.0 * time), 0.0, 0.0};
        });
        FlowState state = startFlow(shapes.first(), parameters, {{{0.1, 0.1, 0.0}, 20e-9, {}}});
        state = advanceFlow(std::move(state), shapes, parameters, 1.0);
        const FlowSample sample = sampleFlow(state, shapes, parameters).front();
        return length(sample.place - Vec3{0.1, 0.1, 0.0});
    };
    EXPECT_LT(shaken(0.001), 1e-9);  // 0.16 m/s2
    EXPECT_GT(shaken(0.05), 1e-3);   // 8 m/s2
}

TEST(FlowShapes, GroundThatRisesCatchesDropletsInTheAir)
{
    const Plate plate(0.2, 0.0, 8);
    const FlowParameters parameters;
    const auto height = [](double time) { return 8.0 * time * time; };
    FlowShapes shapes = shapesOf(plate, 0.5, 24.0, [&](Vec3 p, double time) {
        return p + Vec3{0.0, 0.0, height(time)};
    });
    std::vector<FlowStart> starts;
    for (int k = 0; k < 8; ++k) {
        starts.push_back({{0.02 + 0.02 * k, 0.1, 0.05 + 0.03 * k}, 5e-9, {}});
    }
    FlowState state = startFlow(shapes.first(), parameters, starts);
    for (int frame = 1; frame <= 12; ++frame) {
        state = advanceFlow(std::move(state), shapes, parameters, frame / 24.0);
        for (const FlowSample& sample : sampleFlow(state, shapes, parameters)) {
            EXPECT_GT(sample.place.z, height(frame / 24.0) - 1e-9);
        }
    }
    EXPECT_EQ(state.counts.landings, 8U);
    EXPECT_EQ(balanceOf(state).airborne, 0.0);
}

TEST(FlowShapes, NeighboursShareTheirEdgesInAllShapes)
{
    const Plate plate(0.2, 20.0 * kDegree, 3);
    FlowShapes shapes = shapesOf(plate, 0.2, 25.0, waving, 0.01);
    for (std::size_t shape = 0; shape < shapes.count(); ++shape) {
        const std::shared_ptr<const FlowTerrain> terrain = shapes.at(shape);
        const std::vector<FlowSurface::Face>& faces = terrain->surface().faces;
        ASSERT_GT(faces.size(), 200U);
        for (std::uint32_t f = 0; f < faces.size(); ++f) {
            for (std::size_t k = 0; k < 3; ++k) {
                if (faces[f].neighbour[k] == FlowSurface::kNone) {
                    continue;
                }
                const FlowSurface::Face& beside = faces[faces[f].neighbour[k]];
                for (const std::size_t end : {k, (k + 1) % 3}) {
                    EXPECT_NE(std::find(beside.corners.begin(), beside.corners.end(), faces[f].corners[end]),
                              beside.corners.end());
                }
            }
        }
    }
}

TEST(FlowShapes, RefusesShapesThatDropletsCannotFollow)
{
    const Plate plate(0.2, 0.0, 2);
    const FlowSurface surface = flowSurface(plate.vertices, plate.triangles);
    const auto message_of = [&](std::vector<Places> shapes, double rate) {
        try {
            FlowShapes(surface, plate.triangles, std::move(shapes), rate);
        } catch (const Error& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    Places folded = plate.vertices;
    folded[1] = folded[0];
    EXPECT_NE(message_of({plate.vertices, folded}, 24.0).find("triangle 0 has no area in frame 2 of 2"),
              std::string::npos);
    Places fewer = plate.vertices;
    fewer.pop_back();
    EXPECT_NE(message_of({plate.vertices, fewer}, 24.0).find("number of vertices of a shape is 8"), std::string::npos);
    EXPECT_NE(message_of({plate.vertices}, 0.0).find("frames_per_second is 0"), std::string::npos);
}

}  // namespace
}  // namespace droplet
