// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "droplet/compensated_sum.h"
#include "droplet/windshield/balance.h"
#include "droplet/windshield/droplets.h"
#include "droplet/windshield/mist.h"
#include "droplet/windshield/parameters.h"
#include "droplet/windshield/runoff.h"
#include "droplet/windshield/splash.h"

namespace droplet {

/// Event counters since the start.
struct WindshieldCounts {
    std::uint64_t raindrops = 0;  ///< raindrops that met the glass
    std::uint64_t merged = 0;     ///< running droplets that others absorbed
    std::uint64_t swept = 0;      ///< still droplets that running ones absorbed
    std::uint64_t grown = 0;      ///< still droplets that became running ones
    std::uint64_t torn = 0;       ///< droplets that the wind made from larger ones
    std::uint64_t left = 0;       ///< running droplets that left over the edges
    std::uint64_t wiped = 0;      ///< droplets of both kinds that wipers removed

    friend bool operator==(const WindshieldCounts&, const WindshieldCounts&) = default;  ///< Compares all members.
};

/// Complete state of the simulation; the parameters are the only other input of a step. Made by startWindshield, step
/// and stateFromBytes.
struct WindshieldState {
    double time = 0.0;                     ///< [s]
    std::vector<RunningDroplet> droplets;  ///< running droplets, in the order of their ids
    StillDroplets still;                   ///< still droplets
    std::vector<TrackPiece> tracks;        ///< paths of the last step, of droplets that moved, in the order of ids
    std::vector<StillDroplet> arriving;    ///< water of sprayers and fingers that meets the glass in the next step
    std::vector<Splash> splashes;          ///< of raindrops that have just hit, in the order of their times
    Mist mist;                             ///< mist on the glass
    Runoff film;                           ///< film that runs off the glass
    std::uint64_t next_id = 1;             ///< id of the next running droplet
    std::uint64_t next_raindrop = 0;       ///< number of the next raindrop
    double until_raindrop = 0.0;           ///< time until the next raindrop, as the expected number of raindrops
    std::uint64_t next_touch = 0;          ///< number of the next spray or stroke of a finger
    CompensatedSum rained;                 ///< WaterBalance::rained [m³]
    CompensatedSum sprayed;                ///< WaterBalance::sprayed [m³]
    CompensatedSum condensed;              ///< WaterBalance::condensed [m³]
    CompensatedSum left;                   ///< WaterBalance::left [m³]
    CompensatedSum wiped;                  ///< WaterBalance::wiped [m³]
    CompensatedSum merged;                 ///< WaterBalance::merged [m³]
    CompensatedSum swept;                  ///< WaterBalance::swept [m³]
    CompensatedSum shed;                   ///< WaterBalance::shed [m³]
    WindshieldCounts counts;               ///< event counters

    friend bool operator==(const WindshieldState&, const WindshieldState&) = default;  ///< Compares all members.
};

/// Dry glass at time 0.
/// @throws Error InvalidArgument if a parameter is out of its range
WindshieldState startWindshield(const WindshieldParameters& parameters);

/// Advances the state by dt:
/// - Rain arrives (Poisson). Large raindrops splash; splashes older than their lifetimes are removed.
/// - Forces (wind/forces.h) move running droplets. The vehicle's acceleration acts as gravity does.
/// - Running droplets absorb still ones along their tracks and merge where they touch.
/// - Droplets that are too high for the wind at their height, relative to them (tearOffHeight), break up into parts of
///   random sizes, half as large as the wind leaves whole or more, scattered downwind.
/// - Raindrops on wet glass join a film, which runs off, takes droplets where it is deep, and breaks up where it is
/// thin.
/// - Mist condenses; droplets that run over it take it along.
/// - Wipers remove water. Droplets beyond the edges leave.
///
/// Guarantees: the same arguments give the same bytes with any number of threads; water is conserved (balanceOf);
/// droplets are in the order of their ids; a droplet within its retention stays exactly in place.
/// @param state       made with the same parameters
/// @param parameters  valid
/// @param dt          [s], > 0, finite; at most 1/30 s is advised, as interactions of droplets happen at its end
/// @throws Error      InvalidArgument if an argument is out of its range
WindshieldState step(WindshieldState state, const WindshieldParameters& parameters, double dt);

}  // namespace droplet
