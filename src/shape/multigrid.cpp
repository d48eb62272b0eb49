// SPDX-License-Identifier: GPL-3.0-or-later
//
// Conjugate gradients preconditioned with a multigrid cycle: O. Tatebe, "The multigrid preconditioned conjugate
// gradient method" (1993). Smoother: Chebyshev polynomials of the Jacobi-scaled matrix, M. Adams, M. Brezina, J. Hu, R.
// Tuminaro, "Parallel multigrid smoothing: polynomial versus Gauss-Seidel" (2003): it needs no order of the unknowns,
// so threads do not change its result. The cycle is computed in single precision, which bounds how fast it converges,
// not how far.

#include "shape/multigrid.h"

#include <tbb/parallel_for.h>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "blocks.h"

namespace droplet {
namespace {

using Index = std::uint32_t;

/// Residual at which iteration ends, and the most iterations: lattices need 8 to 12, other meshes some dozens.
constexpr double kTolerance = 1e-10;
constexpr std::size_t kMostIterations = 200;

/// The smoother damps the upper part of the spectrum, down to this share of its end; the coarser level sees the rest.
constexpr double kSmoothedShare = 0.25;

double dotOf(const std::vector<double>& a, const std::vector<double>& b)
{
    return sumOverBlocks(a.size(), [&](std::size_t begin, std::size_t end) {
        // Four sums, so that they need not wait for one another.
        double s0 = 0.0;
        double s1 = 0.0;
        double s2 = 0.0;
        double s3 = 0.0;
        std::size_t i = begin;
        for (; i + 4 <= end; i += 4) {
            s0 += a[i] * b[i];
            s1 += a[i + 1] * b[i + 1];
            s2 += a[i + 2] * b[i + 2];
            s3 += a[i + 3] * b[i + 3];
        }
        for (; i < end; ++i) {
            s0 += a[i] * b[i];
        }
        return (s0 + s1) + (s2 + s3);
    });
}

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

/// What a row of the matrix is applied for: called with the row's unknown and the product.
template <typename Real, typename Use>
void applyRegular(const RegularRun& run, const Stencil& stencil, const Real* x, const Use& use)
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

/// One level's matrix in a precision, and what the smoother needs.
class Smoother {
public:
    explicit Smoother(const Level& level)
        : level_(&level),
          values_(level.irregular.values.begin(), level.irregular.values.end()),
          regular_pieces_(piecesOf(level.regular))
    {
        // The symbol's extremes: the six neighbours' cosines sum to between −3 and 6.
        const double ratio = level.stencil.neighbour / level.stencil.diagonal;
        const double largest = std::max(1.0 - 3.0 * ratio, 1.0 + 6.0 * ratio);
        // By Gershgorin's discs no irregular row goes beyond that if its diagonal is raised to its share.
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
        // Chebyshev polynomial of degree 2 on [kSmoothedShare, 1]·largest.
        const double centre = 0.5 * largest * (1.0 + kSmoothedShare);
        const double half = 0.5 * largest * (1.0 - kSmoothedShare);
        const double rho = half / centre;
        const double next_rho = 1.0 / (2.0 * centre / half - rho);
        first_ = static_cast<float>(1.0 / centre);
        momentum_ = static_cast<float>(next_rho * rho);
        second_ = static_cast<float>(2.0 * next_rho / half);
        regular_scale_ = static_cast<float>(1.0 / level.stencil.diagonal);
    }

