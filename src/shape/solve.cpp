// SPDX-License-Identifier: GPL-3.0-or-later
//
// The thesis, chapter 4: energy (4.1)–(4.3), and volume (4.4) as a constraint with multiplier λ (4.5), over P1 finite
// elements (Ritz and Galerkin coincide). The linear model uses √(1+t) ≈ 1 + t/2.

#include "droplet/shape/solve.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <numeric>
#include <string>
#include <utility>

#include "droplet/error.h"
#include "droplet/units.h"
#include "mesh/lattice.h"
#include "number_text.h"
#include "shape/area_vector.h"
#include "shape/constrained.h"
#include "shape/energy.h"
#include "shape/equilibrium.h"
#include "shape/existence.h"
#include "shape/hanging.h"
#include "shape/own_options.h"
#include "shape/recovered_normals.h"
#include "shape/work.h"

namespace droplet {
namespace {

/// Numbers of unknowns below which a factorisation is faster than multigrid: for meshes that are mostly a lattice, and
/// for others. Measured in bench/RESULTS.md.
constexpr std::size_t kSmall = 500;
constexpr std::size_t kSmallIrregular = 50'000;
/// Number of unknowns up to which Eigen's direct solver takes the one system of the linear model on any mesh: that of
/// 40 000 triangles. It takes 22 ms more there than multigrid.
constexpr std::size_t kSmallLinear = 25'000;

Solver chooseSolver(const PlanarMesh& mesh, Model model)
{
    const bool is_lattice = 2 * irregularTriangleCount(mesh) < mesh.triangles.size();
    const std::size_t small = model == Model::Linear ? kSmallLinear : kSmall;
    return unknownsOf(mesh) < (is_lattice ? small : kSmallIrregular) ? Solver::Llt : Solver::Multigrid;
}

/// Multigrid, or a factorisation if the iteration does not converge.
class SafeMultigrid final : public ConstrainedSolver {
public:
    explicit SafeMultigrid(const PlanarMesh& mesh) : mesh_(&mesh), multigrid_(multigridSolver(mesh)) {}

    void prepare(const Operator& op) override
    {
        op_ = &op;
        if (direct_) {
            direct_->prepare(op);
        } else {
            multigrid_->prepare(op);
        }
    }

    [[nodiscard]] ConstrainedSolution solve(const ConstrainedProblem& problem) const override
    {
        if (!direct_) {
            ConstrainedSolution solution = multigrid_->solve(problem);
            if (solution.converged) {
                return solution;
            }
            direct_ = directSolver(*mesh_);
            direct_->prepare(*op_);
        }
        return direct_->solve(problem);
    }

    [[nodiscard]] const char* method() const override { return direct_ ? direct_->method() : multigrid_->method(); }

    [[nodiscard]] double prepareWork() const override { return direct_ ? direct_->prepareWork() : 0.0; }

private:
    const PlanarMesh* mesh_;
    const Operator* op_ = nullptr;
    std::unique_ptr<ConstrainedSolver> multigrid_;
    mutable std::unique_ptr<ConstrainedSolver> direct_;  // made on first use
};

std::unique_ptr<ConstrainedSolver> solverFor(const PlanarMesh& mesh, const SolveOptions& options)
{
    const bool is_free = options.solver == Solver::Auto;
    const Solver solver = is_free ? chooseSolver(mesh, options.model) : options.solver;
    if (solver != Solver::Multigrid) {
        return directSolver(mesh);
    }
    return is_free ? std::make_unique<SafeMultigrid>(mesh) : multigridSolver(mesh);
}

Physics physicsOf(const SolveOptions& options)
{
    const double scale = options.liquid.density / options.liquid.surface_tension;
    const PlaneGravity gravity = planeGravity(options);
    return {Model::Linear, scale * gravity.normal, scale * gravity.along, options.no_penetration};
}

/// Droplets at one pressure, with the result.
struct Group {
    std::vector<std::size_t> droplets;
    std::vector<Member> members;
    Outcome outcome;
};

CapillarySurface fieldOf(const Energy& energy, const Sheet& sheet, double surface_tension)
{
    const PlanarMesh& mesh = energy.mesh();
    const std::uint32_t rim = mesh.rimVertexCount();
    CapillarySurface field{.triangles = mesh.triangles, .loop_starts = mesh.loop_starts, .lattice = mesh.lattice};
    field.vertices.reserve(mesh.vertices.size());
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
        field.vertices.push_back({mesh.vertices[v].x, mesh.vertices[v].y, sheet.height[v]});
    }
    field.pressure = surface_tension * sheet.pressure;
    if (!sheet.held.empty()) {
        field.dry.assign(rim, 0);
        field.dry.insert(field.dry.end(), sheet.held.begin(), sheet.held.end());
    }
    for (std::uint32_t v = 0; v < rim; ++v) {
        field.contact_angle.push_back(energy.contactAngle(v, sheet.flux[v]).first);
    }
    return field;
}

/// Checks the rims in order. Threads that sample the ground would report any vertex.
void requireGround(const std::vector<PlanarMesh>& meshes, const BaseSurface& ground)
{
    std::vector<Vec2> rims;
    for (const PlanarMesh& mesh : meshes) {
        rims.insert(rims.end(), mesh.vertices.begin(), mesh.vertices.begin() + mesh.rimVertexCount());
    }
    ground.requireAt(rims);
}

}  // namespace

