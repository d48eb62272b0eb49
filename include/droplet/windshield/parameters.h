// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "droplet/units.h"
#include "droplet/wind/forces.h"
#include "droplet/wind/rain.h"
#include "droplet/wind/streaks.h"
#include "droplet/wind/tunnel.h"
#include "droplet/windshield/drive_cycle.h"
#include "droplet/windshield/glass.h"
#include "droplet/windshield/wipers.h"

namespace droplet {

/// Random acceleration along the glass from a vehicle that shakes (thesis 3.2: noise on the gravity along the
/// windshield). Each droplet has its own, with its own phase: uniform values at times `interval` apart, and between
/// them a smooth transition that keeps the variance. It depends on seed, droplet and time alone.
struct Fluctuation {
    double acceleration = 0.5;  ///< root mean square of each component [m/s²], ≥ 0; peaks are at most √6 times that
    double interval = 0.1;      ///< [s], > 0

    /// Checks all fields.
    /// @throws Error InvalidArgument if a field is out of its range
    void validate() const;
};

/// Parameters of the rain on a windshield.
struct WindshieldParameters {
    Glass glass;                                   ///< at most 100 m²
    WindAlongGlass wind = WindAlongGlass::Turned;  ///< speed of the air along the glass
    ForceModel forces;                             ///< constants of the forces on droplets
    DriveCycle vehicle = constantSpeed(11.3);      ///< speed of the vehicle
    double rainfall = 5.0 * kMillimetrePerHour;    ///< [m/s], from 0 to 1000 mm/h
    RaindropRange raindrops;                       ///< diameters that are simulated
    double still_diameter = 1e-3;           ///< smaller raindrops are still (thesis 3.1.5) [m], > 0, at most 2 mm
    bool relative_wind = false;             ///< true: drag uses the wind relative to the moving droplet
    Fluctuation fluctuation;                ///< random acceleration
    Streaks streaks;                        ///< film behind running droplets
    double tear_off_weber = kTearOffWeber;  ///< Weber number above which droplets break up, > 0; infinity: none
    bool splashes = false;                  ///< true: the state has the rings of raindrops that have just hit (Splash)
    double runoff =
        0.0;  ///< time after which a film of heavy rain breaks up without more rain [s], from 0 to 10; 0: none
    double mist = 0.0;          ///< growth of the mist's thickness up to kDenseMist [m/s], from 0 to 1 µm/s
    std::vector<Wiper> wipers;  ///< empty: none
    std::uint64_t seed = 1;     ///< random seed

    /// Checks all fields.
    /// @throws Error InvalidArgument if a field is out of its range
    void validate() const;
};

}  // namespace droplet
