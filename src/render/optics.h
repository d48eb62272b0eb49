// SPDX-License-Identifier: GPL-3.0-or-later
// M. Born, E. Wolf, "Principles of Optics" (1999), section 1.5: the laws of Snell and Fresnel.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "droplet/surface/material.h"
#include "droplet/vector.h"

namespace droplet {

/// Vector of floats, as in Embree; also red, green and blue.
struct Vec3f {
    float x = 0.0F;
    float y = 0.0F;
    float z = 0.0F;
};

constexpr Vec3f operator+(Vec3f a, Vec3f b)
{
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
constexpr Vec3f operator-(Vec3f a, Vec3f b)
{
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
constexpr Vec3f operator*(float s, Vec3f a)
{
    return {s * a.x, s * a.y, s * a.z};
}
constexpr Vec3f operator*(Vec3f a, Vec3f b)
{
    return {a.x * b.x, a.y * b.y, a.z * b.z};
}
constexpr float dot(Vec3f a, Vec3f b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
constexpr Vec3f cross(Vec3f a, Vec3f b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Vec3f unit(Vec3f a)
{
    return (1.0F / std::sqrt(std::max(dot(a, a), 1e-30F))) * a;
}
constexpr Vec3f grey(float level)
{
    return {level, level, level};
}
constexpr Vec3f mix(Vec3f a, Vec3f b, float share)
{
    return (1.0F - share) * a + share * b;
}
constexpr float largest(Vec3f a)
{
    return std::max({a.x, a.y, a.z});
}
inline Vec3f toFloats(Vec3 a)
{
    return {static_cast<float>(a.x), static_cast<float>(a.y), static_cast<float>(a.z)};
}

constexpr float smoothstep(float low, float high, float x)
{
    const float s = std::clamp((x - low) / (high - low), 0.0F, 1.0F);
    return s * s * (3.0F - 2.0F * s);
}

inline Vec3f mirrored(Vec3f direction, Vec3f normal)
{
    return direction - 2.0F * dot(direction, normal) * normal;
}

/// Smooth normal that faces a ray. At a silhouette it may point slightly away; then it is bent to graze the ray.
inline Vec3f facing(Vec3f direction, Vec3f normal)
{
    const float away = dot(direction, normal) + 1e-3F;
    return away > 0.0F ? unit(normal - away * direction) : normal;
}

/// Split of a ray at a surface between two media.
struct Interface {
    float reflected = 1.0F;  ///< share of unpolarised light
    Vec3f transmitted;       ///< direction; valid if reflected < 1
};

/// @param direction  unit, toward the surface
/// @param normal     unit, against the direction
/// @param ratio      refractive index on the near side over that on the far side
inline Interface atInterface(Vec3f direction, Vec3f normal, float ratio)
{
    const float cosine = std::clamp(-dot(direction, normal), 0.0F, 1.0F);
    const float sine2 = ratio * ratio * (1.0F - cosine * cosine);
    if (sine2 >= 1.0F) {
        return {};
    }
    const float far_cosine = std::sqrt(1.0F - sine2);
    const float across = (ratio * cosine - far_cosine) / (ratio * cosine + far_cosine);
    const float along = (cosine - ratio * far_cosine) / (cosine + ratio * far_cosine);
    return {0.5F * (across * across + along * along), unit(ratio * direction + (ratio * cosine - far_cosine) * normal)};
}

/// Share of unpolarised light that a thin film between two media reflects: red, green, blue. Reflections between its
/// two sides add up (G. B. Airy, 1833; Born and Wolf, section 1.6.2). Each channel is the mean of a band of 60 nm about
/// the primaries of sRGB.
/// @param cosine     of the angle to the normal on the near side, above 0
/// @param near, far  refractive indices; `near` below that of the film
inline Vec3f reflectedByFilm(float cosine, float near, float far, const ThinFilm& film)
{
    constexpr std::array<float, 3> kBands{611e-9F, 549e-9F, 464e-9F};
    constexpr std::array<float, 4> kWithin{-22.5e-9F, -7.5e-9F, 7.5e-9F, 22.5e-9F};
    const auto ior = static_cast<float>(film.ior);
    const float sine2 = near * near * (1.0F - cosine * cosine);
    const float below2 = 1.0F - sine2 / (far * far);
    if (below2 <= 0.0F) {
        return grey(1.0F);
    }
    const float inside = std::sqrt(std::max(1.0F - sine2 / (ior * ior), 1e-6F));
    const float below = std::sqrt(below2);
    const auto amplitude = [](float a, float b) { return (a - b) / (a + b); };
    const std::array<std::array<float, 2>, 2> parts{
        {{amplitude(near * cosine, ior * inside), amplitude(ior * inside, far * below)},
         {amplitude(ior * cosine, near * inside), amplitude(far * inside, ior * below)}}};
    const float path = 4.0F * std::numbers::pi_v<float> * ior * static_cast<float>(film.thickness) * inside;
    std::array<float, 3> shares{};
    for (std::size_t c = 0; c < kBands.size(); ++c) {
        for (const float off : kWithin) {
            const float turn = std::cos(path / (kBands[c] + off));
            for (const auto& [first, second] : parts) {
                const float both = 2.0F * first * second * turn;
                const float squares = first * first * second * second;
                shares[c] += (first * first + second * second + both) / (1.0F + squares + both) / 8.0F;
            }
        }
    }
    return {shares[0], shares[1], shares[2]};
}

/// Share of diffuse light that a surface of refractive index n ≥ 1 reflects, from the optically thinner side (S. Q.
/// Duntley, "The optical properties of diffusing materials", 1942).
inline double diffuseReflectance(double n)
{
    if (n < 1.0 + 1e-4) {
        return 0.0;
    }
    const double n2 = n * n;
    const double n4 = n2 * n2;
    return 0.5 + (n - 1.0) * (3.0 * n + 1.0) / (6.0 * (n + 1.0) * (n + 1.0)) +
           n2 * (n2 - 1.0) * (n2 - 1.0) / std::pow(n2 + 1.0, 3.0) * std::log((n - 1.0) / (n + 1.0)) -
           2.0 * n * n2 * (n2 + 2.0 * n - 1.0) / ((n2 + 1.0) * (n4 - 1.0)) +
           8.0 * n4 * (n4 + 1.0) / ((n2 + 1.0) * (n4 - 1.0) * (n4 - 1.0)) * std::log(n);
}

}  // namespace droplet
