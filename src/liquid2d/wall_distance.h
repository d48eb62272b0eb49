// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "grid_shape.h"
#include "wall_samples.h"

namespace droplet {

/// Distances from walls at the corners of a grid's cells.
struct WallField {
    std::vector<double> distance;     ///< negative in walls, from −reach to reach [m]
    std::vector<std::uint32_t> wall;  ///< the nearest one within the reach
    std::vector<WallPose> poses;      ///< of all walls
};

/// Distances from a scene's walls.
class WallDistance {
public:
    /// Cells within which distances are exact; farther away they are that.
    static constexpr double kReach = 3.0;

    /// @param scene  must outlive this
    /// @param cell   of the grids; walls thinner than a cell are taken as one cell thick, so that liquid on one side
    ///               does not feel the other [m]
    WallDistance(const FluidScene& scene, double cell);

    /// Distances at a time.
    [[nodiscard]] WallField at(double time, const GridShape& grid) const;
    /// Poses of all walls at a time.
    [[nodiscard]] std::vector<WallPose> posesAt(double time) const;
    /// Whether any wall moves.
    [[nodiscard]] bool areMoving() const { return !moving_.empty(); }
    /// Longest step from a time in which no wall goes so far that liquid comes nearer to its other side [s].
    [[nodiscard]] double longestStep(double time) const;
    /// Velocity of a wall's matter at a place [m/s].
    [[nodiscard]] Vec2 velocity(const WallField& field, std::uint32_t wall, Vec2 place) const;

private:
    const FluidScene& scene_;
    struct Moving {
        const WallMotion* motion = nullptr;
        double reach = 0.0;  ///< of its corners from the pivot [m]
        double way = 0.0;    ///< that it may go in a step [m]
    };
    std::vector<std::vector<std::uint8_t>> thin_;  ///< of each wall: whether each side has a thin wall behind it
    std::vector<Moving> moving_;
};

}  // namespace droplet
