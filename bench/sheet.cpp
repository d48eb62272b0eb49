// SPDX-License-Identifier: GPL-3.0-or-later
// Times of parametric sheets, as a table in Markdown:
//
//   bench_sheet [--quick] [TRIANGLES...]
//
// Caps of 140° on a disc, without gravity, of 2000 to 200 000 triangles: time of the whole path from the dry footprint,
// by volume and by contact angle. Errors beside the times: those of height, area, pressure and mean angle against the
// spherical cap.
#include "droplet/shape/sheet.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <exception>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "droplet/domain/domain.h"
#include "droplet/mesh/triangulate.h"
#include "droplet/shape/figures.h"

namespace {

using namespace droplet;

constexpr double kPi = std::numbers::pi;
constexpr double kAngle = 140.0 * kPi / 180.0;
constexpr int kRuns = 3;

/// Times of a run [s].
struct Times {
    double wall = 0.0;
    double processor = 0.0;  ///< of all threads
};

Times now()
{
    return {std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(),
            static_cast<double>(std::clock()) / CLOCKS_PER_SEC};
}

/// Disc of radius 1; the error of its polygon's area is 1e-7.
PlanarMesh disc(double triangles)
{
    constexpr std::size_t kPoints = 8192;
    Loop loop;
    for (std::size_t i = 0; i < kPoints; ++i) {
        const double angle = 2.0 * kPi * static_cast<double>(i) / kPoints;
        loop.points.push_back({std::cos(angle), std::sin(angle)});
    }
    loop.corner.assign(kPoints, 0);
    TriangulateOptions options;
    options.triangles = static_cast<std::size_t>(triangles);
    return triangulate({{{loop, {}}}, {2.0, 2.0}}, options).front();
}

/// Fills the disc, and takes the shortest times of several runs.
SheetResult fill(const PlanarMesh& mesh, const SolveOptions& options, Times& times)
{
    SheetResult result;
    for (int run = 0; run < kRuns; ++run) {
        const Times begin = now();
        result = solveSheet(mesh, options);
        const Times end = now();
        times.wall = run == 0 ? end.wall - begin.wall : std::min(times.wall, end.wall - begin.wall);
        times.processor =
            run == 0 ? end.processor - begin.processor : std::min(times.processor, end.processor - begin.processor);
    }
    if (result.end != SheetEnd::Reached) {
        throw std::runtime_error("a cap of 140° was not reached");
    }
    return result;
}

void timeCaps(std::size_t threads, const std::vector<double>& sizes)
{
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const double radius = 1.0 / std::sin(kAngle);
    const double rise = 1.0 - std::cos(kAngle);
    SolveOptions options;
    options.liquid = {"unit", 1.0, 1.0};
    options.gravity = 0.0;
    double first_time = 0.0;
    double first_count = 0.0;
    for (const double size : sizes) {
        const PlanarMesh mesh = disc(size);
        options.fill = {FillBy::Volume, kPi / 3.0 * std::pow(radius, 3) * (2.0 + std::cos(kAngle)) * rise * rise,
                        FillSharing::Each};
        Times by_volume;
        const SheetResult result = fill(mesh, options, by_volume);
        const ShapeFigures figures = measure(result.surface, options);
        options.fill = {FillBy::ContactAngle, kAngle, FillSharing::Each};
        Times by_angle;
        fill(mesh, options, by_angle);
        const auto count = static_cast<double>(result.surface.triangles.size());
        const double part = 1e4 / count;
        std::printf("| %.0f | %zu | %zu | %.3f s | %.3f s | %.3f s | %.3f s | %.1e | %.1e | %.1e | %.4f° |\n", count,
                    threads, result.newton_steps, by_volume.wall, by_volume.wall * part, by_volume.processor * part,
                    by_angle.processor * part, std::abs(figures.height_max / (radius * rise) - 1.0),
                    std::abs(figures.liquid_area / (2.0 * kPi * radius * radius * rise) - 1.0),
                    std::abs(result.surface.pressure * radius / 2.0 - 1.0),
                    std::abs(result.contact_angle - kAngle) * 180.0 / kPi);
        std::fflush(stdout);
        if (first_time == 0.0) {
            first_time = by_volume.processor;
            first_count = count;
        } else if (size == sizes.back()) {
            std::printf("\nExponent, %zu thread%s: %.2f\n\n", threads, threads == 1 ? "" : "s",
                        std::log(by_volume.processor / first_time) / std::log(count / first_count));
        }
    }
}

}  // namespace

int main(int argc, char** argv)
{
    try {
        std::vector<double> sizes;
        for (int k = 1; k < argc; ++k) {
            if (std::strcmp(argv[k], "--quick") == 0) {
                sizes = {2e3};
            } else {
                sizes.push_back(std::atof(argv[k]));
            }
        }
        if (sizes.empty()) {
            sizes = {2e3, 5e3, 1e4, 2e4, 5e4, 1e5, 2e5};
        }
        std::puts(
            "| triangles | threads | Newton steps | path | per 10 k | processor, per 10 k | the same, by angle | "
            "height | "
            "area | pressure | angle |");
        std::puts("| ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |");
        for (const std::size_t threads : {1U, 2U}) {
            timeCaps(threads, sizes);
        }
    } catch (const std::exception& error) {
        std::fprintf(stderr, "bench_sheet: %s\n", error.what());
        return 1;
    }
    return 0;
}
