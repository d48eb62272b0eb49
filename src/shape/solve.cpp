// SPDX-License-Identifier: GPL-3.0-or-later
//
// The linear model of the thesis, chapter 4: energy (4.1), (4.3) with √(1+t) ≈ 1 + t/2 in (4.2), volume (4.4) as a
// constraint with multiplier λ (4.5), over P1 finite elements (Ritz and Galerkin coincide).
// Rim slopes: G. F. Carey, "Derivative calculation from finite element solutions" (1982): the equations of the rim's
// vertices, left out of the system, give the force on the rim, one order more exact than the triangles' gradients.

#include "droplet/shape/solve.h"

#include <tbb/parallel_for.h>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>

#include "droplet/error.h"
#include "shape/gradient.h"

namespace droplet {
namespace {

using Matrix = Eigen::SparseMatrix<double>;
using Vector = Eigen::VectorXd;

/// The equations of one droplet: unknowns are the heights at inner vertices.
struct System {
    Matrix matrix;      ///< σK + ρgM, lower triangle
    Vector load;        ///< m = ∫φ at inner vertices: the right-hand side at unit pressure [m²]
    Matrix rim_matrix;  ///< the same rows of the rim's vertices, columns of inner vertices
    Vector rim_load;    ///< m at the rim's vertices
};

System assemble(const PlanarMesh& mesh, const SolveOptions& options)
{
    const double sigma = options.liquid.surface_tension;
    const double weight = options.liquid.density * options.gravity;
    const std::uint32_t rim = mesh.rimVertexCount();
    const auto inner = static_cast<Eigen::Index>(mesh.vertices.size() - rim);
    std::vector<Eigen::Triplet<double>> entries;
    std::vector<Eigen::Triplet<double>> rim_entries;
    entries.reserve(6 * mesh.triangles.size());
    System system;
    system.load = Vector::Zero(inner);
    system.rim_load = Vector::Zero(rim);
    for (const Triangle& t : mesh.triangles) {
        const double area = 0.5 * doubleArea(mesh, t);
        const std::array<Vec2, 3> hats = hatGradients(mesh, t);
        for (std::size_t a = 0; a < 3; ++a) {
            if (mesh.onRim(t[a])) {
                system.rim_load[t[a]] += area / 3.0;
            } else {
                system.load[t[a] - rim] += area / 3.0;
            }
            for (std::size_t b = 0; b < 3; ++b) {
                if (mesh.onRim(t[b])) {
                    continue;
                }
                // σ∫∇φa·∇φb + ρg∫φaφb; the mass of a triangle is A/6 on the diagonal, A/12 off it.
                const double value = sigma * area * dot(hats[a], hats[b]) + weight * area / (a == b ? 6.0 : 12.0);
                if (mesh.onRim(t[a])) {
                    rim_entries.emplace_back(t[a], t[b] - rim, value);
                } else if (t[a] >= t[b]) {
                    entries.emplace_back(t[a] - rim, t[b] - rim, value);
                }
            }
        }
    }
    system.matrix.resize(inner, inner);
    system.matrix.setFromTriplets(entries.begin(), entries.end());
    system.rim_matrix.resize(rim, inner);
    system.rim_matrix.setFromTriplets(rim_entries.begin(), rim_entries.end());
    return system;
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
    bool factored = false;
    double residual = 0.0;           ///< relative
    Vector height;                   ///< at inner vertices [m/Pa]
    Vector slope;                    ///< at rim vertices [1/Pa]
    std::vector<double> rim_weight;  ///< [m]
    double volume = 0.0;             ///< [m³/Pa]
    double height_max = 0.0;         ///< [m/Pa]
};

UnitSolution solveUnit(const PlanarMesh& mesh, const System& system, double sigma)
{
    UnitSolution unit;
    const Eigen::SimplicialLLT<Matrix, Eigen::Lower> factor(system.matrix);
    if (factor.info() != Eigen::Success) {
        return unit;
    }
    unit.height = factor.solve(system.load);
    const auto symmetric = system.matrix.selfadjointView<Eigen::Lower>();
    // One step of refinement: the factorisation of a fine mesh loses some digits.
    unit.height += factor.solve(Vector(system.load - symmetric * unit.height));
    unit.residual = Vector(system.load - symmetric * unit.height).norm() / system.load.norm();
    unit.factored = true;
    unit.volume = system.load.dot(unit.height);
    unit.height_max = unit.height.maxCoeff();
    unit.rim_weight = rimWeights(mesh);
    // σ∫∂u/∂n φ over the rim = (σK + ρgM)u − λm, outward; the slope is counted inward.
    unit.slope = system.rim_load - system.rim_matrix * unit.height;
    for (Eigen::Index v = 0; v < unit.slope.size(); ++v) {
        unit.slope[v] /= sigma * unit.rim_weight[static_cast<std::size_t>(v)];
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
        for (Eigen::Index v = 0; v < unit.slope.size(); ++v) {
            const double weight = unit.rim_weight[static_cast<std::size_t>(v)];
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
    if (progress) {
        progress(Stage::Assemble);
    }
    std::vector<System> systems(meshes.size());
    tbb::parallel_for(std::size_t{0}, meshes.size(), [&](std::size_t k) { systems[k] = assemble(meshes[k], options); });

    if (progress) {
        progress(Stage::Solve);
    }
    std::vector<UnitSolution> units(meshes.size());
    tbb::parallel_for(std::size_t{0}, meshes.size(), [&](std::size_t k) {
        units[k] = solveUnit(meshes[k], systems[k], options.liquid.surface_tension);
        systems[k] = System{};
    });

    Solution solution;
    solution.report.method = "simplicial-llt";
    solution.report.iterations = 1;
    solution.report.converged = true;
    for (std::size_t k = 0; k < meshes.size(); ++k) {
        solution.report.unknowns += meshes[k].vertices.size() - meshes[k].rimVertexCount();
        solution.report.residual = std::max(solution.report.residual, units[k].residual);
        solution.report.converged = solution.report.converged && units[k].factored && units[k].volume > 0.0;
    }
    // A million triangles leave 1e-12.
    solution.report.converged = solution.report.converged && solution.report.residual < 1e-9;
    if (!solution.report.converged) {
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
        for (Eigen::Index v = 0; v < units[k].height.size(); ++v) {
            field.height[rim + static_cast<std::size_t>(v)] = pressures[k] * units[k].height[v];
        }
        field.rim_slope.resize(rim);
        for (std::uint32_t v = 0; v < rim; ++v) {
            field.rim_slope[v] = pressures[k] * units[k].slope[v];
        }
        solution.droplets.push_back(std::move(field));
    }
    return solution;
}

}  // namespace droplet
