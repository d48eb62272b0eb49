// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "droplet/picture/picture.h"

namespace droplet {

/// How the road is looked at.
struct RoadOptions {
    int width = 1280;                           ///< [px] 1 … 8192
    int height = 720;                           ///< [px] 1 … 8192
    double field_of_view = 0.7853981633974483;  ///< of the width [rad], 45°; over 0, below π
    double travelled = 0.0;                     ///< how far the car has come [m], finite
    double spread = 0.009;                      ///< radius of a light out of focus, over the width; 0.001 … 0.1

    /// @throws Error InvalidArgument
    void validate() const;
};

/// A made-up road on a wet evening, seen from a car whose driver looks at the windshield: everything behind it is out
/// of focus. What stands still comes nearer as the car travels.
///
/// Guarantees: the same bytes for the same options, at any number of threads.
/// @throws Error InvalidArgument
Picture eveningRoad(const RoadOptions& options = {});

}  // namespace droplet
