// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "droplet/windshield/balance.h"
#include "droplet/windshield/droplets.h"
#include "droplet/windshield/parameters.h"

namespace droplet {

/// How many of what happened since the start.
struct WindshieldCounts {
    std::uint64_t raindrops = 0;  ///< that met the glass
    std::uint64_t merged = 0;     ///< running droplets taken up by others
    std::uint64_t swept = 0;      ///< still droplets taken up by running ones
    std::uint64_t grown = 0;      ///< still droplets that became running ones
    std::uint64_t torn = 0;       ///< droplets made by wind from larger ones
    std::uint64_t left = 0;       ///< running droplets that left over the edges
    std::uint64_t wiped = 0;      ///< droplets of both kinds

    friend bool operator==(const WindshieldCounts&, const WindshieldCounts&) = default;
};

/// All there is to know to go on. Plain values; made by startWindshield, step and stateFromBytes.
struct WindshieldState {
    double time = 0.0;                     ///< [s]
    std::vector<RunningDroplet> droplets;  ///< in the order of their ids
    StillDroplets still;                   ///< all others
    std::vector<TrackPiece> tracks;        ///< of the last step, of droplets that moved, in the order of ids
    std::uint64_t next_id = 1;             ///< of a running droplet
    std::uint64_t next_raindrop = 0;       ///< number of the raindrop that comes next
    double until_raindrop = 0.0;           ///< until then, in raindrops expected
    CarriedSum rained;                     ///< [m³], as are these
    CarriedSum left;
    CarriedSum wiped;
    CarriedSum merged;
    CarriedSum swept;
    CarriedSum shed;
    WindshieldCounts counts;

    friend bool operator==(const WindshieldState&, const WindshieldState&) = default;
};

/// Dry glass at time 0.
/// @throws Error InvalidArgument
WindshieldState startWindshield(const WindshieldParameters& parameters);

/// Goes on by dt: rain arrives (Poisson), running droplets are moved by the forces (wind/forces.h), take up still ones
/// along their way and merge where they touch; those too high for the wind break up into the fewest equal ones that are
/// not, in a row along the wind; then wipers pass and what is beyond the edges has left. A vehicle's acceleration acts
/// on the droplets as gravity does.
///
/// Guarantees: the same bytes from the same arguments, at any number of threads; water is kept (balanceOf); droplets in
/// the order of their ids; a droplet whose forces are within the retention limit stays exactly where it is.
/// @param state  of these parameters
/// @param dt     [s], > 0, finite; what happens between two droplets within it happens at its end: 1/30 s or less
/// @throws Error InvalidArgument
WindshieldState step(WindshieldState state, const WindshieldParameters& parameters, double dt);

}  // namespace droplet
