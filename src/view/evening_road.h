// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "droplet/picture/picture.h"

namespace droplet {

/// How the road is looked at.
struct RoadOptions {
    int width = 1280;            ///< [px]
    int height = 720;            ///< [px]
    double field_of_view = 0.0;  ///< of the width [rad]
    double travelled = 0.0;      ///< how far the car has come [m], finite
};

/// A made-up road on a wet evening, seen from a car whose driver looks at the windshield: everything behind it is out
/// of focus. What stands still comes nearer as the car travels.
///
/// Guarantees: the same bytes for the same options, at any number of threads.
/// @param options  as ViewOptions allow
Picture eveningRoad(const RoadOptions& options);

}  // namespace droplet
