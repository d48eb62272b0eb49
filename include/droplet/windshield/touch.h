// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "droplet/vector.h"
#include "droplet/windshield/windshield.h"

namespace droplet {

/// Water from a sprayer.
struct Spray {
    Vec2 middle;          ///< on the unrolled glass [m]
    double radius = 0.1;  ///< deviation of the droplets' places from the middle is half of it [m], > 0
    double volume = 0.0;  ///< of all droplets [m³], from 0 to 1 L

    /// Checks all fields.
    /// @throws Error InvalidArgument if a field is out of its range
    void validate() const;
};

/// Sprays droplets with diameters from 0.3 to 2 mm, as many of each size as water allows: all sizes carry the same
/// volume. They meet the glass in the next step; those beside it are lost over its edges.
/// @param state       made with the same parameters
/// @param parameters  valid
/// @param spray       valid
/// @throws Error      InvalidArgument if an argument is out of its range
WindshieldState sprayed(WindshieldState state, const WindshieldParameters& parameters, const Spray& spray);

/// Straight movement of a finger over the glass.
struct FingerStroke {
    Vec2 from;             ///< where it was, on the unrolled glass [m]
    Vec2 to;               ///< where it is [m]
    double width = 14e-3;  ///< of the finger [m], from 1 mm to 0.2 m

    /// Checks all fields.
    /// @throws Error InvalidArgument if a field is out of its range
    void validate() const;
};

/// Moves a finger: it takes all mist, films and droplets on its way. A third of their water stays as a bead ahead of
/// it, which the next stroke takes along; the rest is left as beads along both edges. They meet the glass in the next
/// step.
///
/// Guarantees: water is conserved (balanceOf).
/// @param state       made with the same parameters
/// @param parameters  valid
/// @param stroke      valid
/// @throws Error      InvalidArgument if an argument is out of its range
WindshieldState stroked(WindshieldState state, const WindshieldParameters& parameters, const FingerStroke& stroke);

}  // namespace droplet
