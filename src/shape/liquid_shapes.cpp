// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape/liquid_shapes.h"

#include <fmt/core.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <numbers>
#include <numeric>
#include <string>
#include <utility>

#include "droplet/error.h"
#include "droplet/shape/figures.h"
#include "droplet/units.h"
#include "number_text.h"
#include "shape/sheet_contact.h"
#include "shape/sheet_mesh.h"

namespace droplet {
namespace {

/// Steps of Newton's method after which a sheet is tried first; height fields that exist take 4 to 8.
constexpr std::size_t kQuickSteps = 15;

/// Work of the height field where no sheet was found, as in SolveOptions: some seconds.
constexpr double kMaxWork = 2e7;

/// Share of the wanted contact angle below which a sheet is no droplet, and the linear model is taken.
constexpr double kLeastShare = 0.5;

/// Largest mean contact angle of sheets that sink to the ground on a straight way [rad].
constexpr double kFlat = 30.0 * kDegree;

/// Reduction of the contact angle until neighbours do not touch [rad], and its most repetitions.
constexpr double kLower = 2.0 * kDegree;
constexpr int kMaxLowerings = 60;

/// Whether liquid may hang over its rim.
bool mayHang(const SolveOptions& options)
{
    return options.model != Model::Linear && options.ground.flat() && !options.no_penetration &&
           options.fill.sharing == FillSharing::Each;
}

/// Whether there is no height field for sure.
bool mustHang(const SolveOptions& options)
{
    return options.volumes.empty() && options.fill.by == FillBy::ContactAngle &&
           options.fill.amount >= 0.5 * std::numbers::pi;
}

bool isUpright(const HeightField& field)
{
    return std::any_of(field.contact_angle.begin(), field.contact_angle.end(),
                       [](double angle) { return angle >= kUpright; });
}

/// Beginning of a message about one droplet of several.
std::string ofDroplet(std::size_t k, std::size_t count)
{
    return count == 1 ? "" : fmt::format("droplet {} of {}: ", k + 1, count);
}

/// Why there is no height field, and what to change.
std::string refusal(const SolveReport& report, const std::string& which)
{
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
    return which + "the equations could not be solved (residual " + numberText(report.residual, 3) +
           "); try another number of --triangles";
}

/// Why there is no sheet, and what to change.
std::string refusal(const SheetResult& result, const std::string& which)
{
    const std::string at = numberText(result.volume / kMicrolitre, 4) + " uL";
    const std::string angle = numberText(result.contact_angle / kDegree, 3) + " degrees";
    switch (result.end) {
        case SheetEnd::NoAngle:
            return which + "no such droplet exists on this footprint: the mean contact angle is at most " + angle +
                   ", at " + at + "; --volume goes on beyond it";
        case SheetEnd::NoHeight:
            return which + "no such droplet exists on this footprint: it is highest at " + at + "; ask for less";
        case SheetEnd::Contact:
            return which + "such a droplet would touch itself at x " + numberText(result.contact->x / kMillimetre, 3) +
                   " mm, y " + numberText(result.contact->y / kMillimetre, 3) + " mm; it holds at most " + at +
                   " (mean contact angle " + angle + "); ask for less";
        case SheetEnd::OutOfWork:
            return which + std::to_string(result.newton_steps) + " steps of Newton's method reached only " + at +
                   " (mean contact angle " + angle + "); ask for less, or use fewer --triangles";
        case SheetEnd::Unstable:
        case SheetEnd::Reached:
            break;
    }
    return which + "no stable droplet was found on this footprint with more than " + at + " (mean contact angle " +
           angle + "); ask for less";
}

/// Shape of one droplet.
struct Shape {
    std::optional<HeightField> field;
    std::optional<SheetResult> sheet;
    SolveReport report;  ///< of the height field
};

/// Height field of one droplet, and how it was found.
Shape solveField(const PlanarMesh& mesh, const SolveOptions& options)
{
    Solution solution = solve({mesh}, options);
    Shape shape{{}, {}, solution.report};
    if (solution.report.usable()) {
        shape.field = std::move(solution.droplets.front());
    }
    return shape;
}

/// Options of one droplet.
SolveOptions ownOptions(const SolveOptions& options, std::size_t k)
{
    SolveOptions own = options;
    if (!options.volumes.empty()) {
        own.volumes.clear();
        own.fill = {FillBy::Volume, options.volumes[k], FillSharing::Each};
    }
    return own;
}

/// Shape of a droplet that may hang over its rim.
/// @param field  height field, if it was found before
Shape solveShape(const PlanarMesh& mesh, const SolveOptions& options, std::optional<HeightField> field,
                 SheetEffort effort)
{
    Shape shape{std::move(field), {}, {}};
    if (!shape.field && !mustHang(options)) {
        SolveOptions quick = options;
        quick.max_newton_steps = std::min(options.max_newton_steps, kQuickSteps);
        shape = solveField(mesh, quick);
    }
    if (shape.field ? !isUpright(*shape.field) : shape.report.termination == Termination::Unstable) {
        return shape;
    }
    shape.sheet = solveSheet(mesh, options, effort);
    if (shape.sheet->end == SheetEnd::Reached) {
        shape.field.reset();
    } else if (!shape.field && !mustHang(options)) {
        SolveOptions limited = options;
        limited.max_work = options.max_work.value_or(kMaxWork);
        Shape upright = solveField(mesh, limited);
        upright.sheet = std::move(shape.sheet);
        return upright;
    }
    return shape;
}

/// Surface of a height field as a sheet.
SheetMesh sheetOf(const PlanarMesh& mesh, const HeightField& field)
{
    SheetMesh sheet{{}, mesh.triangles, mesh.rimVertexCount()};
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
        sheet.places.push_back({mesh.vertices[v].x, mesh.vertices[v].y, field.height[v]});
    }
    return sheet;
}

/// First place where two droplets touch.
std::optional<SheetContact> neighbourContact(const std::vector<PlanarMesh>& meshes, const LiquidShapes& shapes)
{
    std::vector<SheetMesh> sheets;
    std::vector<const SheetMesh*> all;
    sheets.reserve(meshes.size());
    all.reserve(meshes.size());
    for (std::size_t k = 0; k < meshes.size(); ++k) {
        const std::optional<ParametricSheet>& sheet = shapes.sheets[k];
        sheets.push_back(sheet ? SheetMesh{sheet->places, sheet->triangles, sheet->rim}
                               : sheetOf(meshes[k], shapes.solution.droplets[k]));
    }
    for (const SheetMesh& sheet : sheets) {
        all.push_back(&sheet);
    }
    return firstContact(all);
}

/// Takes up the result of a droplet that is a sheet.
void take(SheetResult& result, std::size_t k, LiquidShapes& shapes)
{
    HeightField& field = shapes.solution.droplets[k];
    field = {};
    field.contact_angle = result.sheet.contact_angle;
    field.pressure = result.sheet.pressure;
    shapes.sheets[k] = std::move(result.sheet);
    SolveReport& report = shapes.solution.report;
    report.newton_steps = std::max(report.newton_steps, result.newton_steps);
}

/// Lowers the contact angles of droplets that touch until they do not.
void separate(const std::vector<PlanarMesh>& meshes, const SolveOptions& options, LiquidShapes& shapes)
{
    std::vector<bool> is_lowered(meshes.size(), false);
    for (int round = 0; round < kMaxLowerings; ++round) {
        const std::optional<SheetContact> contact = neighbourContact(meshes, shapes);
        if (!contact) {
            return;
        }
        for (const std::size_t k : {contact->first, contact->second}) {
            if (!shapes.sheets[k]) {
                continue;
            }
            SolveOptions own = options;
            own.volumes.clear();
            own.fill = {FillBy::ContactAngle, 0.0, FillSharing::Each};
            const double angle = measure(*shapes.sheets[k], options).contact_angle.mean;
            for (int lowering = 1; angle > lowering * kLower; ++lowering) {
                own.fill.amount = angle - lowering * kLower;
                SheetResult lower = solveSheet(meshes[k], own, SheetEffort::Modest);
                if (lower.end == SheetEnd::Reached) {
                    shapes.least_angle = std::min(shapes.least_angle, own.fill.amount);
                    take(lower, k, shapes);
                    shapes.with_less += is_lowered[k] ? 0 : 1;
                    is_lowered[k] = true;
                    break;
                }
            }
        }
    }
}

/// Solves the height fields again with other volumes.
bool refillFields(const std::vector<PlanarMesh>& meshes, const std::vector<double>& volumes,
                  const SolveOptions& options, LiquidShapes& shapes)
{
    std::vector<PlanarMesh> own_meshes;
    SolveOptions own = options;
    own.model = shapes.solution.report.model;
    own.max_newton_steps = std::min(options.max_newton_steps, kQuickSteps);
    own.volumes.clear();
    std::vector<std::size_t> own_places;
    for (std::size_t k = 0; k < meshes.size(); ++k) {
        if (shapes.sheets.empty() || !shapes.sheets[k]) {
            own_meshes.push_back(meshes[k]);
            own.volumes.push_back(volumes[k]);
            own_places.push_back(k);
        }
    }
    if (own_meshes.empty()) {
        return true;
    }
    if (options.fill.sharing == FillSharing::Total) {
        own.fill = {FillBy::Volume, std::accumulate(own.volumes.begin(), own.volumes.end(), 0.0), FillSharing::Total};
        own.volumes.clear();
    } else {
        own.fill = {};
    }
    Solution solution = solve(own_meshes, own);
    if (!solution.report.usable()) {
        return false;
    }
    for (std::size_t k = 0; k < own_places.size(); ++k) {
        HeightField& field = shapes.solution.droplets[own_places[k]];
        if (isUpright(solution.droplets[k]) && !isUpright(field)) {
            return false;
        }
        field = std::move(solution.droplets[k]);
    }
    return true;
}

/// Shapes without liquid, if they lie on the ground, and the shapes so far are so flat that they may sink to it.
std::optional<LiquidShapes> empty(LiquidShapes shapes, const SolveOptions& options)
{
    if (!options.ground.flat() || planeGravity(options).along != Vec2{}) {
        return std::nullopt;
    }
    for (HeightField& field : shapes.solution.droplets) {
        std::fill(field.height.begin(), field.height.end(), 0.0);
        std::fill(field.rim_slope.begin(), field.rim_slope.end(), 0.0);
        std::fill(field.contact_angle.begin(), field.contact_angle.end(), 0.0);
        field.pressure = 0.0;
    }
    for (std::optional<ParametricSheet>& sheet : shapes.sheets) {
        if (!sheet) {
            continue;
        }
        if (measure(*sheet, options).contact_angle.mean > kFlat) {
            return std::nullopt;
        }
        for (Vec3& place : sheet->places) {
            place.z = 0.0;
        }
        std::fill(sheet->contact_angle.begin(), sheet->contact_angle.end(), 0.0);
        sheet->pressure = 0.0;
    }
    return shapes;
}

}  // namespace

