// SPDX-License-Identifier: GPL-3.0-or-later
//
// Conjugate gradients preconditioned with a multigrid cycle: O. Tatebe, "The multigrid preconditioned conjugate
// gradient method" (1993). Smoother: Chebyshev polynomials of the Jacobi-scaled matrix, M. Adams, M. Brezina, J. Hu, R.
// Tuminaro, "Parallel multigrid smoothing: polynomial versus Gauss-Seidel" (2003). It needs no order of the unknowns,
// so threads do not change its result. The cycle is computed in single precision. This limits the rate of convergence,
// but not the accuracy.
//
// With a right side, or if gravity pulls the liquid off, the iteration stays among functions without volume: projected
// conjugate gradients with a constraint preconditioner and residual update, N. Gould, M. Hribar, J. Nocedal, "On the
// solution of equality constrained quadratic programming problems arising in optimization" (2001).

#include <tbb/parallel_for.h>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <random>
#include <vector>

#include "blocks.h"
#include "shape/constrained.h"
#include "shape/hierarchy.h"

namespace droplet {
namespace {

using Index = std::uint32_t;

/// Limit of iterations. Lattices need 8 to 15, with steep liquid up to 70; other meshes need some dozens.
constexpr std::size_t kMaxIterations = 200;

/// Tolerance of the search for negative directions.
constexpr double kProbeTolerance = 1e-8;

/// Lower end of the part of the spectrum that the smoother damps, relative to the upper end. Coarser levels damp the
/// rest.
constexpr double kSmoothedShare = 0.25;

/// The same for triangles with tensors. In steep liquid the coupling along the rim is stronger than across. Coarser
/// levels lack functions that are rough across and smooth along it, so the smoother must damp more. A cap of 85° with a
/// million triangles takes 48 iterations instead of 57; a cap of 60° takes the same number.
constexpr double kStretchedShare = 0.15;

/// Pieces of work of about equal size, as ranges of a list of runs.
std::vector<std::size_t> piecesOf(std::size_t count, const std::vector<Index>& sizes)
{
    std::vector<std::size_t> ends;
    std::size_t size = 0;
    for (std::size_t i = 0; i < count; ++i) {
        size += sizes[i];
        if (size >= kBlock) {
            ends.push_back(i + 1);
            size = 0;
        }
    }
    if (ends.empty() || ends.back() != count) {
        ends.push_back(count);
    }
    return ends;
}

template <typename Run>
std::vector<std::size_t> piecesOf(const std::vector<Run>& runs)
{
    std::vector<Index> sizes;
    sizes.reserve(runs.size());
    for (const Run& run : runs) {
        sizes.push_back(run.count);
    }
    return piecesOf(runs.size(), sizes);
}

template <typename Work>
void forPieces(const std::vector<std::size_t>& ends, const Work& work)
{
    const auto run = [&](std::size_t p) {
        for (std::size_t i = p == 0 ? 0 : ends[p - 1]; i < ends[p]; ++i) {
            work(i);
        }
    };
    if (ends.size() < 2) {
        run(0);
        return;
    }
    tbb::parallel_for(std::size_t{0}, ends.size(), run);
}

/// Calls use(unknown, product) for every row of a run, with its product with x.
template <typename Real, typename Use>
void applyRegular(const GridRun& run, const Stencil& stencil, const Real* x, const Use& use)
{
    const auto diagonal = static_cast<Real>(stencil.diagonal);
    const auto neighbour = static_cast<Real>(stencil.neighbour);
    const Real* left = x + run.first - 1;
    const Real* centre = x + run.first;
    const Real* below = x + run.below;
    const Real* above = x + run.above;
    for (Index k = 0; k < run.count; ++k) {
        const Real sum = (left[k] + centre[k + 1]) + (below[k] + below[k + 1]) + (above[k] + above[k + 1]);
        use(run.first + k, diagonal * centre[k] + neighbour * sum);
    }
}

/// The same for rows that differ. `rows` has the members of LatticeRows, as pointers.
template <typename Real, typename Rows, typename Use>
void applyVarying(const GridRun& run, const Rows& rows, const Real* x, const Use& use)
{
    const Real* diagonal = rows.diagonal + run.first;
    const Real* next = rows.next + run.first;
    const Real* last = rows.next + run.first - 1;
    const Real* above_left = rows.above_left + run.first;
    const Real* above_right = rows.above_right + run.first;
    const Real* below_left = rows.above_right + run.below;
    const Real* below_right = rows.above_left + run.below + 1;
    const Real* left = x + run.first - 1;
    const Real* centre = x + run.first;
    const Real* below = x + run.below;
    const Real* above = x + run.above;
    for (Index k = 0; k < run.count; ++k) {
        const Real sum = (last[k] * left[k] + next[k] * centre[k + 1]) +
                         (below_left[k] * below[k] + below_right[k] * below[k + 1]) +
                         (above_left[k] * above[k] + above_right[k] * above[k + 1]);
        use(run.first + k, diagonal[k] * centre[k] + sum);
    }
}

template <typename Real>
struct RowPointers {
    const Real* diagonal;
    const Real* next;
    const Real* above_left;
    const Real* above_right;
};

/// Smoother of one level, with its matrix in single precision.
class Smoother {
public:
    explicit Smoother(const Level& level)
        : level_(&level),
          values_(level.irregular.values.begin(), level.irregular.values.end()),
          regular_pieces_(piecesOf(level.regular))
    {
        // Extremes of the symbol: the sum of the six neighbours' cosines is from −3 to 6.
        const double ratio = level.stencil.neighbour / level.stencil.diagonal;
        const double largest = std::max(1.0 - 3.0 * ratio, 1.0 + 6.0 * ratio);
        // By Gershgorin's theorem no irregular row exceeds that if its scale is at most this.
        const SparseRows& rows = level.irregular;
        scale_.resize(rows.unknowns.size());
        for (std::size_t k = 0; k < scale_.size(); ++k) {
            double diagonal = 0.0;
            double sum = 0.0;
            for (Index e = rows.starts[k]; e < rows.starts[k + 1]; ++e) {
                sum += std::abs(rows.values[e]);
                if (rows.columns[e] == rows.unknowns[k]) {
                    diagonal = rows.values[e];
                }
            }
            scale_[k] = static_cast<float>(1.0 / std::max(diagonal, sum / largest));
        }
        if (!level.varying.empty()) {
            const LatticeRows& varying = level.varying;
            diagonal_.assign(varying.diagonal.begin(), varying.diagonal.end());
            next_.assign(varying.next.begin(), varying.next.end());
            above_left_.assign(varying.above_left.begin(), varying.above_left.end());
            above_right_.assign(varying.above_right.begin(), varying.above_right.end());
            varying_scale_.assign(level.size, 0.0F);
            forPieces(regular_pieces_, [&](std::size_t i) {
                const GridRun& run = level.regular[i];
                for (Index k = 0; k < run.count; ++k) {
                    const RegularRow row = regularRow(level, run.first + k, run.below + k);
                    double sum = row.diagonal;
                    for (const double n : row.neighbours) {
                        sum += std::abs(n);
                    }
                    varying_scale_[run.first + k] = static_cast<float>(1.0 / std::max(row.diagonal, sum / largest));
                }
            });
        }
        // Chebyshev polynomial of degree 2 on [share, 1]·largest.
        const double share = level.varying.empty() ? kSmoothedShare : kStretchedShare;
        const double centre = 0.5 * largest * (1.0 + share);
        const double half = 0.5 * largest * (1.0 - share);
        const double rho = half / centre;
        const double next_rho = 1.0 / (2.0 * centre / half - rho);
        first_ = static_cast<float>(1.0 / centre);
        momentum_ = static_cast<float>(next_rho * rho);
        second_ = static_cast<float>(2.0 * next_rho / half);
        regular_scale_ = static_cast<float>(1.0 / level.stencil.diagonal);
    }

