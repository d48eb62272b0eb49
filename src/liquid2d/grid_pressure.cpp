// SPDX-License-Identifier: GPL-3.0-or-later
// Conjugate gradients, preconditioned by the modified incomplete Cholesky factorisation of level 0 (Gustafsson: A class
// of first order factorization methods. BIT 18, 1978), as in Bridson: Fluid Simulation for Computer Graphics, 2nd ed.,
// 2015, section 5.3.
#include "grid_pressure.h"

#include <algorithm>
#include <cmath>

namespace droplet {
namespace {

constexpr int kMaxIterations = 400;

/// Share of the dropped entries that the diagonal takes, and share of the diagonal below which it takes none (Bridson).
constexpr double kModified = 0.97;
constexpr double kSafe = 0.25;

/// Makes equations of liquid that is enclosed on all sides regular, without effect on others.
constexpr double kEnclosed = 1e-9;

}  // namespace

GridEquations::GridEquations(const GridShape& grid)
    : columns_(grid.columns),
      diagonal_(grid.cells(), 0.0),
      right_(grid.cells(), 0.0),
      up_(grid.cells(), 0.0),
      inverse_(grid.cells(), 0.0),
      residual_(grid.cells(), 0.0),
      search_(grid.cells(), 0.0),
      product_(grid.cells(), 0.0)
{
}

void GridEquations::clear()
{
    for (const std::size_t k : cells_) {
        for (std::vector<double>* values : {&diagonal_, &right_, &up_, &inverse_, &residual_, &search_, &product_}) {
            (*values)[k] = 0.0;
        }
    }
    cells_.clear();
}

void GridEquations::factorise()
{
    for (const std::size_t k : cells_) {
        const double left = right_[k - 1] * inverse_[k - 1];
        const double down = up_[k - columns_] * inverse_[k - columns_];
        const double diagonal = diagonal_[k] *= 1.0 + kEnclosed;
        const double rest =
            diagonal - left * left - down * down -
            kModified * (left * up_[k - 1] * inverse_[k - 1] + down * right_[k - columns_] * inverse_[k - columns_]);
        const double pivot = rest < kSafe * diagonal ? diagonal : rest;
        inverse_[k] = pivot > 0.0 ? 1.0 / std::sqrt(pivot) : 0.0;
    }
}

/// Puts the preconditioned residual into product_.
void GridEquations::precondition()
{
    const std::vector<double>& r = residual_;
    std::vector<double>& z = product_;
    for (const std::size_t k : cells_) {
        z[k] = inverse_[k] * (r[k] - right_[k - 1] * inverse_[k - 1] * z[k - 1] -
                              up_[k - columns_] * inverse_[k - columns_] * z[k - columns_]);
    }
    for (std::size_t n = cells_.size(); n-- > 0;) {
        const std::size_t k = cells_[n];
        z[k] = inverse_[k] * (z[k] - inverse_[k] * (right_[k] * z[k + 1] + up_[k] * z[k + columns_]));
    }
}

GridEquations::Solved GridEquations::solve(const std::vector<double>& rhs, std::vector<double>& x, double tolerance)
{
    Solved solved;
    std::vector<double>& r = residual_;
    std::vector<double>& z = product_;
    std::vector<double>& s = search_;
    const auto times = [&](const std::vector<double>& a, std::size_t k) {
        return diagonal_[k] * a[k] + right_[k] * a[k + 1] + right_[k - 1] * a[k - 1] + up_[k] * a[k + columns_] +
               up_[k - columns_] * a[k - columns_];
    };
    for (const std::size_t k : cells_) {
        r[k] = inverse_[k] > 0.0 ? rhs[k] - times(x, k) : 0.0;
        solved.residual = std::max(solved.residual, std::abs(r[k]));
    }
    if (solved.residual <= tolerance) {
        return solved;
    }
    precondition();
    double rho = 0.0;
    for (const std::size_t k : cells_) {
        s[k] = z[k];
        rho += r[k] * z[k];
    }
    while (solved.iterations < kMaxIterations && rho > 0.0) {
        ++solved.iterations;
        double curvature = 0.0;
        for (const std::size_t k : cells_) {
            z[k] = times(s, k);
            curvature += s[k] * z[k];
        }
        if (!(curvature > 0.0)) {
            break;
        }
        const double alpha = rho / curvature;
        solved.residual = 0.0;
        for (const std::size_t k : cells_) {
            x[k] += alpha * s[k];
            r[k] -= alpha * z[k];
            solved.residual = std::max(solved.residual, std::abs(r[k]));
        }
        if (solved.residual <= tolerance) {
            break;
        }
        precondition();
        double next = 0.0;
        for (const std::size_t k : cells_) {
            next += r[k] * z[k];
        }
        const double beta = next / rho;
        for (const std::size_t k : cells_) {
            s[k] = z[k] + beta * s[k];
        }
        rho = next;
    }
    return solved;
}

}  // namespace droplet
