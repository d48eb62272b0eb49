// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/droplet.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "droplet/error.h"
#include "droplet/mesh/follow.h"
#include "droplet/shape/spread.h"
#include "droplet/units.h"
#include "number_text.h"
#include "pipeline.h"
#include "shape/liquid_shapes.h"

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

/// Share of all rims, by length, with a contact angle of at least 89°.
double uprightShare(const Droplet& droplet)
{
    double upright = 0.0;
    for (const CapillarySurface& surface : droplet.solution.droplets) {
        if (!surface.isHeightField()) {
            continue;  // sheets may lean over
        }
        const PlanarMesh rim = rimOf(surface);
        const std::vector<double>& angle = surface.contact_angle;
        for (std::size_t loop = 0; loop < rim.loopCount(); ++loop) {
            for (std::uint32_t v = rim.loop_starts[loop]; v < rim.loop_starts[loop + 1]; ++v) {
                const std::uint32_t next = nextOnRim(rim, loop, v);
                const double half = 0.5 * length(rim.vertices[next] - rim.vertices[v]);
                upright += (angle[v] >= kUpright ? half : 0.0) + (angle[next] >= kUpright ? half : 0.0);
            }
        }
    }
    return upright / droplet.total.rim_length;
}

/// Warning about droplets that are too high for their mean contact angle, on level flat ground; empty if there are
/// none. Those that are no higher than a puddle of the angle that was wanted are not.
///
/// With one contact angle along the whole rim, round droplets six capillary lengths wide are the highest: by 8 % higher
/// than an endless puddle for small angles, where (I₀(x) − 1)/I₁(x) has its maximum. A jagged rim has small angles that
/// lower the mean but not the height: real drawings reach 33 %.
/// @param options  the droplet was solved with
std::string heightWarning(const Droplet& droplet, const SolveOptions& options)
{
    constexpr double kRoundAndJagged = 1.4;
    // In the linear model the height of a puddle goes to infinity at 90°; it is no guide above 50°.
    constexpr double kSteepestLinear = 50.0 * kDegree;
    if (!options.ground.flat() || planeGravity(options).along != Vec2{}) {
        return {};
    }
    std::size_t count = 0;
    const ShapeFigures* worst = nullptr;
    double bound = 0.0;
    for (std::size_t k = 0; k < droplet.figures.size(); ++k) {
        const ShapeFigures& figures = droplet.figures[k];
        const double mean = figures.contact_angle.mean;
        const bool is_linear_puddle = options.model == Model::Linear && bendingLayer(options);
        const double angle = is_linear_puddle ? std::min(mean, kSteepestLinear) : mean;
        const double height = puddleHeight(options, angle, figures.footprint_area);
        if (droplet.limits[k] != FillLimit::Puddle && figures.height_max > kRoundAndJagged * height) {
            ++count;
            if (worst == nullptr || figures.height_max > worst->height_max) {
                worst = &figures;
                bound = height;
            }
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
           (bendingLayer(options) ? " mm high, but a puddle of this liquid"
                                  : " mm high, but a round droplet of its area") +
           " with a mean contact angle of " + rounded(worst->contact_angle.mean / kDegree) + " degrees is at most " +
           rounded(bound / kMillimetre) + " mm; check its footprint, or ask for less liquid";
}

/// Whether a surface bends at the rim alone: not over ground with relief, nor where liquid ends on a tilted plane.
bool bendsAtRim(const SolveOptions& options)
{
    return options.ground.flat() && !(options.no_penetration && planeGravity(options).along != Vec2{});
}

/// Warning about triangles that are too long for the layer along the rim; empty if there are none.
std::string coarseWarning(const Droplet& droplet, const DropletOptions& options, std::size_t triangles)
{
    const std::optional<double> layer = bendingLayer(options.solve);
    if (!layer) {
        return {};
    }
    constexpr double kVisible = 0.01;
    // The error of the height is a multiple of the edges' square. Discs 100 and 200 mm wide, with 4 and 2 edges per
    // capillary length: linear model 0.036 and 0.034; exact 0.045 and 0.041 at 20°, 0.089 and 0.070 at 40°, 0.28 and
    // 0.16 at 60°, then no more than 0.47, because triangles are moved toward steep rims. About 0.036/cos³θ. Where
    // steep surfaces have few edges per capillary length it is less: 2 % at 117° with three, 11 % with one, 13 % at
    // 60°.
    constexpr double kLinear = 0.036;
    constexpr double kSteepest = 64.0 * kDegree;
    constexpr double kCoarse = 0.058;
    constexpr double kCoarseSquared = 0.05;
    const double angle =
        droplet.solution.report.model == Model::Exact ? std::min(droplet.total.contact_angle.mean, kSteepest) : 0.0;
    const double error = kLinear / std::pow(std::cos(angle), 3.0);
    double longest = 0.0;
    for (const PlanarMesh& mesh : droplet.meshes) {
        longest = std::max(longest, rimLength(mesh) / static_cast<double>(mesh.rimVertexCount()));
    }
    const double relative = longest / *layer;
    const double share = std::min(error * relative * relative, (kCoarse + kCoarseSquared * relative) * relative);
    if (share <= kVisible) {
        return {};
    }
    const double times = relative * std::sqrt(error / kVisible);
    const auto enough = static_cast<std::size_t>(static_cast<double>(triangles) * times * times);
    return "triangles along the rim are " + rounded(longest / kMillimetre) +
           " mm long, but the surface bends there within " + rounded(*layer / kMillimetre) +
           " mm, so heights may be off by about " + percent(share) + "; " +
           (options.mesh.edge ? "shorten the edges to " + rounded(longest / times / kMillimetre) + "mm"
                              : "raise the number of triangles to " + countText(enough)) +
           " for 1 %";
}

/// Warning about height fields that are upright along a part of their rims; empty if there are none.
/// @param model  that was asked for
std::string uprightWarning(const Droplet& droplet, const LiquidShapes& shapes, Model model)
{
    const double share = droplet.solution.report.model == Model::Exact ? uprightShare(droplet) : 0.0;
    if (share == 0.0) {
        return {};
    }
    std::string why;
    if (shapes.given_up) {
        why = *shapes.given_up == SheetEnd::OutOfWork
                  ? ": the search for that shape was given up for the work it took"
                  : std::string(": no such shape was found, for ") +
                        (*shapes.given_up == SheetEnd::Contact ? "the liquid would touch itself" : "it is not stable");
    }
    // Upright angles stand for those from 90° to 180°.
    return "the liquid stands upright along " + percent(share) + " of its rim, where a real droplet would hang over" +
           why + "; its mean contact angle may be off by " + rounded(90.0 * share) + " degrees; ask for less liquid" +
           (model == Model::Exact ? "" : ", or use the exact model");
}

/// Warning about ground under a footprint that sheets leave dry; empty if there is none.
std::string dryWarning(const Droplet& droplet)
{
    constexpr double kVisible = 0.01;  // of the footprint
    const double share = droplet.total.dry_area / droplet.total.footprint_area;
    return share < kVisible
               ? ""
               : "the liquid leaves " + percent(share) + " of the footprint dry; a smaller width leaves less";
}

/// Warning about one droplet of several that has gathered most of what they share; empty if there is none.
std::string gatheredWarning(const Droplet& droplet, const Fill& fill)
{
    constexpr double kMost = 0.5;  // of the liquid
    if (fill.sharing != FillSharing::Total || droplet.figures.size() < 2) {
        return {};
    }
    const auto largest = std::max_element(droplet.figures.begin(), droplet.figures.end(),
                                          [](const auto& a, const auto& b) { return a.volume < b.volume; });
    const double share = largest->volume / droplet.total.volume;
    const bool is_widest =
        largest->footprint_area - largest->dry_area >= kMost * (droplet.total.footprint_area - droplet.total.dry_area);
    if (share < kMost || is_widest || largest->contact_angle.mean < 0.5 * std::numbers::pi) {
        return {};
    }
    return fmt::format(
        "one pressure drives {} of the liquid into droplet {} of {}; ask for less, or for an amount for each",
        percent(share), largest - droplet.figures.begin() + 1, droplet.figures.size());
}

/// Number of triangles of the liquid's surface.
std::size_t trianglesOf(const Droplet& droplet)
{
    std::size_t triangles = 0;
    for (const CapillarySurface& surface : droplet.solution.droplets) {
        triangles += surface.triangles.size();
    }
    return triangles;
}

/// Warning about a number of triangles that is not the wanted one; empty if it is near.
/// @param triangles  of the liquid's surface
/// @param is_fine    whether they are short enough for the layer along the rim
std::string countWarning(const Droplet& droplet, const TriangulateOptions& mesh, std::size_t triangles, bool is_fine)
{
    // Liquid that hangs over adds surface to the footprints' triangles.
    constexpr double kOff = 0.1;
    constexpr double kHangingOff = 0.25;
    std::size_t footprint_triangles = 0;
    for (const PlanarMesh& footprint : droplet.meshes) {
        footprint_triangles += footprint.triangles.size();
    }
    const auto off = [&](std::size_t count) {
        return std::abs(static_cast<double>(count) / static_cast<double>(mesh.triangles) - 1.0);
    };
    const bool is_near = off(triangles) <= kOff || (off(triangles) <= kHangingOff && off(footprint_triangles) <= kOff);
    if (mesh.edge || is_near) {
        return {};
    }
    // A number that nobody changed was not asked for.
    const std::string wanted = countText(mesh.triangles);
    const std::string counts =
        countText(triangles) + " triangles, not the " +
        (mesh.triangles == TriangulateOptions{}.triangles ? "default of " + wanted : wanted + " asked for");
    return triangles < mesh.triangles ? "the surface has " + counts + ": smaller ones failed where it is folded"
           : is_fine                  ? "the footprint's detail takes " + counts
                                      : "the bend of the liquid at its rim takes " + counts;
}

std::vector<std::string> warningsOf(const Droplet& droplet, const DropletOptions& options, const LiquidShapes& shapes)
{
    constexpr double kVisible = 1e-6;  // of the height; less is round-off
    std::vector<std::string> warnings;
    const ShapeFigures& total = droplet.total;
    const double steep = total.steep_area / total.footprint_area;
    const Model model = droplet.solution.report.model;
    if (shapes.is_stand_in) {
        warnings.emplace_back(
            "no exact shape was found for this amount; the linear model stands in, and is too high "
            "where it is steep; ask for less liquid");
    } else if (model == Model::Linear && steep >= kVisiblySteep) {
        warnings.push_back(percent(steep) +
                           " of the surface is too steep (over 50 degrees) for the linear model; use the exact model");
    }
    if (std::string upright = uprightWarning(droplet, shapes, options.solve.model); !upright.empty()) {
        warnings.push_back(std::move(upright));
    }
    if (!options.solve.no_penetration && total.depth_max > kVisible * total.height_max) {
        warnings.push_back("the liquid's surface sinks into the ground, by up to " +
                           rounded(total.depth_max / kMillimetre) + " mm; prevent penetration to keep it above");
    }
    for (std::string warning : {dryWarning(droplet), gatheredWarning(droplet, options.solve.fill)}) {
        if (!warning.empty()) {
            warnings.push_back(std::move(warning));
        }
    }
    const std::size_t triangles = trianglesOf(droplet);
    std::string coarse = coarseWarning(droplet, options, triangles);
    if (std::string count = countWarning(droplet, options.mesh, triangles, coarse.empty()); !count.empty()) {
        warnings.push_back(std::move(count));
    }
    if (!coarse.empty()) {
        warnings.push_back(std::move(coarse));
    }
    return warnings;
}

/// Warning about droplets that have less liquid than was wanted; empty if there are none.
std::string lessWarning(const LiquidShapes& shapes, const Fill& fill, std::size_t count)
{
    const std::size_t less = shapes.withLess();
    if (less == 0) {
        return {};
    }
    const std::string which =
        count == 1 ? "this footprint" : std::to_string(less) + " of " + std::to_string(count) + " footprints";
    const std::string wanted = fill.by == FillBy::ContactAngle
                                   ? "a mean contact angle of " + rounded(fill.amount / kDegree) + " degrees"
                                   : "the amount";
    return wanted + " does not exist on " + which + "; the largest that was found was taken, " +
           rounded(shapes.least_angle / kDegree) + " degrees" + (less > 1 ? " or more" : "");
}

/// What limits the amount of every droplet.
std::vector<FillLimit> limitsOf(const Droplet& droplet, const LiquidShapes& shapes, const SolveOptions& options)
{
    constexpr double kLess = 1.0 - 1e-6;  // of the angle that was wanted
    std::vector<FillLimit> limits = shapes.limits;
    limits.resize(droplet.meshes.size(), FillLimit::None);
    if (!options.fill.below_puddle || options.fill.by != FillBy::ContactAngle || !options.volumes.empty()) {
        return limits;
    }
    const bool is_shared = options.fill.sharing == FillSharing::Total;
    for (std::size_t k = 0; k < limits.size(); ++k) {
        const ShapeFigures& figures = is_shared ? droplet.total : droplet.figures[k];
        if (limits[k] == FillLimit::None && figures.contact_angle.mean < kLess * options.fill.amount) {
            limits[k] = FillLimit::Puddle;
        }
    }
    return limits;
}

/// Fills between 1 and the end of a range, the end included. Between neighbours at 1 and 4/3 the height of a cap of 40°
/// is off by a thousandth.
std::vector<double> fillsTo(double end)
{
    constexpr double kParts = 3.0;  // from 1 to 0, and for every doubling
    std::vector<double> fills;
    const auto count = static_cast<int>(std::ceil(kParts * (end < 1.0 ? 1.0 - end : std::log2(end)) - 1e-9));
    for (int k = 1; k <= count; ++k) {
        const double part = static_cast<double>(k) / count;
        fills.push_back(end < 1.0 ? 1.0 - (1.0 - end) * part : std::pow(end, part));
    }
    return fills;
}

/// Change of one surface into another one with the same vertices.
RefillState changeOf(const Surface& from, const Surface& to, double fill)
{
    RefillState state{fill, {}, {}};
    for (std::size_t v = 0; v < from.vertices.size(); ++v) {
        state.vertices.push_back(to.vertices[v] - from.vertices[v]);
        state.normals.push_back(to.normals[v] - from.normals[v]);
    }
    return state;
}

/// Solves droplets again at the fills of a range, outward from 1.
/// @param shapes  of the droplets at fill 1, but for their solution
/// @throws Error  NoSuchDroplet where droplets of the range do not exist, if it may not shrink
Refill refillOf(const Droplet& droplet, const LiquidShapes& shapes, const SolveOptions& solve, const FillRange& range,
                LoftOptions lofting)
{
    lofting.flatten = false;         // texture coordinates are those of fill 1
    constexpr int kMaxHalvings = 2;  // of a step to a fill that does not exist
    Refill result{1.0, 1.0, {}};
    for (const double end : {range.min, range.max}) {
        LiquidShapes last = shapes;
        last.solution = droplet.solution;
        double& reached = end < 1.0 ? result.min : result.max;
        for (const double next : fillsTo(end)) {
            std::optional<LiquidShapes> found;
            double fill = next;
            for (int k = 0; k <= kMaxHalvings && !found; ++k) {
                fill = reached + (next - reached) * std::pow(0.5, k);
                std::vector<double> volumes;
                for (const ShapeFigures& figures : droplet.figures) {
                    volumes.push_back(fill * figures.volume);
                }
                found = refill(droplet.meshes, last, volumes, solve);
            }
            if (found) {
                result.states.push_back(changeOf(droplet.surface, loft(found->solution.droplets, lofting), fill));
                last = *std::move(found);
                reached = fill;
            }
            if (reached != next) {
                break;
            }
        }
    }
    if (!range.may_shrink && (result.min > range.min || result.max < range.max)) {
        throw Error(ErrorCode::NoSuchDroplet, "droplets of fills " + rounded(range.min) + " to " + rounded(range.max) +
                                                  " do not all exist, but those of " + rounded(result.min) + " to " +
                                                  rounded(result.max) + " do; ask for these, or use the linear model");
    }
    std::sort(result.states.begin(), result.states.end(),
              [](const RefillState& a, const RefillState& b) { return a.fill < b.fill; });
    return result;
}

/// Figures of every droplet.
std::vector<ShapeFigures> figuresOf(const Solution& solution, const SolveOptions& solved)
{
    std::vector<ShapeFigures> figures;
    for (const CapillarySurface& surface : solution.droplets) {
        figures.push_back(measure(surface, solved));
    }
    return figures;
}

/// Bases of a film, with new ones where the rim of a surface is another one.
std::vector<PlanarMesh> basesOf(const Solution& solution, std::vector<PlanarMesh> bases)
{
    for (std::size_t k = 0; k < bases.size(); ++k) {
        if (!sameRim(bases[k], rimOf(solution.droplets[k]))) {
            bases[k] = movableCover(rimOf(solution.droplets[k]));
        }
    }
    return bases;
}

/// Checks that every droplet has liquid, and leaves out those that are dry because nothing may sink into the ground.
/// @return        number of droplets left out
/// @throws Error  NoSuchDroplet
std::size_t requireLiquid(const std::vector<ShapeFigures>& figures, bool no_penetration)
{
    std::size_t dry = 0;
    for (std::size_t k = 0; k < figures.size(); ++k) {
        if (figures[k].volume > 0.0) {
            continue;
        }
        ++dry;
        if (!no_penetration) {
            throw Error(ErrorCode::NoSuchDroplet,
                        (figures.size() == 1 ? "" : fmt::format("droplet {} of {}: ", k + 1, figures.size())) +
                            "with so little liquid the ground stands above it; ask for more, or prevent penetration");
        }
    }
    if (dry == figures.size()) {
        throw Error(ErrorCode::NoSuchDroplet, "with so little liquid all of the ground stays dry; ask for more");
    }
    return dry;
}

/// Options of solving: a range that was asked for takes the linear model, where every fill exists.
SolveOptions solveOptions(const DropletOptions& options)
{
    SolveOptions solve = options.solve;
    if (options.fill_range && !options.fill_range->may_shrink && solve.model == Model::Auto) {
        solve.model = Model::Linear;
    }
    return solve;
}

}  // namespace

bool sameRim(const PlanarMesh& a, const PlanarMesh& b)
{
    return a.loop_starts == b.loop_starts &&
           std::equal(a.vertices.begin(), a.vertices.begin() + a.rimVertexCount(), b.vertices.begin());
}

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
        progress(Stage::Trace, 0.0);
    }
    return makeDroplet(trace(mask, options.trace), options, progress);
}