    /// Calls use(unknown, inverse of its scaled diagonal, product of its row with x).
    template <typename Use>
    void forEachRow(const float* x, const Use& use) const
    {
        if (varying_scale_.empty()) {
            forPieces(regular_pieces_, [&](std::size_t i) {
                applyRegular(level_->regular[i], level_->stencil, x,
                             [&](Index at, float product) { use(at, regular_scale_, product); });
            });
        } else {
            const RowPointers<float> rows{diagonal_.data(), next_.data(), above_left_.data(), above_right_.data()};
            const float* const scale = varying_scale_.data();
            forPieces(regular_pieces_, [&](std::size_t i) {
                applyVarying(level_->regular[i], rows, x,
                             [&](Index at, float product) { use(at, scale[at], product); });
            });
        }
        const SparseRows& rows = level_->irregular;
        forBlocks(rows.unknowns.size(), [&](std::size_t begin, std::size_t end) {
            for (std::size_t k = begin; k < end; ++k) {
                float product = 0.0F;
                for (Index e = rows.starts[k]; e < rows.starts[k + 1]; ++e) {
                    product += values_[e] * x[rows.columns[e]];
                }
                use(rows.unknowns[k], scale_[k], product);
            }
        });
    }

    /// Calls use(unknown, inverse of its scaled diagonal).
    template <typename Use>
    void forEachScale(const Use& use) const
    {
        forPieces(regular_pieces_, [&](std::size_t i) {
            const GridRun& run = level_->regular[i];
            for (Index k = 0; k < run.count; ++k) {
                use(run.first + k, varying_scale_.empty() ? regular_scale_ : varying_scale_[run.first + k]);
            }
        });
        const std::vector<Index>& unknowns = level_->irregular.unknowns;
        for (std::size_t k = 0; k < unknowns.size(); ++k) {
            use(unknowns[k], scale_[k]);
        }
    }

