// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <numeric>
#include <optional>
#include <string>

#include "disc.h"
#include "droplet/io/output.h"
#include "measured.h"
#include "system.h"

namespace droplet::bench {
namespace {

using Counters = benchmark::UserCounters;

constexpr const char* kOutput = "droplet_bench.glb";

struct SolverCase {
    const char* name;
    Solver solver;
    std::size_t max;          // largest number of triangles; more would take minutes
    std::size_t max_on_disc;  // the same on the disc, which has wider separators than strokes
};

constexpr std::array kSolvers = {
    SolverCase{"simplicial-llt", Solver::Llt, 1'000'000, 400'000},
    SolverCase{"multigrid-pcg", Solver::Multigrid, 4'000'000, 4'000'000},
};

void nothing() {}

int repetitions(std::size_t triangles)
{
    return triangles > 1'000'000 ? 3 : 5;
}

void registerPictures(const Plan& plan)
{
    for (const auto& path : plan.masks) {
        const auto mask = std::make_shared<const Mask>(readMask(path));
        const std::string size = std::to_string(mask->width) + "px";
        const double pixels = static_cast<double>(mask->width) * mask->height;
        measure(
            "Read/" + size, 5, nothing, [path] { return readMask(path); },
            [pixels](const Mask&, Counters& counters) { counters["pixels"] = pixels; });
        measure(
            "Trace/" + size, 5, nothing, [mask] { return split(trace(*mask)); },
            [mask, pixels](const Domain& domain, Counters& counters) {
                counters["pixels"] = pixels;
                const double covered = std::accumulate(mask->coverage.begin(), mask->coverage.end(), 0.0) / 65535.0;
                const double pixel = domain.extent.x / mask->width;
                double enclosed = 0.0;
                for (const Footprint& footprint : domain.droplets) {
                    enclosed += area(footprint);
                }
                counters["error"] = std::abs(enclosed / (covered * pixel * pixel) - 1.0);
            });
        DropletOptions draft;
        draft.mesh = meshOf(5'000);
        measure(
            "Draft/" + size, 5, nothing, [mask, draft] { return makeDroplet(*mask, draft); },
            [](const Droplet& droplet, Counters& counters) {
                counters["triangles"] = static_cast<double>(triangleCount(droplet.meshes));
            });
    }
}

void registerTriangulate(const std::shared_ptr<Case>& footprint, std::size_t size)
{
    measure(
        "Triangulate/" + footprint->name() + "/" + inShort(size), repetitions(size), nothing,
        [footprint, size] { return triangulate(footprint->domain(), meshOf(size)); },
        [](const std::vector<PlanarMesh>& meshes, Counters& counters) {
            counters["triangles"] = static_cast<double>(triangleCount(meshes));
            double min = std::numeric_limits<double>::infinity();
            for (const PlanarMesh& mesh : meshes) {
                min = std::min(min, minAngle(mesh));
            }
            counters["min_angle_deg"] = min / kDegree;
        });
}

/// Adds size and quality of a solution. Heights per pressure can be compared with those of another program.
void judge(const std::vector<PlanarMesh>& meshes, const Solution& solution, Counters& counters)
{
    counters["triangles"] = static_cast<double>(triangleCount(meshes));
    counters["unknowns"] = static_cast<double>(solution.report.unknowns);
    counters["solver_iterations"] = static_cast<double>(solution.report.iterations);
    double worst = 0.0;
    double volumes = 0.0;
    double height = 0.0;
    for (std::size_t k = 0; k < meshes.size(); ++k) {
        const CapillarySurface& field = solution.droplets[k];
        worst = std::max(worst, residual(assemble(meshes[k], {}), field));
        volumes += volume(field) / field.pressure;
        height = std::max(height, bench::height(field) / field.pressure);
    }
    counters["residual"] = worst;
    counters["unit_volume"] = volumes;
    counters["unit_height"] = height;
}

void registerSolve(const std::shared_ptr<Case>& footprint, std::size_t size, const std::optional<Disc>& disc)
{
    for (const SolverCase& solver : kSolvers) {
        if (size > (disc ? solver.max_on_disc : solver.max)) {
            continue;
        }
        SolveOptions options;
        options.solver = solver.solver;
        measure(
            std::string("Solve/") + solver.name + "/" + footprint->name() + "/" + inShort(size), repetitions(size),
            [footprint, size] { footprint->meshes(size); },
            [footprint, size, options] { return solve(footprint->meshes(size), options); },
            [footprint, size, disc](const Solution& solution, Counters& counters) {
                const std::vector<PlanarMesh>& meshes = footprint->meshes(size);
                judge(meshes, solution, counters);
                if (disc) {
                    counters["error"] = disc->heightError(solution.droplets.front());
                    counters["middle_error"] = disc->middleError(solution.droplets.front());
                    counters["volume_error"] = disc->volumeError(solution.droplets.front());
                }
            });
    }
}

void registerSurface(const std::shared_ptr<Case>& footprint, std::size_t size)
{
    const std::string at = "/" + footprint->name() + "/" + inShort(size);
    const auto triangles = [footprint, size](Counters& counters) {
        counters["triangles"] = static_cast<double>(triangleCount(footprint->meshes(size)));
        counters["surface_triangles"] = static_cast<double>(footprint->surface(size).triangles.size());
    };
    const auto prepare = [footprint, size] { footprint->surface(size); };
    measure(
        "Loft" + at, repetitions(size), [footprint, size] { footprint->solution(size); },
        [footprint, size] { return loft(footprint->solution(size).droplets, {.extent = footprint->domain().extent}); },
        [triangles](const Surface&, Counters& counters) { triangles(counters); });
    measure(
        "Topology" + at, repetitions(size), prepare, [footprint, size] { return topology(footprint->surface(size)); },
        [triangles](const Topology& found, Counters& counters) {
            triangles(counters);
            counters["closed"] = found.closed ? 1.0 : 0.0;
        });
    measure(
        "Write" + at, repetitions(size), prepare,
        [footprint, size] {
            const WriteOptions known{.closed = true};
            return writeAtomically(
                kOutput, [&](std::ostream& out) { writeSurface(footprint->surface(size), out, Format::Glb, known); });
        },
        [triangles](std::uint64_t bytes, Counters& counters) {
            triangles(counters);
            counters["bytes"] = static_cast<double>(bytes);
            std::filesystem::remove(kOutput);
        });
}

}  // namespace

void registerStages(const Plan& plan)
{
    registerPictures(plan);
    const Outline outline = trace(readMask(plan.masks.front()));
    const auto letter = std::make_shared<Case>("letter", split(outline));
    const Disc disc(3.0);  // neither tension nor weight is negligible
    const auto round = std::make_shared<Case>("disc", disc.domain());
    for (const std::size_t size : plan.sizes) {
        registerTriangulate(letter, size);
        registerSolve(letter, size, {});
        registerSurface(letter, size);
    }
    for (const std::size_t size : plan.sizes) {
        registerSolve(round, size, disc);
    }
}

}  // namespace droplet::bench
