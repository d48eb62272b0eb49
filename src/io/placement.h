// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

#include "droplet/vector.h"

namespace droplet {

/// Affine map: images of the unit vectors and of the origin.
struct Placement {
    Vec3 x{1.0, 0.0, 0.0};
    Vec3 y{0.0, 1.0, 0.0};
    Vec3 z{0.0, 0.0, 1.0};
    Vec3 origin;

    [[nodiscard]] Vec3 direction(Vec3 a) const { return a.x * x + a.y * y + a.z * z; }
    [[nodiscard]] Vec3 place(Vec3 a) const { return origin + direction(a); }
    [[nodiscard]] Placement of(const Placement& inner) const
    {
        return {direction(inner.x), direction(inner.y), direction(inner.z), place(inner.origin)};
    }
    /// Whether it is a similarity.
    [[nodiscard]] bool keepsAngles() const
    {
        const double size = dot(x, x);
        constexpr double kNear = 1e-5;  // files hold floats
        const auto is_near = [&](double a, double b) { return std::abs(a - b) <= kNear * size; };
        return size > 0.0 && is_near(dot(y, y), size) && is_near(dot(z, z), size) && is_near(dot(x, y), 0.0) &&
               is_near(dot(y, z), 0.0) && is_near(dot(z, x), 0.0);
    }
    [[nodiscard]] bool mirrors() const { return dot(cross(x, y), z) < 0.0; }
    /// Normals transform by the cofactor matrix.
    [[nodiscard]] Vec3 normal(Vec3 a) const
    {
        return (mirrors() ? -1.0 : 1.0) * (a.x * cross(y, z) + a.y * cross(z, x) + a.z * cross(x, y));
    }
};

}  // namespace droplet
