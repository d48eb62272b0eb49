// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "droplet/flow_io/trail_film.h"
#include "droplet/vector.h"

namespace droplet {

/// How a droplet passed a place.
struct Passage {
    double time = 0.0;   ///< when its middle was beside the place [s]
    double width = 0.0;  ///< of its contact circle [m], > 0
    double speed = 0.0;  ///< [m/s], ≥ 0
};

/// Cross-section of the film behind a droplet: a parabola.
struct TrailSection {
    double half_width = 0.0;  ///< [m]; 0: the film has broken up there
    double height = 0.0;      ///< of its middle [m]

    /// Height at a distance from the middle [m].
    [[nodiscard]] double at(double distance) const;
};

/// @param place  of it, which the unevenness belongs to [m]
/// @param age    time since the passage [s], ≥ 0
TrailSection trailSection(const TrailFilm& film, const Passage& passage, Vec3 place, double age);

/// Age at which a film on a still picture of a whole animation is shown: drawn together, broken up as far as beads are
/// no droplets, not drained.
double settledAge(const TrailFilm& film, const Passage& passage);

/// Age at which nothing of the film is left [s]; infinity if something stays.
double lifetime(const TrailFilm& film, const Passage& passage);

}  // namespace droplet
