// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "droplet/units.h"

namespace droplet {

/// What is prescribed to say how much liquid there is.
enum class FillBy {
    Volume,        ///< [m³]
    Height,        ///< largest height [m]
    ContactAngle,  ///< mean along the rim [rad]
};

/// Whether droplets are separate or communicate.
enum class FillSharing {
    Each,   ///< every droplet for itself gets the prescribed volume, height or angle: each has its own pressure
    Total,  ///< one reservoir at one pressure; total volume, largest height, mean angle over all rims
};

/// How much liquid.
struct Fill {
    FillBy by = FillBy::ContactAngle;
    double amount = 40.0 * kDegree;  ///< > 0; an angle < 90°
    FillSharing sharing = FillSharing::Each;

    /// @throws Error InvalidArgument
    void validate() const;
};

}  // namespace droplet
