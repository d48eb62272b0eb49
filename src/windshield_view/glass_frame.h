// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "droplet/windshield/glass.h"
#include "render/optics.h"

namespace droplet {

/// Vector on the glass.
struct Vec2f {
    float x = 0.0F;
    float y = 0.0F;
};

/// Unit axes of the glass at a place.
struct GlassFrame {
    Vec3f across;
    Vec3f up;
    Vec3f normal;
};

inline GlassFrame frameOf(const GlassPlace& place)
{
    return {toFloats(place.across), toFloats(place.up), toFloats(place.normal)};
}

inline Vec3f toFrame(const GlassFrame& frame, Vec3f v)
{
    return {dot(v, frame.across), dot(v, frame.up), dot(v, frame.normal)};
}

inline Vec3f fromFrame(const GlassFrame& frame, Vec3f v)
{
    return v.x * frame.across + v.y * frame.up + v.z * frame.normal;
}

}  // namespace droplet
