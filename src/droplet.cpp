// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/droplet.h"

#include <cmath>
#include <utility>

#include "droplet/error.h"
#include "droplet/shape/spread.h"
#include "droplet/units.h"
#include "number_text.h"
#include "pipeline.h"
#include "shape/cap.h"

namespace droplet {
namespace {

std::string rounded(double value)
{
    return numberText(value, 3);
}

std::string percent(double share)
{
    return rounded(100.0 * share) + " %";
}

/// What the linear model's steepness does to its figures: to the height, or to the volume if the height is prescribed,
/// as it would on a disc without gravity.
std::string estimatedError(const ShapeFigures& figures, FillBy by)
{
    const double linear = figures.contact_angle.mean;
    switch (by) {
        case FillBy::Volume: {
            const double t = std::tan(0.5 * capAngleOfLinear(linear));
            return "the height about " + percent(t * t / 3.0) + " too large";
        }
        case FillBy::Height: {
            const double t = 0.5 * std::tan(linear);
            return "the volume about " + percent(t * t / 3.0) + " too small";
        }
        case FillBy::ContactAngle:
            return "the height about " + percent(0.5 * std::tan(linear) / std::tan(0.5 * linear) - 1.0) + " too large";
    }
    return {};
}

std::string steepness(const Droplet& droplet, const SolveOptions& options)
{
    const ShapeFigures& total = droplet.total;
    const bool like_a_cap = options.ground.flat() && planeGravity(options).along == Vec2{};
    return "slopes pass 50 degrees on " + percent(total.steep_area / total.footprint_area) +
           " of the footprint and reach " + rounded(total.slope_max / kDegree) +
           "; the linear model takes the area there for " + percent(total.linear_area / total.liquid_area - 1.0) +
           " of the whole too large" + (like_a_cap ? ", and " + estimatedError(total, options.fill.by) : "") +
           " (model exact has no such error)";
}

/// How much of all rims liquid leaves at 89° or more, by length.
double uprightShare(const Droplet& droplet)
{
    constexpr double kUpright = 89.0 * kDegree;
    double upright = 0.0;
    for (std::size_t k = 0; k < droplet.meshes.size(); ++k) {
        const PlanarMesh& mesh = droplet.meshes[k];
        const std::vector<double>& angle = droplet.solution.droplets[k].contact_angle;
        for (std::size_t loop = 0; loop < mesh.loopCount(); ++loop) {
            for (std::uint32_t v = mesh.loop_starts[loop]; v < mesh.loop_starts[loop + 1]; ++v) {
                const std::uint32_t next = nextOnRim(mesh, loop, v);
                const double half = 0.5 * length(mesh.vertices[next] - mesh.vertices[v]);
                upright += (angle[v] >= kUpright ? half : 0.0) + (angle[next] >= kUpright ? half : 0.0);
            }
        }
    }
    return upright / droplet.total.rim_length;
}

std::vector<std::string> warningsOf(const Droplet& droplet, const DropletOptions& options)
{
    constexpr double kVisible = 1e-6;  // of the height; less is round-off
    std::vector<std::string> warnings;
    const ShapeFigures& total = droplet.total;
    if (options.solve.model == Model::Linear && total.steep_area > 0.0) {
        warnings.push_back(steepness(droplet, options.solve));
    }
    const double upright = options.solve.model == Model::Exact ? uprightShare(droplet) : 0.0;
    if (upright > 0.0) {
        warnings.push_back("the liquid stands upright along " + percent(upright) +
                           " of its rim, where that bends into it; in truth it hangs over there");
    }
    if (!options.solve.no_penetration && total.depth_max > kVisible * total.height_max) {
        warnings.push_back("the liquid's surface sinks into the ground, by up to " +
                           rounded(total.depth_max / kMillimetre) + " mm; no-penetration keeps it above");
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

/// Why there is no droplet, and what to change.
std::string refusal(const SolveReport& report, const Droplet& droplet, const Fill& fill)
{
    const bool one_of_several = droplet.meshes.size() > 1 && fill.sharing == FillSharing::Each;
    const std::string which = one_of_several ? "droplet " + std::to_string(report.failed_droplet + 1) + " of " +
                                                   std::to_string(droplet.meshes.size()) + ": "
                                             : "";
    switch (report.termination) {
        case Termination::NoHeightField:
            return which + "no such droplet is a height field on this footprint: the largest volume that exists is " +
                   numberText(report.largest_volume / kMicrolitre, 4) +
                   " uL, beyond it the liquid hangs over its rim; ask for less";
        case Termination::OutOfSteps:
            return which + std::to_string(report.newton_steps) + " steps of Newton's method went as far as " +
                   numberText(report.largest_volume / kMicrolitre, 4) +
                   " uL on this footprint, not to what was asked for; ask for less, or smooth the footprint";
        case Termination::Unstable:
            return which + "gravity pulls such a droplet off: its Bond number is " + numberText(report.bond_number, 4) +
                   ", and at most " + numberText(report.critical_bond_number, 4) +
                   " holds on this footprint; ask for less gravity or a smaller width";
        case Termination::NotConverged:
        case Termination::Converged:
            break;
    }
    return which + "the equations could not be solved (residual " + rounded(report.residual) +
           "); try another number of triangles";
}

}  // namespace

void validateStages(const DropletOptions& options)
{
    options.mesh.validate();
    options.solve.validate();
    if (options.fill_range) {
        options.fill_range->validate();
        requireRefillable(options.solve);
    }
}

Droplet makeDroplet(const Mask& mask, const DropletOptions& options, const Progress& progress)
{
    options.trace.validate();
    validateStages(options);
    if (progress) {
        progress(Stage::Trace);
    }
    return makeDroplet(trace(mask, options.trace), options, progress);
}

std::vector<PlanarMesh> meshesOf(const Domain& domain, const DropletOptions& options)
{
    std::vector<PlanarMesh> meshes = triangulate(domain, options.mesh);
    return options.solve.model == Model::Exact ? spread(std::move(meshes), options.solve) : meshes;
}

void finish(Droplet& droplet, const DropletOptions& options, const std::vector<PlanarMesh>& bases,
            const Progress& progress)
{
    droplet.solution = solve(droplet.meshes, options.solve, progress);
    if (!droplet.solution.report.usable()) {
        throw Error(ErrorCode::NoSuchDroplet, refusal(droplet.solution.report, droplet, options.solve.fill));
    }
    if (progress) {
        progress(Stage::Loft);
    }
    for (std::size_t k = 0; k < droplet.meshes.size(); ++k) {
        droplet.figures.push_back(measure(droplet.meshes[k], droplet.solution.droplets[k], options.solve));
    }
    droplet.total = combine(droplet.figures);
    LoftOptions lofting{
        .open = options.open, .extent = droplet.domain.extent, .ground = options.solve.ground, .bases = bases};
    if (options.fill_range) {
        lofting.refill = {*options.fill_range, gainsPerFill(droplet.meshes, droplet.solution.droplets, options.solve)};
    }
    droplet.surface = loft(droplet.meshes, droplet.solution.droplets, lofting);
    droplet.warnings = warningsOf(droplet, options);
}

Droplet makeDroplet(Outline outline, const DropletOptions& options, const Progress& progress)
{
    validateStages(options);
    Droplet droplet;
    droplet.outline = std::move(outline);
    droplet.domain = split(droplet.outline);
    if (progress) {
        progress(Stage::Triangulate);
    }
    droplet.meshes = meshesOf(droplet.domain, options);
    finish(droplet, options, {}, progress);
    return droplet;
}

}  // namespace droplet
