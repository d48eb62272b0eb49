// SPDX-License-Identifier: GPL-3.0-or-later
//
// One factorisation of A solves the system bordered with the volume: x = A⁻¹right + λA⁻¹m. Its inertia shows whether A
// is positive definite on functions without volume: N. Gould, "On practical conditions for the existence and uniqueness
// of solutions to the general equality quadratic programming problem" (1985).

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <numeric>
#include <type_traits>
#include <variant>
#include <vector>

#include "shape/constrained.h"

namespace droplet {
namespace {

using SparseMatrix = Eigen::SparseMatrix<double>;
using Llt = Eigen::SimplicialLLT<SparseMatrix, Eigen::Lower>;
using Ldlt = Eigen::SimplicialLDLT<SparseMatrix, Eigen::Lower>;

/// Pairs of a triangle's corners with an entry in the lower triangle of the symmetric matrix.
constexpr std::array<std::array<std::size_t, 2>, 6> kPairs{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}}};

/// Largest number of refinements, and the residual at which no further one is needed.
constexpr int kMaxRefinements = 3;
constexpr double kGoodResidual = 1e-11;

/// Marks a pair without an entry, because one of its vertices is on the rim.
constexpr std::uint32_t kNoEntry = std::numeric_limits<std::uint32_t>::max();

/// Sparsity pattern of the lower triangle of a mesh's matrices, and the entries of every mesh triangle.
class Pattern {
public:
    explicit Pattern(const PlanarMesh& mesh) : rim_(mesh.rimVertexCount()), matrix_(unknowns(mesh), unknowns(mesh))
    {
        const std::size_t count = mesh.vertices.size() - rim_;
        // Every edge occurs once or twice, in the column of its lower vertex.
        std::vector<std::uint32_t> starts(count + 1, 0);
        const auto for_each_edge = [&](const auto& visit) {
            for (const Triangle& t : mesh.triangles) {
                for (std::size_t a = 0; a < 3; ++a) {
                    const auto [low, high] = std::minmax(t[a], t[(a + 1) % 3]);
                    if (!mesh.onRim(low)) {
                        visit(low - rim_, high - rim_);
                    }
                }
            }
        };
        for_each_edge([&](std::uint32_t low, std::uint32_t) { ++starts[low + 1]; });
        for (std::size_t i = 0; i < count; ++i) {
            starts[i + 1] += starts[i];
        }
        std::vector<std::uint32_t> ends(starts.begin(), starts.end() - 1);
        std::vector<std::uint32_t> rows(starts.back());
        for_each_edge([&](std::uint32_t low, std::uint32_t high) { rows[ends[low]++] = high; });
        std::vector<int> lengths(count);
        for (std::size_t i = 0; i < count; ++i) {
            const auto begin = rows.begin() + starts[i];
            std::sort(begin, rows.begin() + ends[i]);
            lengths[i] = 1 + static_cast<int>(std::unique(begin, rows.begin() + ends[i]) - begin);
        }
        const int total = std::accumulate(lengths.begin(), lengths.end(), 0);
        matrix_.resizeNonZeros(total);
        int* const outer = matrix_.outerIndexPtr();
        int* at = matrix_.innerIndexPtr();
        for (std::size_t i = 0; i < count; ++i) {
            outer[i] = static_cast<int>(at - matrix_.innerIndexPtr());
            *at++ = static_cast<int>(i);
            at = std::copy_n(rows.begin() + starts[i], lengths[i] - 1, at);
        }
        outer[count] = total;
        locate(mesh);
    }

    [[nodiscard]] const SparseMatrix& matrix() const { return matrix_; }

    /// Fills in the operator. Rows of held vertices are those of the identity.
    void fill(const PlanarMesh& mesh, const Operator& op)
    {
        double* const values = matrix_.valuePtr();
        std::fill_n(values, matrix_.nonZeros(), 0.0);
        const auto held = [&](std::uint32_t v) { return !op.held.empty() && !mesh.onRim(v) && op.held[v - rim_] != 0; };
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
            const Triangle& t = mesh.triangles[i];
            const auto matrix = elementMatrix(mesh, i, op);
            for (std::size_t k = 0; k < kPairs.size(); ++k) {
                const auto [a, b] = kPairs[k];
                if (entries_[i][k] != kNoEntry && !held(t[a]) && !held(t[b])) {
                    values[entries_[i][k]] += matrix[a][b];
                }
            }
        }
        for (std::size_t i = 0; i < op.held.size(); ++i) {
            if (op.held[i] != 0) {
                values[matrix_.outerIndexPtr()[i]] = 1.0;
            }
        }
    }

