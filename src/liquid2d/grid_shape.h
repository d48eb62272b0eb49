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

/// Values at the points of a square lattice, between which they are bilinear.
struct LatticeShape {
    Vec2 lower{};  ///< place of the first point [m]
    double step = 0.0;
    std::size_t columns = 0;
    std::size_t rows = 0;

    [[nodiscard]] std::size_t count() const { return columns * rows; }
};

/// Points and weights of a place in a lattice; places beyond its rim have those of the nearest one inside.
struct Bilinear {
    std::size_t first = 0;  ///< index of the lower left point
    double u = 0.0;         ///< part of a step right of it
    double v = 0.0;         ///< part of a step above it

    static Bilinear of(const LatticeShape& lattice, Vec2 place)
    {
        const auto within = [](double x, std::size_t count) {
            const auto most = static_cast<double>(count - 1) - 1e-9;
            return x > 0.0 ? (x < most ? x : most) : 0.0;  // of NaN, too
        };
        const double x = within((place.x - lattice.lower.x) / lattice.step, lattice.columns);
        const double y = within((place.y - lattice.lower.y) / lattice.step, lattice.rows);
        const auto i = static_cast<std::size_t>(x);
        const auto j = static_cast<std::size_t>(y);
        return {j * lattice.columns + i, x - static_cast<double>(i), y - static_cast<double>(j)};
    }

    /// Value between the four points.
    template <typename Values>
    [[nodiscard]] double in(const Values& values, std::size_t columns) const
    {
        const double low = values[first] + u * (values[first + 1] - values[first]);
        const double high = values[first + columns] + u * (values[first + columns + 1] - values[first + columns]);
        return low + v * (high - low);
    }

    /// Its derivatives, per step of the lattice.
    template <typename Values>
    [[nodiscard]] Vec2 slopeIn(const Values& values, std::size_t columns) const
    {
        const double right = values[first + 1] - values[first];
        const double right_above = values[first + columns + 1] - values[first + columns];
        const double up = values[first + columns] - values[first];
        const double up_right = values[first + columns + 1] - values[first + 1];
        return {right + v * (right_above - right), up + u * (up_right - up)};
    }
};

}  // namespace droplet
