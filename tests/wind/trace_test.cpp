// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/wind/trace.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "droplet/error.h"

namespace droplet {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr double kPi = std::numbers::pi;
constexpr double kSlope = 35.0 * kDegree;

double between(std::mt19937_64& random, double from, double to)
{
    return from + (to - from) * static_cast<double>(random() >> 11U) * 0x1p-53;
}

DropletForces measured(double kinetic_fraction = 1.0, double viscosity_factor = kArtisticViscosityFactor)
{
    ForceModel model = forcePresetNamed("hashimoto").model;
    model.wetting.kinetic_fraction = kinetic_fraction;
    model.wetting.viscosity_factor = viscosity_factor;
    return forcesOn(model, 30e-9);
}

// v = v∞ (1 − e^(−t/τ)), x = v∞ (t − τ (1 − e^(−t/τ))), τ = m/c.
TEST(Trace, MatchesTheClosedFormInASteadyWind)
{
    for (const double factor : {0.5, 0.045}) {
        const DropletForces forces = measured(1.0, factor);
        const Motion found = traceMotion(forces, kSlope, {}, {4.0, 0.1});
        const double terminal = *terminalVelocity(forces, drivingForce(forces, kSlope, 0.0));
        const double tau = forces.mass / forces.viscous;
        ASSERT_THAT(found.points, SizeIs(41));
        for (const MotionPoint& point : found.points) {
            const double share = -std::expm1(-point.time / tau);
            EXPECT_NEAR(point.velocity, terminal * share, 1e-13);
            EXPECT_NEAR(point.position, terminal * (point.time - tau * share), 1e-13);
            EXPECT_NEAR(point.acceleration, terminal / tau * (1.0 - share), 1e-11);
        }
        EXPECT_NEAR(found.points.back().velocity, terminal, 1e-5);
        EXPECT_THAT(found.events, IsEmpty());
    }
}

TEST(Trace, WithoutViscosityFallsFreelyUnderFriction)
{
    const DropletForces forces = measured(1.0, 0.0);
    const double rate = acceleration(forces, drivingForce(forces, kSlope, 0.0), 0.0);
    const MotionPoint last = traceMotion(forces, kSlope, {}, {0.5, 0.125}).points.back();
    EXPECT_DOUBLE_EQ(last.time, 0.5);
    EXPECT_NEAR(last.velocity, 0.5 * rate, 1e-14);
    EXPECT_NEAR(last.position, 0.125 * rate, 1e-14);
}

TEST(Trace, PushedDropletInTheStillBandStopsAtTheClosedForm)
{
    const DropletForces forces = measured();
    MotionOptions options{0.5, 0.01};
    options.velocity = 0.3;
    const Motion found = traceMotion(forces, kSlope, {9.0}, options);
    // m v' = −G − c v until v = 0: t = τ ln(1 + c v₀/G).
    const double brake = forces.sliding_friction - drivingForce(forces, kSlope, 9.0);
    const double tau = forces.mass / forces.viscous;
    ASSERT_THAT(found.events, SizeIs(1));
    EXPECT_FALSE(found.events[0].moves);
    EXPECT_NEAR(found.events[0].time, tau * std::log1p(forces.viscous * 0.3 / brake), 1e-14);
    EXPECT_EQ(found.points.back().velocity, 0.0);
    EXPECT_EQ(found.points.back().acceleration, 0.0);
    EXPECT_NEAR(found.points.back().position,
                tau * 0.3 - tau * brake / forces.viscous * std::log1p(forces.viscous * 0.3 / brake), 1e-14);
}

TEST(Trace, DropletThrownUpTurnsAndRunsDown)
{
    MotionOptions options{1.0, 0.01};
    options.velocity = 0.5;
    const Motion found = traceMotion(measured(), kSlope, {}, options);
    EXPECT_THAT(found.events, IsEmpty()) << "friction does not hold it at the turn";
    EXPECT_GT(found.points[1].velocity, 0.0);
    const DropletForces forces = measured();
    EXPECT_NEAR(found.points.back().velocity, *terminalVelocity(forces, drivingForce(forces, kSlope, 0.0)), 1e-6);
    const auto highest =
        std::max_element(found.points.begin(), found.points.end(),
                         [](const MotionPoint& a, const MotionPoint& b) { return a.position < b.position; });
    EXPECT_GT(highest->position, 0.0);
}

TEST(Trace, WithinTheStillBandNothingMoves)
{
    const Motion found = traceMotion(measured(), kSlope, {9.0, 0.5, 0.3}, {2.0, 0.1});
    EXPECT_THAT(found.events, IsEmpty());
    for (const MotionPoint& point : found.points) {
        EXPECT_EQ(point.position, 0.0);
        EXPECT_EQ(point.velocity, 0.0);
    }
}

/// Closed form of a droplet that always climbs: D = k (U + A sin ωt)² is a constant, a sine and a cosine.
struct Climbing {
    const DropletForces& forces;
    Gust wind;

