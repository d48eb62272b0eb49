// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

#include "droplet/vector.h"

namespace droplet {

/// Grid of square cells over a part of the plane. Cells are always at the same places, whatever part it is: a corner of
/// cells is at the origin.
struct GridShape {
    double cell = 0.0;        ///< side of a cell [m]
    std::int64_t left = 0;    ///< number of the first column of cells, from the origin
    std::int64_t bottom = 0;  ///< number of the first row
    std::size_t columns = 0;
    std::size_t rows = 0;

    [[nodiscard]] std::size_t cells() const { return columns * rows; }
    /// Index of a cell.
    [[nodiscard]] std::size_t at(std::size_t column, std::size_t row) const { return row * columns + column; }
    /// Number of the corners of cells in a row.
    [[nodiscard]] std::size_t cornerColumns() const { return columns + 1; }
    /// Number of all corners.
    [[nodiscard]] std::size_t corners() const { return (columns + 1) * (rows + 1); }
    /// Place of a point, in columns and rows from the lower left corner; half ones are between corners [m].
    [[nodiscard]] Vec2 placeOf(double column, double row) const
    {
        return {cell * (static_cast<double>(left) + column), cell * (static_cast<double>(bottom) + row)};
    }
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
          x_(place.x / grid.cell, grid.left, grid.columns),
          y_(place.y / grid.cell, grid.bottom, grid.rows)
    {
    }

    /// Cell around the place.
    [[nodiscard]] std::size_t cell() const { return y_.whole * columns_ + x_.whole; }

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
        Coordinate(double at, std::int64_t first, std::size_t cells)
        {
            const double least = static_cast<double>(first) + 0.5;
            const double most = static_cast<double>(first + static_cast<std::int64_t>(cells)) - 0.5 - 1e-9;
            const double inside = at > least ? (at < most ? at : most) : least;  // of NaN, too
            // Parts do not depend on where the grid begins.
            const auto near_zero = static_cast<std::int64_t>(inside);
            const std::int64_t floor = near_zero - (static_cast<double>(near_zero) > inside ? 1 : 0);
            whole = static_cast<std::size_t>(floor - first);
            part = inside - static_cast<double>(floor);
            const bool is_beyond = part >= 0.5;
            half = whole - (is_beyond ? 0 : 1);
            half_part = part + (is_beyond ? -0.5 : 0.5);
        }
        std::size_t whole = 0;
        double part = 0.0;
        std::size_t half = 0;
        double half_part = 0.0;
    };
    std::size_t columns_;
    Coordinate x_;
    Coordinate y_;
};

}  // namespace droplet
