// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "droplet/units.h"
#include "droplet/vector.h"
#include "droplet/windshield/glass.h"

namespace droplet {

/// A blade that sweeps back and forth about a pivot: its angle goes as a cosine from `first` to `last` and back in
/// `stroke`, then rests at `first` for what is left of `period`. It takes all water it passes over off the glass:
/// wiped.
struct Wiper {
    Vec2 pivot{0.7, -0.05};          ///< on the rolled out glass, or beside it [m]
    double inner = 0.1;              ///< where the blade begins, from the pivot [m], ≥ 0
    double outer = 0.7;              ///< and ends [m], > inner
    double first = 175.0 * kDegree;  ///< from the glass's x, towards its y [rad]
    double last = 5.0 * kDegree;     ///< [rad]; differs from first, by at most 2π
    double stroke = 1.2;             ///< there and back [s], > 0
    double period = 1.2;             ///< [s], ≥ stroke
    double start = 0.0;              ///< when it first leaves `first` [s]; at rest before

    /// Its angle at a time [rad].
    [[nodiscard]] double angleAt(double time) const;

    /// @throws Error InvalidArgument
    void validate() const;
};

/// Two blades in tandem, as most cars have them, that between them reach most of the glass.
/// @param period  of both [s], ≥ 1.2: they take 1.2 s there and back
std::vector<Wiper> tandemWipers(const Glass& glass, double period);

}  // namespace droplet