    [[nodiscard]] double velocity(double time) const
    {
        const double k = forces.drag / forces.mass;
        const double l = forces.viscous / forces.mass;
        const double w = 2.0 * kPi / wind.period;
        const double steady = k * (wind.mean * wind.mean + 0.5 * wind.amplitude * wind.amplitude) -
                              (forces.weight * std::sin(kSlope) + forces.sliding_friction) / forces.mass;
        const double first = 2.0 * k * wind.mean * wind.amplitude;
        const double second = -0.5 * k * wind.amplitude * wind.amplitude;
        // v' = −l v + steady + first sin wt + second cos 2wt
        const auto particular = [&](double t) {
            return steady / l + first * (l * std::sin(w * t) - w * std::cos(w * t)) / (l * l + w * w) +
                   second * (l * std::cos(2.0 * w * t) + 2.0 * w * std::sin(2.0 * w * t)) / (l * l + 4.0 * w * w);
        };
        return particular(time) - particular(0.0) * std::exp(-l * time);
    }
};

TEST(Trace, ConvergesWithFourthOrderInAGust)
{
    const DropletForces forces = measured();
    const Climbing exact{forces, {14.0, 1.0, 0.4}};
    const auto error = [&](double step) {
        MotionOptions options{0.4, 0.1};
        options.fixed_step = step;
        double max = 0.0;
        for (const MotionPoint& point : traceMotion(forces, kSlope, exact.wind, options).points) {
            max = std::max(max, std::abs(point.velocity - exact.velocity(point.time)));
        }
        return max;
    };
    // Steps end at the turns of the gust, which are multiples of these steps.
    double coarse = error(0.1 / 4);
    for (const double parts : {8.0, 16.0, 32.0}) {
        const double fine = error(0.1 / parts);
        EXPECT_NEAR(std::log2(coarse / fine), 4.0, 0.25) << parts;
        coarse = fine;
    }
}

TEST(Trace, KeepsItsToleranceInAGust)
{
    const DropletForces forces = measured();
    const Climbing exact{forces, {14.0, 1.0, 0.4}};
    std::size_t steps = 0;
    for (const double tolerance : {1e-5, 1e-7, 1e-9}) {
        MotionOptions options{4.0, 0.05};
        options.tolerance = tolerance;
        const Motion found = traceMotion(forces, kSlope, exact.wind, options);
        EXPECT_GT(found.steps, steps);
        steps = found.steps;
        for (const MotionPoint& point : found.points) {
            // Viscosity damps the errors of earlier steps, so they do not add up.
            EXPECT_NEAR(point.velocity, exact.velocity(point.time), 10.0 * tolerance) << tolerance;
        }
    }
}

// Stick–slip: a droplet climbs in gusts above the upper threshold and rests in lulls.
TEST(Trace, DropletSticksAndSlipsOncePerGust)
{
    std::mt19937_64 random(9);
    for (int k = 0; k < 30; ++k) {
        const DropletForces forces = measured(between(random, 0.5, 1.0), between(random, 0.1, 1.0));
        const double period = between(random, 0.5, 2.0);
        const Gust wind{9.3, 2.0, period};  // the still band is 7.7 to 10.5 m/s: the mean is in it, the peak above
        const double weight = forces.weight * std::sin(kSlope);
        const Motion found = traceMotion(forces, kSlope, wind, {5.0 * period, period / 200.0});
        ASSERT_GE(found.events.size(), 9U);
        double release = 0.0;
        for (std::size_t e = 0; e < found.events.size(); ++e) {
            const double time = found.events[e].time;
            EXPECT_EQ(found.events[e].moves, e % 2 == 0);
            const double drag = forces.drag * wind.at(time) * wind.at(time);
            if (found.events[e].moves) {
                release = std::sqrt((weight + forces.retention) / forces.drag);
                const bool up = drag > weight;
                EXPECT_NEAR(drag, up ? weight + forces.retention : weight - forces.retention, 1e-9 * weight);
            } else {
                EXPECT_LE(std::abs(drag - weight), forces.retention);
            }
        }
        EXPECT_GT(release, 0.0);
        for (const MotionPoint& point : found.points) {
            const double drag = forces.drag * point.wind * point.wind;
            if (point.velocity == 0.0 && point.acceleration == 0.0) {
                EXPECT_LE(std::abs(drag - weight), forces.retention * (1.0 + 1e-12));
            }
        }
    }
}

// The times of events must not depend on the interval of the series.
TEST(Trace, IsTheSameAtAnyInterval)
{
    const DropletForces forces = measured(0.7);
    const Gust wind{9.3, 3.0, 0.7};
    const Motion often = traceMotion(forces, kSlope, wind, {2.8, 0.01});
    const Motion seldom = traceMotion(forces, kSlope, wind, {2.8, 0.7});
    ASSERT_EQ(often.events.size(), seldom.events.size());
    for (std::size_t e = 0; e < often.events.size(); ++e) {
        EXPECT_NEAR(often.events[e].time, seldom.events[e].time, 1e-7);
    }
    ASSERT_THAT(seldom.points, SizeIs(5));
    for (std::size_t k = 0; k < seldom.points.size(); ++k) {
        EXPECT_NEAR(often.points[70 * k].position, seldom.points[k].position, 1e-8);
        EXPECT_NEAR(often.points[70 * k].velocity, seldom.points[k].velocity, 1e-7);
    }
}

// A droplet of a picolitre stops in less than a microsecond: a stiff equation.
TEST(Trace, TakesFewStepsAtAnyViscosity)
{
    ForceModel model = forcePresetNamed("hashimoto").model;
    model.wetting.hysteresis = 0.0;
    model.wetting.viscosity_factor = 0.5;
    const DropletForces forces = forcesOn(model, 1e-15);
    const Motion found = traceMotion(forces, kSlope, {14.0, 1.0, 0.4}, {1.0, 0.1});
    EXPECT_LT(found.steps + found.rejected, 20'000U);
    for (std::size_t k = 1; k < found.points.size(); ++k) {
        const MotionPoint& point = found.points[k];
        const double terminal = *terminalVelocity(forces, drivingForce(forces, kSlope, point.wind));
        EXPECT_NEAR(point.velocity / terminal, 1.0, 1e-4) << "quasi-steady";
    }
}

TEST(Trace, RejectsFieldsOutOfRange)
{
    const auto expect_refused = [](const std::string& field, const std::function<void(MotionOptions&, Gust&)>& spoil) {
        MotionOptions options;
        Gust wind;
        spoil(options, wind);
        try {
            traceMotion(measured(), kSlope, wind, options);
            ADD_FAILURE() << field;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::InvalidArgument);
            EXPECT_THAT(error.what(), HasSubstr(field));
        }
    };
    expect_refused("duration", [](MotionOptions& o, Gust&) { o.duration = 0.0; });
    expect_refused("interval", [](MotionOptions& o, Gust&) { o.interval = -1.0; });
    expect_refused("interval", [](MotionOptions& o, Gust&) { o.interval = 1e-9; });
    expect_refused("velocity", [](MotionOptions& o, Gust&) { o.velocity = std::nan(""); });
    expect_refused("tolerance", [](MotionOptions& o, Gust&) { o.tolerance = 0.0; });
    expect_refused("fixed_step", [](MotionOptions& o, Gust&) { o.fixed_step = 0.0; });
    expect_refused("wind.mean", [](MotionOptions&, Gust& w) { w.mean = std::nan(""); });
    expect_refused("wind.amplitude", [](MotionOptions&, Gust& w) { w.amplitude = -1.0; });
    expect_refused("wind.period", [](MotionOptions&, Gust& w) { w.period = 0.0; });
    expect_refused("wind.period", [](MotionOptions&, Gust& w) { w = {9.0, 1.0, 1e-6}; });
}

}  // namespace
}  // namespace droplet
