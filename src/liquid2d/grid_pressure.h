// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "grid_shape.h"

namespace droplet {

/// Symmetric five-point equations for the liquid cells of a grid, and their solution by conjugate gradients.
class GridEquations {
public:
    /// Memory of solve() for cells of a grid. What is solved at the same time needs memory of its own.
    class Memory {
    public:
        Memory() = default;
        explicit Memory(const GridShape& grid);

    private:
        friend class GridEquations;
        // Of the scaled and preconditioned equations:
        std::vector<double> solution_;
        std::vector<double> residual_;
        std::vector<double> search_;
        std::vector<double> product_;  ///< of the equations and the search direction
        std::vector<double> lower_;    ///< its part by the lower factor
    };

    GridEquations() = default;
    explicit GridEquations(const GridShape& grid);

    /// Takes all cells and equations out again.
    void clear();
    /// Makes a cell one of the unknowns; cells are added in rising order.
    void add(std::size_t cell) { cells_.push_back(static_cast<std::uint32_t>(cell)); }
    /// Adds w (x_cell − x_right) to a cell's equation, and its negative to that of the cell on its right.
    void joinRight(std::size_t cell, double w)
    {
        right_[cell] -= w;
        diagonal_[cell] += w;
        diagonal_[cell + 1] += w;
    }
    /// Likewise with the cell above.
    void joinAbove(std::size_t cell, double w)
    {
        up_[cell] -= w;
        diagonal_[cell] += w;
        diagonal_[cell + columns_] += w;
    }
    /// Adds w x_cell to a cell's equation.
    void hold(std::size_t cell, double w) { diagonal_[cell] += w; }

    /// Factorises the equations after all have been joined; none may be joined after that.
    void factorise();

    struct Solved {
        int iterations = 0;
        double residual = 0.0;  ///< greatest of all equations
    };
    struct Problem {
        const std::vector<double>& rhs;  ///< for every cell of the grid
        double tolerance = 0.0;          ///< greatest residual
    };
    /// Solves the equations.
    /// @param x  first guess, and solution; 0 where there is no equation
    Solved solve(const Problem& problem, std::vector<double>& x, Memory& memory) const;

private:
    std::size_t columns_ = 0;
    std::vector<std::uint32_t> cells_;
    std::vector<double> diagonal_;
    std::vector<double> right_;    ///< coefficient of the cell on the right
    std::vector<double> up_;       ///< of the cell above
    std::vector<double> scale_;    ///< of unknowns and equations
    std::vector<double> inverse_;  ///< of the scale; 0 where that is 0
};

}  // namespace droplet