    [[nodiscard]] float first() const { return first_; }
    [[nodiscard]] float momentum() const { return momentum_; }
    [[nodiscard]] float second() const { return second_; }

private:
    const Level* level_;
    std::vector<float> values_;
    std::vector<float> scale_;
    std::vector<std::size_t> regular_pieces_;
    // For rows that differ.
    std::vector<float> diagonal_;
    std::vector<float> next_;
    std::vector<float> above_left_;
    std::vector<float> above_right_;
    std::vector<float> varying_scale_;
    float regular_scale_ = 0.0F;
    float first_ = 0.0F;
    float momentum_ = 0.0F;
    float second_ = 0.0F;
};

/// Factorisation of the coarsest level.
class CoarsestSolver {
public:
    explicit CoarsestSolver(const Level& level) : position_(level.size, 0)
    {
        for (const GridRun& run : level.regular) {
            for (Index k = 0; k < run.count; ++k) {
                unknowns_.push_back(run.first + k);
            }
        }
        unknowns_.insert(unknowns_.end(), level.irregular.unknowns.begin(), level.irregular.unknowns.end());
        std::sort(unknowns_.begin(), unknowns_.end());
        for (Index i = 0; i < unknowns_.size(); ++i) {
            position_[unknowns_[i]] = static_cast<int>(i);
        }
        std::vector<Eigen::Triplet<double>> entries;
        const auto add = [&](Index row, Index column, double value) {
            if (row >= column) {
                entries.emplace_back(position_[row], position_[column], value);
            }
        };
        for (const GridRun& run : level.regular) {
            for (Index k = 0; k < run.count; ++k) {
                const Index at = run.first + k;
                const RegularRow row = regularRow(level, at, run.below + k);
                const std::array<Index, 6> others{at - 1,        at + 1,           run.below + k, run.below + k + 1,
                                                  run.above + k, run.above + k + 1};
                add(at, at, row.diagonal);
                for (std::size_t n = 0; n < others.size(); ++n) {
                    add(at, others[n], row.neighbours[n]);
                }
            }
        }
        const SparseRows& rows = level.irregular;
        for (std::size_t k = 0; k < rows.unknowns.size(); ++k) {
            for (Index e = rows.starts[k]; e < rows.starts[k + 1]; ++e) {
                add(rows.unknowns[k], rows.columns[e], rows.values[e]);
            }
        }
        const auto n = static_cast<Eigen::Index>(unknowns_.size());
        Eigen::SparseMatrix<double> matrix(n, n);
        matrix.setFromTriplets(entries.begin(), entries.end());
        factor_.compute(matrix);
    }

