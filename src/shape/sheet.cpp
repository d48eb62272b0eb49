// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/shape/sheet.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "droplet/error.h"
#include "mesh/mean_edge.h"
#include "mesh/rim_corner.h"
#include "mesh/round_inward.h"
#include "number_text.h"
#include "shape/puddle.h"
#include "shape/sheet_base.h"
#include "shape/sheet_energy.h"
#include "shape/sheet_follow.h"
#include "shape/sheet_levels.h"
#include "shape/sheet_path.h"
#include "shape/sheet_remesh.h"
#include "shape/work.h"

namespace droplet {
namespace {

/// Largest edges of sheets that confirm an end and of those on the way, over the mean edge of the footprint's mesh.
constexpr double kFinalEdge = 1.5;
constexpr double kPathEdge = 5.0;
/// Largest edges of the footprint and of the sheets on the way, over the root of the footprint's area: droplets of a
/// dozen triangles, as in large pictures, have no shape.
constexpr double kLeastPart = 0.08;
constexpr double kPathPart = 0.15;
/// Most triangles of the coarsest level of nested iteration: with fewer than 3000 a star and a g failed at the first
/// motion of their rims.
constexpr double kCoarsest = 12'000.0;
/// Radius of corners that point inward, over the same: with half of it all slits of drawings were filled, with none a
/// third of them failed.
constexpr double kInnerRadius = 0.5;
/// Most work over that of one factorisation on the footprint's triangles. Of 298 silhouettes of 8000 triangles half
/// took 30 and one 310 at 40°, half 41 and one 620 at 60°; of drawings of 40 000 a butterfly took 370.
constexpr double kWork = 1500.0;
/// Least limit of the work of a full effort, half a minute, and of the others. A U of 600 triangles took 1.5e7 in all;
/// a cock of 8000 took 1.4e9.
constexpr double kLeastFullWork = 1e10;
constexpr double kLeastWork = 3e8;
/// Most work of a full effort, one and a half minutes: masks full of holes take a hundred thousand triangles and more.
constexpr double kMostWork = 4e10;
/// Work of rounding a rim, over the square of its vertices. Noise is the worst case: 174 000 took two minutes.
constexpr double kRoundingWork = 2.0;
/// Share of it for slight and modest efforts: of the masks of data/, none is made with 0.1 that is not with 0.03.
constexpr double kSlightWork = 0.04;
constexpr double kModestWork = 0.3;
/// Work up to which a trial is a modest effort, one second; a slight one beyond. Of 255 silhouettes of 8000 triangles
/// at 40°, 161 were sheets with slight efforts, and 205 with this; the others kept an upright height field, with up to
/// 45 % more liquid.
constexpr double kTrialWork = 5e8;

void requireFlat(const SolveOptions& options)
{
    if (!options.ground.flat()) {
        throw Error(ErrorCode::InvalidArgument, "ground must be flat for sheets that follow their rims");
    }
}

/// Places and triangles alone.
CapillarySurface bare(const CapillarySurface& surface)
{
    return {.vertices = surface.vertices, .triangles = surface.triangles, .loop_starts = surface.loop_starts};
}

/// Takes the noise of single triangles out of angles along a rim, between its corners. A mean over a vertex and its
/// neighbours is what a test function twice as wide measures: it takes the largest error on discs from order 0.7 to 1.
/// The mean along the rim stays.
std::vector<double> smoothed(const PlanarMesh& footprint, const std::vector<double>& angle)
{
    std::vector<double> result = angle;
    for (std::size_t loop = 0; loop < footprint.loopCount(); ++loop) {
        const std::uint32_t begin = footprint.loop_starts[loop];
        const std::uint32_t count = footprint.loop_starts[loop + 1] - begin;
        const auto side = [&](std::uint32_t i) {
            return footprint.vertices[begin + (i + 1) % count] - footprint.vertices[begin + i % count];
        };
        const auto is_corner = [&](std::uint32_t i) {
            const Vec2 in = side(i + count - 1);
            const Vec2 out = side(i);
            return std::abs(turnBetween(in, out)) > kCorner;
        };
        for (std::uint32_t i = 0; i < count; ++i) {
            const std::uint32_t next = (i + 1) % count;
            if (is_corner(i) || is_corner(next)) {
                continue;
            }
            const double edge = length(side(i));
            const double exchanged = 0.5 * edge * (angle[begin + next] - angle[begin + i]);
            result[begin + i] += exchanged / (length(side(i + count - 1)) + edge);
            result[begin + next] -= exchanged / (edge + length(side(next)));
        }
    }
    return result;
}

/// @param footprint  of the sheet
SheetResult resultOf(FilledSheet filled, PlanarMesh footprint, const SolveOptions& options)
{
    SheetResult result;
    result.end = filled.end;
    result.volume = filled.volume;
    result.contact_angle = filled.angle;
    result.newton_steps = static_cast<std::size_t>(filled.newton_steps);
    result.work = filled.work / kSheetUnits;
    result.residual = filled.residual;
    result.contact = filled.contact;
    CapillarySurface& surface = result.surface;
    surface = std::move(filled.mesh);
    surface.contact_angle =
        smoothed(footprint, rimAngles(surface, weightOf(options), filled.pressure, options.ground).angle);
    surface.pressure = options.liquid.surface_tension * filled.pressure;
    surface.footprint = std::move(footprint);
    surface.dry = SheetBase{options.ground}.dryOf(surface);
    return result;
}

/// Mean edge of the triangles over a footprint [m].
double edgeOf(const PlanarMesh& footprint)
{
    const double size = area(footprint);
    return std::min(meanEdge(size, footprint.triangles.size()), kLeastPart * std::sqrt(size));
}

/// Most work of a sheet, as SheetOptions::max_work.
/// @param most  as SolveOptions::max_work
double workOf(double triangles, SheetEffort effort, std::optional<double> most)
{
    const double work = std::min(kWork * std::pow(triangles, 1.5), kMostWork);
    const double slight = kSlightWork * std::max(kLeastWork, work);
    double own = 0.0;
    switch (effort) {
        case SheetEffort::Slight:
            own = slight;
            break;
        case SheetEffort::Trial:
            own = std::max(slight, std::min(kModestWork * work, kTrialWork));
            break;
        case SheetEffort::Modest:
            own = kModestWork * std::max(kLeastWork, work);
            break;
        case SheetEffort::Full:
            own = std::max(kLeastFullWork, work);
            break;
    }
    return most ? std::min(own, kSheetUnits * *most) : own;
}

/// Footprints with their corners rounded, and what a sheet over them takes at a level, but for the work.
/// @param scale      of edges over those of the finest level
/// @param may_round  otherwise they stay as they are
SheetLevel levelOf(const std::vector<PlanarMesh>& footprints, const SolveOptions& options, double scale, bool may_round)
{
    const std::optional<double> layer = bendingLayer(options);
    std::vector<PlanarMesh> rounded;
    double covered = 0.0;
    double triangles = 0.0;
    double path_edge = 0.0;
    for (const PlanarMesh& footprint : footprints) {
        const double size = area(footprint);
        const double edge = scale * edgeOf(footprint);
        // In wide puddles edges are shorter along the rim, where alone the surface bends.
        const double own_rim_edge = scale * rimLength(footprint) / static_cast<double>(footprint.rimVertexCount());
        const double rim_edge = layer ? std::min(edge, std::max(own_rim_edge, *layer / kEdgesPerLayer)) : edge;
        std::optional<PlanarMesh> changed =
            may_round ? roundInward(footprint, kInnerRadius * rim_edge, rim_edge) : std::nullopt;
        rounded.push_back(changed ? *std::move(changed) : footprint);
        covered += size;
        triangles += trianglesOf(size, edge);
        path_edge = std::max(path_edge, std::min(kPathEdge * edge, kPathPart * std::sqrt(size)));
    }
    return {rounded.size() == 1 ? std::move(rounded.front()) : join(rounded),
            {.weight = weightOf(options),
             .edge = kFinalEdge * meanEdge(covered, triangles),
             .path_edge = path_edge,
             .triangles = static_cast<std::size_t>(std::lround(triangles)),
             .ground = options.ground}};
}

}  // namespace

SheetResult solveSheet(const PlanarMesh& footprint, const SolveOptions& options, SheetEffort effort)
{
    return solveSheet(std::vector<PlanarMesh>{footprint}, options, effort);
}

SheetResult solveSheet(const std::vector<PlanarMesh>& footprints, const SolveOptions& options, SheetEffort effort,
                       const std::function<void(double)>& reached)
{
    options.liquid.validate();
    options.fill.validate();
    for (const PlanarMesh& footprint : footprints) {
        options.ground.requireAt({footprint.vertices.data(), footprint.rimVertexCount()});
    }
    double triangles = 0.0;
    double rounding = 0.0;
    std::vector<const PlanarMesh*> all;
    for (const PlanarMesh& footprint : footprints) {
        triangles += trianglesOf(area(footprint), edgeOf(footprint));
        rounding += hasInnerCorner(footprint) ? kRoundingWork * std::pow(footprint.rimVertexCount(), 2.0) : 0.0;
        all.push_back(&footprint);
    }
    const double most = workOf(triangles, effort, options.max_work);
    const bool may_round = rounding < most;
    SolveOptions exact = options;
    exact.model = Model::Exact;
    const SheetTarget target{options.fill.by, options.fill.amount, maxHeight(all, exact)};
    // On ground that is not flat, what lies under a coarse rim is not under the fine one.
    const bool has_levels = may_round && options.ground.flat();
    std::vector<SheetLevel> levels;
    double scale = 1.0;
    do {
        levels.insert(levels.begin(), levelOf(footprints, options, scale, may_round));
        SheetOptions& own = levels.front().options;
        own.is_end_confirmed = effort == SheetEffort::Full || (effort == SheetEffort::Modest && !options.ground.flat());
        own.is_largest_wanted = effort != SheetEffort::Full;
        own.is_end_wanted = effort != SheetEffort::Trial;
        own.max_work = may_round ? most - rounding : 0.0;
        own.reached = reached;
        scale *= 2.0;
    } while (has_levels && static_cast<double>(levels.front().options.triangles) > kCoarsest);
    double work = 0.0;
    std::optional<FilledSheet> filled = levels.size() > 1 ? fillByLevels(levels, target, work) : std::nullopt;
    if (!filled) {
        levels.back().options.max_work = std::max(levels.back().options.max_work - work, 0.0);
        filled = fillSheet(levels.back().footprint, target, levels.back().options);
        filled->work += work;
    }
    return resultOf(*std::move(filled), std::move(levels.back().footprint), options);
}

SheetResult refill(const CapillarySurface& sheet, double volume, const SolveOptions& options)
{
    options.liquid.validate();
    if (!(volume > 0.0)) {
        throw Error(ErrorCode::InvalidArgument, "volume = " + numberText(volume) + " must be positive");
    }
    const PlanarMesh footprint = footprintOf(sheet);
    const Vec3 weight = weightOf(options);
    return resultOf(refillSheet(bare(sheet), sheet.pressure / options.liquid.surface_tension, {FillBy::Volume, volume},
                                weight, baseOf(footprint, options.ground, weight)),
                    footprint, options);
}

SheetResult follow(const CapillarySurface& first, const CapillarySurface& last, const PlanarMesh& footprint,
                   const SolveOptions& options)
{
    options.liquid.validate();
    options.fill.validate();
    requireFlat(options);
    if (first.triangles != last.triangles || first.loop_starts != last.loop_starts ||
        footprint.loop_starts != first.loop_starts) {
        throw Error(ErrorCode::InvalidArgument, "first, last and footprint must have the same triangles and loops");
    }
    const std::vector<Vec2> rim(footprint.vertices.begin(), footprint.vertices.begin() + footprint.rimVertexCount());
    return resultOf(followSheet(bare(first), bare(last), last.pressure / options.liquid.surface_tension, rim,
                                {options.fill.by, options.fill.amount}, weightOf(options)),
                    footprint, options);
}

}  // namespace droplet