private:
    static Eigen::Index unknowns(const PlanarMesh& mesh)
    {
        return static_cast<Eigen::Index>(mesh.vertices.size() - mesh.rimVertexCount());
    }

    /// Finds the entries of every triangle.
    void locate(const PlanarMesh& mesh)
    {
        const int* const outer = matrix_.outerIndexPtr();
        const int* const inner = matrix_.innerIndexPtr();
        entries_.resize(mesh.triangles.size());
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
            for (std::size_t k = 0; k < kPairs.size(); ++k) {
                const Triangle& t = mesh.triangles[i];
                const auto [low, high] = std::minmax(t[kPairs[k][0]], t[kPairs[k][1]]);
                entries_[i][k] = kNoEntry;
                if (!mesh.onRim(low)) {
                    const int* const begin = inner + outer[low - rim_];
                    const int* const at =
                        std::find(begin, inner + outer[low - rim_ + 1], static_cast<int>(high - rim_));
                    entries_[i][k] = static_cast<std::uint32_t>(at - inner);
                }
            }
        }
    }

    std::uint32_t rim_;
    SparseMatrix matrix_;
    std::vector<std::array<std::uint32_t, kPairs.size()>> entries_;
};

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
    explicit DirectSolver(const PlanarMesh& mesh) : mesh_(&mesh), pattern_(mesh) {}

    void prepare(const Operator& op) override
    {
        held_ = heldOf(*mesh_, op);
        load_ = loadOf(*mesh_, held_);
        mass_weight_ = op.mass_weight;
        pattern_.fill(*mesh_, op);
        if (op.mass_weight < 0.0) {
            factorize<Ldlt>();
        } else {
            factorize<Llt>();
        }
        if (usable_) {
            unit_ = divided(load_);
            unit_volume_ = load_.dot(unit_);
            // A may be negative in one direction, a function with volume. By the inertia of the bordered matrix, A is
            // then positive on functions without volume if and only if mᵀA⁻¹m < 0.
            const Eigen::Index negative = negativePivots();
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
            x += divided(residual);
            const double more = (problem.volume - load_.dot(x)) / unit_volume_;
            x += more * unit_;
            lambda += more;
        };
        if (!problem.right.empty()) {
            refine(right);
        }
        for (int step = 0;; ++step) {
            const Eigen::VectorXd pull = lambda * load_;
            const Eigen::VectorXd residual = right + pull - pattern_.matrix().selfadjointView<Eigen::Lower>() * x;
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

    [[nodiscard]] const char* method() const override
    {
        return std::holds_alternative<Ldlt>(factor_) ? "simplicial-ldlt" : "simplicial-llt";
    }

    [[nodiscard]] double prepareWork() const override
    {
        // Up to 25 000 unknowns a factorisation costs no more than a step besides its systems; then with the power 3/2.
        constexpr double kPerPower = 0.1;
        return kPerPower * std::pow(static_cast<double>(load_.size()), 1.5);
    }

private:
    /// Orders the unknowns on the first use of a kind of factorisation.
    template <typename Factor>
    void factorize()
    {
        if (!std::holds_alternative<Factor>(factor_)) {
            factor_.emplace<Factor>().analyzePattern(pattern_.matrix());
        }
        Factor& factor = std::get<Factor>(factor_);
        factor.factorize(pattern_.matrix());
        usable_ = factor.info() == Eigen::Success;
    }

    [[nodiscard]] Eigen::VectorXd divided(const Eigen::VectorXd& right) const
    {
        return std::visit(
            [&](const auto& factor) -> Eigen::VectorXd {
                if constexpr (std::is_same_v<std::decay_t<decltype(factor)>, std::monostate>) {
                    return right;
                } else {
                    return factor.solve(right);
                }
            },
            factor_);
    }

    [[nodiscard]] Eigen::Index negativePivots() const
    {
        const Ldlt* const ldlt = std::get_if<Ldlt>(&factor_);
        return ldlt == nullptr ? 0 : (ldlt->vectorD().array() < 0.0).count();
    }

    const PlanarMesh* mesh_;
    Pattern pattern_;
    std::variant<std::monostate, Llt, Ldlt> factor_;
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