    [[nodiscard]] bool usable() const { return !unknowns_.empty() && factor_.info() == Eigen::Success; }

    void solve(const std::vector<float>& right, std::vector<float>& x) const
    {
        Eigen::VectorXd b(static_cast<Eigen::Index>(unknowns_.size()));
        for (std::size_t i = 0; i < unknowns_.size(); ++i) {
            b[static_cast<Eigen::Index>(i)] = static_cast<double>(right[unknowns_[i]]);
        }
        const Eigen::VectorXd solution = factor_.solve(b);
        for (std::size_t i = 0; i < unknowns_.size(); ++i) {
            x[unknowns_[i]] = static_cast<float>(solution[static_cast<Eigen::Index>(i)]);
        }
    }

private:
    std::vector<Index> unknowns_;
    std::vector<int> position_;
    Eigen::SimplicialLLT<Eigen::SparseMatrix<double>, Eigen::Lower> factor_;
};

/// One V-cycle, started from zero. It is symmetric, as conjugate gradients need it.
class Cycle {
public:
    explicit Cycle(const std::vector<Level>& levels) : levels_(&levels), coarsest_(levels.back())
    {
        for (std::size_t l = 0; l + 1 < levels.size(); ++l) {
            smoothers_.emplace_back(levels[l]);
            restriction_pieces_.push_back(piecesOf(levels[l].restriction));
            prolongation_pieces_.push_back(piecesOf(levels[l].prolongation));
        }
    }

    /// Vectors of a cycle.
    class Workspace {
    public:
        explicit Workspace(const std::vector<Level>& levels)
        {
            for (std::size_t l = 0; l < levels.size(); ++l) {
                Vectors& v = vectors_.emplace_back();
                v.right.assign(levels[l].size, 0.0F);
                v.x.assign(levels[l].size, 0.0F);
                if (l + 1 < levels.size()) {
                    v.next.assign(levels[l].size, 0.0F);
                    v.step.assign(levels[l].size, 0.0F);
                }
            }
        }

        /// Input of run(): the residual.
        std::vector<float>& right() { return vectors_.front().right; }
        /// Output of run().
        [[nodiscard]] const std::vector<float>& result() const
        {
            return vectors_.size() == 1 ? vectors_.front().x : vectors_.front().next;
        }

    private:
        friend class Cycle;
        struct Vectors {
            std::vector<float> right;
            std::vector<float> x;
            std::vector<float> next;
            std::vector<float> step;
        };
        std::vector<Vectors> vectors_;
    };

    [[nodiscard]] bool usable() const { return coarsest_.usable(); }

    void run(Workspace& workspace) const { descend(workspace.vectors_, 0); }

private:
    using Vectors = Workspace::Vectors;

    void descend(std::vector<Vectors>& vectors, std::size_t l) const
    {
        Vectors& v = vectors[l];
        if (l + 1 == levels_->size()) {
            coarsest_.solve(v.right, v.x);
            return;
        }
        const Smoother& smoother = smoothers_[l];
        const float* right = v.right.data();
        float* x = v.x.data();
        float* next = v.next.data();
        float* step = v.step.data();
        const float first = smoother.first();
        smoother.forEachScale([=](Index i, float scale) { x[i] = step[i] = first * scale * right[i]; });
        secondStep(smoother, v);
        smoother.forEachRow(next, [=](Index i, float, float product) { step[i] = right[i] - product; });
        restrictTo(vectors, l);
        descend(vectors, l + 1);
        addFrom(vectors, l);
        smoother.forEachRow(next, [=](Index i, float scale, float product) {
            step[i] = first * scale * (right[i] - product);
            x[i] = next[i] + step[i];
        });
        secondStep(smoother, v);
    }

    /// Second step of the Chebyshev polynomial: computes `next` from x and the first step.
    static void secondStep(const Smoother& smoother, Vectors& v)
    {
        const float* right = v.right.data();
        const float* x = v.x.data();
        const float* step = v.step.data();
        float* next = v.next.data();
        const float momentum = smoother.momentum();
        const float second = smoother.second();
        smoother.forEachRow(x, [=](Index i, float scale, float product) {
            next[i] = x[i] + momentum * step[i] + second * scale * (right[i] - product);
        });
    }

