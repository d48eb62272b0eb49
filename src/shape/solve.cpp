// SPDX-License-Identifier: GPL-3.0-or-later
//
// The linear model of the thesis, chapter 4: energy (4.1), (4.3) with √(1+t) ≈ 1 + t/2 in (4.2), volume (4.4) as a
// constraint with multiplier λ (4.5), over P1 finite elements (Ritz and Galerkin coincide).
// Rim slopes: G. F. Carey, "Derivative calculation from finite element solutions" (1982): the equations of the rim's
// vertices, left out of the system, give the force on the rim, one order more exact than the triangles' gradients.

#include "droplet/shape/solve.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "droplet/error.h"
#include "mesh/regular_runs.h"
#include "shape/direct.h"
#include "shape/hierarchy.h"
#include "shape/multigrid.h"
#include "shape/operator.h"

namespace droplet {
namespace {

/// Fewer unknowns are factored in less time than a hierarchy takes to build, if most of the mesh is its lattice; and if
/// not, up to many more. Measured in bench/RESULTS.md.
constexpr std::size_t kSmall = 500;
constexpr std::size_t kSmallIrregular = 50'000;

/// The linear system of one droplet, ready for the solver chosen.
struct System {
    Solver solver = Solver::Llt;
    std::optional<SparseSystem> sparse;
    std::optional<Hierarchy> hierarchy;
};

Solver chooseSolver(const PlanarMesh& mesh)
{
    const std::size_t unknowns = mesh.vertices.size() - mesh.rimVertexCount();
    const bool is_lattice = 2 * irregularTriangleCount(mesh) < mesh.triangles.size();
    return unknowns < (is_lattice ? kSmall : kSmallIrregular) ? Solver::Llt : Solver::Multigrid;
}

System prepare(const PlanarMesh& mesh, const Operator& op, Solver wanted)
{
    System system;
    system.solver = wanted == Solver::Auto ? chooseSolver(mesh) : wanted;
    if (system.solver == Solver::Multigrid) {
        system.hierarchy = buildHierarchy(mesh, op);
    } else {
        system.sparse = assemble(mesh, op);
    }
    return system;
}

const char* nameOf(Solver solver)
{
    switch (solver) {
        case Solver::Llt:
            return "simplicial-llt";
        case Solver::Cholmod:
            return "cholmod-supernodal";
        case Solver::Multigrid:
            return "multigrid-pcg";
        case Solver::Auto:
            break;
    }
    return "";
}

/// Half the length of the two rim edges at every rim vertex [m].
std::vector<double> rimWeights(const PlanarMesh& mesh)
{
    std::vector<double> weights(mesh.rimVertexCount(), 0.0);
    for (std::size_t loop = 0; loop < mesh.loopCount(); ++loop) {
        for (std::uint32_t v = mesh.loop_starts[loop]; v < mesh.loop_starts[loop + 1]; ++v) {
            const std::uint32_t next = nextOnRim(mesh, loop, v);
            const double half = 0.5 * length(mesh.vertices[next] - mesh.vertices[v]);
            weights[v] += half;
            weights[next] += half;
        }
    }
    return weights;
}

/// One droplet at unit pressure. Heights, slopes and volume are proportional to the pressure.
struct UnitSolution {
    Solver solver = Solver::Llt;     ///< the one that solved it
    LinearSolution linear;           ///< heights by σ [m²]
    std::vector<double> slope;       ///< at rim vertices [1/Pa]
    std::vector<double> rim_weight;  ///< [m]
    double volume = 0.0;             ///< [m³/Pa]
    double height_max = 0.0;         ///< [m/Pa]
};

/// Slopes, volume and height of what the linear system gave.
void measureUnit(const PlanarMesh& mesh, const Operator& op, double sigma, UnitSolution& unit)
{
    const std::uint32_t rim = mesh.rimVertexCount();
    const std::vector<double>& values = unit.linear.values;
    const auto at = [&](std::uint32_t v) { return mesh.onRim(v) ? 0.0 : values[v - rim]; };
    unit.slope.assign(rim, 0.0);
    // Where there is a lattice, its triangles come last and none of them touches the rim.
    const std::size_t near_rim = irregularTriangleCount(mesh);
    for (std::size_t i = 0; i < near_rim; ++i) {
        const Triangle& t = mesh.triangles[i];
        if (!mesh.onRim(std::min({t[0], t[1], t[2]}))) {
            continue;
        }
        const auto matrix = elementMatrix(mesh, i, op);
        for (std::size_t a = 0; a < 3; ++a) {
            if (mesh.onRim(t[a])) {
                // ∫∂u/∂n φ over the rim = (K + wM)u − λm/σ, outward; the slope is counted inward.
                unit.slope[t[a]] += doubleArea(mesh, t) / 6.0 - matrix[a][0] * at(t[0]) - matrix[a][1] * at(t[1]) -
                                    matrix[a][2] * at(t[2]);
            }
        }
    }
    unit.rim_weight = rimWeights(mesh);
    for (std::uint32_t v = 0; v < rim; ++v) {
        unit.slope[v] /= sigma * unit.rim_weight[v];
    }
    unit.volume = unit.linear.integral / sigma;
    unit.height_max = *std::max_element(values.begin(), values.end()) / sigma;
}

UnitSolution solveUnit(const PlanarMesh& mesh, System&& system, const Operator& op, const SolveOptions& options)
{
    UnitSolution unit;
    unit.solver = system.solver;
    if (system.hierarchy) {
        unit.linear = solveByMultigrid(*system.hierarchy);
        system.hierarchy.reset();
        if (!unit.linear.converged && options.solver == Solver::Auto) {
            unit.solver = Solver::Cholmod;
            system.sparse = assemble(mesh, op);
        }
    }
    if (system.sparse) {
        unit.linear = unit.solver == Solver::Cholmod ? solveByCholmod(*system.sparse) : solveByLlt(*system.sparse);
    }
    if (unit.linear.converged) {
        measureUnit(mesh, op, options.liquid.surface_tension, unit);
    }
    return unit;
}

/// Mean contact angle over some droplets' rims at a pressure, and its derivative.
std::pair<double, double> meanAngle(const std::vector<UnitSolution>& units, const std::vector<std::size_t>& group,
                                    double pressure)
{
    double angle = 0.0;
    double derivative = 0.0;
    double total = 0.0;
    for (const std::size_t k : group) {
        const UnitSolution& unit = units[k];
        for (std::size_t v = 0; v < unit.slope.size(); ++v) {
            const double weight = unit.rim_weight[v];
            const double slope = pressure * unit.slope[v];
            angle += weight * std::atan(slope);
            derivative += weight * unit.slope[v] / (1.0 + slope * slope);
            total += weight;
        }
    }
    return {angle / total, derivative / total};
}

/// The pressure at which the mean angle is the wanted one: Newton inside a bracket that bisection keeps.
double pressureForAngle(const std::vector<UnitSolution>& units, const std::vector<std::size_t>& group, double angle)
{
    double high = std::tan(angle) / meanAngle(units, group, 0.0).second;
    double low = 0.0;
    // Rim pieces in sharp corners steepen slowly, so the mean may lag behind for long, but not beyond this.
    for (int k = 0; meanAngle(units, group, high).first < angle; ++k) {
        if (k == 60) {
            throw Error(ErrorCode::NoSuchDroplet, "no pressure gives a mean contact angle of " +
                                                      std::to_string(angle / kDegree) +
                                                      " degrees on this footprint; ask for a smaller angle");
        }
        low = high;
        high *= 2.0;
    }
    double pressure = 0.5 * (low + high);
    for (int k = 0; k < 200 && high - low > 4.0 * std::numeric_limits<double>::epsilon() * high; ++k) {
        const auto [mean, derivative] = meanAngle(units, group, pressure);
        (mean < angle ? low : high) = pressure;
        const double newton = pressure + (angle - mean) / derivative;
        const bool inside = newton > low && newton < high;
        if (inside && std::abs(newton - pressure) <= 2.0 * std::numeric_limits<double>::epsilon() * pressure) {
            return newton;
        }
        pressure = inside ? newton : 0.5 * (low + high);
    }
    return pressure;
}

/// The common pressure of some droplets that meets the fill.
double pressureFor(const std::vector<UnitSolution>& units, const std::vector<std::size_t>& group, const Fill& fill)
{
    double volume = 0.0;
    double height = 0.0;
    for (const std::size_t k : group) {
        volume += units[k].volume;
        height = std::max(height, units[k].height_max);
    }
    switch (fill.by) {
        case FillBy::Volume:
            return fill.amount / volume;
        case FillBy::Height:
            return fill.amount / height;
        case FillBy::ContactAngle:
            break;
    }
    return pressureForAngle(units, group, fill.amount);
}

}  // namespace

void SolveOptions::validate() const
{
    liquid.validate();
    fill.validate();
    if (!(gravity >= 0.0 && std::isfinite(gravity))) {
        throw Error(ErrorCode::InvalidArgument, "gravity " + std::to_string(gravity) + " m/s² must not be negative");
    }
}

Solution solve(const std::vector<PlanarMesh>& meshes, const SolveOptions& options, const Progress& progress)
{
    options.validate();
    if (meshes.empty()) {
        throw Error(ErrorCode::InvalidArgument, "meshes must hold at least one droplet");
    }
    for (std::size_t k = 0; k < meshes.size(); ++k) {
        if (meshes[k].vertices.size() <= meshes[k].rimVertexCount()) {
            throw Error(ErrorCode::InvalidArgument, "meshes[" + std::to_string(k) + "] must have an inner vertex");
        }
    }
    if (progress) {
        progress(Stage::Assemble);
    }
    Operator op;
    op.mass_weight = options.liquid.density * options.gravity / options.liquid.surface_tension;
    std::vector<System> systems(meshes.size());
    tbb::parallel_for(std::size_t{0}, meshes.size(),
                      [&](std::size_t k) { systems[k] = prepare(meshes[k], op, options.solver); });

    if (progress) {
        progress(Stage::Solve);
    }
    std::vector<UnitSolution> units(meshes.size());
    tbb::parallel_for(std::size_t{0}, meshes.size(),
                      [&](std::size_t k) { units[k] = solveUnit(meshes[k], std::move(systems[k]), op, options); });

    Solution solution;
    SolveReport& report = solution.report;
    bool converged = true;
    std::size_t most = 0;
    for (std::size_t k = 0; k < meshes.size(); ++k) {
        const std::size_t unknowns = meshes[k].vertices.size() - meshes[k].rimVertexCount();
        report.unknowns += unknowns;
        report.iterations = std::max(report.iterations, units[k].linear.iterations);
        report.residual = std::max(report.residual, units[k].linear.residual);
        converged = converged && units[k].linear.converged && units[k].volume > 0.0;
        if (unknowns > most) {
            most = unknowns;
            report.method = nameOf(units[k].solver);
        }
    }
    report.newton_steps = 1;
    report.termination = converged ? Termination::Converged : Termination::NotConverged;
    if (!converged) {
        return solution;
    }

    std::vector<double> pressures(meshes.size());
    std::vector<std::size_t> all(meshes.size());
    for (std::size_t k = 0; k < meshes.size(); ++k) {
        all[k] = k;
        if (options.fill.sharing == FillSharing::Each) {
            pressures[k] = pressureFor(units, {k}, options.fill);
        }
    }
    if (options.fill.sharing == FillSharing::Total) {
        std::fill(pressures.begin(), pressures.end(), pressureFor(units, all, options.fill));
    }
    for (std::size_t k = 0; k < meshes.size(); ++k) {
        const std::uint32_t rim = meshes[k].rimVertexCount();
        HeightField field;
        field.pressure = pressures[k];
        field.height.assign(meshes[k].vertices.size(), 0.0);
        const double factor = pressures[k] / options.liquid.surface_tension;
        for (std::size_t i = 0; i < units[k].linear.values.size(); ++i) {
            field.height[rim + i] = factor * units[k].linear.values[i];
        }
        field.rim_slope.resize(rim);
        for (std::uint32_t v = 0; v < rim; ++v) {
            field.rim_slope[v] = pressures[k] * units[k].slope[v];
            field.contact_angle.push_back(std::atan(field.rim_slope[v]));
        }
        solution.droplets.push_back(std::move(field));
    }
    return solution;
}

}  // namespace droplet
