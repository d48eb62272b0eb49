// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>
#include <optional>
#include <string>

#include "disc.h"
#include "measured.h"
#include "stages.h"
#include "system.h"

namespace droplet::bench {
namespace {

struct Shape {
    std::string name;
    Domain domain;
    std::optional<Disc> disc;  // set if the heights are known
};

struct Graded {
    std::vector<PlanarMesh> meshes;
    Solution solution;
};

void registerGraded(const std::shared_ptr<const Shape>& shape, int grading, std::size_t triangles)
{
    measure(
        "Grading/" + shape->name + "/" + std::to_string(grading) + "/" + inShort(triangles), 1, [] {},
        [shape, grading, triangles] {
            TriangulateOptions options = meshOf(triangles);
            options.grading = grading;
            Graded graded{triangulate(shape->domain, options), {}};
            graded.solution = solve(graded.meshes);
            return graded;
        },
        [shape, grading](const Graded& graded, benchmark::UserCounters& counters) {
            const PlanarMesh& mesh = graded.meshes.front();
            const CapillarySurface& field = graded.solution.droplets.front();
            counters["grading"] = grading;
            counters["triangles"] = static_cast<double>(mesh.triangles.size());
            counters["unit_volume"] = volume(field) / field.pressure;
            if (shape->disc) {
                counters["error"] = shape->disc->heightError(field);
                counters["volume_error"] = shape->disc->volumeError(field);
            }
        });
}

}  // namespace

void registerGrading(const Plan& plan)
{
    if (!plan.has(100'000)) {
        return;
    }
    for (const Shape& shape : {Shape{"disc of 3 capillary lengths", Disc(3.0).domain(), Disc(3.0)},
                               Shape{"disc of 20 capillary lengths", Disc(20.0).domain(), Disc(20.0)},
                               Shape{"letter", split(trace(readMask(plan.masks.front()))), {}}}) {
        const auto shared = std::make_shared<const Shape>(shape);
        for (const int grading : {1, 2, 4, 8, 16}) {
            for (const std::size_t triangles : {5'000U, 10'000U, 20'000U, 40'000U, 80'000U, 160'000U}) {
                registerGraded(shared, grading, triangles);
            }
        }
    }
}

}  // namespace droplet::bench