    /// Restricts the residual in `step` to the next level.
    void restrictTo(std::vector<Vectors>& vectors, std::size_t l) const
    {
        const Level& level = (*levels_)[l];
        const float* fine = vectors[l].step.data();
        float* coarse = vectors[l + 1].right.data();
        forPieces(restriction_pieces_[l], [&](std::size_t i) {
            const RestrictionRun& run = level.restriction[i];
            const float* left = fine + run.fine - 1;
            const float* below = fine + run.below;
            const float* above = fine + run.above;
            float* out = coarse + run.first;
            for (Index k = 0; k < run.count; ++k) {
                const Index f = 2 * k;
                out[k] = left[f + 1] +
                         0.5F * ((left[f] + left[f + 2]) + (below[f] + below[f + 1]) + (above[f] + above[f + 1]));
            }
        });
        const SparseRows& rows = level.outside;
        for (std::size_t k = 0; k < rows.unknowns.size(); ++k) {
            float sum = 0.0F;
            for (Index e = rows.starts[k]; e < rows.starts[k + 1]; ++e) {
                sum += static_cast<float>(rows.values[e]) * fine[rows.columns[e]];
            }
            coarse[rows.unknowns[k]] += sum;
        }
    }

    /// Adds the result of the next level to `next`.
    void addFrom(std::vector<Vectors>& vectors, std::size_t l) const
    {
        const Level& level = (*levels_)[l];
        const std::vector<float>& result = l + 2 == levels_->size() ? vectors[l + 1].x : vectors[l + 1].next;
        const float* coarse = result.data();
        float* fine = vectors[l].next.data();
        forPieces(prolongation_pieces_[l], [&](std::size_t i) {
            const ProlongationRun& run = level.prolongation[i];
            const float* early = coarse + run.early;
            const float* late = coarse + run.late;
            float* out = fine + run.first;
            const std::size_t pairs = run.count / 2;
            for (std::size_t k = 0; k < pairs; ++k) {
                out[2 * k] += 0.5F * (early[k] + late[k]);
                out[2 * k + 1] += 0.5F * (early[k + 1] + late[k]);
            }
            if (run.count % 2 == 1) {
                out[2 * pairs] += 0.5F * (early[pairs] + late[pairs]);
            }
        });
        for (std::size_t i = 0; i < level.inside.size(); ++i) {
            const Inside& inside = level.inside[i];
            float sum = 0.0F;
            for (std::size_t k = 0; k < 3; ++k) {
                sum += static_cast<float>(inside.weights[k]) * coarse[inside.corners[k]];
            }
            fine[i] += sum;
        }
    }

    const std::vector<Level>* levels_;
    CoarsestSolver coarsest_;
    std::vector<Smoother> smoothers_;
    std::vector<std::vector<std::size_t>> restriction_pieces_;
    std::vector<std::vector<std::size_t>> prolongation_pieces_;
};

/// Product of the finest level's matrix with a vector.
class Product {
public:
    explicit Product(const Level& level) : level_(&level), pieces_(piecesOf(level.regular)) {}

