// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/shape/sheet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "blocks.h"
#include "droplet/error.h"
#include "mesh/mean_edge.h"
#include "mesh/rim_corner.h"
#include "mesh/round_inward.h"
#include "number_text.h"
#include "shape/puddle.h"
#include "shape/rim_figures.h"
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
/// Triangles of a footprint up to which a refusal is confirmed on edges half as long.
constexpr std::size_t kConfirmed = 10'000;
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

/// Clearance of ground that a sheet leaves dry, over the root of the footprint's area: round-off.
constexpr double kTouching = 1e-12;

/// Gradient of gravity's potential over the surface tension [1/m²].
Vec3 weightOf(const SolveOptions& options)
{
    const double scale = options.liquid.density / options.liquid.surface_tension;
    const PlaneGravity gravity = planeGravity(options);
    return scale * Vec3{-gravity.along.x, -gravity.along.y, gravity.normal};
}

void requireFlat(const SolveOptions& options)
{
    if (!options.ground.flat()) {
        throw Error(ErrorCode::InvalidArgument, "ground must be flat for sheets that follow their rims");
    }
}

SheetMesh meshOf(const ParametricSheet& sheet)
{
    return {sheet.vertices, sheet.triangles, sheet.rim};
}

/// Sides of a footprint's rim, and which of them are beside a place.
class RimSides {
public:
    explicit RimSides(const PlanarMesh& footprint)
    {
        for (std::size_t loop = 0; loop < footprint.loopCount(); ++loop) {
            Vec2 a = footprint.vertices[footprint.loop_starts[loop + 1] - 1];
            for (std::uint32_t v = footprint.loop_starts[loop]; v < footprint.loop_starts[loop + 1]; ++v) {
                sides_.push_back({a, footprint.vertices[v]});
                a = footprint.vertices[v];
                low_ = std::min(low_, a.y);
                high_ = std::max(high_, a.y);
            }
        }
        rows_.resize(sides_.size());
        for (std::size_t k = 0; k < sides_.size(); ++k) {
            const auto [first, last] = std::minmax({rowOf(sides_[k][0].y), rowOf(sides_[k][1].y)});
            for (std::size_t row = first; row <= last; ++row) {
                rows_[row].push_back(k);
            }
        }
    }

    [[nodiscard]] bool isInside(Vec2 place) const
    {
        bool is_inside = false;
        for (const std::size_t k : rows_[rowOf(place.y)]) {
            const auto& [a, b] = sides_[k];
            if ((a.y > place.y) != (b.y > place.y) && place.x < a.x + (place.y - a.y) / (b.y - a.y) * (b.x - a.x)) {
                is_inside = !is_inside;
            }
        }
        return is_inside;
    }

    /// Squared distance of a place, if it is more than another one; otherwise something below that [m²].
    /// @param near  side that is likely near; receives the nearest one that was looked at
    [[nodiscard]] double squaredIfMore(Vec2 place, double least, std::size_t& near) const
    {
        double nearest = squaredTo(place, near);
        for (std::size_t k = 0; k < sides_.size() && nearest > least; ++k) {
            const double squared = squaredTo(place, k);
            if (squared < nearest) {
                nearest = squared;
                near = k;
            }
        }
        return nearest;
    }

private:
    [[nodiscard]] std::size_t rowOf(double y) const
    {
        const auto count = static_cast<double>(rows_.size());
        return static_cast<std::size_t>(std::clamp((y - low_) / (high_ - low_) * count, 0.0, count - 1.0));
    }

    [[nodiscard]] double squaredTo(Vec2 place, std::size_t k) const
    {
        const auto& [a, b] = sides_[k];
        const Vec2 side = b - a;
        const Vec2 arm = place - a - std::clamp(dot(place - a, side) / dot(side, side), 0.0, 1.0) * side;
        return dot(arm, arm);
    }

    std::vector<std::array<Vec2, 2>> sides_;
    std::vector<std::vector<std::size_t>> rows_;  ///< sides that reach into strips of equal width
    double low_ = std::numeric_limits<double>::infinity();
    double high_ = -std::numeric_limits<double>::infinity();
};

