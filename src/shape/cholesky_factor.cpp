// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/SparseCholesky>

#include "shape/symmetric_factor.h"

namespace droplet {
namespace {

class CholeskyFactor final : public SymmetricFactor {
public:
    explicit CholeskyFactor(const Eigen::SparseMatrix<double>& lower) { factor_.analyzePattern(lower); }

    bool factorize(const Eigen::SparseMatrix<double>& lower) override
    {
        factor_.factorize(lower);
        return factor_.info() == Eigen::Success;
    }

    [[nodiscard]] std::size_t negatives() const override { return 0; }
    [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& right) const override { return factor_.solve(right); }
    [[nodiscard]] const char* method() const override { return "simplicial-llt"; }

private:
    Eigen::SimplicialLLT<Eigen::SparseMatrix<double>, Eigen::Lower> factor_;
};

}  // namespace

std::unique_ptr<SymmetricFactor> choleskyFactor(const Eigen::SparseMatrix<double>& lower)
{
    return std::make_unique<CholeskyFactor>(lower);
}

}  // namespace droplet
