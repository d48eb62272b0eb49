// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape/liquid_shapes.h"

#include <fmt/core.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <functional>
#include <mutex>
#include <numbers>
#include <numeric>
#include <string>
#include <tuple>
#include <utility>

#include "box_corners.h"
#include "droplet/error.h"
#include "droplet/shape/figures.h"
#include "droplet/units.h"
#include "mesh/mean_edge.h"
#include "mesh/rim_corner.h"
#include "mesh/round_inward.h"
#include "number_text.h"
#include "shape/own_options.h"
#include "shape/recovered_normals.h"
#include "shape/sheet_base.h"
#include "shape/sheet_contact.h"
#include "shape/work.h"
#include "union_find.h"

namespace droplet {
namespace {

/// Steps of Newton's method after which a sheet is tried first; height fields that exist take 4 to 8.
constexpr std::size_t kQuickSteps = 15;

/// Work of the height field where no sheet was found, as in SolveOptions: some seconds.
constexpr double kMaxWork = 2e7;

/// Most work of a run: one and a half minutes, or half of what a height field may take. A part of it where nobody asked
/// for an amount.
constexpr double kRunWork = 2.7e8;
constexpr double kFieldShare = 0.5;
constexpr double kDefaultShare = 0.5;

/// Part of it that is kept for droplets that touch, and work of a test for contact, of a triangle.
constexpr double kContactShare = 0.2;
constexpr double kContactWork = 10.0;

/// Contact angle of a height field at corners that point inward from which on a sheet is more exact [rad]. The angle
/// grows without bound there, and a height field's ends at 90°. Sheets with the same mean of a star, an A and an & have
/// 0.2 to 0.3 % more liquid where the field has 50° there, and 0.6 % where it has 80°.
constexpr double kSteepCorner = 50.0 * kDegree;

/// Share of the wanted contact angle below which a sheet is no droplet, and the linear model is taken.
constexpr double kLeastShare = 0.5;

/// Depth below the ground, over the height above it, beyond which the linear model would be no stand-in, as on a steep
/// ball.
constexpr double kSunk = 0.1;

/// Mean contact angle that is tried where the search for one beyond 90° ends below it: that of a fill by default [rad].
constexpr double kModestAngle = Fill{}.amount;

/// Vertices inside up to which a search for an angle beyond 90° that nobody is sure of takes a second at most: discs of
/// 1000 to 9000 triangles end at 104° to 138° with a slight effort, and reach 140° with a modest one.
constexpr std::size_t kSmall = 5000;

/// Largest mean contact angle of sheets that sink to the ground on a straight way [rad].
constexpr double kFlat = 30.0 * kDegree;

/// First reduction of the contact angle of a droplet that touches a neighbour [rad], the growth of the next ones, and
/// the most of them.
constexpr double kLower = 2.0 * kDegree;
constexpr double kLowerMore = 1.5;
constexpr int kMaxLowerings = 60;

/// Error of the largest share of an amount at which neighbours do not touch, and most pairs that are looked at.
constexpr double kShareError = 0.01;
constexpr int kMaxPairs = 8;

/// Triangles of a probe: some 5 ms.
constexpr double kProbe = 2500.0;

/// Whether a footprint is a wide puddle, with triangles that are much smaller along the rim. A sheet there is no better
/// at corners, which are as small as the triangles, and takes many times the work of a height field.
/// @param layer  bendingLayer()
bool isWidePuddle(const PlanarMesh& mesh, double layer)
{
    constexpr double kShorter = 0.5;  // the & of data/: 0.58 at 20 cm, in 1.6 s; 0.28 at 1 m, 3.6 s; 5 m, 16 s
    const double rim_edge = rimLength(mesh) / static_cast<double>(mesh.rimVertexCount());
    const double edge = meanEdge(area(mesh), mesh.triangles.size());
    return rim_edge < kShorter * edge && kEdgesPerLayer * edge > layer;
}

/// Whether there is no height field for sure.
bool mustHang(const SolveOptions& options)
{
    return options.volumes.empty() && options.fill.by == FillBy::ContactAngle &&
           options.fill.amount >= 0.5 * std::numbers::pi;
}

/// Whether the linear model may stand in where no exact shape is found: for an amount that nobody asked for, on
/// footprints as ragged as noise, where one droplet of many would refuse all that share its liquid.
bool hasLinear(const SolveOptions& options, bool allow_less)
{
    const bool is_shared = options.fill.sharing == FillSharing::Total;
    return allow_less && options.model == Model::Auto && is_shared && !mustHang(options);
}

/// Droplets that are solved together: all at one pressure, or each for itself.
std::vector<std::vector<std::size_t>> groupsOf(std::size_t count, const SolveOptions& options)
{
    std::vector<std::vector<std::size_t>> groups(options.fill.sharing == FillSharing::Total ? 1 : count);
    for (std::size_t k = 0; k < count; ++k) {
        groups[std::min(k, groups.size() - 1)].push_back(k);
    }
    return groups;
}

bool isUpright(const CapillarySurface& field)
{
    return std::any_of(field.contact_angle.begin(), field.contact_angle.end(),
                       [](double angle) { return angle >= kUpright; });
}

bool areUpright(const std::vector<CapillarySurface>& fields)
{
    return std::any_of(fields.begin(), fields.end(), isUpright);
}

/// Whether sheets are more exact: rims are upright, or steep at corners that point inward; or, on ground that is not
/// flat, steep to the plane.
bool areSteep(const std::vector<CapillarySurface>& fields, const BaseSurface& ground)
{
    const auto is_steep = [&](const CapillarySurface& field) {
        if (!ground.flat()) {
            const std::vector<double> slopes = rimSlopes(field, ground);
            if (std::any_of(slopes.begin(), slopes.end(),
                            [](double slope) { return std::abs(slope) >= std::tan(kSteepCorner); })) {
                return true;
            }
        }
        const PlanarMesh mesh = rimOf(field);
        for (std::size_t loop = 0; loop < mesh.loopCount(); ++loop) {
            std::uint32_t last = mesh.loop_starts[loop + 1] - 1;
            for (std::uint32_t v = mesh.loop_starts[loop]; v < mesh.loop_starts[loop + 1]; last = v++) {
                const Vec2 p = mesh.vertices[v];
                const Vec2 next = mesh.vertices[nextOnRim(mesh, loop, v)];
                if (field.contact_angle[v] >= kSteepCorner &&
                    turnBetween(p - mesh.vertices[last], next - p) < -kCorner) {
                    return true;
                }
            }
        }
        return false;
    };
    return std::any_of(fields.begin(), fields.end(),
                       [&](const CapillarySurface& field) { return isUpright(field) || is_steep(field); });
}

/// Whether no height field is so deep below the ground, as on a wall, that it has no liquid.
bool haveLiquid(const std::vector<CapillarySurface>& fields, const SolveOptions& options)
{
    return std::all_of(fields.begin(), fields.end(),
                       [&](const CapillarySurface& field) { return liquidVolume(field, options.ground) > 0.0; });
}

/// Beginning of a message about one droplet of several.
std::string ofDroplet(std::size_t k, std::size_t count)
{
    return count == 1 ? "" : fmt::format("droplet {} of {}: ", k + 1, count);
}

/// Droplets that do not exist.
struct Refused {
    std::string which;         ///< beginning of the message
    std::size_t droplets = 1;  ///< number at one pressure
    PlaneGravity gravity;
};

/// Why there is no height field, and what to change.
std::string refusal(const SolveReport& report, const Refused& refused)
{
    const std::string& which = refused.which;
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
            return which +
                   (refused.droplets > 1
                        ? "at one pressure such droplets drain into each other: the largest has a Bond number of "
                        : "gravity pulls such a droplet off: its Bond number is ") +
                   numberText(report.bond_number, 4) + ", but at most " + numberText(report.critical_bond_number, 4) +
                   " can hang on this footprint; use less gravity or a smaller width";
        case Termination::NotConverged:
        case Termination::Converged:
            break;
    }
    return which + "the equations could not be solved (residual " + numberText(report.residual, 3) +
           "); try another number of triangles";
}

/// Options of a search that ends early where there is no height field.
SolveOptions quickly(SolveOptions options)
{
    options.max_newton_steps = std::min(options.max_newton_steps, kQuickSteps);
    return options;
}

/// Height fields, or none where no volume gives the amount.
Solution findFields(const std::vector<PlanarMesh>& meshes, const SolveOptions& options, const Progress& progress)
{
    try {
        return solve(meshes, options, progress);
    } catch (const Error& error) {
        if (error.code() != ErrorCode::NoSuchDroplet) {
            throw;
        }
        Solution none;
        none.report.termination = Termination::NoHeightField;
        return none;
    }
}

bool areWidePuddles(const std::vector<PlanarMesh>& meshes, const SolveOptions& options)
{
    const std::optional<double> layer = bendingLayer(options);
    return layer && std::all_of(meshes.begin(), meshes.end(),
                                [&](const PlanarMesh& mesh) { return isWidePuddle(mesh, *layer); });
}

/// What coarse triangles tell of height fields, before fine ones are solved that hang over their rims.
struct Probe {
    bool exists = false;    ///< whether there are any
    bool is_steep = false;  ///< whether their rims are upright somewhere, or would be
};

/// @return  none where fine triangles are few, or stay with height fields
std::optional<Probe> probe(const std::vector<PlanarMesh>& meshes, const SolveOptions& options)
{
    const auto is_large = [](const PlanarMesh& mesh) {
        return static_cast<double>(mesh.triangles.size()) > 4.0 * kProbe;
    };
    if (std::none_of(meshes.begin(), meshes.end(), is_large) || areWidePuddles(meshes, options)) {
        return std::nullopt;
    }
    std::vector<PlanarMesh> coarse;
    bool is_fine = false;
    for (const PlanarMesh& mesh : meshes) {
        std::optional<PlanarMesh> changed =
            is_large(mesh) ? roundInward(mesh, 0.0, meanEdge(area(mesh), kProbe)) : std::nullopt;
        is_fine = is_fine || changed;
        coarse.push_back(changed ? *std::move(changed) : mesh);
    }
    if (!is_fine) {
        return std::nullopt;
    }
    const Solution solution = findFields(coarse, quickly(options), {});
    const bool exists = solution.report.usable() && haveLiquid(solution.droplets, options);
    const bool is_steep =
        exists ? areSteep(solution.droplets, options.ground) : solution.report.termination != Termination::Unstable;
    return Probe{exists, is_steep};
}

/// What was found of droplets before their shape is solved.
struct Before {
    std::vector<CapillarySurface> fields = {};  ///< one per droplet, or empty
    std::optional<Probe> probed = {};           ///< of them alone
    std::optional<SolveReport> failed = {};     ///< of height fields that do not exist
};

/// Shapes of the linear model in place of exact ones, if there are any above the ground.
/// @param may_dry  leave ground dry into which they would sink
std::optional<LiquidShapes> linearStandIn(const std::vector<PlanarMesh>& meshes, SolveOptions options, bool may_dry)
{
    if (mustHang(options)) {
        return std::nullopt;
    }
    options.model = Model::Linear;
    const auto stands = [&](const LiquidShapes& shapes) {
        const std::vector<CapillarySurface>& fields = shapes.solution.droplets;
        return shapes.solution.report.usable() && haveLiquid(fields, options) &&
               std::all_of(fields.begin(), fields.end(), [&](const CapillarySurface& field) {
                   const ShapeFigures figures = measure(field, options);
                   return figures.depth_max <= kSunk * figures.height_max;
               });
    };
    LiquidShapes shapes{.solution = findFields(meshes, options, {}), .is_stand_in = true};
    if (!stands(shapes) && may_dry) {
        options.no_penetration = true;
        shapes.solution = findFields(meshes, options, {});
    }
    return stands(shapes) ? std::optional(std::move(shapes)) : std::nullopt;
}

/// Whether a sheet that missed its angle is so small that the linear model is nearer to what was wanted. Ground that it
/// leaves dry takes from the mean angle, and not from the height. Under a ceiling the linear model has no limit.
bool isTooLittle(const SheetResult& sheet, const SolveOptions& options)
{
    if (sheet.volume == 0.0) {
        return true;
    }
    const ShapeFigures figures = measure(sheet.surface, options);
    const double height = puddleHeight(options, std::min(options.fill.amount, kModestAngle), figures.footprint_area);
    return planeGravity(options).normal >= 0.0 && sheet.contact_angle < kLeastShare * options.fill.amount &&
           figures.height_max < kLeastShare * height;
}

/// Why there is no sheet, and what to change.
std::string refusal(const SheetResult& result, const Refused& refused)
{
    const std::string& which = refused.which;
    const std::string at = numberText(result.volume / kMicrolitre, 4) + " uL";
    const std::string angle = numberText(result.contact_angle / kDegree, 3) + " degrees";
    if (result.volume == 0.0) {
        const char* const why =
            "fill this footprint: its ground is too steep or rough, or its rim too ragged; smooth "
            "them, or reduce the number of triangles";
        return which +
               (result.end == SheetEnd::OutOfWork ? "the work that a run may take does not begin to "
                                                  : "no stable droplet begins to ") +
               why;
    }
    switch (result.end) {
        case SheetEnd::NoAngle:
            return which + "no such droplet exists on this footprint: the mean contact angle is at most " + angle +
                   ", at " + at + "; a given volume goes on beyond it";
        case SheetEnd::NoHeight:
            return which + "no such droplet exists on this footprint: it is highest at " + at + "; ask for less";
        case SheetEnd::Contact:
            return (refused.droplets > 1 ? "at one pressure the liquid would touch itself at x "
                                         : which + "such a droplet would touch itself at x ") +
                   numberText(result.contact->x / kMillimetre, 3) + " mm, y " +
                   numberText(result.contact->y / kMillimetre, 3) + " mm; it holds at most " + at +
                   " (mean contact angle " + angle + "); ask for less";
        case SheetEnd::NotHeld:
            return (refused.droplets > 1 ? "at one pressure a rim does not hold its droplet: with " + at + " in all"
                                         : which + "the rim does not hold such a droplet: at " + at) +
                   " it has a contact angle of 180 degrees all along; ask for less";
        case SheetEnd::OutOfWork:
            return which + std::to_string(result.newton_steps) + " steps of Newton's method reached only " + at +
                   " (mean contact angle " + angle + "); ask for less, or reduce the number of triangles";
        case SheetEnd::Unstable:
        case SheetEnd::Reached:
            break;
    }
    const std::string most = at + " (mean contact angle " + angle + ")";
    if (refused.gravity.normal < 0.0) {
        return which + "gravity pulls a droplet of more than " + most + " off this footprint; ask for less";
    }
    return which + "no stable droplet was found on this footprint with more than " + most +
           (refused.gravity.along == Vec2{} ? "" : ": gravity pulls more over the rim") + "; ask for less";
}

/// Shape of one droplet, or of all at one pressure.
struct Shape {
    std::vector<CapillarySurface> fields = {};  ///< one per droplet, or empty
    std::optional<SheetResult> sheet = {};
    SolveReport report = {};            ///< of the height fields
    std::optional<double> lesser = {};  ///< mean contact angle, if they have less liquid than was wanted [rad]
    double work = 0.0;                  ///< done for all of it, as SolveOptions::max_work
};

std::size_t unknownsOf(const std::vector<PlanarMesh>& meshes)
{
    std::size_t unknowns = 0;
    for (const PlanarMesh& mesh : meshes) {
        unknowns += unknownsOf(mesh);
    }
    return unknowns;
}

/// Most work of a run.
double runWork(const std::vector<PlanarMesh>& meshes, const SolveOptions& options, bool allow_less)
{
    const double most = std::max(kRunWork, kFieldShare * fieldWork(unknownsOf(meshes)));
    return options.max_work.value_or(allow_less ? kDefaultShare * most : most);
}

/// Share of the work for every group of droplets: one half in equal parts, one in proportion to a factorisation.
std::vector<double> sharesOf(const std::vector<PlanarMesh>& meshes, const std::vector<std::vector<std::size_t>>& groups)
{
    std::vector<double> costs;
    for (const std::vector<std::size_t>& group : groups) {
        std::size_t triangles = 0;
        for (const std::size_t k : group) {
            triangles += meshes[k].triangles.size();
        }
        costs.push_back(factorWork(triangles));
    }
    const double all = std::accumulate(costs.begin(), costs.end(), 0.0);
    for (double& cost : costs) {
        cost = 0.5 * cost / all + 0.5 / static_cast<double>(costs.size());
    }
    return costs;
}

/// Height fields of droplets, and how they were found.
Shape solveFields(const std::vector<PlanarMesh>& meshes, const SolveOptions& options,
                  const std::function<void(double)>& reached = {})
{
    const auto report = [&](Stage stage, double share) {
        if (stage == Stage::Solve) {
            reached(share);
        }
    };
    Solution solution = findFields(meshes, options, reached ? Progress(report) : Progress{});
    Shape shape{.report = solution.report, .work = solution.report.work};
    if (solution.report.usable() && haveLiquid(solution.droplets, options)) {
        shape.fields = std::move(solution.droplets);
    }
    return shape;
}

/// Whether height fields go on where the work for a sheet ended.
bool reachesFurther(const Shape& shape)
{
    return shape.sheet->end == SheetEnd::OutOfWork && shape.report.largest_volume > shape.sheet->volume;
}

/// Height fields with the most liquid that was reached, if there are any.
Shape lesserFields(const std::vector<PlanarMesh>& meshes, const SolveOptions& options, Shape shape)
{
    constexpr double kSurely = 0.95;  // of the last equilibrium: Newton's method starts anew
    SolveOptions less = options;
    less.volumes.clear();
    less.fill.by = FillBy::Volume;
    less.fill.amount = kSurely * shape.report.largest_volume;
    Shape lesser = solveFields(meshes, less);
    lesser.work += shape.work;
    if (lesser.fields.empty()) {
        return shape;
    }
    std::vector<ShapeFigures> figures;
    for (std::size_t k = 0; k < meshes.size(); ++k) {
        figures.push_back(measure(lesser.fields[k], options));
    }
    lesser.lesser = combine(figures).contact_angle.mean;
    return lesser;
}

/// Shape of droplets at one pressure, which may hang over their rims.
/// @param reached  as of solveSheet()
Shape solveShape(const std::vector<PlanarMesh>& meshes, const SolveOptions& options, Before before, SheetEffort effort,
                 const std::function<void(double)>& reached)
{
    const double most = options.max_work.value_or(kRunWork);
    const double field_work = fieldWork(unknownsOf(meshes));
    Shape shape{.fields = std::move(before.fields)};
    if (shape.fields.empty() && !mustHang(options) && !before.probed && !before.failed) {
        before.probed = probe(meshes, options);
    }
    const bool is_steep = shape.fields.empty() && before.probed && before.probed->is_steep;
    if (before.failed) {
        shape.report = *before.failed;
    }
    if (shape.fields.empty() && !mustHang(options) && !is_steep && !before.failed) {
        SolveOptions quick = quickly(options);
        quick.max_work = std::min(field_work, most);
        shape = solveFields(meshes, quick);
    }
    if (!is_steep && (shape.fields.empty() ? shape.report.termination == Termination::Unstable
                                           : !areSteep(shape.fields, options.ground))) {
        return shape;
    }
    // A height field that is upright in a few places may stand, unless the exact shape was asked for.
    const bool is_exact = !shape.fields.empty() && !areUpright(shape.fields);
    const bool has_stand_in =
        is_exact || ((is_steep ? before.probed->exists : !shape.fields.empty()) && options.model == Model::Auto);
    if (has_stand_in && areWidePuddles(meshes, options)) {
        return shape;
    }
    SolveOptions rest = options;
    rest.max_work = std::max(most - shape.work, 0.0);
    shape.sheet = solveSheet(meshes, rest, has_stand_in ? SheetEffort::Trial : effort, reached);
    shape.work += shape.sheet->work;
    if (shape.sheet->end == SheetEnd::Reached) {
        shape.fields.clear();
    } else if (shape.fields.empty() && !mustHang(options)) {
        SolveOptions limited = options;
        // Where a mask full of holes takes too many triangles for a sheet, height fields are all there is.
        const bool is_lost = shape.sheet->end == SheetEnd::OutOfWork && shape.sheet->volume == 0.0;
        limited.max_work = std::clamp(is_lost ? field_work : kMaxWork, 0.0, std::max(most - shape.work, 0.0));
        Shape upright = solveFields(meshes, limited, reached);
        upright.sheet = std::move(shape.sheet);
        upright.work += shape.work;
        return upright.fields.empty() && reachesFurther(upright) && effort == SheetEffort::Modest
                   ? lesserFields(meshes, limited, std::move(upright))
                   : upright;
    }
    return shape;
}

/// Number of every mesh's cluster. Meshes with a common rim vertex are in one cluster.
std::vector<std::size_t> clustersOf(const std::vector<PlanarMesh>& meshes)
{
    std::vector<std::pair<Vec2, std::uint32_t>> vertices;
    for (std::uint32_t k = 0; k < meshes.size(); ++k) {
        for (std::uint32_t v = 0; v < meshes[k].rimVertexCount(); ++v) {
            vertices.emplace_back(meshes[k].vertices[v], k);
        }
    }
    std::sort(vertices.begin(), vertices.end(), [](const auto& a, const auto& b) {
        return std::tie(a.first.x, a.first.y, a.second) < std::tie(b.first.x, b.first.y, b.second);
    });
    UnionFind sets(meshes.size());
    for (std::size_t i = 1; i < vertices.size(); ++i) {
        if (vertices[i].first == vertices[i - 1].first) {
            sets.join(vertices[i].second, vertices[i - 1].second);
        }
    }
    std::vector<std::size_t> clusters;
    for (std::uint32_t k = 0; k < meshes.size(); ++k) {
        clusters.push_back(sets.find(k));
    }
    return clusters;
}

/// Least box around a surface, along the axes.
struct Box {
    explicit Box(const std::vector<Vec3>& vertices) : corners(cornersOf(vertices)) {}

