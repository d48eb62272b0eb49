// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/SparseCore>
#include <memory>

namespace droplet {

/// CHOLMOD's supernodal factorisation of symmetric positive definite matrices, in the manner of Eigen's own. Matrices
/// are given by their lower triangle.
class CholmodFactor {
public:
    /// @throws Error  InvalidArgument where the CHOLMOD library is not installed
    CholmodFactor();
    ~CholmodFactor();
    CholmodFactor(const CholmodFactor&) = delete;
    CholmodFactor& operator=(const CholmodFactor&) = delete;

    /// Orders the unknowns of all matrices with this one's pattern.
    void analyzePattern(const Eigen::SparseMatrix<double>& matrix);
    /// @param matrix  of the pattern analysed
    void factorize(const Eigen::SparseMatrix<double>& matrix);
    [[nodiscard]] Eigen::ComputationInfo info() const;
    [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& right) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace droplet
