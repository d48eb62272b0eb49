// SPDX-License-Identifier: GPL-3.0-or-later
#include "liquid2d/grid_pressure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace {

using droplet::GridEquations;
using droplet::GridShape;

/// Equations of −∇²p on the inner cells of a square, 0 beyond them.
struct Square {
    explicit Square(std::size_t inner)
        : grid{1.0 / static_cast<double>(inner + 1), 0, 0, inner + 2, inner + 2}, all(grid)
    {
        for (std::size_t row = 1; row <= inner; ++row) {
            for (std::size_t column = 1; column <= inner; ++column) {
                const std::size_t k = grid.at(column, row);
                all.add(k);
                cells.push_back(k);
                column < inner ? all.joinRight(k, 1.0) : all.hold(k, 1.0);
                row < inner ? all.joinAbove(k, 1.0) : all.hold(k, 1.0);
                all.hold(k, (column == 1 ? 1.0 : 0.0) + (row == 1 ? 1.0 : 0.0));
            }
        }
        all.factorise();
    }

    GridShape grid;
    GridEquations all;
    std::vector<std::size_t> cells;
};

/// sin πx sin πy is the solution for 2π² times itself; the five-point equations have it with second order.
TEST(GridEquations, SolvePoissonsEquationWithSecondOrder)
{
    std::vector<double> errors;
    for (const std::size_t inner : {15U, 31U, 63U}) {
        Square square(inner);
        const double h = square.grid.cell;
        std::vector<double> rhs(square.grid.cells());
        std::vector<double> exact(square.grid.cells());
        for (const std::size_t k : square.cells) {
            const double x = h * static_cast<double>(k % square.grid.columns);
            const double y = h * static_cast<double>(k / square.grid.columns);
            exact[k] = std::sin(std::numbers::pi * x) * std::sin(std::numbers::pi * y);
            rhs[k] = 2.0 * std::numbers::pi * std::numbers::pi * h * h * exact[k];
        }
        std::vector<double> solution(square.grid.cells());
        GridEquations::Memory memory(square.grid);
        const auto solved = square.all.solve({rhs, 1e-12}, solution, memory);
        EXPECT_LE(solved.residual, 1e-12);
        // The factor makes the iterations grow as the root of the cells across, and not as their number.
        EXPECT_LT(solved.iterations, 60);
        double error = 0.0;
        for (const std::size_t k : square.cells) {
            error = std::max(error, std::abs(solution[k] - exact[k]));
        }
        errors.push_back(error);
    }
    EXPECT_NEAR(std::log2(errors[0] / errors[1]), 2.0, 0.1);
    EXPECT_NEAR(std::log2(errors[1] / errors[2]), 2.0, 0.1);
}

/// Liquid that walls enclose has no pressure to begin with: any constant may be added.
TEST(GridEquations, SolveEnclosedLiquid)
{
    const GridShape grid{1.0, 0, 0, 4, 3};
    GridEquations equations(grid);
    const std::size_t left = grid.at(1, 1);
    equations.add(left);
    equations.add(left + 1);
    equations.joinRight(left, 0.5);
    equations.factorise();
    std::vector<double> rhs(grid.cells());
    rhs[left] = 1.0;
    rhs[left + 1] = -1.0;
    std::vector<double> solution(grid.cells());
    GridEquations::Memory memory(grid);
    equations.solve({rhs, 1e-9}, solution, memory);
    EXPECT_NEAR(solution[left] - solution[left + 1], 2.0, 1e-6);
}

}  // namespace
