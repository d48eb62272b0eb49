// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/SparseCore>
#include <cstddef>
#include <memory>
#include <vector>

#include "droplet/vector.h"

namespace droplet {

/// Direct solver of symmetric systems with one pattern.
///
/// Guarantees: the same input gives the same bits at any number of threads.
class SymmetricFactor {
public:
    virtual ~SymmetricFactor() = default;

    /// Factorises a matrix.
    /// @param lower  lower triangle with its diagonal, with the pattern that was ordered
    /// @return       false if it has no such factors
    virtual bool factorize(const Eigen::SparseMatrix<double>& lower) = 0;
    /// Number of negative eigenvalues of the last matrix.
    [[nodiscard]] virtual std::size_t negatives() const = 0;
    /// Solves with the last matrix.
    [[nodiscard]] virtual Eigen::VectorXd solve(const Eigen::VectorXd& right) const = 0;
    /// Its name in reports.
    [[nodiscard]] virtual const char* method() const = 0;
};

/// Eigen's simplicial LLᵀ, of positive definite matrices alone.
/// @param lower  lower triangle with its diagonal; the values do not count
std::unique_ptr<SymmetricFactor> choleskyFactor(const Eigen::SparseMatrix<double>& lower);

/// LDLᵀ of matrices with the pattern of a surface mesh, over dense blocks, without pivoting: D is diagonal, and its
/// signs are those of the eigenvalues.
/// @param lower   as above
/// @param places  of the unknowns in space; near ones are coupled
std::unique_ptr<SymmetricFactor> multifrontalFactor(const Eigen::SparseMatrix<double>& lower,
                                                    const std::vector<Vec3>& places);

}  // namespace droplet