std::optional<LiquidShapes> refill(const std::vector<PlanarMesh>& meshes, const LiquidShapes& shapes,
                                   const std::vector<double>& volumes, const SolveOptions& options)
{
    if (std::all_of(volumes.begin(), volumes.end(), [](double volume) { return volume == 0.0; })) {
        return empty(shapes, options);
    }
    LiquidShapes result = shapes;
    if (!refillFields(meshes, volumes, options, result)) {
        return std::nullopt;
    }
    if (shapes.sheets.empty()) {
        return result;
    }
    std::vector<std::optional<SheetResult>> found(meshes.size());
    tbb::parallel_for(std::size_t{0}, meshes.size(), [&](std::size_t k) {
        if (shapes.sheets[k] && volumes[k] > 0.0) {
            found[k] = refill(*shapes.sheets[k], volumes[k], options);
        }
    });
    for (std::size_t k = 0; k < meshes.size(); ++k) {
        if (shapes.sheets[k]) {
            if (!found[k] || found[k]->end != SheetEnd::Reached) {
                return std::nullopt;
            }
            take(*found[k], k, result);
        }
    }
    return neighbourContact(meshes, result) ? std::nullopt : std::optional(std::move(result));
}

LiquidShapes solveShapes(const std::vector<PlanarMesh>& meshes, const SolveOptions& options, bool allow_less,
                         const Progress& progress, std::vector<std::optional<SheetResult>> followed)
{
    const std::size_t count = meshes.size();
    LiquidShapes shapes;
    Solution& solution = shapes.solution;
    if (!mayHang(options)) {
        solution = solve(meshes, options, progress);
        if (!solution.report.usable() && options.model == Model::Auto) {
            // On such ground the linear model is all there is.
            SolveOptions linear = options;
            linear.model = Model::Linear;
            if (Solution flat = solve(meshes, linear); flat.report.usable()) {
                solution = std::move(flat);
            }
        }
        if (!solution.report.usable()) {
            throw Error(ErrorCode::NoSuchDroplet,
                        refusal(solution.report, options.fill.sharing == FillSharing::Each
                                                     ? ofDroplet(solution.report.failed_droplet, count)
                                                     : ""));
        }
        return shapes;
    }
    followed.resize(count);
    const bool any_followed = std::any_of(followed.begin(), followed.end(), [](const auto& one) { return !!one; });
    if (!mustHang(options) && !any_followed) {
        SolveOptions quick = options;
        quick.max_newton_steps = std::min(options.max_newton_steps, kQuickSteps);
        solution = solve(meshes, quick, progress);
        if (solution.report.usable() && std::none_of(solution.droplets.begin(), solution.droplets.end(), isUpright)) {
            return shapes;
        }
    } else if (progress) {
        progress(Stage::Solve);
    }
    const bool has_fields = solution.report.usable();
    std::vector<Shape> found(count);
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t k) {
        if (followed[k]) {
            found[k].sheet = std::move(followed[k]);
            return;
        }
        found[k] = solveShape(meshes[k], ownOptions(options, k),
                              has_fields ? std::optional(std::move(solution.droplets[k])) : std::nullopt,
                              allow_less ? SheetEffort::Modest : SheetEffort::Full);
    });
    solution.droplets.assign(count, {});
    shapes.sheets.resize(count);
    SolveReport& report = solution.report;
    report.model = Model::Exact;
    report.termination = Termination::Converged;
    if (report.method.empty()) {
        report.method = "simplicial-ldlt";
    }
    report.unknowns = 0;
    shapes.least_angle = std::numbers::pi;
    for (std::size_t k = 0; k < count; ++k) {
        Shape& shape = found[k];
        report.unknowns += meshes[k].vertices.size() - meshes[k].rimVertexCount();
        report.residual = std::max(report.residual, shape.report.usable() ? shape.report.residual : 0.0);
        if (shape.field) {
            solution.droplets[k] = *std::move(shape.field);
        } else if (!shape.sheet) {
            throw Error(ErrorCode::NoSuchDroplet, refusal(shape.report, ofDroplet(k, count)));
        } else {
            if (shape.sheet->end != SheetEnd::Reached) {
                if (!allow_less) {
                    throw Error(ErrorCode::NoSuchDroplet, refusal(*shape.sheet, ofDroplet(k, count)));
                }
                if (options.model == Model::Auto && options.fill.by == FillBy::ContactAngle &&
                    shape.sheet->contact_angle < kLeastShare * options.fill.amount) {
                    SolveOptions linear = options;
                    linear.model = Model::Linear;
                    if (Solution flat = solve(meshes, linear); flat.report.usable()) {
                        return {std::move(flat), {}};
                    }
                }
                ++shapes.with_less;
                shapes.least_angle = std::min(shapes.least_angle, shape.sheet->contact_angle);
            }
            take(*shape.sheet, k, shapes);
        }
    }
    if (count > 1) {
        if (allow_less) {
            separate(meshes, options, shapes);
        }
        if (const std::optional<SheetContact> contact = neighbourContact(meshes, shapes)) {
            throw Error(
                ErrorCode::NoSuchDroplet,
                fmt::format("droplets {} and {} would touch at x {} mm, y {} mm; ask for less", contact->first + 1,
                            contact->second + 1, numberText(contact->place.x / kMillimetre, 3),
                            numberText(contact->place.y / kMillimetre, 3)));
        }
    }
    return shapes;
}

}  // namespace droplet
