// SPDX-License-Identifier: GPL-3.0-or-later
// E. Heitz, "Sampling the GGX Distribution of Visible Normals", Journal of Computer Graphics Techniques 7 (2018) 1. A
// ray that meets rough matter goes on as a fan of rays, each from a facet. M. Roberts' sequence R2 ("The unreasonable
// effectiveness of quasirandom sequences", 2018) spreads those of all samples of a pixel; a shift from pixel to pixel
// (R. Cranley, T. N. L. Patterson, 1976) turns what it leaves out into fine grain. The shift is a hash, so nothing is
// random.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "hashed_number.h"
#include "render/optics.h"

namespace droplet {

/// Whether facets of matter tilt less than a pixel shows: their reflection is that of the smooth surface.
inline bool isSmooth(double roughness)
{
    return roughness < 0.05;
}

/// Hash of two numbers.
constexpr std::uint32_t hashOf(std::uint32_t a, std::uint32_t b)
{
    return hashed(a * 0x9e3779b9U + b);
}
inline std::uint32_t hashOf(float a, float b)
{
    return hashOf(std::bit_cast<std::uint32_t>(a), std::bit_cast<std::uint32_t>(b));
}

/// Which of the facets that a ray sees: a point of the unit square.
struct FacetChoice {
    float u = 0.0F;
    float v = 0.0F;
};

/// Choice number `index` of those that fill the square evenly, all moved by a shift.
/// @param shift  hash
inline FacetChoice facetChoice(std::uint32_t index, std::uint32_t shift)
{
    constexpr float kUnit = 1.0F / static_cast<float>(1 << 24);
    // 2³² over the root of g³ = g + 1, and over its square. Sums wrap around.
    const std::uint32_t u = shift + index * 3242174889U;
    const std::uint32_t v = hashOf(shift, 1U) + index * 2447445414U;
    return {kUnit * static_cast<float>(u >> 8), kUnit * static_cast<float>(v >> 8)};
}

/// Normal of a facet that a ray sees.
/// @param direction  of the ray, unit, against the normal
/// @param normal     of the surface, unit
/// @param roughness  as glTF defines it: the width of the distribution is its square
inline Vec3f facetNormal(Vec3f direction, Vec3f normal, double roughness, FacetChoice choice)
{
    const auto width = static_cast<float>(roughness * roughness);
    const Vec3f side = std::abs(normal.z) < 0.9F ? Vec3f{0.0F, 0.0F, 1.0F} : Vec3f{1.0F, 0.0F, 0.0F};
    const Vec3f x = unit(cross(side, normal));
    const Vec3f y = cross(normal, x);
    // Against the ray, in the frame of the surface, stretched as if the roughness were 1.
    const Vec3f seen = unit({-width * dot(direction, x), -width * dot(direction, y), -dot(direction, normal)});
    const Vec3f across = seen.z < 0.9999F ? unit({-seen.y, seen.x, 0.0F}) : Vec3f{1.0F, 0.0F, 0.0F};
    const Vec3f up = cross(seen, across);
    const float radius = std::sqrt(choice.u);
    const float angle = 2.0F * std::numbers::pi_v<float> * choice.v;
    const float a = radius * std::cos(angle);
    const float share = 0.5F * (1.0F + seen.z);
    const float b = (1.0F - share) * std::sqrt(std::max(1.0F - a * a, 0.0F)) + share * radius * std::sin(angle);
    const float c = std::sqrt(std::max(1.0F - a * a - b * b, 0.0F));
    const Vec3f half = a * across + b * up + c * seen;
    const Vec3f facet = unit({width * half.x, width * half.y, std::max(half.z, 1e-6F)});
    return unit(facet.x * x + facet.y * y + facet.z * normal);
}

}  // namespace droplet
