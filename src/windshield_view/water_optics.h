// SPDX-License-Identifier: GPL-3.0-or-later
// Refraction by water on the glass. Rays are traced backward, from the eye outward, in a frame of the glass: x across,
// y up along the glass, z out of it into the wind.
#pragma once

#include <algorithm>
#include <cmath>

#include "render/optics.h"

namespace droplet {

/// Direction in water of a ray from the cabin. The pane has parallel faces and does not turn the ray, so Snell's law
/// from air to water holds.
/// @param direction  unit, z > 0
inline Vec3f intoWater(Vec3f direction, float ior)
{
    const float x = direction.x / ior;
    const float y = direction.y / ior;
    return {x, y, std::sqrt(std::max(1.0F - x * x - y * y, 0.0F))};
}

/// Refraction of a ray from water into air: as atInterface(), but faster.
/// @param normal  unit, out of the water
/// @return        `transmitted` is a unit vector up to rounding
inline Interface intoAir(Vec3f direction, Vec3f normal, float ior)
{
    const float cosine = std::clamp(dot(direction, normal), 0.0F, 1.0F);
    const float far2 = 1.0F - ior * ior * (1.0F - cosine * cosine);
    if (far2 <= 0.0F) {
        return {};
    }
    const float far = std::sqrt(far2);
    // Fresnel: ((n c − f)/(n c + f))² and ((c − n f)/(c + n f))², over one denominator.
    const float a = ior * cosine - far;
    const float b = ior * cosine + far;
    const float c = cosine - ior * far;
    const float d = cosine + ior * far;
    const float ad = a * d;
    const float bc = b * c;
    const float bd = b * d;
    return {0.5F * (ad * ad + bc * bc) / (bd * bd), ior * direction + (far - ior * cosine) * normal};
}

/// Capsule with its axis along x.
struct Capsule {
    float half_length = 0.0F;
    float radius = 0.0F;
    float centre_height = 0.0F;
};

/// Outward normal where a ray leaves a capsule that it begins in.
/// @param from       point on the glass, relative to the capsule's middle
/// @param direction  unit
inline Vec3f normalAtExit(const Capsule& capsule, Vec3f from, Vec3f direction)
{
    const float z = from.z - capsule.centre_height;
    const float r2 = capsule.radius * capsule.radius;
    // The cylinder around the axis, y² + z² = r².
    const float a = direction.y * direction.y + direction.z * direction.z;
    const float b = from.y * direction.y + z * direction.z;
    const float c = from.y * from.y + z * z - r2;
    const float t = (std::sqrt(std::max(b * b - a * c, 0.0F)) - b) / std::max(a, 1e-12F);
    const float x = from.x + t * direction.x;
    if (std::abs(x) <= capsule.half_length) {
        return unit({0.0F, from.y + t * direction.y, z + t * direction.z});
    }
    // The sphere around the end of the axis.
    const Vec3f own{from.x - std::copysign(capsule.half_length, x), from.y, z};
    const float along = dot(own, direction);
    const float way = std::sqrt(std::max(along * along - dot(own, own) + r2, 0.0F)) - along;
    return unit(own + way * direction);
}

}  // namespace droplet
