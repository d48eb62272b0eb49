// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

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
    using Pair = Eigen::Array2d;
    using Row = Eigen::Map<const Pair>;

    std::size_t first = 0;    ///< index of the lower left point
    std::size_t columns = 0;  ///< points in a row
    double u = 0.0;           ///< part of a step right of it
    double v = 0.0;           ///< part of a step above it

    /// Value at the place.
    [[nodiscard, gnu::always_inline]] double in(const std::vector<double>& values) const
    {
        const Row low(values.data() + first);
        const Row high(values.data() + first + columns);
        const Pair beside = low + v * (high - low);
        return beside[0] + u * (beside[1] - beside[0]);
    }

    struct Ascent {
        double value = 0.0;
        Vec2 slope{};  ///< its derivatives, per step of the lattice
    };
    [[nodiscard]] Ascent ascentIn(const std::vector<double>& values) const
    {
        const Row low(values.data() + first);
        const Row high(values.data() + first + columns);
        const Pair up = high - low;
        const Pair beside = low + v * up;
        const double right = beside[1] - beside[0];
        return {beside[0] + u * right, {right, up[0] + u * (up[1] - up[0])}};
    }
    [[nodiscard]] Vec2 slopeIn(const std::vector<double>& values) const { return ascentIn(values).slope; }
};

/// A place among the points of a grid.
class GridPlace {
public:
    /// @param least  lower left point, in cells from the origin, from its cell's lower left corner on
    /// @param place  in cells from the origin
    GridPlace(double columns, const Eigen::Array2d& least, const Eigen::Array2d& place)
        : columns_(columns),
          // Adding and taking away a large number rounds. At a corner, either cell around it may be taken.
          part_(place - ((place - 0.5) + kRound - kRound)),
          whole_(place - part_ - least),
          near_(place + kRound - kRound),
          half_part_(place - near_ + 0.5),
          half_(near_ - 1.0 - least)
    {
    }

    /// Cell around the place.
    [[nodiscard]] std::size_t cell() const { return index(whole_[0], whole_[1], columns_); }

    /// Among the corners of cells.
    [[nodiscard]] Bilinear amongCorners() const { return among(whole_, whole_, part_, part_, columns_ + 1.0); }
    /// Among the middles of cells.
    [[nodiscard]] Bilinear amongMiddles() const { return among(half_, half_, half_part_, half_part_, columns_); }
    /// Among the middles of sides on the left and right of cells.
    [[nodiscard]] Bilinear amongLeftSides() const { return among(whole_, half_, part_, half_part_, columns_ + 1.0); }
    /// Among the middles of sides below and above cells.
    [[nodiscard]] Bilinear amongLowerSides() const { return among(half_, whole_, half_part_, part_, columns_); }

private:
    /// Numbers of 53 bits have no bit left after the point beside it.
    static constexpr double kRound = 0x1.8p52;

    static std::size_t index(double column, double row, double columns)
    {
        return static_cast<std::size_t>(static_cast<std::int64_t>(row * columns + column));
    }
    static Bilinear among(const Eigen::Array2d& across, const Eigen::Array2d& up, const Eigen::Array2d& across_part,
                          const Eigen::Array2d& up_part, double columns)
    {
        return {index(across[0], up[1], columns), static_cast<std::size_t>(static_cast<std::int64_t>(columns)),
                across_part[0], up_part[1]};
    }

    double columns_;
    Eigen::Array2d part_;
    Eigen::Array2d whole_;
    Eigen::Array2d near_;
    Eigen::Array2d half_part_;
    Eigen::Array2d half_;
};

/// Finds places among the points of a grid. Places beyond the middles of the outer cells are those of the nearest point
/// there. Parts of steps do not depend on where the grid begins.
class GridPlaces {
public:
    GridPlaces() = default;
    explicit GridPlaces(const GridShape& grid)
        : columns_(static_cast<double>(grid.columns)),
          inverse_(1.0 / grid.cell),
          origin_(static_cast<double>(grid.left), static_cast<double>(grid.bottom)),
          least_(origin_ + 0.5 + 1e-9),
          most_(origin_ + Eigen::Array2d(columns_, static_cast<double>(grid.rows)) - 0.5 - 1e-9)
    {
    }

    [[nodiscard, gnu::always_inline]] GridPlace at(Vec2 place) const
    {
        // NaN is the least, too.
        const auto inside = [](double x, double least, double most) { return std::min(std::max(least, x), most); };
        return {columns_, origin_,
                Eigen::Array2d(inside(inverse_ * place.x, least_[0], most_[0]),
                               inside(inverse_ * place.y, least_[1], most_[1]))};
    }

private:
    double columns_ = 0.0;
    double inverse_ = 0.0;
    Eigen::Array2d origin_{0.0, 0.0};
    Eigen::Array2d least_{0.0, 0.0};
    Eigen::Array2d most_{0.0, 0.0};
};

}  // namespace droplet