    [[nodiscard]] bool meets(const Box& other) const
    {
        const auto& [low, high] = corners;
        const auto& [other_low, other_high] = other.corners;
        return low.x <= other_high.x && other_low.x <= high.x && low.y <= other_high.y && other_low.y <= high.y &&
               low.z <= other_high.z && other_low.z <= high.z;
    }

    std::array<Vec3, 2> corners;
};

/// First place where two droplets touch whose footprints are apart. Droplets that share boundaries may lean over them;
/// that none touches itself, its own solver has seen.
std::optional<SheetContact> neighbourContact(const std::vector<PlanarMesh>& meshes, const LiquidShapes& shapes)
{
    if (meshes.size() == 1 || !haveSheets(shapes.solution.droplets)) {
        return std::nullopt;
    }
    const std::vector<CapillarySurface>& surfaces = shapes.solution.droplets;
    std::vector<Box> boxes;
    boxes.reserve(surfaces.size());
    for (const CapillarySurface& surface : surfaces) {
        boxes.emplace_back(surface.vertices);
    }
    const std::vector<std::size_t> clusters = clustersOf(meshes);
    std::vector<const CapillarySurface*> near;
    std::vector<std::size_t> near_clusters;
    std::vector<std::size_t> droplets;
    for (std::size_t k = 0; k < meshes.size(); ++k) {
        for (std::size_t other = 0; other < meshes.size(); ++other) {
            if (clusters[other] != clusters[k] && boxes[other].meets(boxes[k])) {
                near.push_back(&surfaces[k]);
                near_clusters.push_back(clusters[k]);
                droplets.push_back(k);
                break;
            }
        }
    }
    std::optional<SheetContact> contact = near.empty() ? std::nullopt : firstContact(near, near_clusters);
    if (contact) {
        contact->first = droplets[contact->first];
        contact->second = droplets[contact->second];
    }
    return contact;
}

/// Takes up the result of droplets that are sheets.
void take(SheetResult& result, const std::vector<std::size_t>& droplets, LiquidShapes& shapes)
{
    if (droplets.size() == 1) {
        shapes.solution.droplets[droplets.front()] = std::move(result.surface);
    } else {
        std::vector<CapillarySurface> parts = separate(result.surface);
        for (std::size_t i = 0; i < droplets.size(); ++i) {
            shapes.solution.droplets[droplets[i]] = std::move(parts[i]);
        }
    }
    SolveReport& report = shapes.solution.report;
    report.newton_steps = std::max(report.newton_steps, result.newton_steps);
    report.residual = std::max(report.residual, result.residual);
    report.iterations = std::max<std::size_t>(report.iterations, 1);
}

/// Notes that droplets have less liquid than was wanted.
void limit(const std::vector<std::size_t>& droplets, double angle, LiquidShapes& shapes)
{
    for (const std::size_t k : droplets) {
        shapes.limits[k] = FillLimit::Existence;
    }
    shapes.least_angle = std::min(shapes.least_angle, angle);
}

/// States the unknowns of what was found, and how the largest part of it was solved.
/// @param method  of height fields
void describe(const std::string& method, Solution& solution)
{
    solution.report.unknowns = 0;
    std::size_t most = 0;
    for (const CapillarySurface& surface : solution.droplets) {
        const std::size_t own = surface.vertices.size() - surface.rimVertexCount();
        solution.report.unknowns += own;
        if (own > most) {
            most = own;
            solution.report.method = surface.isHeightField() ? method : "multifrontal-ldlt";
        }
    }
}

/// Work of neighbourContact().
double contactWork(const LiquidShapes& shapes)
{
    std::size_t triangles = 0;
    for (const CapillarySurface& surface : shapes.solution.droplets) {
        triangles += surface.triangles.size();
    }
    return kContactWork * static_cast<double>(triangles);
}

/// Lowers the contact angles of droplets that touch until they do not, or no work is left.
/// @return  where two still do
std::optional<SheetContact> lowerUntilApart(const std::vector<PlanarMesh>& meshes, const SolveOptions& options,
                                            Work& work, LiquidShapes& shapes)
{
    std::vector<double> lowerings(meshes.size(), kLower);
    for (int round = 0; round < kMaxLowerings && work.isLeft(); ++round) {
        const std::optional<SheetContact> contact = neighbourContact(meshes, shapes);
        work.done += contactWork(shapes);
        if (!contact) {
            return std::nullopt;
        }
        for (const std::size_t k : {contact->first, contact->second}) {
            if (shapes.solution.droplets[k].isHeightField()) {
                continue;
            }
            SolveOptions own = options;
            own.volumes.clear();
            own.fill = {FillBy::ContactAngle, 0.0, FillSharing::Each};
            const double angle = measure(shapes.solution.droplets[k], options).contact_angle.mean;
            for (double& lowering = lowerings[k]; angle > lowering && work.isLeft(); lowering *= kLowerMore) {
                own.fill.amount = angle - lowering;
                own.max_work = work.left();
                SheetResult lower = solveSheet(meshes[k], own, SheetEffort::Modest);
                work.done += lower.work;
                if (lower.end == SheetEnd::Reached) {
                    take(lower, {k}, shapes);
                    limit({k}, own.fill.amount, shapes);
                    lowering *= kLowerMore;
                    break;
                }
            }
        }
    }
    return neighbourContact(meshes, shapes);
}

/// Solves the height fields again with other volumes.
bool refillFields(const std::vector<PlanarMesh>& meshes, const std::vector<double>& volumes,
                  const SolveOptions& options, LiquidShapes& shapes)
{
    std::vector<PlanarMesh> own_meshes;
    SolveOptions own = quickly(options);
    own.model = shapes.solution.report.model;
    own.volumes.clear();
    std::vector<std::size_t> own_places;
    for (std::size_t k = 0; k < meshes.size(); ++k) {
        if (shapes.solution.droplets[k].isHeightField()) {
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
        CapillarySurface& field = shapes.solution.droplets[own_places[k]];
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
    for (CapillarySurface& surface : shapes.solution.droplets) {
        if (!surface.isHeightField() && measure(surface, options).contact_angle.mean > kFlat) {
            return std::nullopt;
        }
        for (Vec3& place : surface.vertices) {
            place.z = 0.0;
        }
        std::fill(surface.contact_angle.begin(), surface.contact_angle.end(), 0.0);
        surface.pressure = 0.0;
    }
    return shapes;
}

/// Share of the wanted amounts that is reached, of several droplets that are solved at the same time.
class ReachedShare {
public:
    ReachedShare(const Progress& progress, std::size_t count) : progress_(&progress), shares_(count, 0.0) {}

    /// Reports the mean if it rose by enough.
    void reach(std::size_t droplet, double share)
    {
        constexpr double kStep = 0.01;
        if (!*progress_) {
            return;
        }
        const std::lock_guard lock(mutex_);
        shares_[droplet] = std::max(shares_[droplet], share);
        const double mean = std::accumulate(shares_.begin(), shares_.end(), 0.0) / static_cast<double>(shares_.size());
        if (mean >= reported_ + kStep || (mean >= 1.0 && reported_ < 1.0)) {
            reported_ = mean;
            (*progress_)(Stage::Solve, std::min(mean, 1.0));
        }
    }

private:
    const Progress* progress_;
    std::mutex mutex_;
    std::vector<double> shares_;
    double reported_ = 0.0;
};

/// Solves every droplet, whether or not neighbours touch.
/// @param followed  as of solveShapes()
LiquidShapes solveAll(const std::vector<PlanarMesh>& meshes, const SolveOptions& options, bool allow_less,
                      const Progress& progress, std::vector<std::optional<SheetResult>> followed = {})
{
    const std::size_t count = meshes.size();
    const PlaneGravity gravity = planeGravity(options);
    LiquidShapes shapes;
    Solution& solution = shapes.solution;
    if (options.model == Model::Linear) {
        solution = solve(meshes, options, progress);
        shapes.work = solution.report.work;
        if (!solution.report.usable()) {
            throw Error(
                ErrorCode::NoSuchDroplet,
                refusal(solution.report, options.fill.sharing == FillSharing::Each
                                             ? Refused{ofDroplet(solution.report.failed_droplet, count), 1, gravity}
                                             : Refused{"", count, gravity}));
        }
        return shapes;
    }
    followed.resize(options.fill.sharing == FillSharing::Total ? 1 : count);
    const bool any_followed = std::any_of(followed.begin(), followed.end(), [](const auto& one) { return !!one; });
    bool has_fields = false;
    const std::optional<Probe> probed = !mustHang(options) && !any_followed ? probe(meshes, options) : std::nullopt;
    const bool tried = !mustHang(options) && !any_followed && !(probed && probed->is_steep);
    if (tried) {
        solution = findFields(meshes, quickly(options), progress);
        shapes.work = solution.report.work;
        has_fields = solution.report.usable() && haveLiquid(solution.droplets, options);
        if (has_fields && !areSteep(solution.droplets, options.ground)) {
            return shapes;
        }
    } else if (progress) {
        progress(Stage::Solve, 0.0);
    }
    const std::vector<std::vector<std::size_t>> groups = groupsOf(count, options);
    const bool has_linear = hasLinear(options, allow_less);
    const double most = std::max(runWork(meshes, options, allow_less) - shapes.work, 0.0);
    const std::vector<double> parts = sharesOf(meshes, groups);
    std::vector<Shape> found(groups.size());
    ReachedShare reached(progress, groups.size());
    tbb::parallel_for(std::size_t{0}, groups.size(), [&](std::size_t g) {
        if (followed[g]) {
            found[g].sheet = std::move(followed[g]);
            return;
        }
        std::vector<PlanarMesh> own;
        Before before;
        if (groups.size() == 1) {
            before.probed = probed;
            before.failed = tried && !has_fields ? std::optional(solution.report) : std::nullopt;
        }
        for (const std::size_t k : groups[g]) {
            own.push_back(meshes[k]);
            if (has_fields) {
                before.fields.push_back(std::move(solution.droplets[k]));
            }
        }
        SolveOptions own_options = ownOptions(options, g);
        own_options.max_work = parts[g] * most;
        const auto report = [&](double share) { reached.reach(g, share); };
        const bool is_small = unknownsOf(own) <= kSmall;
        found[g] = solveShape(own, own_options, std::move(before),
                              has_linear || (allow_less && mustHang(options) && !is_small) ? SheetEffort::Slight
                              : allow_less                                                 ? SheetEffort::Modest
                                                                                           : SheetEffort::Full,
                              report);
        Shape& shape = found[g];
        if (allow_less && mustHang(options) && shape.sheet->end != SheetEnd::Reached &&
            shape.sheet->contact_angle < kModestAngle) {
            SolveOptions modest = own_options;
            modest.fill.amount = kModestAngle;
            modest.max_work = std::max(*own_options.max_work - shape.work, 0.0);
            Shape lesser = solveShape(own, modest, {}, SheetEffort::Modest, report);
            lesser.work += shape.work;
            if (!lesser.fields.empty() || (lesser.sheet && lesser.sheet->contact_angle > shape.sheet->contact_angle)) {
                lesser.lesser = lesser.lesser.value_or(kModestAngle);
                shape = std::move(lesser);
            }
        }
        if (shape.fields.empty() ? shape.sheet && shape.sheet->end == SheetEnd::Reached : !shape.lesser) {
            reached.reach(g, 1.0);
        }
    });
    solution.droplets.assign(count, {});
    shapes.limits.assign(count, FillLimit::None);
    shapes.least_angle = std::numbers::pi;
    // Only what was found counts, not what was tried.
    const SolveReport field_report = std::exchange(solution.report, {});
    SolveReport& report = solution.report;
    report.model = Model::Exact;
    report.termination = Termination::Converged;
    std::string method;
    for (std::size_t g = 0; g < groups.size(); ++g) {
        Shape& shape = found[g];
        shapes.work += shape.work;
        const Refused refused{groups.size() == 1 ? "" : ofDroplet(g, count), groups[g].size(), gravity};
        if (!shape.fields.empty()) {
            const SolveReport& own = shape.report.usable() ? shape.report : field_report;
            report.iterations = std::max(report.iterations, own.iterations);
            report.newton_steps = std::max(report.newton_steps, own.newton_steps);
            report.residual = std::max(report.residual, own.residual);
            method = own.method;
            if (shape.sheet && !shapes.given_up) {
                shapes.given_up = shape.sheet->end;
            }
            for (std::size_t i = 0; i < groups[g].size(); ++i) {
                solution.droplets[groups[g][i]] = std::move(shape.fields[i]);
            }
            if (shape.lesser) {
                limit(groups[g], *shape.lesser, shapes);
            }
        } else if (!shape.sheet) {
            throw Error(ErrorCode::NoSuchDroplet, refusal(shape.report, refused));
        } else {
            if (shape.sheet->end == SheetEnd::Reached) {
                if (shape.lesser) {
                    limit(groups[g], *shape.lesser, shapes);
                }
            } else {
                const bool is_too_little = allow_less && options.model == Model::Auto &&
                                           options.fill.by == FillBy::ContactAngle &&
                                           isTooLittle(*shape.sheet, options);
                if (is_too_little || has_linear) {
                    if (auto stand_in = linearStandIn(meshes, options, shape.sheet->volume == 0.0)) {
                        return *std::move(stand_in);
                    }
                }
                if (!allow_less || shape.sheet->volume == 0.0) {
                    throw Error(ErrorCode::NoSuchDroplet, reachesFurther(shape) ? refusal(shape.report, refused)
                                                                                : refusal(*shape.sheet, refused));
                }
                limit(groups[g], shape.sheet->contact_angle, shapes);
            }
            take(*shape.sheet, groups[g], shapes);
        }
    }
    describe(method, solution);
    return shapes;
}

/// Options with a share of the amount.
SolveOptions scaled(const SolveOptions& options, double share)
{
    SolveOptions own = options;
    own.fill.amount *= share;
    for (double& volume : own.volumes) {
        volume *= share;
    }
    return own;
}

/// Whether droplets with a share of their amount exist, and do not touch.
bool areApart(const std::vector<PlanarMesh>& meshes, const SolveOptions& options, double share, Work& work)
{
    SolveOptions own = scaled(options, share);
    own.max_work = work.left();
    const LiquidShapes shapes = solveAll(meshes, own, true, {});
    work.done += shapes.work + (haveSheets(shapes.solution.droplets) ? contactWork(shapes) : 0.0);
    return shapes.withLess() == 0 && !neighbourContact(meshes, shapes);
}

/// Why neighbours are refused, with the largest amount at which no droplets touch, or one that was found with the work.
std::string refusal(const std::vector<PlanarMesh>& meshes, const SolveOptions& options, SheetContact contact, Work work)
{
    const std::string who = contact.first == contact.second
                                ? fmt::format("droplet {} would touch itself", contact.first + 1)
                                : fmt::format("droplets {} and {} would touch", contact.first + 1, contact.second + 1);
    const std::string where = fmt::format("{} at x {} mm, y {} mm; ", who, numberText(contact.place.x / kMillimetre, 3),
                                          numberText(contact.place.y / kMillimetre, 3));
    if (contact.first == contact.second) {
        return where + "ask for less";
    }
    double share = 1.0;
    for (int round = 0; round < kMaxPairs; ++round) {
        const std::array<std::size_t, 2> pair{contact.first, contact.second};
        SolveOptions own = options;
        if (!options.volumes.empty()) {
            own.volumes = {options.volumes[pair[0]], options.volumes[pair[1]]};
        }
        double apart = 0.0;
        for (double touching = share; touching - apart > kShareError * touching && work.isLeft();) {
            const double middle = 0.5 * (apart + touching);
            (areApart({meshes[pair[0]], meshes[pair[1]]}, own, middle, work) ? apart : touching) = middle;
            if (touching < kShareError) {
                break;
            }
        }
        share = apart;
        if (!work.isLeft()) {
            return where + "ask for less";
        }
        if (share == 0.0) {
            return where + "they do with less, too";
        }
        own = scaled(options, share);
        own.max_work = work.left();
        const LiquidShapes shapes = solveAll(meshes, own, true, {});
        work.done += shapes.work;
        const std::optional<SheetContact> next = neighbourContact(meshes, shapes);
        if (!next) {
            break;
        }
        contact = *next;
    }
    const double amount = share * options.fill.amount;
    if (!options.volumes.empty()) {
        return where + "none do with " + numberText(100.0 * share, 3) + " % of their volumes";
    }
    switch (options.fill.by) {
        case FillBy::ContactAngle:
            return where + "none do up to a mean contact angle of " + numberText(amount / kDegree, 3) + " degrees";
        case FillBy::Height:
            return where + "none do up to a height of " + numberText(amount / kMillimetre, 3) + " mm";
        case FillBy::Volume:
            break;
    }
    return where + "none do up to " + numberText(amount / kMicrolitre, 3) + " uL for each";
}

}  // namespace

bool haveSheets(const std::vector<CapillarySurface>& surfaces)
{
    return std::any_of(surfaces.begin(), surfaces.end(),
                       [](const CapillarySurface& surface) { return !surface.isHeightField(); });
}

std::size_t LiquidShapes::withLess() const
{
    return static_cast<std::size_t>(std::count(limits.begin(), limits.end(), FillLimit::Existence));
}

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
    const std::vector<CapillarySurface>& surfaces = shapes.solution.droplets;
    const std::vector<std::vector<std::size_t>> groups = groupsOf(meshes.size(), options);
    std::vector<std::optional<SheetResult>> found(groups.size());
    tbb::parallel_for(std::size_t{0}, groups.size(), [&](std::size_t g) {
        if (surfaces[groups[g].front()].isHeightField()) {
            return;
        }
        std::vector<CapillarySurface> sheets;
        double volume = 0.0;
        for (const std::size_t k : groups[g]) {
            sheets.push_back(surfaces[k]);
            volume += volumes[k];
        }
        if (volume > 0.0) {
            found[g] = refill(sheets.size() == 1 ? sheets.front() : join(sheets), volume, options);
        }
    });
    for (std::size_t g = 0; g < groups.size(); ++g) {
        if (!surfaces[groups[g].front()].isHeightField()) {
            if (!found[g] || found[g]->end != SheetEnd::Reached) {
                return std::nullopt;
            }
            take(*found[g], groups[g], result);
        }
    }
    return neighbourContact(meshes, result) ? std::nullopt : std::optional(std::move(result));
}

LiquidShapes solveShapes(const std::vector<PlanarMesh>& meshes, const SolveOptions& options, bool allow_less,
                         const Progress& progress, std::vector<std::optional<SheetResult>> followed)
{
    LiquidShapes shapes = solveAll(meshes, options, allow_less, progress, std::move(followed));
    if (!haveSheets(shapes.solution.droplets) || options.fill.sharing == FillSharing::Total) {
        return shapes;
    }
    const double most = runWork(meshes, options, allow_less);
    Work work{std::max(most - shapes.work, kContactShare * most)};
    const std::optional<SheetContact> contact =
        allow_less ? lowerUntilApart(meshes, options, work, shapes) : neighbourContact(meshes, shapes);
    if (!contact) {
        return shapes;
    }
    if (allow_less && options.model == Model::Auto) {
        if (auto stand_in = linearStandIn(meshes, options, true)) {
            return *std::move(stand_in);
        }
    }
    throw Error(ErrorCode::NoSuchDroplet, refusal(meshes, options, *contact, work));
}

}  // namespace droplet