    void operator()(const std::vector<double>& x, std::vector<double>& result) const
    {
        const auto use = [&](Index at, double product) { result[at] = product; };
        const LatticeRows& varying = level_->varying;
        const RowPointers<double> pointers{varying.diagonal.data(), varying.next.data(), varying.above_left.data(),
                                           varying.above_right.data()};
        forPieces(pieces_, [&](std::size_t i) {
            if (varying.empty()) {
                applyRegular(level_->regular[i], level_->stencil, x.data(), use);
            } else {
                applyVarying(level_->regular[i], pointers, x.data(), use);
            }
        });
        const SparseRows& rows = level_->irregular;
        forBlocks(rows.unknowns.size(), [&](std::size_t begin, std::size_t end) {
            for (std::size_t k = begin; k < end; ++k) {
                double product = 0.0;
                for (Index e = rows.starts[k]; e < rows.starts[k + 1]; ++e) {
                    product += rows.values[e] * x[rows.columns[e]];
                }
                result[rows.unknowns[k]] = product;
            }
        });
    }

private:
    const Level* level_;
    std::vector<std::size_t> pieces_;
};

/// Solution of A·solution = load.
struct Unit {
    std::vector<double> solution;
    double residual = 0.0;
    std::size_t iterations = 0;
};

Unit solveUnit(const Hierarchy& hierarchy, const Cycle& cycle, double tolerance)
{
    Unit unit;
    Cycle::Workspace workspace(hierarchy.levels);
    const Product product(hierarchy.levels.front());
    const std::size_t size = hierarchy.load.size();
    const double target = std::sqrt(dotProduct(hierarchy.load, hierarchy.load));
    std::vector<double>& x = unit.solution;
    x.assign(size, 0.0);
    std::vector<double> r = hierarchy.load;
    std::vector<double> p(size, 0.0);
    std::vector<double> q(size, 0.0);
    double last_rz = 0.0;
    double norm = target;
    while (norm > tolerance * target && unit.iterations < kMaxIterations) {
        std::vector<float>& right = workspace.right();
        forBlocks(size, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                right[i] = static_cast<float>(r[i]);
            }
        });
        cycle.run(workspace);
        const std::vector<float>& z = workspace.result();
        const double rz = sumOverBlocks(size, [&](std::size_t begin, std::size_t end) {
            double sum = 0.0;
            for (std::size_t i = begin; i < end; ++i) {
                sum += r[i] * static_cast<double>(z[i]);
            }
            return sum;
        });
        if (!(rz > 0.0)) {
            break;
        }
        const double beta = unit.iterations == 0 ? 0.0 : rz / last_rz;
        forBlocks(size, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                p[i] = static_cast<double>(z[i]) + beta * p[i];
            }
        });
        product(p, q);
        const double alpha = rz / dotProduct(p, q);
        norm = std::sqrt(sumOverBlocks(size, [&](std::size_t begin, std::size_t end) {
            double sum = 0.0;
            for (std::size_t i = begin; i < end; ++i) {
                x[i] += alpha * p[i];
                r[i] -= alpha * q[i];
                sum += r[i] * r[i];
            }
            return sum;
        }));
        last_rz = rz;
        ++unit.iterations;
    }
    product(x, q);
    unit.residual = std::sqrt(sumOverBlocks(size,
                                            [&](std::size_t begin, std::size_t end) {
                                                double sum = 0.0;
                                                for (std::size_t i = begin; i < end; ++i) {
                                                    const double here = hierarchy.load[i] - q[i];
                                                    sum += here * here;
                                                }
                                                return sum;
                                            })) /
                    target;
    return unit;
}

/// Values at inner vertices, from values at indices.
std::vector<double> gathered(const Hierarchy& hierarchy, const std::vector<double>& x, double factor)
{
    std::vector<double> values(hierarchy.index_of_vertex.size());
    forBlocks(values.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const Index at = hierarchy.index_of_vertex[i];
            values[i] = at == kNoUnknown ? 0.0 : factor * x[at];
        }
    });
    return values;
}

/// Solution of Ax = right + λ·load with loadᵀx = volume.
struct Projected {
    std::vector<double> x;
    double multiplier = 0.0;
    double residual = 0.0;
    std::size_t iterations = 0;
    bool indefinite = false;  ///< A is not positive definite on functions without volume
};

class ProjectedIteration {
public:
    /// @param weight  |w|·edge²
    ProjectedIteration(const Hierarchy& hierarchy, const Cycle& cycle, double weight)
        : cycle_(&cycle),
          load_(&hierarchy.load),
          product_(hierarchy.indefinite ? *hierarchy.indefinite : hierarchy.levels.front()),
          workspace_(hierarchy.levels),
          load_norm_(std::sqrt(dotProduct(hierarchy.load, hierarchy.load))),
          weight_(weight)
    {
        precondition(hierarchy.load);
        unit_.assign(workspace_.result().begin(), workspace_.result().end());
        unit_volume_ = dotProduct(hierarchy.load, unit_);
    }

