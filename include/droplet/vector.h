// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

namespace droplet {

/// Point or vector in the footprint's plane; metres unless stated otherwise, y up.
struct Vec2 {
    double x = 0.0;  ///< to the right
    double y = 0.0;  ///< up in the picture

    /// Compares the numbers.
    friend constexpr bool operator==(const Vec2&, const Vec2&) = default;
};

/// Sum of two vectors.
constexpr Vec2 operator+(Vec2 a, Vec2 b)
{
    return {a.x + b.x, a.y + b.y};
}
/// Difference of two vectors.
constexpr Vec2 operator-(Vec2 a, Vec2 b)
{
    return {a.x - b.x, a.y - b.y};
}
/// Vector times a number.
constexpr Vec2 operator*(double s, Vec2 a)
{
    return {s * a.x, s * a.y};
}
/// Dot product.
constexpr double dot(Vec2 a, Vec2 b)
{
    return a.x * b.x + a.y * b.y;
}
/// z component of the cross product: twice the signed area of the triangle (0, a, b).
constexpr double cross(Vec2 a, Vec2 b)
{
    return a.x * b.y - a.y * b.x;
}
/// Length of a vector.
inline double length(Vec2 a)
{
    return std::hypot(a.x, a.y);
}

/// Point or vector in space; metres unless stated otherwise, z up out of the footprint's plane.
struct Vec3 {
    double x = 0.0;  ///< to the right in the picture
    double y = 0.0;  ///< up in the picture
    double z = 0.0;  ///< out of the plane

    /// Compares the numbers.
    friend constexpr bool operator==(const Vec3&, const Vec3&) = default;
};

/// Sum of two vectors.
constexpr Vec3 operator+(Vec3 a, Vec3 b)
{
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
/// Difference of two vectors.
constexpr Vec3 operator-(Vec3 a, Vec3 b)
{
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
/// Vector times a number.
constexpr Vec3 operator*(double s, Vec3 a)
{
    return {s * a.x, s * a.y, s * a.z};
}
/// Dot product.
constexpr double dot(Vec3 a, Vec3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
/// Cross product.
constexpr Vec3 cross(Vec3 a, Vec3 b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
/// Length of a vector.
inline double length(Vec3 a)
{
    return std::sqrt(dot(a, a));
}

}  // namespace droplet
