// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/body/droplet_body.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "body/body_grid.h"
#include "body/running_footprint.h"
#include "droplet/body/running_shape.h"
#include "droplet/error.h"
#include "droplet/shape/solve.h"
#include "droplet/units.h"
#include "support/heights.h"

namespace droplet {
namespace {

using testing::heightsOf;

constexpr double kVolume = 20e-9;
constexpr Vec3 kDown{0.0, 0.0, -9.81};

struct Made {
    std::vector<Vec3> vertices;
    std::vector<Vec3> normals;
};

Made make(const DropletBodies& bodies, const BodyConditions& conditions)
{
    Made made{std::vector<Vec3>(bodies.vertices()), std::vector<Vec3>(bodies.vertices())};
    bodies.make(conditions, made.vertices, made.normals);
    return made;
}

DropletBodies bodiesOf(BodyShape shape, double degrees = 105.0)
{
    ForceModel model;
    model.wetting.contact_angle = degrees * kDegree;
    return DropletBodies(shape, model);
}

double volumeOf(const DropletBodies& bodies, const std::vector<Vec3>& vertices)
{
    double sum = 0.0;
    for (const Triangle& t : bodies.triangles()) {
        sum += dot(vertices[t[0]], cross(vertices[t[1]], vertices[t[2]]));
    }
    return sum / 6.0;
}

/// Mean angle between surface and ground at the rim [degrees].
double rimAngle(const DropletBodies& bodies, const Made& made)
{
    double sum = 0.0;
    for (std::size_t v = 0; v < bodies.rimVertices(); ++v) {
        sum += std::acos(made.normals[v].z);
    }
    return sum / static_cast<double>(bodies.rimVertices()) / kDegree;
}

double farthest(const std::vector<Vec3>& a, const std::vector<Vec3>& b)
{
    double far = 0.0;
    for (std::size_t v = 0; v < a.size(); ++v) {
        far = std::max(far, length(a[v] - b[v]));
    }
    return far;
}

/// Droplets of all kinds: small and large, at rest and running, on level ground, slopes, walls and ceilings.
std::vector<BodyConditions> manyConditions()
{
    std::vector<BodyConditions> all;
    for (const double volume : {1e-15, 2e-9, 60e-9, 3e-6}) {
        for (const double speed : {0.0, 0.03, 0.3, 5.0}) {
            for (const Vec3 gravity : {Vec3{}, kDown, Vec3{6.9, 0.0, -6.9}, Vec3{9.81, 0.0, 0.0}, Vec3{-5.0, 7.0, -3.0},
                                       Vec3{0.0, 0.0, 9.81}, Vec3{3.0, -2.0, 9.0}}) {
                all.push_back({volume, speed, gravity});
            }
        }
    }
    return all;
}

constexpr std::array kShapes{BodyShape::Capillary, BodyShape::Springs, BodyShape::Capsule};

TEST(DropletBodies, HaveTheirVolumeAndFaceOutward)
{
    for (const BodyShape shape : kShapes) {
        for (const double angle : {5.0, 40.0, 90.0, 105.0, 150.0, 175.0}) {
            const DropletBodies bodies = bodiesOf(shape, angle);
            for (const BodyConditions& conditions : manyConditions()) {
                const std::string name = std::to_string(static_cast<int>(shape)) + " " + std::to_string(angle) + " " +
                                         std::to_string(conditions.volume * 1e9) + " " +
                                         std::to_string(conditions.speed) + " " + std::to_string(conditions.gravity.x) +
                                         " " + std::to_string(conditions.gravity.z);
                const Made made = make(bodies, conditions);
                ASSERT_NEAR(volumeOf(bodies, made.vertices) / conditions.volume, 1.0, 1e-9) << name;
                Vec2 centre;
                for (std::size_t v = 0; v < bodies.vertices(); ++v) {
                    ASSERT_NEAR(length(made.normals[v]), 1.0, 1e-12) << name;
                    if (v < bodies.rimVertices()) {
                        ASSERT_EQ(made.vertices[v].z, 0.0) << name;
                        const Vec3 next = made.vertices[(v + 1) % bodies.rimVertices()];
                        const double twice = cross(made.vertices[v], next).z;
                        ASSERT_GT(twice, 0.0) << name;
                        centre = centre + twice * Vec2{made.vertices[v].x + next.x, made.vertices[v].y + next.y};
                    } else {
                        ASSERT_GT(made.vertices[v].z, 0.0) << name;
                    }
                }
                ASSERT_LE(length(centre), 1e-9 * conditions.volume) << name;
                for (const Triangle& t : bodies.triangles()) {
                    const Vec3 outward =
                        cross(made.vertices[t[1]] - made.vertices[t[0]], made.vertices[t[2]] - made.vertices[t[0]]);
                    for (const std::uint32_t v : t) {
                        ASSERT_GT(dot(outward, made.normals[v]), 0.0) << name << " vertex " << v;
                    }
                }
            }
        }
    }
}

TEST(DropletBodies, ShareOneTopology)
{
    const DropletBodies first = bodiesOf(BodyShape::Capillary);
    for (const BodyShape shape : kShapes) {
        const DropletBodies bodies = bodiesOf(shape);
        EXPECT_EQ(bodies.triangles(), first.triangles());
        EXPECT_EQ(bodies.vertices(), first.vertices());
    }
    // Open at the rim alone: every other edge has two triangles, in opposite directions.
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (const Triangle& t : first.triangles()) {
        for (std::size_t k = 0; k < 3; ++k) {
            ++edges[{t[k], t[(k + 1) % 3]}];
        }
    }
    std::size_t open = 0;
    for (const auto& [edge, count] : edges) {
        EXPECT_EQ(count, 1);
        if (edges.count({edge.second, edge.first}) == 0) {
            ++open;
            EXPECT_EQ(edge.second, (edge.first + 1) % first.rimVertices());
        }
    }
    EXPECT_EQ(open, first.rimVertices());
}

TEST(DropletBodies, AreBallsInTheAir)
{
    const DropletBodies bodies = bodiesOf(BodyShape::Capillary);
    const Made made = make(bodies, {kVolume, 1.0, kDown, true});
    EXPECT_NEAR(volumeOf(bodies, made.vertices) / kVolume, 1.0, 1e-12);
    const double radius = length(made.vertices[0]);
    for (std::size_t v = 0; v < bodies.vertices(); ++v) {
        EXPECT_LE(length(made.vertices[v] - radius * made.normals[v]), 1e-12 * radius);
    }
}

TEST(DropletBodies, AtRestAreRound)
{
    for (const BodyShape shape : {BodyShape::Capillary, BodyShape::Capsule}) {
        const DropletBodies bodies = bodiesOf(shape);
        for (const Vec3 gravity : {Vec3{}, kDown, Vec3{0.0, 0.0, 9.81}}) {
            const Made made = make(bodies, {kVolume, 0.0, gravity});
            for (std::size_t v = 0; v + 1 < bodies.vertices(); ++v) {
                const Vec3 first = made.vertices[v - v % bodies.rimVertices()];
                EXPECT_NEAR(std::hypot(made.vertices[v].x, made.vertices[v].y), first.x, 1e-9 * first.x);
                EXPECT_NEAR(made.vertices[v].z, first.z, 1e-9 * first.x);
            }
        }
    }
}

TEST(DropletBodies, WithoutGravityAreCapsOfAnyAngle)
{
    for (const double angle : {2.0, 30.0, 60.0, 90.0, 105.0, 140.0, 165.0, 178.0}) {
        const DropletBodies bodies = bodiesOf(BodyShape::Capillary, angle);
        const Made made = make(bodies, {kVolume, 0.0, {}});
        const double foot = made.vertices[0].x;
        const double radius = foot / std::sin(angle * kDegree);
        const Vec3 centre{0.0, 0.0, -radius * std::cos(angle * kDegree)};
        for (std::size_t v = 0; v < bodies.vertices(); ++v) {
            EXPECT_NEAR(length(made.vertices[v] - centre), radius, 1e-9 * radius) << angle;
            EXPECT_LE(length(radius * made.normals[v] - made.vertices[v] + centre), 1e-6 * radius) << angle << " " << v;
        }
        // The mesh is inscribed, so it is larger than the cap of the same volume.
        EXPECT_NEAR(foot / capOf(kVolume, angle * kDegree).contact_radius, 1.01, 0.01) << angle;
    }
}

TEST(DropletBodies, MeetTheGroundAtTheContactAngle)
{
    for (const double angle : {20.0, 60.0, 105.0, 150.0}) {
        const DropletBodies bodies = bodiesOf(BodyShape::Capillary, angle);
        for (const double volume : {1e-12, 1e-9, 20e-9, 1e-6}) {
            EXPECT_NEAR(rimAngle(bodies, make(bodies, {volume, 0.0, kDown})), angle, 1.0) << volume;
        }
    }
}

TEST(DropletBodies, WidePuddlesHaveTheHeightOfThePuddle)
{
    for (const double angle : {30.0, 60.0, 105.0, 150.0}) {
        const DropletBodies bodies = bodiesOf(BodyShape::Capillary, angle);
        const Liquid water;
        const double capillary_length = std::sqrt(water.surface_tension / (water.density * 9.81));
        const Made made = make(bodies, {angle < 80.0 ? 3e-6 : 20e-6, 0.0, kDown});
        EXPECT_NEAR(made.vertices.back().z / (2.0 * capillary_length * std::sin(0.5 * angle * kDegree)), 1.0, 0.15)
            << angle;
    }
}

/// Height that the project's exact solver finds over the footprint of a body.
double solvedHeight(const DropletBodies& bodies, const Made& made, double volume, double gravity, double tilt)
{
    PlanarMesh mesh;
    constexpr std::size_t kRings = 40;
    const std::size_t n = bodies.rimVertices();
    for (std::size_t ring = 0; ring < kRings; ++ring) {
        for (std::size_t j = 0; j < n; ++j) {
            const double share = 1.0 - static_cast<double>(ring) / kRings;
            mesh.vertices.push_back({share * made.vertices[j].x, share * made.vertices[j].y});
            const auto a = static_cast<std::uint32_t>(ring * n + j);
            const auto b = static_cast<std::uint32_t>(ring * n + (j + 1) % n);
            if (ring + 1 == kRings) {
                mesh.triangles.push_back({a, b, static_cast<std::uint32_t>(kRings * n)});
            } else {
                mesh.triangles.push_back({a, b, static_cast<std::uint32_t>(b + n)});
                mesh.triangles.push_back({a, static_cast<std::uint32_t>(b + n), static_cast<std::uint32_t>(a + n)});
            }
        }
    }
    mesh.vertices.push_back({});
    mesh.loop_starts = {0, static_cast<std::uint32_t>(n)};
    SolveOptions options;
    options.gravity = gravity;
    options.tilt = tilt;
    options.tilt_direction = 0.0;
    options.model = Model::Exact;
    options.fill = {FillBy::Volume, volume, FillSharing::Each};
    const Solution solution = solve({mesh}, options);
    EXPECT_TRUE(solution.report.usable());
    const std::vector<double> height = heightsOf(solution.droplets.at(0));
    return *std::max_element(height.begin(), height.end());
}

TEST(DropletBodies, AgreeWithTheExactSolver)
{
    for (const double angle : {20.0, 40.0, 60.0}) {
        const DropletBodies bodies = bodiesOf(BodyShape::Capillary, angle);
        for (const double volume : {1e-9, 20e-9, 200e-9}) {
            const auto check = [&](double speed, Vec3 gravity, double g, double tilt, double tolerance) {
                const Made made = make(bodies, {volume, speed, gravity});
                double height = 0.0;
                for (const Vec3 p : made.vertices) {
                    height = std::max(height, p.z);
                }
                EXPECT_NEAR(height / solvedHeight(bodies, made, volume, g, tilt), 1.0, tolerance)
                    << angle << " " << volume << " " << speed;
            };
            check(0.0, kDown, 9.81, 0.0, 0.01);
            check(0.1, kDown, 9.81, 0.0, 0.03);
            if (volume < 100e-9) {  // larger ones lean less than they should, and nearly fall off
                check(0.0, {0.0, 0.0, 9.81}, -9.81, 0.0, 0.02);
                check(0.0, {1.5, 0.0, -9.0}, std::hypot(1.5, 9.0), std::atan2(1.5, 9.0), 0.02);
            }
        }
    }
}

TEST(DropletBodies, RunningHaveAHeadAndATail)
{
    const DropletBodies bodies = bodiesOf(BodyShape::Capillary);
    double last = 1.0;
    for (const double speed : {0.02, 0.1, 0.4, 2.0}) {
        const Made made = make(bodies, {kVolume, speed, {7.0, 0.0, -7.0}});
        double front = 0.0;
        double back = 0.0;
        double width = 0.0;
        double widest_at = 0.0;
        for (std::size_t v = 0; v < bodies.rimVertices(); ++v) {
            const Vec3 p = made.vertices[v];
            front = std::max(front, p.x);
            back = std::min(back, p.x);
            if (p.y > width) {
                width = p.y;
                widest_at = p.x;
            }
        }
        EXPECT_GT((front - back) / (2.0 * width), last);
        last = (front - back) / (2.0 * width);
        EXPECT_GT(widest_at, 0.0) << "the head is full";
        // The head is blunter and steeper than the tail.
        EXPECT_GT(std::acos(made.normals[0].z), std::acos(made.normals[bodies.rimVertices() / 2].z));
        // Left and right are mirror images.
        for (std::size_t v = 1; v < bodies.rimVertices(); ++v) {
            const Vec3 other = made.vertices[bodies.rimVertices() - v];
            EXPECT_LE(length(Vec3{other.x, -other.y, other.z} - made.vertices[v]), 1e-8 * front);
        }
    }
    EXPECT_LT(last, 4.0) << "elongation is bounded";
}

TEST(DropletBodies, LeanWithTheForce)
{
    for (const BodyShape shape : {BodyShape::Capillary, BodyShape::Springs}) {
        const DropletBodies bodies = bodiesOf(shape);
        const Made right = make(bodies, {kVolume, 0.0, {0.0, -9.81, 0.0}});
        const Made left = make(bodies, {kVolume, 0.0, {0.0, 9.81, 0.0}});
        double lean = 0.0;
        for (std::size_t v = 0; v < bodies.vertices(); ++v) {
            lean += left.vertices[v].y * left.vertices[v].z;
            const std::size_t ring = v / bodies.rimVertices();
            const std::size_t slice = v % bodies.rimVertices();
            const std::size_t mirrored =
                v + 1 == bodies.vertices()
                    ? v
                    : ring * bodies.rimVertices() + (bodies.rimVertices() - slice) % bodies.rimVertices();
            const Vec3 other = right.vertices[mirrored];
            EXPECT_LE(length(Vec3{other.x, -other.y, other.z} - left.vertices[v]), 1e-5 * left.vertices.back().z);
        }
        EXPECT_GT(lean, 0.0);
    }
}

TEST(DropletBodies, ChangeSmoothly)
{
    for (const BodyShape shape : kShapes) {
        const DropletBodies bodies = bodiesOf(shape);
        Made last = make(bodies, {kVolume, 0.0, kDown});
        for (int step = 1; step <= 400; ++step) {
            // Speed rises and the ground turns over.
            const double t = step / 400.0;
            const Made next = make(bodies, {kVolume, t, 9.81 * Vec3{std::sin(3.0 * t), 0.0, -std::cos(3.0 * t)}});
            EXPECT_LE(farthest(last.vertices, next.vertices), 0.05e-3) << t;
            EXPECT_LE(farthest(last.normals, next.normals), 0.1) << t;
            last = next;
        }
    }
}

TEST(DropletBodies, CapsulesLieOnTheRunningShape)
{
    const DropletBodies bodies = bodiesOf(BodyShape::Capsule, 95.0);
    const Made made = make(bodies, {kVolume, 0.5, {}});
    const RunningShape shape = runningShape(kVolume, 0.5, {.contact_angle = 95.0 * kDegree});
    // The mesh is inscribed and has the volume, so it is a little larger.
    const double scale = made.vertices.back().z / shape.height();
    EXPECT_NEAR(scale, 1.02, 0.02);
    for (std::size_t v = 0; v < bodies.vertices(); ++v) {
        const Vec3 p = (1.0 / scale) * made.vertices[v];
        const double beyond = std::max(std::abs(p.x) - shape.half_length, 0.0);
        EXPECT_NEAR(std::hypot(beyond, p.y, p.z - shape.centre_height), shape.radius, 1e-9 * shape.radius);
    }
}

TEST(DropletBodies, AreTheSameAtAnyNumberOfThreads)
{
    const BodyConditions conditions{kVolume, 0.1, {4.0, 2.0, -7.0}};
    const Made many = make(bodiesOf(BodyShape::Capillary), conditions);
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
    const Made one = make(bodiesOf(BodyShape::Capillary), conditions);
    EXPECT_EQ(one.vertices, many.vertices);
    EXPECT_EQ(one.normals, many.normals);
}

TEST(DropletBodies, RejectInvalidArguments)
{
    ForceModel model;
    model.wetting.contact_angle = 0.0;
    EXPECT_THROW(DropletBodies(BodyShape::Capillary, model), Error);
    const DropletBodies bodies = bodiesOf(BodyShape::Capsule);
    EXPECT_THROW(make(bodies, {0.0, 0.0, {}}), Error);
    EXPECT_THROW(make(bodies, {1e-9, -1.0, {}}), Error);
    EXPECT_THROW(make(bodies, {1e-9, 0.0, {std::nan(""), 0.0, 0.0}}), Error);
    std::vector<Vec3> few(3);
    EXPECT_THROW(bodies.make({1e-9, 0.0, {}}, few, few), Error);
}

TEST(RunningFootprint, IsConvexWithTheAreaOfTheCircle)
{
    double circle = 0.0;
    for (int step = 0; step <= 20; ++step) {
        const auto rim = runningFootprint(step / 20.0);
        double twice = 0.0;
        for (std::size_t j = 0; j < rim.size(); ++j) {
            const Vec2 a = rim[j];
            const Vec2 b = rim[(j + 1) % rim.size()];
            const Vec2 c = rim[(j + 2) % rim.size()];
            twice += cross(a, b);
            EXPECT_GT(cross(b - a, c - b), 0.0) << step << " " << j;
            if (step == 0) {
                EXPECT_NEAR(length(a), 1.0, 1e-14);
            }
        }
        circle = step == 0 ? twice : circle;
        EXPECT_NEAR(twice, circle, 1e-12);
    }
}

}  // namespace
}  // namespace droplet
