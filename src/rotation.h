// SPDX-License-Identifier: GPL-3.0-or-later
// K. Shoemake, "Animating rotation with quaternion curves", SIGGRAPH 1985.
#pragma once

#include <cmath>

#include "droplet/vector.h"

namespace droplet {

/// Rotation as a unit quaternion.
struct Rotation {
    Vec3 axis;          ///< vector part
    double real = 1.0;  ///< real part

    /// The rotated vector.
    [[nodiscard]] Vec3 of(Vec3 a) const
    {
        const Vec3 twice = 2.0 * cross(axis, a);
        return a + real * twice + cross(axis, twice);
    }
    [[nodiscard]] Rotation inverse() const { return {-1.0 * axis, real}; }

    friend bool operator==(const Rotation&, const Rotation&) = default;
};

/// The rotation b, then the rotation a.
inline Rotation operator*(const Rotation& a, const Rotation& b)
{
    return {a.real * b.axis + b.real * a.axis + cross(a.axis, b.axis), a.real * b.real - dot(a.axis, b.axis)};
}

/// Rotation by a vector's length about its direction [rad].
inline Rotation rotationBy(Vec3 vector)
{
    const double angle = length(vector);
    constexpr double kSmall = 1e-4;  // the next term of the series is below rounding
    const double share = angle < kSmall ? 0.5 - angle * angle / 48.0 : std::sin(0.5 * angle) / angle;
    return {share * vector, std::cos(0.5 * angle)};
}

/// The vector, no longer than π, for which rotationBy() gives this rotation.
inline Vec3 vectorOf(const Rotation& turn)
{
    const double size = length(turn.axis);
    if (size == 0.0) {
        return {};
    }
    const double sign = turn.real < 0.0 ? -1.0 : 1.0;
    return (sign * 2.0 * std::atan2(size, std::abs(turn.real)) / size) * turn.axis;
}

}  // namespace droplet
