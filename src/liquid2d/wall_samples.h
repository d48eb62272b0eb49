// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "droplet/liquid2d/fluid_scene.h"
#include "kernel.h"

namespace droplet {

/// Points along the walls of a scene that stand for the solid in sums over neighbours (Akinci et al. 2012).
struct WallSamples {
    std::vector<Vec2> position;  ///< below the wall's surface, by `depth` [m]
    std::vector<Vec2> normal;    ///< unit vector out of the solid
    std::vector<Vec2> velocity;  ///< [m/s]
    std::vector<double> area;    ///< each stands for [m²]
    double depth = 0.0;          ///< at which a lattice of particles half a row above the wall is at rest [m]
};

/// Samples of all walls at a time, as far as liquid can come near them.
class WallSampler {
public:
    /// @throws Error InvalidArgument: the walls are too long for the spacing
    WallSampler(const FluidScene& scene, const Kernel& kernel);

    /// Samples at a time; they are the same at any time if no wall moves.
    [[nodiscard]] WallSamples at(double time) const;
    /// Whether any wall moves.
    [[nodiscard]] bool moves() const { return moves_; }
    /// Greatest speed that a wall ever has [m/s].
    [[nodiscard]] double maxSpeed() const { return max_speed_; }

private:
    std::vector<Wall> walls_;        ///< without their regions
    std::vector<std::size_t> wall_;  ///< of each sample
    WallSamples rest_;
    bool moves_ = false;
    double max_speed_ = 0.0;
};

/// Displacement and rotation of a wall.
struct WallPose {
    Vec2 shift{};                 ///< [m]
    double angle = 0.0;           ///< about the pivot [rad]
    Vec2 shift_velocity{};        ///< [m/s]
    double angle_velocity = 0.0;  ///< [rad/s]
};

/// Pose of a motion at a time.
WallPose poseAt(const WallMotion& motion, double time);

}  // namespace droplet
