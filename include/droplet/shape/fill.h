// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "droplet/units.h"

namespace droplet {

/// Quantity that sets the amount of liquid.
enum class FillBy {
    Volume,        ///< volume [m³]
    Height,        ///< largest height [m]
    ContactAngle,  ///< mean contact angle along the rim [rad]
};

/// Whether droplets are separate or communicate.
enum class FillSharing {
    Each,   ///< every droplet has the volume, height or angle, and a pressure of its own
    Total,  ///< one reservoir at one pressure: total volume, largest height, mean angle over all rims
};

/// What makes a droplet's amount smaller than the wanted one.
enum class FillLimit {
    None,       ///< it is the wanted amount
    Puddle,     ///< the height of a puddle, with Fill::below_puddle
    Existence,  ///< no larger amount exists on the footprint, or was found
};

/// Amount of liquid.
struct Fill {
    FillBy by = FillBy::ContactAngle;         ///< quantity that is given
    double amount = 40.0 * kDegree;           ///< its value, in SI units, > 0; an angle < 180°, for height fields
                                              ///< < 90°
    FillSharing sharing = FillSharing::Each;  ///< for each droplet, or for all together
    bool below_puddle = false;                ///< with ContactAngle: no droplet is higher than puddleHeight(); where
                                              ///< the angle would need more, this height is the amount

    /// Checks the amount.
    /// @throws Error InvalidArgument
    void validate() const;
};

}  // namespace droplet
