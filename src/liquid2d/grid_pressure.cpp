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
      scale_(grid.cells(), 0.0),
      inverse_(grid.cells(), 0.0)
{
}

GridEquations::Memory::Memory(const GridShape& grid)
    : solution_(grid.cells(), 0.0),
      residual_(grid.cells(), 0.0),
      search_(grid.cells(), 0.0),
      product_(grid.cells(), 0.0),
      lower_(grid.cells(), 0.0)
{
}

void GridEquations::clear()
{
    for (const std::size_t k : cells_) {
        for (std::vector<double>* values : {&diagonal_, &right_, &up_, &scale_, &inverse_}) {
            (*values)[k] = 0.0;
        }
    }
    cells_.clear();
}

void GridEquations::factorise()
{
    // With unknowns and equations scaled so that the factor has ones on its diagonal, its other entries are those of
    // the equations: A = L + D + L', and the preconditioner is (1 + L)(1 + L').
    for (const std::size_t k : cells_) {
        const double left = right_[k - 1] * scale_[k - 1];
        const double down = up_[k - columns_] * scale_[k - columns_];
        const double diagonal = diagonal_[k] *= 1.0 + kEnclosed;
        const double rest =
            diagonal - left * left - down * down -
            kModified * (left * up_[k - 1] * scale_[k - 1] + down * right_[k - columns_] * scale_[k - columns_]);
        const double pivot = rest < kSafe * diagonal ? diagonal : rest;
        inverse_[k] = std::sqrt(std::max(pivot, 0.0));
        scale_[k] = pivot > 0.0 ? 1.0 / inverse_[k] : 0.0;
    }
    for (const std::size_t k : cells_) {
        diagonal_[k] *= scale_[k] * scale_[k];
        right_[k] *= scale_[k] * scale_[k + 1];
        up_[k] *= scale_[k] * scale_[k + columns_];
    }
}

GridEquations::Solved GridEquations::solve(const Problem& problem, std::vector<double>& x, Memory& memory) const
{
    Solved solved;
    // Unknowns are y = (1 + L') x, equations those of (1 + L)⁻¹ A (1 + L')⁻¹ y.
    std::vector<double>& y = memory.solution_;
    std::vector<double>& r = memory.residual_;
    std::vector<double>& s = memory.search_;
    std::vector<double>& t = memory.product_;
    std::vector<double>& lower = memory.lower_;
    for (const std::size_t k : cells_) {
        y[k] = x[k] * inverse_[k];
        t[k] = 0.0;
    }
    // Residuals of the equations as they were joined.
    const auto residual_at = [&](std::size_t k) {
        return std::abs(r[k] + right_[k - 1] * r[k - 1] + up_[k - columns_] * r[k - columns_]) * inverse_[k];
    };
    for (const std::size_t k : cells_) {
        const double own = problem.rhs[k] * scale_[k] - diagonal_[k] * y[k] - right_[k] * y[k + 1] -
                           right_[k - 1] * y[k - 1] - up_[k] * y[k + columns_] - up_[k - columns_] * y[k - columns_];
        solved.residual = std::max(solved.residual, std::abs(own) * inverse_[k]);
        r[k] = own - up_[k - columns_] * r[k - columns_] - right_[k - 1] * r[k - 1];
    }
    if (solved.residual <= problem.tolerance) {
        return solved;
    }
    double rho = 0.0;
    for (const std::size_t k : cells_) {
        y[k] += right_[k] * y[k + 1] + up_[k] * y[k + columns_];
        s[k] = 0.0;
        rho += r[k] * r[k];
    }
    double beta = 0.0;
    while (solved.iterations < kMaxIterations && rho > 0.0) {
        ++solved.iterations;
        // The product by one solution with each factor (Eisenstat: Efficient implementation of a class of
        // preconditioned conjugate gradient methods. SIAM J. Sci. Stat. Comput. 2, 1981):
        // (1 + L)⁻¹ A t = t + (1 + L)⁻¹ (s + (D - 2) t) with t = (1 + L')⁻¹ s.
        double beside = 0.0;  // value of the last cell: where that is not the next one, its coefficient is 0
        for (std::size_t n = cells_.size(); n-- > 0;) {
            const std::size_t k = cells_[n];
            s[k] = r[k] + beta * s[k];
            beside = s[k] - up_[k] * t[k + columns_] - right_[k] * beside;
            t[k] = beside;
        }
        double curvature = 0.0;
        beside = 0.0;
        for (const std::size_t k : cells_) {
            beside =
                s[k] + (diagonal_[k] - 2.0) * t[k] - up_[k - columns_] * lower[k - columns_] - right_[k - 1] * beside;
            lower[k] = beside;
            t[k] += beside;
            curvature += s[k] * t[k];
        }
        if (!(curvature > 0.0)) {
            break;
        }
        const double alpha = rho / curvature;
        double next = 0.0;
        solved.residual = 0.0;
        for (const std::size_t k : cells_) {
            y[k] += alpha * s[k];
            r[k] -= alpha * t[k];
            next += r[k] * r[k];
            solved.residual = std::max(solved.residual, residual_at(k));  // of cells before and this one alone
        }
        if (solved.residual <= problem.tolerance) {
            break;
        }
        beta = next / rho;
        rho = next;
    }
    for (std::size_t n = cells_.size(); n-- > 0;) {
        const std::size_t k = cells_[n];
        y[k] -= up_[k] * y[k + columns_] + right_[k] * y[k + 1];
        x[k] = scale_[k] * y[k];
    }
    return solved;
}

}  // namespace droplet