DomainMeshes meshesOf(const Domain& domain, const DropletOptions& options)
{
    const SolveOptions solve = solveOptions(options);
    TriangulateOptions mesh = options.mesh;
    if (!mesh.layer && bendsAtRim(solve)) {
        mesh.layer = bendingLayer(solve);
    }
    if (!mesh.max_edge) {
        mesh.max_edge = bendingLayer(solve);
    }
    DomainMeshes result{triangulate(domain, mesh), gradingOf(domain, mesh) == 1};
    if (spreads(solve)) {
        std::vector<PlanarMesh> moved = spread(result.meshes, solve);
        for (std::size_t k = 0; k < moved.size(); ++k) {
            result.are_even = result.are_even && moved[k].vertices == result.meshes[k].vertices;
        }
        result.meshes = std::move(moved);
    }
    return result;
}

std::vector<double> volumesOf(const std::vector<PlanarMesh>& meshes, const DropletOptions& options)
{
    SolveOptions solved = solveOptions(options);
    solved.volumes.clear();
    const LiquidShapes shapes = solveShapes(meshes, solved, options.allow_less, {});
    solved.model = shapes.solution.report.model;
    const std::vector<ShapeFigures> figures = figuresOf(shapes.solution, solved);
    requireLiquid(figures, solved.no_penetration);
    std::vector<double> volumes;
    volumes.reserve(figures.size());
    for (const ShapeFigures& droplet : figures) {
        volumes.push_back(droplet.volume);
    }
    return volumes;
}

