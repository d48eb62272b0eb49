// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow/walk.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "droplet/error.h"
#include "droplet/units.h"
#include "flow/flow_terrain_content.h"

namespace droplet {
namespace {

constexpr Vec3 kGravity{0.0, 0.0, -9.81};

struct Mesh {
    std::vector<Vec3> vertices;
    std::vector<Triangle> triangles;
};

/// A grid over [0, 1]², n by m cells, with heights.
template <typename Height>
Mesh gridOf(std::uint32_t n, std::uint32_t m, const Height& height)
{
    Mesh mesh;
    for (std::uint32_t j = 0; j <= m; ++j) {
        for (std::uint32_t i = 0; i <= n; ++i) {
            const double x = static_cast<double>(i) / n;
            const double y = static_cast<double>(j) / m;
            mesh.vertices.push_back({x, y, height(x, y)});
        }
    }
    for (std::uint32_t j = 0; j < m; ++j) {
        for (std::uint32_t i = 0; i < n; ++i) {
            const std::uint32_t a = j * (n + 1) + i;
            mesh.triangles.push_back({a, a + 1, a + n + 2});
            mesh.triangles.push_back({a, a + n + 2, a + n + 1});
        }
    }
    return mesh;
}

Mesh sphere(std::uint32_t rings, double radius)
{
    Mesh mesh;
    const std::uint32_t around = 2 * rings;
    for (std::uint32_t j = 0; j <= rings; ++j) {
        const double polar = std::numbers::pi * j / rings;
        for (std::uint32_t i = 0; i < around; ++i) {
            const double turn = 2.0 * std::numbers::pi * (i + 0.5 * (j % 2)) / around;
            const double s = j == 0 || j == rings ? 0.0 : std::sin(polar);
            const double c = j == 0 ? 1.0 : j == rings ? -1.0 : std::cos(polar);
            mesh.vertices.push_back({radius * s * std::cos(turn), radius * s * std::sin(turn), radius * c});
        }
    }
    for (std::uint32_t j = 0; j < rings; ++j) {
        for (std::uint32_t i = 0; i < around; ++i) {
            const std::uint32_t next = (i + 1) % around;
            const std::uint32_t a = j * around + i;
            const std::uint32_t b = j * around + next;
            const std::uint32_t c = (j + 1) * around + i;
            const std::uint32_t d = (j + 1) * around + next;
            if (j % 2 == 0) {
                mesh.triangles.push_back({a, c, b});
                mesh.triangles.push_back({b, c, d});
            } else {
                mesh.triangles.push_back({a, c, d});
                mesh.triangles.push_back({a, d, b});
            }
        }
    }
    return mesh;
}

WalkForces forces(double decay = 0.0)
{
    WalkForces f;
    f.acceleration = kGravity;
    f.fall = kGravity;
    f.decay = decay;
    f.adhesion = 1e9;
    f.contact_width = 2e-3;
    return f;
}

class Ground {
public:
    explicit Ground(const Mesh& mesh) : terrain(flowSurface(mesh.vertices, mesh.triangles)) {}

    /// A droplet on the face above or below (x, y).
    FlowDroplet dropletAt(const WalkForces& f, Vec2 at, Vec3 velocity = {}, bool on_top = true) const
    {
        for (std::uint32_t t = 0; t < surface.faces.size(); ++t) {
            const auto& face = surface.faces[t];
            if ((face.normal.z > 0.0) != on_top) {
                continue;
            }
            const double z = face.corners[0].z -
                             ((at.x - face.corners[0].x) * face.normal.x + (at.y - face.corners[0].y) * face.normal.y) /
                                 face.normal.z;
            const Vec3 p{at.x, at.y, z};
            bool inside = true;
            for (std::size_t k = 0; k < 3; ++k) {
                inside = inside && dot(p - face.corners[k], face.inward[k]) >= -1e-12;
            }
            if (inside) {
                FlowDroplet droplet;
                putOnFace({surface, landing}, f, droplet, t, {0.0, p, velocity, {}, 0.0});
                return droplet;
            }
        }
        throw std::logic_error("no face there");
    }

    double distance(const FlowDroplet& droplet, double time) const
    {
        const auto& face = surface.faces[droplet.face];
        const Vec3 p = droplet.leg.placeAt(time);
        double worst = std::abs(dot(p - face.corners[0], face.normal));
        for (std::size_t k = 0; k < 3; ++k) {
            worst = std::max(worst, -dot(p - face.corners[k], face.inward[k]));
        }
        return worst;
    }