void SolveOptions::validate() const
{
    liquid.validate();
    fill.validate();
    if (model == Model::Linear && fill.by == FillBy::ContactAngle && fill.amount >= 0.5 * std::numbers::pi) {
        throw Error(ErrorCode::InvalidArgument, "contact_angle " + numberText(fill.amount / kDegree) +
                                                    " degrees must be below 90 in the linear model");
    }
    if (!std::isfinite(gravity)) {
        throw Error(ErrorCode::InvalidArgument, "gravity " + numberText(gravity) + " m/s² must be finite");
    }
    if (!(tilt >= 0.0 && tilt <= std::numbers::pi)) {
        throw Error(ErrorCode::InvalidArgument, "tilt " + numberText(tilt) + " must be from 0 to pi");
    }
    if (!std::isfinite(tilt_direction)) {
        throw Error(ErrorCode::InvalidArgument, "tilt_direction " + numberText(tilt_direction) + " must be finite");
    }
}

namespace {

void checkVolumes(const std::vector<PlanarMesh>& meshes, const SolveOptions& options)
{
    const std::vector<double>& volumes = options.volumes;
    if (volumes.empty()) {
        return;
    }
    if (volumes.size() != meshes.size()) {
        throw Error(ErrorCode::InvalidArgument,
                    fmt::format("volumes must have {} entries, one per mesh, not {}", meshes.size(), volumes.size()));
    }
    if (options.fill.sharing != FillSharing::Each) {
        throw Error(ErrorCode::InvalidArgument, "fill.sharing must be each if volumes are given");
    }
    for (std::size_t k = 0; k < volumes.size(); ++k) {
        if (!(volumes[k] > 0.0 && std::isfinite(volumes[k]))) {
            throw Error(ErrorCode::InvalidArgument,
                        fmt::format("volumes[{}] {} m³ must be positive", k, numberText(volumes[k])));
        }
    }
}

}  // namespace

PlaneGravity planeGravity(const SolveOptions& options)
{
    // A level ceiling has no downhill direction, but sin π is not exactly 0.
    const double sine = options.tilt == std::numbers::pi ? 0.0 : std::sin(options.tilt);
    const double along = options.gravity * sine;
    return {options.gravity * std::cos(options.tilt),
            along * Vec2{std::cos(options.tilt_direction), std::sin(options.tilt_direction)}};
}

