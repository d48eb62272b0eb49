// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/droplet.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "droplet/error.h"
#include "droplet/units.h"

namespace droplet {
namespace {

/// Slope up to which the linear model's area is within 10 % (thesis, section 4.1.2).
constexpr double kLinearSlope = 50.0 * kDegree;

std::string rounded(double value)
{
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.3g", value);
    return text.data();
}

std::vector<std::string> warningsOf(const Droplet& droplet, const DropletOptions& options)
{
    std::vector<std::string> warnings;
    if (droplet.total.slope_max > kLinearSlope) {
        warnings.push_back("slopes reach " + rounded(droplet.total.slope_max / kDegree) +
                           " degrees; the linear model's area is within 10 % up to 50 degrees only");
    }
    std::size_t triangles = 0;
    for (const PlanarMesh& mesh : droplet.meshes) {
        triangles += mesh.triangles.size();
    }
    const auto wanted = static_cast<double>(options.mesh.triangles);
    if (!options.mesh.edge && std::abs(static_cast<double>(triangles) - wanted) > 0.1 * wanted) {
        warnings.push_back("the footprint's detail takes " + std::to_string(triangles) + " triangles, not the " +
                           std::to_string(options.mesh.triangles) + " asked for");
    }
    return warnings;
}

}  // namespace

Droplet makeDroplet(const Mask& mask, const DropletOptions& options, const Progress& progress)
{
    options.trace.validate();
    options.mesh.validate();
    options.solve.validate();
    const auto begin = [&](Stage stage) {
        if (progress) {
            progress(stage);
        }
    };
    Droplet droplet;
    begin(Stage::Trace);
    droplet.outline = trace(mask, options.trace);
    droplet.domain = split(droplet.outline);
    begin(Stage::Triangulate);
    droplet.meshes = triangulate(droplet.domain, options.mesh);
    droplet.solution = solve(droplet.meshes, options.solve, progress);
    if (!droplet.solution.report.usable()) {
        throw Error(ErrorCode::NoSuchDroplet, "the linear system could not be solved (residual " +
                                                  rounded(droplet.solution.report.residual) +
                                                  "); try another number of triangles");
    }
    begin(Stage::Loft);
    for (std::size_t k = 0; k < droplet.meshes.size(); ++k) {
        droplet.figures.push_back(measure(droplet.meshes[k], droplet.solution.droplets[k], options.solve));
    }
    droplet.total = combine(droplet.figures);
    droplet.surface = loft(droplet.meshes, droplet.solution.droplets,
                           {.open = options.open, .extent = droplet.domain.extent, .ground = options.solve.ground});
    droplet.warnings = warningsOf(droplet, options);
    return droplet;
}

}  // namespace droplet
