// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "droplet/flow/flow_parameters.h"
#include "droplet/vector.h"

namespace droplet {

/// Resistance of uneven hysteresis against a droplet, over that of even hysteresis.
struct PinningHold {
    double along = 1.0;  ///< against its way
    double aside = 0.0;  ///< to the left of its way: it gives way to where it is held less
};

/// A front of a droplet's contact line.
struct ContactFront {
    Vec3 middle;          ///< of the contact circle [m]
    double radius = 0.0;  ///< of the contact circle [m]
    Vec3 ahead;           ///< unit
    Vec3 left;            ///< unit, perpendicular to it, along the ground
};

/// Where hysteresis holds droplets more, and where less.
class PinningField {
public:
    PinningField(const FlowPinning& pinning, std::uint64_t seed) : pinning_(pinning), seed_(seed) {}

    [[nodiscard]] bool isEven() const { return pinning_.spread == 0.0; }

    /// Factor on hysteresis at a place, > 0; its mean over space is 1.
    [[nodiscard]] double at(Vec3 place) const;

    /// Smallest factor anywhere.
    [[nodiscard]] double least() const;

    /// Largest factor anywhere.
    [[nodiscard]] double most() const;

    /// Integral over the front half of the contact line.
    [[nodiscard]] PinningHold over(const ContactFront& front) const;

private:
    [[nodiscard]] double factor(double random) const;

    FlowPinning pinning_;
    std::uint64_t seed_;
};

}  // namespace droplet
