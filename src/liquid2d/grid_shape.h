// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "droplet/vector.h"

namespace droplet {

/// Grid of square cells over a part of the plane.
struct GridShape {
    Vec2 lower{};       ///< lower left corner [m]
    double cell = 0.0;  ///< side of a cell [m]
    std::size_t columns = 0;
    std::size_t rows = 0;

    [[nodiscard]] std::size_t cells() const { return columns * rows; }
    /// Index of a cell.
    [[nodiscard]] std::size_t at(std::size_t column, std::size_t row) const { return row * columns + column; }
    /// Number of the corners of cells in a row.
    [[nodiscard]] std::size_t cornerColumns() const { return columns + 1; }
    /// Number of all corners.
    [[nodiscard]] std::size_t corners() const { return (columns + 1) * (rows + 1); }
    /// Index of a cell's lower left corner.
    [[nodiscard]] std::size_t cornerAt(std::size_t column, std::size_t row) const
    {
        return row * (columns + 1) + column;
    }
};

/// Four points of a square lattice around a place, and its parts of a step: values between them are bilinear.
struct Bilinear {
    std::size_t first = 0;    ///< index of the lower left point
    std::size_t columns = 0;  ///< points in a row
    double u = 0.0;           ///< part of a step right of it
    double v = 0.0;           ///< part of a step above it

    /// Value at the place.
    template <typename Values>
    [[nodiscard]] double in(const Values& values) const
    {
        const double low = values[first] + u * (values[first + 1] - values[first]);
        const double high = values[first + columns] + u * (values[first + columns + 1] - values[first + columns]);
        return low + v * (high - low);
    }

    /// Its derivatives, per step of the lattice.
    template <typename Values>
    [[nodiscard]] Vec2 slopeIn(const Values& values) const
    {
        const double right = values[first + 1] - values[first];
        const double right_above = values[first + columns + 1] - values[first + columns];
        const double up = values[first + columns] - values[first];
        const double up_right = values[first + columns + 1] - values[first + 1];
        return {right + v * (right_above - right), up + u * (up_right - up)};
    }
};

/// A place among the points of a grid. Places beyond the middles of the outer cells are those of the nearest point
/// there.
class GridPlace {
public:
    GridPlace(const GridShape& grid, Vec2 place)
        : columns_(grid.columns),
          x_((place.x - grid.lower.x) / grid.cell, grid.columns),
          y_((place.y - grid.lower.y) / grid.cell, grid.rows)
    {
    }

    /// Among the corners of cells.
    [[nodiscard]] Bilinear amongCorners() const
    {
        return {y_.whole * (columns_ + 1) + x_.whole, columns_ + 1, x_.part, y_.part};
    }
    /// Among the middles of cells.
    [[nodiscard]] Bilinear amongMiddles() const
    {
        return {y_.half * columns_ + x_.half, columns_, x_.half_part, y_.half_part};
    }
    /// Among the middles of sides on the left and right of cells.
    [[nodiscard]] Bilinear amongLeftSides() const
    {
        return {y_.half * (columns_ + 1) + x_.whole, columns_ + 1, x_.part, y_.half_part};
    }
    /// Among the middles of sides below and above cells.
    [[nodiscard]] Bilinear amongLowerSides() const
    {
        return {y_.whole * columns_ + x_.half, columns_, x_.half_part, y_.part};
    }

private:
    /// A coordinate in cells, among their rims and among their middles.
    struct Coordinate {
        Coordinate(double at, std::size_t cells)
        {
            const auto most = static_cast<double>(cells) - 0.5 - 1e-9;
            const double inside = at > 0.5 ? (at < most ? at : most) : 0.5;  // of NaN, too
            whole = static_cast<std::size_t>(inside);
            part = inside - static_cast<double>(whole);
            half = static_cast<std::size_t>(inside - 0.5);
            half_part = inside - 0.5 - static_cast<double>(half);
        }
        std::size_t whole;
        double part;
        std::size_t half;
        double half_part;
    };
    std::size_t columns_;
    Coordinate x_;
    Coordinate y_;
};

}  // namespace droplet
