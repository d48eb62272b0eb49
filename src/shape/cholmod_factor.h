// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/SparseCore>
#include <memory>

namespace droplet {

/// CHOLMOD's supernodal factorisation of a symmetric positive definite matrix, in the manner of Eigen's own.
class CholmodFactor {
public:
    /// @param matrix  lower triangle
    /// @throws Error  InvalidArgument where the CHOLMOD library is not installed
    explicit CholmodFactor(const Eigen::SparseMatrix<double>& matrix);
    ~CholmodFactor();
    CholmodFactor(const CholmodFactor&) = delete;
    CholmodFactor& operator=(const CholmodFactor&) = delete;

    [[nodiscard]] Eigen::ComputationInfo info() const;
    [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& right) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace droplet
