// SPDX-License-Identifier: GPL-3.0-or-later
// Times of 2D liquids, as tables in Markdown:
//
//   bench_liquid2d [--quick]
//
// 1. Steps of a breaking dam of 1000 to 300 000 particles, their number a frame, and the outlines around them.
// 2. Frames of 20 000 particles of all presets: simulation and outlines, by both solvers, on one and two cores.
//
// Errors beside the times: the mean compression that a step leaves, and the area of the outlines against that of the
// particles.
#include <tbb/global_control.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <exception>
#include <utility>
#include <vector>

#include "droplet/expression/expression.h"
#include "droplet/liquid2d/fluid.h"
#include "droplet/liquid2d_io/fluid_presets.h"

namespace {

using namespace droplet;

double now()
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Times of a run of frames and what they leave.
struct Measured {
    std::size_t particles = 0;
    double steps = 0.0;        ///< per frame
    double iterations = 0.0;   ///< of the pressures, per step
    double step = 0.0;         ///< time of a step [s]
    double surface = 0.0;      ///< time of a frame's outlines [s]
    double compression = 0.0;  ///< mean of all frames
    double area = 0.0;         ///< of the outlines over that of the particles, at the end
};

const char* nameOf(PressureSolver solver)
{
    return solver == PressureSolver::Grid ? "grid" : "dfsph";
}

/// Scene with another number of particles.
FluidScene withParticles(FluidScene scene, std::size_t count)
{
    // A scene of emitters alone begins without particles.
    const double now_there = static_cast<double>(std::max<std::size_t>(startFluid(scene).position.size(), 1));
    scene.max_particles = std::max<std::size_t>(2 * count, scene.max_particles);
    if (!scene.liquid.empty()) {
        scene.spacing *= std::sqrt(now_there / static_cast<double>(count));
    }
    return scene;
}

Measured measure(const FluidScene& scene, PressureSolver solver, const ExpressionOptions& controls, double settling,
                 int frames)
{
    constexpr double kRate = 24.0;
    FluidOptions options;
    options.solver = solver;
    FluidState state = startFluid(scene);
    ExpressionState surface;
    FluidStepper stepper(scene, options);
    state = stepper.advance(std::move(state), settling);
    Measured measured;
    const FluidCounts before = state.counts;
    double simulation = 0.0;
    for (int k = 1; k <= frames; ++k) {
        const double begin = now();
        state = stepper.advance(std::move(state), settling + k / kRate);
        const double middle = now();
        const ParticleFrame frame = frameOf(state, scene);
        surface = advanceExpression(std::move(surface), frame, controls);
        const LiquidShape shape = liquidShape(surface, frame, controls);
        surface = remember(std::move(surface), shape);
        measured.surface += (now() - middle) / frames;
        simulation += middle - begin;
        measured.compression += state.density_error / frames;
        measured.area = shape.area() / (static_cast<double>(frame.position.size()) * scene.spacing * scene.spacing);
    }
    const auto steps = static_cast<double>(state.counts.steps - before.steps);
    measured.particles = state.position.size();
    measured.steps = steps / frames;
    measured.step = simulation / steps;
    measured.iterations = static_cast<double>(state.counts.divergence_iterations + state.counts.density_iterations -
                                              before.divergence_iterations - before.density_iterations) /
                          steps;
    return measured;
}

void timeSteps(PressureSolver solver, bool is_quick)
{
    std::puts(
        "| particles | threads | steps per frame | iterations | step | per particle | outlines | share of a step | "
        "compression |");
    std::puts("| ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |");
    const ExpressionOptions controls = expressionOf(LiquidStyle::Realistic);
    for (const std::size_t threads : {1U, 2U}) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        Vec2 first{};
        Vec2 last{};
        for (const std::size_t count : {1000U, 3000U, 10000U, 30000U, 100000U, 300000U}) {
            if (is_quick && count > 3000) {
                break;
            }
            const FluidScene scene = withParticles(fluidPresetNamed("dam").scene, count);
            // The same number of steps, about, from the same moment.
            const Measured m = measure(scene, solver, controls, count > 30000 ? 0.05 : 0.2, count > 30000 ? 1 : 6);
            last = {std::log(static_cast<double>(m.particles)), std::log(m.step)};
            first = count == 1000 ? last : first;
            std::printf("| %zu | %zu | %.0f | %.1f | %.2f ms | %.2f µs | %.2f ms | %.0f %% | %.1e |\n", m.particles,
                        threads, m.steps, m.iterations, 1e3 * m.step, 1e6 * m.step / static_cast<double>(m.particles),
                        1e3 * m.surface, 100.0 * m.surface / m.step, m.compression);
            std::fflush(stdout);
        }
        std::printf("\nExponent, %zu thread%s: %.2f\n\n", threads, threads == 1 ? "" : "s",
                    (last.y - first.y) / (last.x - first.x));
    }
}

void timeFrames(bool is_quick)
{
    std::puts(
        "| preset | solver | threads | particles | steps per frame | simulation per frame | outlines per frame | "
        "frames/s "
        "| area |");
    std::puts("| --- | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |");
    for (const FluidPreset& preset : fluidPresets()) {
        const FluidScene scene = withParticles(preset.scene, is_quick ? 1000 : 20000);
        const ExpressionOptions controls = expressionOf(liquidStyleNamed(preset.style));
        for (const PressureSolver solver : {PressureSolver::Grid, PressureSolver::Dfsph}) {
            for (const std::size_t threads : {1U, 2U}) {
                const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
                const Measured m = measure(scene, solver, controls, 0.0, is_quick ? 4 : 24);
                std::printf("| %s | %s | %zu | %zu | %.1f | %.0f ms | %.1f ms | %.1f | %.3f |\n", preset.name.c_str(),
                            nameOf(solver), threads, m.particles, m.steps, 1e3 * m.step * m.steps, 1e3 * m.surface,
                            1.0 / (m.step * m.steps + m.surface), m.area);
                std::fflush(stdout);
            }
        }
    }
}

}  // namespace

int main(int argc, char** argv)
{
    try {
        const bool is_quick = argc > 1 && std::strcmp(argv[1], "--quick") == 0;
        for (const PressureSolver solver : {PressureSolver::Grid, PressureSolver::Dfsph}) {
            std::printf("%s:\n\n", nameOf(solver));
            timeSteps(solver, is_quick);
        }
        timeFrames(is_quick);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "bench_liquid2d: %s\n", error.what());
        return 1;
    }
    return 0;
}