void finish(Droplet& droplet, const DropletOptions& options, const Progress& progress, FilmState film)
{
    SolveOptions solved = solveOptions(options);
    LiquidShapes shapes = solveShapes(droplet.meshes, solved, options.allow_less, progress, std::move(film.followed));
    droplet.solution = std::move(shapes.solution);
    solved.model = droplet.solution.report.model;
    if (progress) {
        progress(Stage::Loft, 0.0);
    }
    droplet.figures = figuresOf(droplet.solution, solved);
    droplet.total = combine(droplet.figures);
    const std::size_t dry = requireLiquid(droplet.figures, solved.no_penetration);
    droplet.limits = limitsOf(droplet, shapes, solved);
    LoftOptions lofting{.open = options.open,
                        .extent = droplet.domain.extent,
                        .ground = options.solve.ground,
                        .bases = basesOf(droplet.solution, std::move(film.bases)),
                        .even_base = options.mesh.quads,
                        .keeps_dry = film.keeps_triangles || options.fill_range};
    const bool is_affine = solved.model == Model::Linear;
    if (options.fill_range && is_affine) {
        lofting.refill = {*options.fill_range, gainsPerFill(droplet.meshes, droplet.solution.droplets, solved)};
    }
    droplet.surface = loft(droplet.solution.droplets, lofting);
    if (options.fill_range && !is_affine) {
        Refill refill = refillOf(droplet, shapes, options.solve, *options.fill_range, lofting);
        if (!refill.states.empty()) {
            droplet.surface.refill = std::move(refill);
        }
    }
    if (options.mesh.quads) {
        joinTriangles(droplet.surface);
    }
    droplet.warnings = warningsOf(droplet, options, shapes);
    if (std::string less = lessWarning(shapes, solved.fill, droplet.meshes.size()); !less.empty()) {
        droplet.warnings.push_back(std::move(less));
    }
    if (dry > 0) {
        droplet.warnings.push_back(
            fmt::format("{} of {} footprints {} dry and left out: at this pressure the "
                        "ground there is above the liquid",
                        dry, droplet.figures.size(), dry == 1 ? "is" : "are"));
    }
    if (std::string tall = heightWarning(droplet, solved); !tall.empty()) {
        droplet.warnings.insert(droplet.warnings.begin(), std::move(tall));
        droplet.severe_warnings = 1;
    }
}

Droplet makeDroplet(Outline outline, const DropletOptions& options, const Progress& progress)
{
    validateStages(options);
    Domain domain = split(outline);
    Droplet droplet = makeDroplet(std::move(domain), options, progress);
    droplet.outline = std::move(outline);
    return droplet;
}

Droplet makeDroplet(Domain domain, const DropletOptions& options, const Progress& progress)
{
    validateStages(options);
    Droplet droplet;
    droplet.domain = std::move(domain);
    if (progress) {
        progress(Stage::Triangulate, 0.0);
    }
    droplet.meshes = meshesOf(droplet.domain, options).meshes;
    finish(droplet, options, progress);
    return droplet;
}

}  // namespace droplet
