// SPDX-License-Identifier: GPL-3.0-or-later
//
// One factorisation of A solves the system bordered with the volume: x = A⁻¹right + λA⁻¹m. Its inertia shows whether A
// is positive definite on functions without volume: N. Gould, "On practical conditions for the existence and uniqueness
// of solutions to the general equality quadratic programming problem" (1985).

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "shape/constrained.h"
#include "shape/mesh_pattern.h"
#include "shape/symmetric_factor.h"

namespace droplet {
namespace {

using SparseMatrix = Eigen::SparseMatrix<double>;

/// Largest number of refinements, and the residual at which no further one is needed.
constexpr int kMaxRefinements = 3;
constexpr double kGoodResidual = 1e-11;

/// Lower triangle of an operator. Rows of held vertices are those of the identity.
SparseMatrix matrixOf(const PlanarMesh& mesh, const Operator& op, const MeshPattern& pattern)
{
    const auto is_held = [&](std::uint32_t v) {
        return !op.held.empty() && !mesh.onRim(v) && op.held[v - mesh.rimVertexCount()] != 0;
    };
    SparseMatrix matrix = pattern.assemble([&](std::size_t i) {
        const Triangle& t = mesh.triangles[i];
        const auto whole = elementMatrix(mesh, i, op);
        MeshPattern::Element element{};
        for (std::size_t k = 0; k < element.size(); ++k) {
            const auto [a, b] = MeshPattern::kPairs[k];
            element[k] = is_held(t[a]) || is_held(t[b]) ? 0.0 : whole[a][b];
        }
        return element;
    });
    for (std::size_t i = 0; i < op.held.size(); ++i) {
        if (op.held[i] != 0) {
            matrix.valuePtr()[matrix.outerIndexPtr()[i]] = 1.0;
        }
    }
    return matrix;
}

std::vector<std::uint8_t> heldOf(const PlanarMesh& mesh, const Operator& op)
{
    return op.held.empty() ? std::vector<std::uint8_t>(mesh.vertices.size() - mesh.rimVertexCount(), 0) : op.held;
}

/// m, with 0 at held vertices.
Eigen::VectorXd loadOf(const PlanarMesh& mesh, const std::vector<std::uint8_t>& held)
{
    const std::uint32_t rim = mesh.rimVertexCount();
    Eigen::VectorXd load = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(held.size()));
    for (const Triangle& t : mesh.triangles) {
        const double third = doubleArea(mesh, t) / 6.0;
        for (const std::uint32_t v : t) {
            if (!mesh.onRim(v) && held[v - rim] == 0) {
                load[v - rim] += third;
            }
        }
    }
    return load;
}

class DirectSolver final : public ConstrainedSolver {
public:
    explicit DirectSolver(const PlanarMesh& mesh)
        : mesh_(&mesh), pattern_(mesh.triangles, mesh.vertices.size(), mesh.rimVertexCount())
    {
    }

    void prepare(const Operator& op) override
    {
        held_ = heldOf(*mesh_, op);
        load_ = loadOf(*mesh_, held_);
        mass_weight_ = op.mass_weight;
        matrix_ = matrixOf(*mesh_, op, pattern_);
        // Without a pull away from the ground A is positive definite.
        if (!factor_ || is_definite_ != (op.mass_weight >= 0.0)) {
            is_definite_ = op.mass_weight >= 0.0;
            factor_ = is_definite_ ? choleskyFactor(matrix_) : multifrontalFactor(matrix_, placesInside());
        }
        usable_ = factor_->factorize(matrix_);
        if (usable_) {
            unit_ = factor_->solve(load_);
            unit_volume_ = load_.dot(unit_);
            // A may be negative in one direction, a function with volume. By the inertia of the bordered matrix, A is
            // then positive on functions without volume if and only if mᵀA⁻¹m < 0.
            const std::size_t negative = factor_->negatives();
            usable_ = (negative == 0 && unit_volume_ > 0.0) || (negative == 1 && unit_volume_ < 0.0);
        }
    }

    [[nodiscard]] ConstrainedSolution solve(const ConstrainedProblem& problem) const override
    {
        ConstrainedSolution solution;
        if (!usable_) {
            return solution;
        }
        Eigen::VectorXd right = Eigen::VectorXd::Zero(load_.size());
        for (std::size_t i = 0; i < problem.right.size(); ++i) {
            right[static_cast<Eigen::Index>(i)] = held_[i] == 0 ? problem.right[i] : 0.0;
        }
        double lambda = problem.volume / unit_volume_;
        Eigen::VectorXd x = lambda * unit_;
        // Refinement corrects round-off on a fine mesh, and cancellation if A itself is nearly singular. The first step
        // solves for the right side, if there is one.
        const auto refine = [&](const Eigen::VectorXd& residual) {
            x += factor_->solve(residual);
            const double more = (problem.volume - load_.dot(x)) / unit_volume_;
            x += more * unit_;
            lambda += more;
        };
        if (!problem.right.empty()) {
            refine(right);
        }
        for (int step = 0;; ++step) {
            const Eigen::VectorXd pull = lambda * load_;
            const Eigen::VectorXd residual = right + pull - matrix_.selfadjointView<Eigen::Lower>() * x;
            const double weight = std::abs(mass_weight_) * load_.cwiseProduct(x).norm();
            const double scale = std::max({right.norm(), pull.norm(), weight});
            solution.residual = scale > 0.0 ? residual.norm() / scale : 0.0;
            if (step == kMaxRefinements || (step > 0 && solution.residual < kGoodResidual)) {
                break;
            }
            refine(residual);
        }
        solution.values.assign(x.data(), x.data() + x.size());
        solution.multiplier = lambda;
        solution.iterations = 1;
        solution.converged = solution.residual < kLargestResidual;
        return solution;
    }

    [[nodiscard]] const char* method() const override { return factor_ ? factor_->method() : ""; }

    [[nodiscard]] double prepareWork() const override
    {
        // Up to 25 000 unknowns a factorisation costs no more than a step besides its systems; then with the power 3/2.
        constexpr double kPerPower = 0.1;
        return kPerPower * std::pow(static_cast<double>(load_.size()), 1.5);
    }

private:
    [[nodiscard]] std::vector<Vec3> placesInside() const
    {
        std::vector<Vec3> places;
        for (std::size_t v = mesh_->rimVertexCount(); v < mesh_->vertices.size(); ++v) {
            places.push_back({mesh_->vertices[v].x, mesh_->vertices[v].y, 0.0});
        }
        return places;
    }

    const PlanarMesh* mesh_;
    MeshPattern pattern_;
    SparseMatrix matrix_;
    std::unique_ptr<SymmetricFactor> factor_;
    bool is_definite_ = false;  ///< whether the factor is one for positive definite matrices
    std::vector<std::uint8_t> held_;
    Eigen::VectorXd load_;
    Eigen::VectorXd unit_;  ///< A⁻¹m
    double unit_volume_ = 0.0;
    double mass_weight_ = 0.0;
    bool usable_ = false;
};

}  // namespace

std::unique_ptr<ConstrainedSolver> directSolver(const PlanarMesh& mesh)
{
    return std::make_unique<DirectSolver>(mesh);
}

}  // namespace droplet