namespace {

/// Largest error of the linear model's force along the rim. With the same angles, its pressure bears on ∫tan θ of the
/// rim where the exact model's bears on ∫sin θ: on a disc that is too much by t²/2 with a slope of t, while the volume
/// is by t²/6 and a height by t²/4, or 3t²/8 in a puddle. A part of the rim that is steeper counts with the cube of its
/// slope: on letters 0.3 % is reached from 3 to 4°, on discs at 4°. The error of the pressure is the largest of the
/// three. With 1 %, films of a growing droplet had a jump there.
constexpr double kSmallError = 0.0027;

/// Whether the linear model is within 0.3 % of the exact one.
bool linearSuffices(const CapillarySurface& field, const BaseSurface& ground)
{
    double excess = 0.0;
    double force = 0.0;
    const std::vector<double> slopes = rimSlopes(field, ground);
    const PlanarMesh rim = rimOf(field);
    for (std::size_t loop = 0; loop < rim.loopCount(); ++loop) {
        for (std::uint32_t v = rim.loop_starts[loop]; v < rim.loop_starts[loop + 1]; ++v) {
            const double edge = length(rim.vertices[nextOnRim(rim, loop, v)] - rim.vertices[v]);
            const double slope = std::abs(slopes[v]);
            excess += 0.5 * edge * slope * slope * slope;
            force += edge * slope;
        }
    }
    double inside = 0.0;
    double covered = 0.0;
    for (const Triangle& t : field.triangles) {
        const Vec3 normal = areaVector(field.vertices, t);
        inside += (normal.x * normal.x + normal.y * normal.y) / normal.z;
        covered += normal.z;
    }
    // On a disc the mean square of the slope is half of that along the rim.
    return excess <= kSmallError * force && inside <= kSmallError * covered;
}

Solution solveModel(const std::vector<PlanarMesh>& meshes, const SolveOptions& options, const Progress& progress)
{
    options.validate();
    if (meshes.empty()) {
        throw Error(ErrorCode::InvalidArgument, "meshes must hold at least one droplet");
    }
    for (std::size_t k = 0; k < meshes.size(); ++k) {
        if (unknownsOf(meshes[k]) == 0) {
            throw Error(ErrorCode::InvalidArgument, "meshes[" + std::to_string(k) + "] must have an inner vertex");
        }
    }
    checkVolumes(meshes, options);
    if (options.fill.by == FillBy::ContactAngle && options.fill.amount >= 0.5 * std::numbers::pi) {
        throw Error(
            ErrorCode::InvalidArgument,
            fmt::format("contact_angle {} degrees must be below 90 for a height field; solveSheet() goes beyond",
                        numberText(options.fill.amount / kDegree)));
    }
    requireGround(meshes, options.ground);
    if (progress) {
        progress(Stage::Assemble, 0.0);
    }
    const Physics physics = physicsOf(options);
    std::vector<std::unique_ptr<Energy>> energies(meshes.size());
    std::vector<std::unique_ptr<ConstrainedSolver>> solvers(meshes.size());
    std::vector<Sheet> sheets(meshes.size());
    tbb::parallel_for(std::size_t{0}, meshes.size(), [&](std::size_t k) {
        energies[k] = std::make_unique<Energy>(meshes[k], options.ground, physics);
        solvers[k] = solverFor(meshes[k], options);
        sheets[k] = emptySheet(*energies[k]);
    });
    std::vector<Group> groups(options.fill.sharing == FillSharing::Total ? 1 : meshes.size());
    for (std::size_t k = 0; k < meshes.size(); ++k) {
        Group& group = groups[groups.size() == 1 ? 0 : k];
        group.droplets.push_back(k);
        group.members.push_back({energies[k].get(), solvers[k].get(), &sheets[k]});
    }

    if (progress) {
        progress(Stage::Solve, 0.0);
    }
    // The share of several would have to wait for each other.
    const auto reached = [&](double share) { progress(Stage::Solve, share); };
    const bool tells = progress && groups.size() == 1;
    tbb::parallel_for(std::size_t{0}, groups.size(), [&](std::size_t g) {
        groups[g].outcome = findEquilibrium(groups[g].members, ownOptions(options, g),
                                            tells ? std::function<void(double)>(reached) : nullptr);
    });

    Solution solution;
    SolveReport& report = solution.report;
    report.model = options.model;
    report.termination = Termination::Converged;
    for (const Group& group : groups) {
        const Outcome& outcome = group.outcome;
        report.newton_steps = std::max(report.newton_steps, outcome.newton_steps);
        report.iterations = std::max(report.iterations, outcome.iterations);
        report.residual = std::max(report.residual, outcome.residual);
        report.work += outcome.work;
        if (outcome.termination != Termination::Converged && report.usable()) {
            report.termination = outcome.termination;
            report.failed_droplet = group.droplets[outcome.failed_member];
            report.largest_volume = outcome.largest_volume;
            report.bond_number = outcome.bond_number;
            report.critical_bond_number = outcome.critical_bond_number;
        }
    }
    std::size_t max = 0;
    for (std::size_t k = 0; k < meshes.size(); ++k) {
        report.unknowns += unknownsOf(meshes[k]);
        if (unknownsOf(meshes[k]) > max) {
            max = unknownsOf(meshes[k]);
            report.method = solvers[k]->method();
        }
    }
    if (report.usable()) {
        for (std::size_t k = 0; k < meshes.size(); ++k) {
            solution.droplets.push_back(fieldOf(*energies[k], sheets[k], options.liquid.surface_tension));
        }
    }
    return solution;
}

}  // namespace

Solution solve(const std::vector<PlanarMesh>& meshes, const SolveOptions& options, const Progress& progress)
{
    if (options.model != Model::Auto) {
        return solveModel(meshes, options, progress);
    }
    options.validate();
    SolveOptions own = options;
    const bool is_steep = options.volumes.empty() && options.fill.by == FillBy::ContactAngle &&
                          0.5 * std::pow(std::tan(options.fill.amount), 2) > kSmallError;
    if (!is_steep) {
        own.model = Model::Linear;
        Solution linear = solveModel(meshes, own, progress);
        bool suffices = linear.report.usable();
        for (std::size_t k = 0; suffices && k < meshes.size(); ++k) {
            suffices = linearSuffices(linear.droplets[k], own.ground);
        }
        if (suffices) {
            return linear;
        }
    }
    own.model = Model::Exact;
    if (is_steep || !progress) {
        return solveModel(meshes, own, progress);
    }
    // The stages have been called already.
    return solveModel(meshes, own, [&](Stage stage, double share) {
        if (share > 0.0) {
            progress(stage, share);
        }
    });
}

}  // namespace droplet