    FlowTerrain terrain;
    const FlowSurface& surface = terrain.surface();
    const Landing& landing = terrain.content().landing;
};

TEST(Walk, IsTheFormulaOnASlopeHoweverFineItIsCut)
{
    const double slope = 30.0 * kDegree;
    const auto height = [&](double, double y) { return std::tan(slope) * y; };
    for (const auto& [n, m] : {std::pair{1U, 1U}, {4U, 3U}, {16U, 16U}, {100U, 130U}, {500U, 500U}}) {
        const Ground run(gridOf(n, m, height));
        for (const double decay : {0.0, 1.5, 20.0}) {
            const WalkForces f = forces(decay);
            FlowDroplet droplet = run.dropletAt(f, {0.313, 0.917}, {0.11, 0.0, 0.0});
            const Leg whole = droplet.leg;
            for (double time = 0.05; time < 0.45; time += 0.05) {
                walk({run.surface, run.landing}, f, droplet, time);
                ASSERT_EQ(droplet.contact, FlowContact::Face);
                EXPECT_LE(length(droplet.leg.placeAt(time) - whole.placeAt(time)), n == 1 ? 1e-12 : 1e-9)
                    << n << " at " << time;
            }
        }
    }
}

TEST(Walk, DoesNotDependOnTheFrames)
{
    const auto bumps = [](double x, double y) { return 0.4 * y + 0.02 * std::sin(19.0 * x) * std::cos(23.0 * y); };
    const Ground run(gridOf(60, 60, bumps));
    WalkForces f = forces(2.0);
    f.adhesion = 20.0;
    FlowDroplet once = run.dropletAt(f, {0.4, 0.9}, {0.3, 0.0, 0.0});
    FlowDroplet often = once;
    walk({run.surface, run.landing}, f, once, 1.0);
    for (int i = 1; i <= 777; ++i) {
        walk({run.surface, run.landing}, f, often, i / 777.0);
    }
    EXPECT_EQ(once.leg.place, often.leg.place);
    EXPECT_EQ(once.leg.velocity, often.leg.velocity);
    EXPECT_EQ(once.leg.begin, often.leg.begin);
}

TEST(Walk, StopsByHysteresisWhereCoulombsFrictionDoes)
{
    // Up a slope with v₀: v₀²/2(g sin + f). Retention holds it there.
    const double slope = 10.0 * kDegree;
    const Ground run(gridOf(7, 9, [&](double, double y) { return std::tan(slope) * y; }));
    WalkForces f = forces();
    f.sliding = 2.0;
    f.retention = 2.5;
    const double v = 1.2;
    FlowDroplet droplet = run.dropletAt(f, {0.3, 0.2}, {0.0, v * std::cos(slope), v * std::sin(slope)});
    const Vec3 start = droplet.leg.place;
    walk({run.surface, run.landing}, f, droplet, 5.0);
    EXPECT_EQ(droplet.contact, FlowContact::Still);
    const double way = v * v / (2.0 * (9.81 * std::sin(slope) + 2.0));
    EXPECT_NEAR(length(droplet.leg.placeAt(5.0) - start), way, 1e-9);
    // With less retention than its weight it slides back, with friction the other way.
    f.retention = f.sliding = 1.0;
    droplet = run.dropletAt(f, {0.3, 0.6});
    walk({run.surface, run.landing}, f, droplet, 0.5);
    EXPECT_NEAR(0.5 * (9.81 * std::sin(slope) - 1.0) * 0.25, (0.6 - droplet.leg.placeAt(0.5).y) / std::cos(slope),
                1e-12);
}

TEST(Walk, TurnsDownhillAsTheEquationOfMotionSays)
{
    const double slope = 40.0 * kDegree;
    const double down = 9.81 * std::sin(slope);
    WalkForces f = forces(1.5);
    f.sliding = 3.0;
    f.retention = 3.0;
    // Reference: dv/dt = F − f v/|v| − c v in small steps.
    Vec2 p;
    Vec2 v{0.5, 0.0};
    constexpr int kSteps = 200000;
    const double dt = 0.3 / kSteps;
    for (int i = 0; i < kSteps; ++i) {
        const Vec2 a = Vec2{0.0, -down} - (3.0 / length(v)) * v - 1.5 * v;
        v = v + dt * a;
        p = p + dt * v;
    }
    for (const std::uint32_t n : {1U, 8U, 60U}) {
        const Ground run(gridOf(n, n, [&](double, double y) { return std::tan(slope) * y; }));
        FlowDroplet droplet = run.dropletAt(f, {0.2, 0.9}, {0.5, 0.0, 0.0});
        walk({run.surface, run.landing}, f, droplet, 0.3);
        const Vec3 found = droplet.leg.placeAt(0.3);
        EXPECT_NEAR(found.x - 0.2, p.x, 5e-3 * length(p)) << n;
        EXPECT_NEAR((found.y - 0.9) / std::cos(slope), p.y, 5e-3 * length(p)) << n;
    }
}

TEST(Walk, KeepsItsEnergyOverConvexEdges)
{
    const Ground run(sphere(40, 0.1));
    const WalkForces f = forces();
    FlowDroplet droplet = run.dropletAt(f, {0.01, 0.003});
    const auto energy = [&](double time) {
        const Vec3 v = droplet.leg.velocityAt(time);
        return 0.5 * dot(v, v) + 9.81 * droplet.leg.placeAt(time).z;
    };
    const double start = energy(0.0);
    for (int i = 1; i <= 20; ++i) {
        walk({run.surface, run.landing}, f, droplet, 0.02 * i);
        ASSERT_EQ(droplet.contact, FlowContact::Face);
        EXPECT_NEAR(energy(0.02 * i), start, 1e-12);
    }
    EXPECT_LT(droplet.leg.placeAt(0.4).z, 0.0);
}

TEST(Walk, LeavesASphereWhereTheWeakerAdhesionFailsSooner)
{
    const Ground run(sphere(60, 0.1));
    double before = 1.0;
    for (const double adhesion : {0.0, 1.0, 3.0, 5.0, 9.0}) {
        WalkForces f = forces(400.0);  // slow, so that only weight pulls it off
        f.adhesion = adhesion;
        FlowDroplet droplet = run.dropletAt(f, {0.02, 0.007});
        double time = 0.0;
        while (droplet.contact != FlowContact::Air && time < 60.0) {
            walk({run.surface, run.landing}, f, droplet, time += 0.05);
        }
        ASSERT_EQ(droplet.contact, FlowContact::Air) << adhesion;
        const double z = droplet.leg.place.z / 0.1;
        EXPECT_LT(z, before) << adhesion;
        EXPECT_NEAR(z, -adhesion / 9.81, 0.06) << adhesion;  // g cos = adhesion
        before = z;
    }
}

// An upright sheet: 2 r σ π/4 (cos θ_r + 1) against the weight. What comes faster than this force stops over the radius
// falls off, and what hangs falls when it is heavier.
TEST(Walk, HangsAtAnOpenEdgeThatHoldsItsWeight)
{
    const FlowTerrain sheet(flowSurface({{-0.03, 0.0, 0.0}, {0.03, 0.0, 0.0}, {0.03, 0.0, 0.05}, {-0.03, 0.0, 0.05}},
                                        {{0, 1, 2}, {0, 2, 3}}));
    FlowParameters parameters;
    parameters.pinning.spread = 0.0;
    const Wetting& wetting = parameters.forces.wetting;
    const Liquid& liquid = parameters.forces.liquid;
    const double held = std::cos(wetting.contact_angle) + 0.5 * wetting.hysteresis + 1.0;
    // r of a droplet grows as the root of the weight's third part: both are equal at this volume.
    const double radius = capOf(1e-9, wetting.contact_angle).contact_radius;
    const double most = 1e-9 * std::pow(0.5 * std::numbers::pi * radius * liquid.surface_tension * held /
                                            (1e-9 * liquid.density * kStandardGravity),
                                        1.5);
    const auto after = [&](double volume, double height) {
        FlowState state = startFlow(sheet, parameters, {{{0.001, 0.0, height}, volume, {}}});
        return advanceFlow(std::move(state), sheet, parameters, 1.0);
    };
    const FlowState hangs = after(0.9 * most, 1e-6);
    ASSERT_EQ(hangs.droplets.size(), 1U);
    EXPECT_EQ(hangs.droplets[0].contact, FlowContact::Still);
    EXPECT_NEAR(hangs.droplets[0].leg.place.z, 0.0, 1e-9);
    EXPECT_EQ(after(1.1 * most, 1e-6).counts.launches, 1U);
    EXPECT_EQ(after(0.9 * most, 0.04).counts.launches, 1U) << "it comes fast";
    // Two that hang are one that falls.
    FlowState state =
        startFlow(sheet, parameters, {{{0.0, 0.0, 1e-6}, 0.7 * most, {}}, {{2e-3, 0.0, 1e-6}, 0.7 * most, {}}});
    state = advanceFlow(std::move(state), sheet, parameters, 1.0);
    EXPECT_EQ(state.counts.merged, 1U);
    EXPECT_EQ(state.counts.launches, 1U);
}

TEST(Walk, FallsOffTheBoundaryAndLandsBelow)
{
    Mesh mesh = gridOf(3, 3, [](double, double y) { return 1.0 + 0.5 * y; });
    const Mesh floor = gridOf(2, 2, [](double, double) { return 0.0; });
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const Vec3 p : floor.vertices) {
        mesh.vertices.push_back({4.0 * p.x - 2.0, 4.0 * p.y - 2.0, 0.0});
    }
    for (const auto& [a, b, c] : floor.triangles) {
        mesh.triangles.push_back({a + first, b + first, c + first});
    }
    const Ground run(mesh);
    EXPECT_EQ(run.surface.report.parts, 2U);
    const WalkForces f = forces();
    FlowDroplet droplet = run.dropletAt(f, {0.4, 0.3});
    const WalkCounts counts = walk({run.surface, run.landing}, f, droplet, 1.2);
    EXPECT_EQ(counts.launches, 1U);
    EXPECT_EQ(counts.landings, 1U);
    EXPECT_EQ(droplet.contact, FlowContact::Face);
    EXPECT_EQ(droplet.leg.placeAt(1.2).z, 0.0);
    // On the slope: a = g sin, then a parabola of 1 m, then straight on with the level velocity.
    const double slope = std::atan(0.5);
    const double along = 9.81 * std::sin(slope);
    const double length_on = 0.3 / std::cos(slope);
    const double t1 = std::sqrt(2.0 * length_on / along);
    const double v = along * t1;
    const double down = v * std::sin(slope);
    const double t2 = (-down + std::sqrt(down * down + 2.0 * 9.81)) / 9.81;
    const double level = v * std::cos(slope);
    EXPECT_NEAR(droplet.leg.placeAt(1.2).y, -level * (1.2 - t1), 1e-6);
    EXPECT_NEAR(droplet.leg.begin, t1 + t2, 1e-2);
}

TEST(Walk, GoesOnOverPartsThatTouch)
{
    // Strips of a slope, each cut in its own way, whose edges differ by the rounding of floats.
    const double slope = 30.0 * kDegree;
    Mesh mesh;
    for (std::uint32_t k = 0; k < 6; ++k) {
        const Mesh strip = gridOf(2 * k + 1, k % 3 + 1, [](double, double) { return 0.0; });
        const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
        for (const Vec3 p : strip.vertices) {
            const double y = (k + p.y) / 6.0 + (k % 2 == 0 ? 3e-8 : -3e-8) * std::sin(40.0 * p.x);
            mesh.vertices.push_back({p.x, y, std::tan(slope) * y + 3e-8 * std::cos(30.0 * p.x + k)});
        }
        for (const auto& [a, b, c] : strip.triangles) {
            mesh.triangles.push_back({a + first, b + first, c + first});
        }
    }
    const Ground run(mesh);
    ASSERT_EQ(run.surface.report.parts, 6U);
    const WalkForces f = forces(20.0);
    // Falls over five gaps of up to 6e-8 m, without friction as long as they take.
    const double gain = 5.0 * std::sqrt(2.0 * 6e-8 / 9.81) * 9.81 * std::sin(slope) / f.decay;
    for (int i = 1; i < 40; ++i) {
        FlowDroplet droplet = run.dropletAt(f, {i / 40.0, 0.97}, {0.05, 0.0, 0.0});
        const Leg whole = droplet.leg;
        walk({run.surface, run.landing}, f, droplet, 3.0);
        EXPECT_EQ(droplet.contact, FlowContact::Face) << i;
        EXPECT_LE(length(droplet.leg.placeAt(3.0) - whole.placeAt(3.0)), gain) << i;
    }
}

TEST(Walk, StaysOnFacesThatBendLessThanItsHeading)
{
    const Ground run(gridOf(10, 40, [](double x, double y) { return 0.6 * y + 0.02 * y * y + 0.01 * x * x; }));
    WalkForces f = forces(2.0);
    f.sliding = 0.5;
    f.retention = 0.5;
    FlowDroplet droplet = run.dropletAt(f, {0.4, 0.95});
    std::uint64_t crossings = 0;
    for (int k = 1; k < 50; ++k) {
        const double time = 0.01 * k;
        crossings += walk({run.surface, run.landing}, f, droplet, time).crossings;
        ASSERT_LE(run.distance(droplet, time), 1e-12);
    }
    EXPECT_GT(crossings, 10U);
}

TEST(Walk, RunsAlongAValley)
{
    const auto gutter = [](double x, double y) { return std::abs(x - 0.5) + 0.3 * y; };
    const Ground run(gridOf(2, 1, gutter));
    const WalkForces f = forces(3.0);
    FlowDroplet droplet = run.dropletAt(f, {0.7, 0.9});
    walk({run.surface, run.landing}, f, droplet, 0.9);
    EXPECT_EQ(droplet.contact, FlowContact::Edge);
    EXPECT_NEAR(droplet.leg.placeAt(0.9).x, 0.5, 1e-12);
    walk({run.surface, run.landing}, f, droplet, 5.0);
    EXPECT_EQ(droplet.contact, FlowContact::Air);
    EXPECT_LT(droplet.leg.place.y, 1e-9);
}

TEST(Walk, RestsInAPit)
{
    const auto pit = [](double x, double y) { return std::max(std::abs(x - 0.5), std::abs(y - 0.5)); };
    const Ground run(gridOf(4, 4, pit));
    const WalkForces f = forces(3.0);
    FlowDroplet droplet = run.dropletAt(f, {0.8, 0.63});
    walk({run.surface, run.landing}, f, droplet, 30.0);
    EXPECT_EQ(droplet.contact, FlowContact::Still);
    EXPECT_NEAR(length(droplet.leg.placeAt(30.0) - Vec3{0.5, 0.5, 0.0}), 0.0, 1e-9);
}

TEST(Walk, NeverLeavesTheSurfaceOverAMillionCrossings)
{
    Mesh mesh = sphere(70, 0.1);
    for (Vec3& p : mesh.vertices) {
        p = (1.0 + 0.01 * std::sin(170.0 * p.x) * std::cos(130.0 * p.y + 90.0 * p.z)) * p;
    }
    const Ground run(mesh);
    const WalkForces f = forces();
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(-0.05, 0.05);
    std::uint64_t crossings = 0;
    std::uint64_t stuck = 0;
    for (int i = 0; crossings < 1'000'000; ++i) {
        ASSERT_LT(i, 10000);
        FlowDroplet droplet = run.dropletAt(f, {uniform(random), uniform(random)}, {30.0 * uniform(random), 1.0, 0.0});
        for (int k = 1; k <= 30; ++k) {
            const WalkCounts counts = walk({run.surface, run.landing}, f, droplet, 0.02 * k);
            crossings += counts.crossings;
            stuck += counts.stuck;
            ASSERT_NE(droplet.contact, FlowContact::Air) << i;
            ASSERT_LE(run.distance(droplet, 0.02 * k), 1e-10) << i;
        }
    }
    EXPECT_GE(crossings, 1'000'000U);
    EXPECT_EQ(stuck, 0U);
}

TEST(FlowSurface, TurnsPartsToFaceOutward)
{
    Mesh mesh = sphere(10, 1.0);
    const std::size_t whole = mesh.triangles.size();
    for (std::size_t t = 0; t < whole; t += 3) {
        std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
    }
    const FlowSurface surface = flowSurface(mesh.vertices, mesh.triangles);
    EXPECT_EQ(surface.report.parts, 1U);
    EXPECT_EQ(surface.report.boundary_edges, 0U);
    EXPECT_GT(surface.report.turned, 0U);
    EXPECT_EQ(surface.report.inside_out, 0U) << "single triangles";
    for (std::size_t t = 0; t < whole; ++t) {
        std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
    }
    const FlowSurfaceReport inside_out = flowSurface(mesh.vertices, mesh.triangles).report;
    EXPECT_GT(inside_out.turned, whole / 2);
    EXPECT_EQ(inside_out.inside_out, inside_out.turned) << "most of the ball faced inward";
    for (const auto& face : surface.faces) {
        EXPECT_GT(dot(face.normal, face.corners[0]), 0.0);
        for (std::size_t k = 0; k < 3; ++k) {
            const auto& back = surface.faces[face.neighbour[k]].neighbour;
            EXPECT_NE(std::count(back.begin(), back.end(), static_cast<std::uint32_t>(&face - surface.faces.data())),
                      0);
        }
    }
}

TEST(FlowSurface, LeavesOutWhatHasNoArea)
{
    Mesh mesh = gridOf(2, 2, [](double, double) { return 0.0; });
    mesh.triangles.push_back({0, 0, 1});
    mesh.triangles.push_back({0, 1, 2});  // in one line
    mesh.triangles.push_back(mesh.triangles[0]);
    const FlowSurface surface = flowSurface(mesh.vertices, mesh.triangles);
    EXPECT_EQ(surface.faces.size(), 8U);
    EXPECT_EQ(surface.report.without_area, 2U);
    EXPECT_EQ(surface.report.duplicates, 1U);
    EXPECT_THROW(flowSurface(mesh.vertices, {{0, 0, 1}}), Error);
}

}  // namespace
}  // namespace droplet
