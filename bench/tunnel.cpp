// SPDX-License-Identifier: GPL-3.0-or-later
// Times and errors of the wind tunnel's sweeps and of one droplet's trace, as tables in Markdown:
//
//   bench_tunnel [--points=N]
//
// Hemispheres in a boundary layer with n = ½ have closed forms, which are evaluated in long double.
#include "droplet/wind/tunnel.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <functional>
#include <numbers>
#include <string_view>
#include <vector>

#include "droplet/wind/trace.h"

namespace {

using namespace droplet;

constexpr double kPi = std::numbers::pi;

/// Median and half the range of seven runs.
struct Times {
    double median = 0.0;  ///< [s]
    double spread = 0.0;
};

Times timed(const std::function<void()>& work)
{
    std::vector<double> times;
    for (int run = 0; run < 7; ++run) {
        const auto start = std::chrono::steady_clock::now();
        work();
        times.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    }
    std::sort(times.begin(), times.end());
    return {times[3], 0.5 * (times.back() - times.front())};
}

std::vector<double> spaced(double from, double to, std::size_t count)
{
    std::vector<double> values;
    for (std::size_t k = 0; k < count; ++k) {
        values.push_back(from + (to - from) * static_cast<double>(k) /
                                    static_cast<double>(std::max<std::size_t>(1, count - 1)));
    }
    return values;
}

TunnelSweep hemispheres()
{
    TunnelSweep swept;
    swept.model.wetting.contact_angle = 0.5 * kPi;
    swept.model.air.boundary_layer = 20e-3;
    return swept;
}

struct Errors {
    double thresholds = 0.0;     ///< largest error, relative to the upper threshold
    double accelerations = 0.0;  ///< largest error, relative to g
};

Errors errorsOf(const TunnelSweep& swept, const Tunnel& found)
{
    using Real = long double;
    const Real pi = std::numbers::pi_v<Real>;
    const ForceModel& model = swept.model;
    const Real g = model.gravity;
    Errors errors;
    const auto raise = [](double& max, Real error) { max = std::max(max, static_cast<double>(std::abs(error))); };
    for (std::size_t c = 0; c < found.cases.size(); ++c) {
        const TunnelCase& of = found.cases[c];
        const Real radius = std::cbrt(static_cast<Real>(of.cap.volume) * 3 / (2 * pi));
        const Real weight = g * std::sin(static_cast<Real>(of.slope));
        const Real held =
            Real{0.75L} * model.liquid.surface_tension * of.hysteresis / (model.liquid.density * radius * radius);
        const Real drag = Real{0.375L} * model.air.density * model.air.drag_coefficient /
                          (model.liquid.density * static_cast<Real>(model.air.boundary_layer));
        const Real upper = std::sqrt((weight + held) / drag);
        raise(errors.thresholds, (of.thresholds.upper.value_or(0.0) - upper) / upper);
        if (weight > held) {
            // The error is relative to the upper threshold, because the lower one may be almost 0.
            raise(errors.thresholds, (of.thresholds.lower.value_or(0.0) - std::sqrt((weight - held) / drag)) / upper);
        }
        for (std::size_t w = 0; w < found.winds.size(); ++w) {
            const Real driving = drag * found.winds[w] * found.winds[w] - weight;
            const Real rate = std::abs(driving) <= held ? 0 : driving - std::copysign(held, driving);
            raise(errors.accelerations, (found.rows[c * found.winds.size() + w].acceleration - rate) / g);
        }
    }
    return errors;
}

void sweeps(std::size_t points)
{
    std::printf(
        "| sweep | points | 1 thread | 2 threads | error of thresholds | error of accelerations, relative to g |\n");
    std::printf("| --- | ---: | ---: | ---: | ---: | ---: |\n");
    const auto side = static_cast<std::size_t>(std::sqrt(static_cast<double>(points)));
    const auto root = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(side))));
    struct Shape {
        const char* name;
        std::size_t volumes, winds, slopes, hystereses;
    };
    for (const Shape& shape : {Shape{"volumes × winds", side, side, 1, 1},
                               Shape{"volumes × winds × slopes × hystereses", root, root, root, root},
                               Shape{"volumes, at one wind", points, 1, 1, 1}}) {
        TunnelSweep swept = hemispheres();
        swept.volumes = spaced(1e-9, 100e-9, shape.volumes);
        swept.winds = spaced(0.0, 25.0, shape.winds);
        swept.slopes = spaced(0.3, 1.2, shape.slopes);
        swept.hystereses = spaced(0.05, 0.5, shape.hystereses);
        Tunnel found;
        Times times[2];
        for (std::size_t threads = 1; threads <= 2; ++threads) {
            const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
            times[threads - 1] = timed([&] { found = sweep(swept); });
        }
        const Errors errors = errorsOf(swept, found);
        std::printf("| %s | %zu | %.1f ± %.1f ms | %.1f ± %.1f ms | %.0e | %.0e |\n", shape.name, found.rows.size(),
                    1e3 * times[0].median, 1e3 * times[0].spread, 1e3 * times[1].median, 1e3 * times[1].spread,
                    errors.thresholds, errors.accelerations);
    }
}