/// How far a sheet leans out over its rim [m].
double overhangOf(const ParametricSheet& sheet)
{
    const RimSides rim(sheet.footprint);
    double overhang = 0.0;
    for (const double part :
         mapBlocks<double>(sheet.vertices.size() - sheet.rim, [&](std::size_t begin, std::size_t end) {
             double farthest = 0.0;
             std::size_t near = 0;
             for (std::size_t i = begin; i < end; ++i) {
                 const Vec3& p = sheet.vertices[sheet.rim + i];
                 if (!rim.isInside({p.x, p.y})) {
                     farthest = std::max(farthest, rim.squaredIfMore({p.x, p.y}, farthest, near));
                 }
             }
             return farthest;
         })) {
        overhang = std::max(overhang, part);
    }
    return std::sqrt(overhang);
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

void take(FilledSheet filled, const SolveOptions& options, SheetResult& result)
{
    result.end = filled.end;
    result.volume = filled.volume;
    result.contact_angle = filled.angle;
    result.newton_steps = static_cast<std::size_t>(filled.newton_steps);
    result.work = filled.work / kSheetUnits;
    result.residual = filled.residual;
    result.contact = filled.contact;
    result.sheet.contact_angle = smoothed(
        result.sheet.footprint, rimAngles(filled.mesh, weightOf(options), filled.pressure, options.ground).angle);
    result.sheet.vertices = std::move(filled.mesh.vertices);
    result.sheet.triangles = std::move(filled.mesh.triangles);
    result.sheet.rim = filled.mesh.rim;
    result.sheet.pressure = options.liquid.surface_tension * filled.pressure;
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
    const double share = effort == SheetEffort::Modest ? kModestWork : kSlightWork;
    const double own =
        effort == SheetEffort::Full ? std::max(kLeastFullWork, work) : share * std::max(kLeastWork, work);
    return most ? std::min(own, kSheetUnits * *most) : own;
}

/// Length of edges at a level of nested iteration.
struct LevelEdges {
    double scale = 1.0;  ///< over those of the finest level
    double share = 1.0;  ///< of the finest level over those of the footprints, for shapes; not for their final number
};

/// Footprints with their corners rounded, and what a sheet over them takes, but for the work.
/// @param may_round  otherwise they stay as they are
SheetLevel levelOf(const std::vector<PlanarMesh>& footprints, const SolveOptions& options, const LevelEdges& edges,
                   bool may_round)
{
    const std::optional<double> layer = bendingLayer(options);
    std::vector<PlanarMesh> rounded;
    double covered = 0.0;
    double triangles = 0.0;
    double wanted = 0.0;
    double path_edge = 0.0;
    for (const PlanarMesh& footprint : footprints) {
        const double size = area(footprint);
        const double own_edge = edges.scale * edgeOf(footprint);
        const double edge = edges.share * own_edge;
        // In wide puddles edges are shorter along the rim, where alone the surface bends.
        const double own_rim_edge =
            edges.scale * edges.share * rimLength(footprint) / static_cast<double>(footprint.rimVertexCount());
        const double rim_edge = layer ? std::min(edge, std::max(own_rim_edge, *layer / kEdgesPerLayer)) : edge;
        std::optional<PlanarMesh> changed =
            may_round ? roundInward(footprint, kInnerRadius * rim_edge, rim_edge) : std::nullopt;
        rounded.push_back(changed ? *std::move(changed) : footprint);
        covered += size;
        triangles += trianglesOf(size, edge);
        wanted += std::round(trianglesOf(size, own_edge));
        path_edge = std::max(path_edge, std::min(kPathEdge * edge, kPathPart * std::sqrt(size)));
    }
    return {rounded.size() == 1 ? std::move(rounded.front()) : join(rounded),
            {.weight = weightOf(options),
             .edge = kFinalEdge * meanEdge(covered, triangles),
             .path_edge = path_edge,
             .triangles = static_cast<std::size_t>(wanted),
             .ground = options.ground}};
}

/// @param share  of the triangles' edges over those of the footprints
SheetResult solveWith(const std::vector<PlanarMesh>& footprints, const SolveOptions& options, double share,
                      SheetEffort effort, const std::function<void(double)>& reached)
{
    double triangles = 0.0;
    double rounding = 0.0;
    std::vector<const PlanarMesh*> all;
    for (const PlanarMesh& footprint : footprints) {
        triangles += trianglesOf(area(footprint), share * edgeOf(footprint));
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
        levels.insert(levels.begin(), levelOf(footprints, options, {scale, share}, may_round));
        SheetOptions& own = levels.front().options;
        own.is_end_confirmed = effort == SheetEffort::Full;
        own.is_end_wanted = effort != SheetEffort::Trial;
        own.max_work = may_round ? most - rounding : 0.0;
        own.reached = reached;
        scale *= 2.0;
    } while (has_levels && static_cast<double>(levels.front().options.triangles) > kCoarsest);
    SheetResult result;
    double work = 0.0;
    std::optional<FilledSheet> filled = levels.size() > 1 ? fillByLevels(levels, target, work) : std::nullopt;
    if (!filled) {
        levels.back().options.max_work = std::max(levels.back().options.max_work - work, 0.0);
        filled = fillSheet(levels.back().footprint, target, levels.back().options);
        filled->work += work;
    }
    result.sheet.footprint = std::move(levels.back().footprint);
    take(*std::move(filled), options, result);
    return result;
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
    std::size_t triangles = 0;
    for (const PlanarMesh& footprint : footprints) {
        options.ground.requireAt({footprint.vertices.data(), footprint.rimVertexCount()});
        triangles += footprint.triangles.size();
    }
    SheetResult result = solveWith(footprints, options, 1.0, effort, reached);
    const bool is_open = result.end != SheetEnd::Reached && result.end != SheetEnd::OutOfWork;
    const bool has_work = !options.max_work || result.work < *options.max_work;
    if (is_open && effort == SheetEffort::Full && triangles <= kConfirmed && has_work) {
        SolveOptions rest = options;
        if (rest.max_work) {
            *rest.max_work -= result.work;
        }
        SheetResult finer = solveWith(footprints, rest, 0.5, effort, reached);
        const double work = result.work + finer.work;
        if (finer.end == SheetEnd::Reached || finer.volume > result.volume) {
            result = std::move(finer);
        }
        result.work = work;
    }
    return result;
}

SheetResult refill(const ParametricSheet& sheet, double volume, const SolveOptions& options)
{
    options.liquid.validate();
    if (!(volume > 0.0)) {
        throw Error(ErrorCode::InvalidArgument, "volume = " + numberText(volume) + " must be positive");
    }
    SheetResult result;
    result.sheet.footprint = sheet.footprint;
    const Vec3 weight = weightOf(options);
    take(refillSheet(meshOf(sheet), sheet.pressure / options.liquid.surface_tension, {FillBy::Volume, volume}, weight,
                     baseOf(sheet.footprint, options.ground, weight)),
         options, result);
    return result;
}

SheetResult follow(const ParametricSheet& first, const ParametricSheet& last, const PlanarMesh& footprint,
                   const SolveOptions& options)
{
    options.liquid.validate();
    options.fill.validate();
    requireFlat(options);
    if (first.triangles != last.triangles || first.rim != last.rim ||
        footprint.loop_starts != first.footprint.loop_starts) {
        throw Error(ErrorCode::InvalidArgument, "first, last and footprint must have the same triangles and loops");
    }
    SheetResult result;
    if (hasInnerCorner(footprint) && !hasInnerCorner(first.footprint)) {
        // It needs rounding, which solveSheet() does.
        result.sheet = last;
        result.end = SheetEnd::Unstable;
        return result;
    }
    result.sheet.footprint = footprint;
    const std::vector<Vec2> rim(footprint.vertices.begin(), footprint.vertices.begin() + footprint.rimVertexCount());
    take(followSheet(meshOf(first), meshOf(last), last.pressure / options.liquid.surface_tension, rim,
                     {options.fill.by, options.fill.amount}, weightOf(options)),
         options, result);
    return result;
}

double minAngle(const ParametricSheet& sheet)
{
    const std::vector<double> angles = minAngles(meshOf(sheet));
    return *std::min_element(angles.begin(), angles.end());
}

ShapeFigures measure(const ParametricSheet& sheet, const SolveOptions& options)
{
    const Vec3 weight = weightOf(options);
    const SheetBase base = baseOf(sheet.footprint, options.ground, weight);
    const SheetIntegrals sums = integrate({sheet.vertices, sheet.triangles, sheet.rim}, weight);
    const double sigma = options.liquid.surface_tension;
    ShapeFigures figures;
    figures.footprint_area = area(sheet.footprint);
    figures.volume = sums.volume - base.integrals.volume;
    figures.liquid_area = sums.area;
    figures.gravity_energy = sigma * (sums.gravity - base.integrals.gravity);
    const double touching = kTouching * std::sqrt(figures.footprint_area);
    std::vector<std::uint8_t> is_grounded;
    for (const Vec3& p : sheet.vertices) {
        const double clearance = base.clearance(p);
        is_grounded.push_back(clearance <= touching ? 1 : 0);
        if (std::isfinite(clearance)) {
            figures.height_max = std::max(figures.height_max, clearance);
            figures.depth_max = std::max(figures.depth_max, -clearance);
        }
    }
    for (const Triangle& t : sheet.triangles) {
        const Vec3 normal = areaVector(sheet.vertices, t);
        // Liquid that lies on the ground beside the footprint has its surface upside down there.
        if (normal.z > 0.0 && std::all_of(t.begin(), t.end(), [&](std::uint32_t v) { return is_grounded[v] != 0; })) {
            figures.dry_area += normal.z;
            figures.liquid_area -= length(normal);
        }
        figures.slope_max = std::max(figures.slope_max, std::atan2(std::hypot(normal.x, normal.y), normal.z));
    }
    figures.surface_energy = sigma * figures.liquid_area;
    figures.overhang = overhangOf(sheet);
    addRimFigures(sheet.footprint, sheet.contact_angle, options, figures);
    return figures;
}

}  // namespace droplet
