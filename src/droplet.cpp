// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/droplet.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "droplet/error.h"
#include "droplet/shape/spread.h"
#include "droplet/units.h"
#include "number_text.h"
#include "pipeline.h"

namespace droplet {
namespace {

std::string rounded(double value)
{
    return numberText(value, 3);
}

/// Count in the notation of --triangles; large ones are rounded: 5300, 41.2k, 1.25M.
std::string countText(std::size_t count)
{
    constexpr std::size_t kThousands = 10'000;
    constexpr std::size_t kMillions = 999'500;
    const auto number = static_cast<double>(count);
    return count < kThousands  ? std::to_string(count)
           : count < kMillions ? rounded(number / 1e3) + "k"
                               : rounded(number / 1e6) + "M";
}

std::string percent(double share)
{
    constexpr double kMin = 1e-3;
    constexpr double kWhole = 0.1;  // larger shares have no decimals; with two digits they would become 9.5e+02
    return share < kMin      ? "less than 0.1 %"
           : share >= kWhole ? numberText(std::round(100.0 * share)) + " %"
                             : numberText(100.0 * share, 2) + " %";
}

/// Share of the footprint too steep for the linear model above which the error is visible. At the same volume, heights
/// of both models differ by 2 % if this share is 14 % of a letter.
constexpr double kVisiblySteep = 0.05;

/// Rims that stand so upright that a height field is not the true shape any more [rad].
constexpr double kUpright = 89.0 * kDegree;

/// Share of all rims, by length, with a contact angle of at least 89°.
double uprightShare(const Droplet& droplet)
{
    double upright = 0.0;
    for (std::size_t k = 0; k < droplet.meshes.size(); ++k) {
        if (!droplet.sheets.empty() && droplet.sheets[k]) {
            continue;  // sheets may lean over
        }
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

/// Largest height that is plausible. With one contact angle along the whole rim, round droplets six capillary lengths
/// wide are the highest: by 8 % higher than an infinite puddle for small angles, where (I₀(x) − 1)/I₁(x) has its
/// maximum. A jagged rim has small angles that lower the mean but not the height: real drawings reach 33 %. In the
/// linear model a puddle is √(σ/ρg) tan θ high, which holds up to 50°.
double maxPlausibleHeight(const ShapeFigures& figures, Model model)
{
    constexpr double kRoundAndJagged = 1.4;
    const double angle = std::min(figures.contact_angle.mean, 50.0 * kDegree);
    const double linear = std::tan(angle) / (2.0 * std::sin(0.5 * angle));
    return *figures.height_bound * kRoundAndJagged * (model == Model::Linear ? linear : 1.0);
}

/// Warning about droplets that are too high; empty if there are none.
std::string heightWarning(const Droplet& droplet, Model model)
{
    std::size_t count = 0;
    const ShapeFigures* worst = nullptr;
    for (const ShapeFigures& figures : droplet.figures) {
        if (figures.height_bound && figures.height_max > maxPlausibleHeight(figures, model)) {
            ++count;
            worst = worst == nullptr || figures.height_max > worst->height_max ? &figures : worst;
        }
    }
    if (worst == nullptr) {
        return {};
    }
    const std::string which = droplet.figures.size() == 1
                                  ? "the droplet is "
                                  : std::to_string(count) + " of " + std::to_string(droplet.figures.size()) +
                                        (count == 1 ? " droplets stands" : " droplets stand") + " too high, up to ";
    return which + rounded(worst->height_max / kMillimetre) +
           " mm high, but a puddle of this liquid with a mean contact angle of " +
           rounded(worst->contact_angle.mean / kDegree) + " degrees is at most " +
           rounded(*worst->height_bound / kMillimetre) + " mm; check its footprint, or ask for less liquid";
}

std::vector<std::string> warningsOf(const Droplet& droplet, const DropletOptions& options)
{
    constexpr double kVisible = 1e-6;  // of the height; less is round-off
    std::vector<std::string> warnings;
    const ShapeFigures& total = droplet.total;
    const double steep = total.steep_area / total.footprint_area;
    if (options.solve.model == Model::Linear && steep >= kVisiblySteep) {
        warnings.push_back(percent(steep) +
                           " of the surface is too steep (over 50 degrees) for the linear model; use --model exact");
    }
    const double upright = options.solve.model == Model::Exact ? uprightShare(droplet) : 0.0;
    if (upright > 0.0) {
        warnings.push_back("the liquid stands upright along " + percent(upright) +
                           " of its rim; a real droplet would hang over there; ask for less liquid");
    }
    if (!options.solve.no_penetration && total.depth_max > kVisible * total.height_max) {
        warnings.push_back("the liquid's surface sinks into the ground, by up to " +
                           rounded(total.depth_max / kMillimetre) + " mm; --no-penetration keeps it above");
    }
    std::size_t triangles = 0;
    for (const PlanarMesh& mesh : droplet.meshes) {
        triangles += mesh.triangles.size();
    }
    const auto wanted = static_cast<double>(options.mesh.triangles);
    if (!options.mesh.edge && std::abs(static_cast<double>(triangles) - wanted) > 0.1 * wanted) {
        warnings.push_back("the footprint's detail takes " + countText(triangles) + " triangles, not the " +
                           countText(options.mesh.triangles) + " asked for");
    }
    return warnings;
}

/// Message that says why there is no droplet, and what to change.
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
                   " uL; more liquid would hang over its rim; ask for less";
        case Termination::OutOfSteps:
            return which + std::to_string(report.newton_steps) + " steps of Newton's method reached only " +
                   numberText(report.largest_volume / kMicrolitre, 4) +
                   " uL on this footprint; ask for less, or smooth the footprint";
        case Termination::Unstable:
            return which + "gravity pulls such a droplet off: its Bond number is " + numberText(report.bond_number, 4) +
                   ", but at most " + numberText(report.critical_bond_number, 4) +
                   " can hang on this footprint; use a smaller --gravity or --width";
        case Termination::NotConverged:
        case Termination::Converged:
            break;
    }
    return which + "the equations could not be solved (residual " + rounded(report.residual) +
           "); try another number of --triangles";
}

/// Why a droplet is no sheet, and what to change.
std::string refusal(const SheetResult& result, const std::string& which)
{
    const std::string at = numberText(result.volume / kMicrolitre, 4) + " uL";
    switch (result.end) {
        case SheetEnd::NoAngle:
            return which + "no such droplet exists on this footprint: the mean contact angle is at most " +
                   rounded(result.contact_angle / kDegree) + " degrees, at " + at + "; --volume goes on beyond it";
        case SheetEnd::NoHeight:
            return which + "no such droplet exists on this footprint: it is highest at " + at + "; ask for less";
        case SheetEnd::Unstable:
        case SheetEnd::Reached:
            break;
    }
    return which + "no stable droplet was found on this footprint with more than " + at + " (mean contact angle " +
           rounded(result.contact_angle / kDegree) + " degrees); ask for less";
}

/// Solves every droplet: as a height field, or, in the exact model, as a sheet that hangs over its rim where there is
/// none.
void solveShapes(Droplet& droplet, const SolveOptions& options, const Progress& progress)
{
    const std::size_t count = droplet.meshes.size();
    const bool may_hang = options.model == Model::Exact && options.ground.flat() && !options.no_penetration &&
                          options.fill.sharing == FillSharing::Each;
    const bool must_hang = options.volumes.empty() && options.fill.by == FillBy::ContactAngle &&
                           options.fill.amount >= 0.5 * std::numbers::pi;
    Solution& solution = droplet.solution;
    if (!may_hang || !must_hang) {
        solution = solve(droplet.meshes, options, progress);
    } else if (progress) {
        progress(Stage::Solve);
    }
    const auto is_upright = [](const HeightField& field) {
        return std::any_of(field.contact_angle.begin(), field.contact_angle.end(),
                           [](double angle) { return angle >= kUpright; });
    };
    const bool has_field = solution.report.usable();
    const bool has_none = solution.report.termination == Termination::NoHeightField ||
                          solution.report.termination == Termination::OutOfSteps;
    if (!may_hang || (!must_hang && !has_none &&
                      !(has_field && std::any_of(solution.droplets.begin(), solution.droplets.end(), is_upright)))) {
        if (!has_field) {
            throw Error(ErrorCode::NoSuchDroplet, refusal(solution.report, droplet, options.fill));
        }
        return;
    }
    std::vector<HeightField> fields(count);
    std::vector<SheetResult> results(count);
    droplet.sheets.resize(count);
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t k) {
        SolveOptions own = options;
        if (!options.volumes.empty()) {
            own.volumes.clear();
            own.fill = {FillBy::Volume, options.volumes[k], FillSharing::Each};
        }
        if (has_field) {
            fields[k] = std::move(solution.droplets[k]);
        } else if (!must_hang && count > 1) {
            Solution one = solve({droplet.meshes[k]}, own);
            if (one.report.usable()) {
                fields[k] = std::move(one.droplets.front());
            }
        }
        const bool has_own = !fields[k].height.empty();
        if (has_own && !is_upright(fields[k])) {
            return;
        }
        results[k] = solveSheet(droplet.meshes[k], own);
        if (results[k].end == SheetEnd::Reached) {
            droplet.sheets[k] = std::move(results[k].sheet);
            fields[k] = {};
            fields[k].contact_angle = droplet.sheets[k]->contact_angle;
            fields[k].pressure = droplet.sheets[k]->pressure;
        } else if (has_own) {
            results[k].end = SheetEnd::Reached;  // the height field stands
        }
    });
    for (std::size_t k = 0; k < count; ++k) {
        if (results[k].end != SheetEnd::Reached) {
            throw Error(
                ErrorCode::NoSuchDroplet,
                refusal(results[k],
                        count == 1 ? "" : "droplet " + std::to_string(k + 1) + " of " + std::to_string(count) + ": "));
        }
        solution.report.newton_steps = std::max(solution.report.newton_steps, results[k].newton_steps);
        solution.report.unknowns += droplet.sheets[k] && !has_field ? droplet.sheets[k]->places.size() : 0;
    }
    solution.droplets = std::move(fields);
    solution.report.termination = Termination::Converged;
    if (solution.report.method.empty()) {
        solution.report.method = "simplicial-ldlt";
    }
}

