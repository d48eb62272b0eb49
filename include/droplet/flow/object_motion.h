// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "droplet/vector.h"

namespace droplet {

/// Place and direction of an object in the world: a point p of the object is at place + R p.
struct ObjectPose {
    Vec3 place;         ///< of the object's origin [m]
    Vec3 axis;          ///< R as a unit quaternion: its vector part
    double real = 1.0;  ///< and its real part

    /// Direction of the object's frame in the world.
    [[nodiscard]] Vec3 toWorld(Vec3 direction) const;
    /// Direction of the world in the object's frame.
    [[nodiscard]] Vec3 toObject(Vec3 direction) const;

    /// Compares the numbers.
    friend bool operator==(const ObjectPose&, const ObjectPose&) = default;
};

/// Motion of a rigid object: a turn at constant speed, or keys.
///
/// Between two keys the object turns at a constant angular velocity, by the smaller angle, and its pivot moves along a
/// line at a constant velocity. At a key both velocities may change at once. The motion has no acceleration there that
/// a droplet could feel: a droplet keeps its velocity in the object's frame. Two keys at the same time are a jump.
struct ObjectMotion {
    /// Pose at a time.
    struct Key {
        double time = 0.0;  ///< [s]
        ObjectPose pose;    ///< at that time
    };

    Vec3 spin;              ///< angular velocity in the world [rad/s]
    std::vector<Key> keys;  ///< ascending times; if not empty, they replace `spin`; before and after them it rests
    Vec3 pivot;             ///< point of the object's frame about which it turns [m]

    /// Whether the object's frame is the world's at all times.
    [[nodiscard]] bool rests() const;
    /// Pose at a time; at a jump, after it.
    [[nodiscard]] ObjectPose at(double time) const;
    /// Acceleration that a body at rest in the object's frame feels besides gravity, in that frame: the centrifugal
    /// one. Those of Euler and of the pivot are 0, since both velocities are constant [m/s²].
    /// @param time      [s]
    /// @param place     in the object's frame [m]
    /// @param velocity  in the object's frame [m/s]; adds Coriolis' acceleration
    [[nodiscard]] Vec3 apparentAcceleration(double time, Vec3 place, Vec3 velocity) const;
    /// Checks all fields.
    /// @throws Error InvalidArgument
    void validate() const;
};

}  // namespace droplet
