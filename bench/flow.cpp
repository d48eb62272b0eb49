// SPDX-License-Identifier: GPL-3.0-or-later
// Times of droplets on meshes, as tables in Markdown:
//
//   bench_flow [--quick]
//
// 1. Droplets that traverse a slope of 2 to 500 000 triangles (Fournier, Habibi and Poulin 1998, table 1).
// 2. Frames of 1000 to 100 000 droplets that merge, on 100 000 triangles, at the same number per area (table 2): motion
//    and shapes.
// 3. The small scene of the paper: 1000 droplets on 512 triangles for 48 frames, and with hysteresis and pinning.
#include "droplet/flow/flow.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <exception>
#include <utility>
#include <vector>

#include "droplet/body/droplet_body.h"
#include "droplet/flow/scatter.h"
#include "droplet/flow_io/droplet_surfaces.h"
#include "droplet/units.h"

namespace {

using namespace droplet;

constexpr double kSlope = 30.0 * kDegree;

double now()
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double median(std::vector<double> values)
{
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

Vec3 onSlope(double x, double y)
{
    return {x, y, std::tan(kSlope) * y};
}

/// A square slope of 2 cells² triangles.
FlowTerrain slope(double side, std::uint32_t cells)
{
    std::vector<Vec3> vertices;
    std::vector<Triangle> triangles;
    for (std::uint32_t j = 0; j <= cells; ++j) {
        for (std::uint32_t i = 0; i <= cells; ++i) {
            vertices.push_back(onSlope(side * i / cells, side * j / cells));
        }
    }
    for (std::uint32_t j = 0; j < cells; ++j) {
        for (std::uint32_t i = 0; i < cells; ++i) {
            const std::uint32_t a = j * (cells + 1) + i;
            triangles.push_back({a, a + 1, a + cells + 2});
            triangles.push_back({a, a + cells + 2, a + cells + 1});
        }
    }
    return FlowTerrain(flowSurface(vertices, triangles));
}

/// Slope of the line with the least squares of errors.
double slopeOf(const std::vector<Vec2>& points)
{
    Vec2 mean;
    for (const Vec2 p : points) {
        mean = mean + (1.0 / static_cast<double>(points.size())) * p;
    }
    double along = 0.0;
    double across = 0.0;
    for (const Vec2 p : points) {
        along += (p.x - mean.x) * (p.y - mean.y);
        across += (p.x - mean.x) * (p.x - mean.x);
    }
    return along / across;
}

/// Droplets run at up to about 6 cm/s.
FlowParameters running()
{
    FlowParameters parameters;
    parameters.model = FlowModel::Paper;
    parameters.friction = 16e-4;
    parameters.adhesion = 1e6;
    return parameters;
}

void timeTraversal()
{
    std::puts("| triangles | edges crossed | time per droplet | per edge |");
    std::puts("| ---: | ---: | ---: | ---: |");
    constexpr int kDroplets = 1000;
    constexpr double kSide = 0.3;
    for (const std::uint32_t cells : {1U, 2U, 4U, 8U, 16U, 50U, 158U, 500U}) {
        const FlowTerrain terrain = slope(kSide, cells);
        FlowParameters parameters = running();
        parameters.merges = false;
        std::vector<FlowStart> starts;
        for (int k = 0; k < kDroplets; ++k) {
            starts.push_back({onSlope(kSide * (k + 0.37) / kDroplets, 0.99 * kSide), 20e-9, {}});
        }
        std::vector<double> times;
        double crossings = 0.0;
        for (int run = 0; run < 5; ++run) {
            FlowState state = startFlow(terrain, parameters, starts);
            const double begin = now();
            while (state.counts.launches < kDroplets) {
                state = advanceFlow(std::move(state), terrain, parameters, state.time + 0.5);
            }
            times.push_back((now() - begin) / kDroplets);
            crossings = static_cast<double>(state.counts.crossings) / kDroplets;
        }
        const double time = median(times);
        std::printf("| %u | %.0f | %.1f µs | %.0f ns |\n", 2 * cells * cells, crossings, 1e6 * time,
                    1e9 * time / crossings);
        std::fflush(stdout);
    }
}

void timeFrames(bool is_quick)
{
    constexpr double kRate = 24.0;
    constexpr int kSettling = 2;
    constexpr int kFrames = 15;
    constexpr double kPerSquareMetre = 5000.0;
    constexpr double kOverlapping = 1.15;  // droplets that touch at the start merge at once
    const DropletBodies bodies(BodyShape::Capillary);
    std::puts("\n| droplets | slope | threads | motion per frame | per droplet | frames/s | shapes per frame |");
    std::puts("| ---: | ---: | ---: | ---: | ---: | ---: | ---: |");
    for (const std::size_t threads : {1U, 2U}) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        std::vector<Vec2> logs;
        for (const std::size_t count : {1'000U, 3'000U, 10'000U, 30'000U, 100'000U}) {
            if (is_quick && count > 3'000U) {
                break;
            }
            const double side = std::sqrt(static_cast<double>(count) / kPerSquareMetre);
            const FlowTerrain terrain = slope(side, 224);
            const FlowParameters parameters = running();
            ScatterOptions scatter;
            scatter.count = static_cast<std::size_t>(kOverlapping * static_cast<double>(count));
            scatter.volumes = {10e-9, 0.5};
            FlowState state = startFlow(terrain, parameters, scatterDroplets(terrain, scatter));
            std::vector<double> motion;
            std::vector<double> shapes;
            double droplets = 0.0;
            for (int frame = 1; frame <= kSettling + kFrames; ++frame) {
                const double begin = now();
                state = advanceFlow(std::move(state), terrain, parameters, frame / kRate);
                const std::vector<FlowSample> samples = sampleFlow(state, terrain, parameters);
                const double between = now();
                const Surface surface = dropletSurfaces(samples, {bodies, parameters.gravity});
                if (frame > kSettling) {
                    shapes.push_back(now() - between);
                    motion.push_back(between - begin);
                    droplets += static_cast<double>(samples.size()) / kFrames;
                }
            }
            const double time = median(motion);
            logs.push_back({std::log(droplets), std::log(time)});
            std::printf("| %.0f | %.1f m² | %zu | %.2f ms | %.2f µs | %.0f | %.2f ms |\n", droplets, side * side,
                        threads, 1e3 * time, 1e6 * time / droplets, 1.0 / time, 1e3 * median(shapes));
            std::fflush(stdout);
        }
        std::printf("| exponent | | %zu | %.2f | | | |\n", threads, slopeOf(logs));
    }
}

void timeSmallScene()
{
    std::puts("\n| model | pinning | 1000 droplets on 512 triangles, 48 frames | edges crossed |");
    std::puts("| --- | ---: | ---: | ---: |");
    const FlowTerrain terrain = slope(0.4, 16);
    ScatterOptions scatter;
    scatter.count = 1000;
    scatter.volumes = {10e-9, 0.5};
    const std::vector<FlowStart> starts = scatterDroplets(terrain, scatter);
    FlowParameters capillary;
    capillary.forces.wetting.hysteresis = 0.15;
    FlowParameters even = capillary;
    even.pinning.spread = 0.0;
    for (const FlowParameters& parameters : {running(), even, capillary}) {
        std::vector<double> times;
        std::uint64_t crossings = 0;
        for (int run = 0; run < 7; ++run) {
            FlowState state = startFlow(terrain, parameters, starts);
            const double begin = now();
            for (int frame = 1; frame <= 48; ++frame) {
                state = advanceFlow(std::move(state), terrain, parameters, frame / 24.0);
            }
            times.push_back(now() - begin);
            crossings = state.counts.crossings;
        }
        const bool is_paper = parameters.model == FlowModel::Paper;
        std::printf("| %s | %.1f | %.3f s | %llu |\n", is_paper ? "paper" : "capillary",
                    is_paper ? 0.0 : parameters.pinning.spread, median(times),
                    static_cast<unsigned long long>(crossings));
    }
}

}  // namespace

int main(int argc, char** argv)
{
    const bool is_quick = argc == 2 && std::strcmp(argv[1], "--quick") == 0;
    if (argc > 1 && !is_quick) {
        std::fputs("usage: bench_flow [--quick]\n", stderr);
        return 2;
    }
    try {
        timeTraversal();
        timeFrames(is_quick);
        timeSmallScene();
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "bench_flow: %s\n", error.what());
        return 1;
    }
}