    Projected solve(std::vector<double> right, double volume, double tolerance)
    {
        const std::vector<double>& load = *load_;
        const std::size_t size = load.size();
        Projected result;
        result.x.assign(size, 0.0);
        std::vector<double>& x = result.x;
        // Scaled to the range of single precision.
        const double right_norm = std::sqrt(dotProduct(right, right));
        const double unit = std::max(right_norm, std::abs(volume / unit_volume_) * load_norm_);
        if (!(unit > 0.0)) {
            return result;
        }
        const double wanted = volume / unit;
        forBlocks(size, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                right[i] /= unit;
                x[i] = wanted / unit_volume_ * unit_[i];
            }
        });
        std::vector<double> r(size);
        std::vector<double> p(size, 0.0);
        std::vector<double> q(size, 0.0);
        double norm = 0.0;
        double scale = 0.0;
        const auto measure = [&] {
            product_(x, q);
            forBlocks(size, [&](std::size_t begin, std::size_t end) {
                for (std::size_t i = begin; i < end; ++i) {
                    r[i] = right[i] - q[i];
                }
            });
            result.multiplier = 0.0;
            norm = takeMultiplier(r, result.multiplier);
            scale = scaleOf(right_norm / unit, result.multiplier, x);
        };
        measure();
        double last_rz = 0.0;
        while (norm > tolerance * scale && result.iterations < kMaxIterations) {
            precondition(r);
            const std::vector<float>& z = workspace_.result();
            const double shift = dotProduct(z, load) / unit_volume_;
            const double rz = dotProduct(z, r) - shift * dotProduct(unit_, r);
            if (!(rz > 0.0)) {
                break;
            }
            const double beta = result.iterations == 0 ? 0.0 : rz / last_rz;
            forBlocks(size, [&](std::size_t begin, std::size_t end) {
                for (std::size_t i = begin; i < end; ++i) {
                    p[i] = (static_cast<double>(z[i]) - shift * unit_[i]) + beta * p[i];
                }
            });
            product_(p, q);
            const double curvature = dotProduct(p, q);
            if (!(curvature > 0.0)) {
                result.indefinite = true;
                break;
            }
            const double alpha = rz / curvature;
            forBlocks(size, [&](std::size_t begin, std::size_t end) {
                for (std::size_t i = begin; i < end; ++i) {
                    x[i] += alpha * p[i];
                    r[i] -= alpha * q[i];
                }
            });
            norm = takeMultiplier(r, result.multiplier);
            scale = scaleOf(right_norm / unit, result.multiplier, x);
            last_rz = rz;
            ++result.iterations;
        }
        // Corrects the round-off of the volume.
        const double missing = (wanted - dotProduct(load, x)) / unit_volume_;
        forBlocks(size, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                x[i] += missing * unit_[i];
            }
        });
        measure();
        result.residual = norm / scale;
        result.multiplier *= unit;
        for (double& value : x) {
            value *= unit;
        }
        return result;
    }

private:
    void precondition(const std::vector<double>& r)
    {
        std::vector<float>& right = workspace_.right();
        forBlocks(r.size(), [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                right[i] = static_cast<float>(r[i]);
            }
        });
        cycle_->run(workspace_);
    }

    /// Adds the multiple of the load to a residual that minimises its norm.
    /// @return the norm
    double takeMultiplier(std::vector<double>& r, double& multiplier) const
    {
        const std::vector<double>& load = *load_;
        const double more = -dotProduct(load, r) / (load_norm_ * load_norm_);
        multiplier += more;
        return std::sqrt(sumOverBlocks(r.size(), [&](std::size_t begin, std::size_t end) {
            double sum = 0.0;
            for (std::size_t i = begin; i < end; ++i) {
                r[i] += more * load[i];
                sum += r[i] * r[i];
            }
            return sum;
        }));
    }

    /// Scale of a relative residual.
    [[nodiscard]] double scaleOf(double right, double multiplier, const std::vector<double>& x) const
    {
        const double others = std::max(right, std::abs(multiplier) * load_norm_);
        if (weight_ == 0.0) {
            return others;
        }
        const double square = sumOverBlocks(x.size(), [&](std::size_t begin, std::size_t end) {
            double sum = 0.0;
            for (std::size_t i = begin; i < end; ++i) {
                const double here = (*load_)[i] * x[i];
                sum += here * here;
            }
            return sum;
        });
        return std::max(others, weight_ * std::sqrt(square));
    }

    const Cycle* cycle_;
    const std::vector<double>* load_;
    Product product_;
    Cycle::Workspace workspace_;
    std::vector<double> unit_;  ///< result of a cycle for the load
    double unit_volume_ = 0.0;
    double load_norm_ = 0.0;
    double weight_ = 0.0;
};