    /// Calls with every unknown, the inverse of its scaled diagonal, and its row's product with x.
    template <typename Use>
    void forEachRow(const float* x, const Use& use) const
    {
        forPieces(regular_pieces_, [&](std::size_t i) {
            applyRegular(level_->regular[i], level_->stencil, x,
                         [&](Index at, float product) { use(at, regular_scale_, product); });
        });
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

    /// Calls with every unknown and the inverse of its scaled diagonal.
    template <typename Use>
    void forEachScale(const Use& use) const
    {
        forPieces(regular_pieces_, [&](std::size_t i) {
            const RegularRun& run = level_->regular[i];
            for (Index k = 0; k < run.count; ++k) {
                use(run.first + k, regular_scale_);
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
    float regular_scale_ = 0.0F;
    float first_ = 0.0F;
    float momentum_ = 0.0F;
    float second_ = 0.0F;
};

/// The coarsest level, factored.
class CoarsestSolver {
public:
    explicit CoarsestSolver(const Level& level) : position_(level.size, 0)
    {
        for (const RegularRun& run : level.regular) {
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
        for (const RegularRun& run : level.regular) {
            for (Index k = 0; k < run.count; ++k) {
                const Index at = run.first + k;
                add(at, at, level.stencil.diagonal);
                for (const Index other :
                     {at - 1, at + 1, run.below + k, run.below + k + 1, run.above + k, run.above + k + 1}) {
                    add(at, other, level.stencil.neighbour);
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

    [[nodiscard]] bool usable() const { return factor_.info() == Eigen::Success; }

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

/// One V-cycle, from zero: symmetric, as conjugate gradients need it.
class Cycle {
public:
    explicit Cycle(const std::vector<Level>& levels) : levels_(&levels), coarsest_(levels.back())
    {
        for (std::size_t l = 0; l < levels.size(); ++l) {
            Vectors& v = vectors_.emplace_back();
            v.right.assign(levels[l].size, 0.0F);
            v.x.assign(levels[l].size, 0.0F);
            if (l + 1 < levels.size()) {
                smoothers_.emplace_back(levels[l]);
                v.next.assign(levels[l].size, 0.0F);
                v.step.assign(levels[l].size, 0.0F);
                restriction_pieces_.push_back(piecesOf(levels[l].restriction));
                prolongation_pieces_.push_back(piecesOf(levels[l].prolongation));
            }
        }
    }

    [[nodiscard]] bool usable() const { return coarsest_.usable(); }

    /// The residual to work on.
    std::vector<float>& right() { return vectors_.front().right; }
    /// What run() found.
    [[nodiscard]] const std::vector<float>& result() const
    {
        return smoothers_.empty() ? vectors_.front().x : vectors_.front().next;
    }

    void run() { descend(0); }

private:
    struct Vectors {
        std::vector<float> right;
        std::vector<float> x;
        std::vector<float> next;
        std::vector<float> step;
    };

    void descend(std::size_t l)
    {
        Vectors& v = vectors_[l];
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
        restrictTo(l);
        descend(l + 1);
        addFrom(l);
        smoother.forEachRow(next, [=](Index i, float scale, float product) {
            step[i] = first * scale * (right[i] - product);
            x[i] = next[i] + step[i];
        });
        secondStep(smoother, v);
    }

    /// From x and the step that led there to `next`.
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

    /// The residual in `step`, to the next level.
    void restrictTo(std::size_t l)
    {
        const Level& level = (*levels_)[l];
        const float* fine = vectors_[l].step.data();
        float* coarse = vectors_[l + 1].right.data();
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

    /// The next level's result, to `next`.
    void addFrom(std::size_t l)
    {
        const Level& level = (*levels_)[l];
        const std::vector<float>& result = l + 2 == levels_->size() ? vectors_[l + 1].x : vectors_[l + 1].next;
        const float* coarse = result.data();
        float* fine = vectors_[l].next.data();
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
    std::vector<Vectors> vectors_;
    std::vector<std::vector<std::size_t>> restriction_pieces_;
    std::vector<std::vector<std::size_t>> prolongation_pieces_;
};

/// The finest level's matrix times a vector.
class Product {
public:
    explicit Product(const Level& level) : level_(&level), pieces_(piecesOf(level.regular)) {}

    void operator()(const std::vector<double>& x, std::vector<double>& result) const
    {
        forPieces(pieces_, [&](std::size_t i) {
            applyRegular(level_->regular[i], level_->stencil, x.data(),
                         [&](Index at, double product) { result[at] = product; });
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

}  // namespace

LinearSolution solveByMultigrid(const Hierarchy& hierarchy)
{
    LinearSolution solution;
    Cycle cycle(hierarchy.levels);
    if (!cycle.usable()) {
        return solution;
    }
    const Product product(hierarchy.levels.front());
    const std::size_t size = hierarchy.load.size();
    const double target = std::sqrt(dotOf(hierarchy.load, hierarchy.load));
    std::vector<double> x(size, 0.0);
    std::vector<double> r = hierarchy.load;
    std::vector<double> p(size, 0.0);
    std::vector<double> q(size, 0.0);
    double last_rz = 0.0;
    double norm = target;
    while (norm > kTolerance * target && solution.iterations < kMostIterations) {
        std::vector<float>& right = cycle.right();
        forBlocks(size, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                right[i] = static_cast<float>(r[i]);
            }
        });
        cycle.run();
        const std::vector<float>& z = cycle.result();
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
        const double beta = solution.iterations == 0 ? 0.0 : rz / last_rz;
        forBlocks(size, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                p[i] = static_cast<double>(z[i]) + beta * p[i];
            }
        });
        product(p, q);
        const double alpha = rz / dotOf(p, q);
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
        ++solution.iterations;
    }
    product(x, q);
    solution.residual = std::sqrt(sumOverBlocks(size,
                                                [&](std::size_t begin, std::size_t end) {
                                                    double sum = 0.0;
                                                    for (std::size_t i = begin; i < end; ++i) {
                                                        const double here = hierarchy.load[i] - q[i];
                                                        sum += here * here;
                                                    }
                                                    return sum;
                                                })) /
                        target;
    solution.converged = solution.residual < kLargestResidual;
    const double scale = hierarchy.edge * hierarchy.edge;
    solution.integral = scale * scale * dotOf(hierarchy.load, x);
    solution.values.resize(hierarchy.index_of_vertex.size());
    forBlocks(solution.values.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            solution.values[i] = scale * x[hierarchy.index_of_vertex[i]];
        }
    });
    return solution;
}

}  // namespace droplet
