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
};

/// Motion of a rigid object: a turn at constant speed, or keys.
struct ObjectMotion {
    /// Pose at a time.
    struct Key {
        double time = 0.0;  ///< [s]
        ObjectPose pose;
    };

    Vec3 spin;              ///< angular velocity about the origin, in the world [rad/s]
    std::vector<Key> keys;  ///< ascending times; if not empty, they replace `spin`; before and after them it rests

    /// Whether the object stays where it is.
    [[nodiscard]] bool rests() const;
    /// Pose at a time.
    [[nodiscard]] ObjectPose at(double time) const;
    /// Acceleration that a body at rest in the object's frame feels besides gravity, in that frame: centrifugal, of
    /// Euler and of the origin [m/s²].
    /// @param place     in the object's frame [m]
    /// @param velocity  in the object's frame [m/s]; adds Coriolis' acceleration
    [[nodiscard]] Vec3 apparentAcceleration(double time, Vec3 place, Vec3 velocity) const;
    /// Checks all fields.
    /// @throws Error InvalidArgument
    void validate() const;
};

}  // namespace droplet
