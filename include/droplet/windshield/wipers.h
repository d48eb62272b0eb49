// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "droplet/units.h"
#include "droplet/vector.h"
#include "droplet/windshield/glass.h"

namespace droplet {

/// Blade that sweeps about a pivot. In the time `stroke` its angle moves from `first` to `last` and back as a cosine;
/// then it rests at `first` until `period` is over. It removes all water that it passes over.
struct Wiper {
    Vec2 pivot{0.7, -0.05};          ///< on the plane of the unrolled glass, on or beside the glass [m]
    double inner = 0.1;              ///< distance of the blade's inner end from the pivot [m], ≥ 0
    double outer = 0.7;              ///< distance of the blade's outer end from the pivot [m], > inner
    double first = 175.0 * kDegree;  ///< angle at rest, from the glass's x towards its y [rad]
    double last = 5.0 * kDegree;     ///< angle at the turn [rad]; differs from `first`, by at most 2π
    double stroke = 1.2;             ///< time there and back [s], > 0
    double period = 1.2;             ///< time from start to start [s], ≥ stroke
    double start = 0.0;              ///< time of the first start [s]; at rest before

    /// Angle at a time [rad].
    [[nodiscard]] double angleAt(double time) const;

    /// Checks all fields.
    /// @throws Error InvalidArgument if a field is out of its range
    void validate() const;
};

/// Two blades in tandem, as on most cars; together they reach most of the glass.
/// @param glass   glass to wipe
/// @param period  period of both [s], ≥ 1.2; a stroke takes 1.2 s
std::vector<Wiper> tandemWipers(const Glass& glass, double period);

}  // namespace droplet