class MultigridSolver final : public ConstrainedSolver {
public:
    explicit MultigridSolver(const PlanarMesh& mesh) : mesh_(&mesh) {}

    void prepare(const Operator& op) override
    {
        cycle_.reset();
        hierarchy_ = buildHierarchy(*mesh_, op);
        cycle_.emplace(hierarchy_.levels);
        weight_ = std::abs(op.mass_weight) * hierarchy_.edge * hierarchy_.edge;
        usable_ = cycle_->usable() && (!hierarchy_.indefinite || isDefinite());
    }

    [[nodiscard]] ConstrainedSolution solve(const ConstrainedProblem& problem) const override
    {
        ConstrainedSolution solution;
        if (!usable_) {
            return solution;
        }
        const double scale = hierarchy_.edge * hierarchy_.edge;
        if (problem.right.empty() && !hierarchy_.indefinite) {
            const Unit unit = solveUnit(hierarchy_, *cycle_, problem.tolerance);
            const double factor = problem.volume / (scale * dotProduct(hierarchy_.load, unit.solution));
            solution.values = gathered(hierarchy_, unit.solution, factor);
            solution.multiplier = factor / scale;
            solution.residual = unit.residual;
            solution.iterations = unit.iterations;
        } else {
            ProjectedIteration iteration(hierarchy_, *cycle_, weight_);
            const Projected projected =
                iteration.solve(scattered(problem.right), problem.volume / scale, problem.tolerance);
            solution.values = gathered(hierarchy_, projected.x, 1.0);
            solution.multiplier = projected.multiplier / scale;
            solution.residual = projected.residual;
            solution.iterations = projected.iterations;
            if (projected.indefinite) {
                return solution;
            }
        }
        // This is the true residual; the iteration only updates its own.
        solution.converged = solution.residual < std::max(kLargestResidual, 2.0 * problem.tolerance);
        return solution;
    }

    [[nodiscard]] const char* method() const override { return "multigrid-pcg"; }

private:
    [[nodiscard]] std::vector<double> scattered(const std::vector<double>& right) const
    {
        std::vector<double> x(hierarchy_.load.size(), 0.0);
        for (std::size_t i = 0; i < right.size(); ++i) {
            if (const Index at = hierarchy_.index_of_vertex[i]; at != kNoUnknown) {
                x[at] = right[i];
            }
        }
        return x;
    }

    /// Whether the iteration finds no direction in which the operator is negative. It starts with a share in every
    /// direction: the solution may be symmetric where the direction in which the liquid falls is not.
    [[nodiscard]] bool isDefinite() const
    {
        std::mt19937 random(1);
        std::vector<double> right(hierarchy_.index_of_vertex.size());
        for (double& r : right) {
            r = static_cast<double>(random()) - 0.5 * static_cast<double>(std::mt19937::max());
        }
        ProjectedIteration iteration(hierarchy_, *cycle_, weight_);
        return !iteration.solve(scattered(right), 0.0, kProbeTolerance).indefinite;
    }

    const PlanarMesh* mesh_;
    Hierarchy hierarchy_;
    std::optional<Cycle> cycle_;
    double weight_ = 0.0;
    bool usable_ = false;
};

}  // namespace

std::unique_ptr<ConstrainedSolver> multigridSolver(const PlanarMesh& mesh)
{
    return std::make_unique<MultigridSolver>(mesh);
}

}  // namespace droplet
