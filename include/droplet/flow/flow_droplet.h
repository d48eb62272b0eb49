// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

#include "droplet/flow/leg.h"
#include "droplet/vector.h"

namespace droplet {

/// What a droplet is in contact with.
enum class FlowContact : std::uint8_t {
    Face,   ///< it runs over a triangle
    Edge,   ///< it runs along a concave edge, pressed against both triangles
    Still,  ///< it rests on a triangle, an edge or a corner
    Air,    ///< it falls
};

/// A droplet on its way over a surface. Its path is known in advance up to the next event.
struct FlowDroplet {
    std::uint64_t id = 0;                    ///< unique; selects the droplet's random stream
    double volume = 0.0;                     ///< [m³], > 0
    double drying = 0.0;                     ///< volume that evaporates in a second [m³/s], ≥ 0
    double born = 0.0;                       ///< when it came to be [s]
    bool has_grown = false;                  ///< since neighbours were searched for
    FlowContact contact = FlowContact::Air;  ///< what it touches
    std::uint32_t face = 0;                  ///< number in FlowSurface::faces; in the air, the last one
    std::uint32_t side = 0;                  ///< of the face, for contact Edge
    Leg leg;                                 ///< the path since the last event
    Vec3 heading;       ///< unit; friction of contact angle hysteresis acts against it; 0 if there is none
    double held = 0.0;  ///< volume that a hollow around `held_at` is known to hold [m³]
    Vec3 held_at;       ///< place [m]
};

}  // namespace droplet
