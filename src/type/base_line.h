// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <numbers>
#include <vector>

#include "droplet/vector.h"

namespace droplet {

/// Smallest turn of a polyline at a corner [rad], as in traced outlines; pieces of curves turn by about 10° at most.
inline constexpr double kCornerTurn = 25.0 * std::numbers::pi / 180.0;

/// Piece of a line, with constant curvature. A corner has no length.
struct LinePiece {
    Vec2 begin;
    Vec2 along;           ///< direction at its begin, unit
    double length = 0.0;  ///< ≥ 0
    double turn = 0.0;    ///< from its begin to its end, counter-clockwise [rad]
};

/// Circle around which text runs clockwise, from its bottom on, outside; inside it runs counter-clockwise from the top
/// on.
/// @param radius  below 0 for inside, not 0
std::vector<LinePiece> circlePieces(double radius);

/// Pieces of a polyline, arcs where it turns by up to 25° at each end.
/// @param points  of a line longer than 0
std::vector<LinePiece> piecesOf(const std::vector<Vec2>& points);

/// Line at a constant distance from another one, beside which it goes round outer corners. On the inside, there is
/// nothing beside pieces whose radius is smaller than the distance.
class BaseLine {
public:
    /// @param height  distance to the left of the line; below 0 to the right
    BaseLine(const std::vector<LinePiece>& pieces, double height);

    /// Point of the line, and its direction there.
    struct Place {
        Vec2 point;
        Vec2 along;  ///< unit
    };

    [[nodiscard]] double length() const { return ends_.empty() ? 0.0 : ends_.back(); }

    /// Place at a distance from the begin along the line.
    /// @param distance  from 0 to length(), which is more than 0
    [[nodiscard]] Place at(double distance) const;

private:
    std::vector<LinePiece> pieces_;  ///< of the other line, without those that have nothing beside them
    std::vector<double> ends_;       ///< distances of their ends along this line
    double height_;
};

}  // namespace droplet