/// Surfaces of all droplets: of height fields first.
Surface surfaceOf(const Droplet& droplet, const LoftOptions& options)
{
    if (droplet.sheets.empty()) {
        return loft(droplet.meshes, droplet.solution.droplets, options);
    }
    LoftOptions some = options;
    some.bases.clear();
    std::vector<PlanarMesh> meshes;
    std::vector<HeightField> fields;
    Surface sheets;
    for (std::size_t k = 0; k < droplet.meshes.size(); ++k) {
        if (droplet.sheets[k]) {
            LoftOptions own = options;
            own.bases.clear();
            if (!options.bases.empty()) {
                own.bases.push_back(options.bases[k]);
            }
            append(sheets, loft(droplet.meshes[k], *droplet.sheets[k], own));
        } else {
            meshes.push_back(droplet.meshes[k]);
            fields.push_back(droplet.solution.droplets[k]);
            if (!options.bases.empty()) {
                some.bases.push_back(options.bases[k]);
            }
        }
    }
    Surface surface = meshes.empty() ? Surface{} : loft(meshes, fields, some);
    append(surface, sheets);
    surface.mean_height = droplet.total.volume / (droplet.total.footprint_area - droplet.total.dry_area);
    return surface;
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
    solveShapes(droplet, options.solve, progress);
    if (progress) {
        progress(Stage::Loft);
    }
    for (std::size_t k = 0; k < droplet.meshes.size(); ++k) {
        const bool is_sheet = !droplet.sheets.empty() && droplet.sheets[k];
        droplet.figures.push_back(is_sheet ? measure(droplet.meshes[k], *droplet.sheets[k], options.solve)
                                           : measure(droplet.meshes[k], droplet.solution.droplets[k], options.solve));
    }
    droplet.total = combine(droplet.figures);
    LoftOptions lofting{
        .open = options.open, .extent = droplet.domain.extent, .ground = options.solve.ground, .bases = bases};
    if (options.fill_range) {
        lofting.refill = {*options.fill_range, gainsPerFill(droplet.meshes, droplet.solution.droplets, options.solve)};
    }
    droplet.surface = surfaceOf(droplet, lofting);
    droplet.warnings = warningsOf(droplet, options);
    if (std::string tall = heightWarning(droplet, options.solve.model); !tall.empty()) {
        droplet.warnings.insert(droplet.warnings.begin(), std::move(tall));
        droplet.severe_warnings = 1;
    }
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
