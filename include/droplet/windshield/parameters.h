// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "droplet/units.h"
#include "droplet/wind/forces.h"
#include "droplet/wind/tunnel.h"
#include "droplet/windshield/drive_cycle.h"
#include "droplet/windshield/glass.h"
#include "droplet/windshield/rain.h"
#include "droplet/windshield/wipers.h"

namespace droplet {

/// Random pushes along the glass from a vehicle that shakes (thesis 3.2: noise on the gravity along the windshield).
/// Each droplet has its own: uniform values at times `interval` apart, its phase its own, with a smooth passage between
/// them that keeps their variance; a function of seed, droplet and time alone.
struct Fluctuation {
    double acceleration = 0.5;  ///< root mean square of each component [m/s²], ≥ 0; never beyond √6 of it
    double interval = 0.1;      ///< [s], > 0

    /// @throws Error InvalidArgument
    void validate() const;
};

/// What running droplets leave behind: a film as wide as they are, which breaks up into still droplets.
struct Streaks {
    double film = 0.0;      ///< its thickness [m], ≥ 0; 0: none. Water-repellent glass stays dry
    double spacing = 4e-3;  ///< mean distance of the droplets it becomes [m], > 0

    /// @throws Error InvalidArgument
    void validate() const;
};

struct WindshieldParameters {
    Glass glass;
    WindAlongGlass wind = WindAlongGlass::Turned;
    ForceModel forces;
    DriveCycle vehicle = constantSpeed(11.3);
    double rainfall = 5.0 * kMillimetrePerHour;  ///< [m/s], ≥ 0
    RaindropRange raindrops;
    double still_diameter = 1e-3;  ///< raindrops of less make still droplets (thesis 3.1.5) [m], > 0, at most 2 mm
    bool relative_wind = false;    ///< drag by the wind relative to the moving droplet, instead of to the glass
    Fluctuation fluctuation;
    Streaks streaks;
    /// Droplets so high that the Weber number of the wind along the glass is more break up; > 0, infinity: none does.
    double tear_off_weber = kTearOffWeber;
    std::vector<Wiper> wipers;
    std::uint64_t seed = 1;

    /// Guarantees: returns only when every field is in its documented range.
    /// @throws Error InvalidArgument
    void validate() const;
};

}  // namespace droplet