/// Velocity of a droplet that climbs during all gusts: k (U + A sin ωt)² against viscous drag.
double climbing(const DropletForces& forces, double slope, const Gust& wind, double time)
{
    const double k = forces.drag / forces.mass;
    const double l = forces.viscous / forces.mass;
    const double w = 2.0 * kPi / wind.period;
    const double steady = k * (wind.mean * wind.mean + 0.5 * wind.amplitude * wind.amplitude) -
                          (forces.weight * std::sin(slope) + forces.sliding_friction) / forces.mass;
    const double first = 2.0 * k * wind.mean * wind.amplitude;
    const double second = -0.5 * k * wind.amplitude * wind.amplitude;
    const auto particular = [&](double t) {
        return steady / l + first * (l * std::sin(w * t) - w * std::cos(w * t)) / (l * l + w * w) +
               second * (l * std::cos(2.0 * w * t) + 2.0 * w * std::sin(2.0 * w * t)) / (l * l + 4.0 * w * w);
    };
    return particular(time) - particular(0.0) * std::exp(-l * time);
}

void traces()
{
    std::printf(
        "\n| tolerance, in gusts | steps per period | time per step | error of velocity, relative to the largest |\n");
    std::printf("| ---: | ---: | ---: | ---: |\n");
    const ForcePreset& preset = forcePresetNamed("thesis");
    const DropletForces forces = forcesOn(preset.model, preset.reference_volume);
    const Gust wind{15.0, 1.5, 0.4};
    for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-10}) {
        MotionOptions options;
        options.duration = 40.0;
        options.interval = 0.37;  // not a multiple of the gusts' period
        options.tolerance = tolerance;
        Motion found;
        const Times times = timed([&] { found = traceMotion(forces, preset.slope, wind, options); });
        double error = 0.0;
        double fastest = 0.0;
        for (const MotionPoint& point : found.points) {
            error = std::max(error, std::abs(point.velocity - climbing(forces, preset.slope, wind, point.time)));
            fastest = std::max(fastest, std::abs(point.velocity));
        }
        std::printf("| %.0e | %.0f | %.2f ± %.2f µs | %.0e |\n", tolerance,
                    static_cast<double>(found.steps) / (options.duration / wind.period),
                    1e6 * times.median / static_cast<double>(found.steps),
                    1e6 * times.spread / static_cast<double>(found.steps), error / fastest);
    }
}

}  // namespace

int main(int argc, char** argv)
{
    std::size_t points = 1'000'000;
    constexpr std::string_view kPoints = "--points=";
    if (argc == 2 && std::string_view(argv[1]).starts_with(kPoints)) {
        points = std::strtoull(argv[1] + kPoints.size(), nullptr, 10);
    } else if (argc != 1) {
        std::fputs("usage: bench_tunnel [--points=N]\n", stderr);
        return 2;
    }
    try {
        sweeps(std::max<std::size_t>(1, points));
        traces();
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "bench_tunnel: %s\n", error.what());
        return 1;
    }
}
