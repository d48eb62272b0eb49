// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "droplet/flow_io/droplet_surfaces.h"
#include "flow_io/seat.h"

namespace droplet {

/// How one droplet is deformed.
struct DropletDeformation {
    double share = 0.0;             ///< SmallDeformation::at its speed
    const SmallDeformation& field;  ///< over the surface
    const DropletFrame& frame;      ///< where the field is
};

/// Moves the outline of a droplet by the field at its contact line, and all above alike; its volume stays.
/// @param droplet  in its frame, open at z = 0
void deform(const DropletDeformation& deformation, const FlatDroplet& droplet);

}  // namespace droplet
