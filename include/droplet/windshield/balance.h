// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace droplet {

struct WindshieldState;

/// Balance of all water since the start [m³].
struct WaterBalance {
    double rained = 0.0;            ///< volume of the raindrops that met the glass
    double sprayed = 0.0;           ///< volume that sprayers gave
    double condensed = 0.0;         ///< volume of the mist that has condensed
    double on_glass_mist = 0.0;     ///< volume of the mist
    double on_glass_film = 0.0;     ///< volume of the film that runs off
    double on_glass_still = 0.0;    ///< volume of the still droplets, and of those that arrive in the next step
    double on_glass_running = 0.0;  ///< volume of the running droplets
    double left = 0.0;              ///< volume that has run off over the edges
    double wiped = 0.0;             ///< volume that wipers removed
    double merged = 0.0;  ///< flow on the glass: still droplets, rain and others that running droplets absorbed
    double swept = 0.0;   ///< part of `merged` from still droplets along tracks: the Lotus effect
    double shed = 0.0;    ///< flow on the glass: water that running droplets left behind as streaks

    /// Relative error: (come − on glass − left − wiped) / come, where what has come is rained + sprayed + condensed; 0
    /// before any water.
    [[nodiscard]] double residual() const;
};

/// Balance of a state; the volumes on the glass are summed up anew.
WaterBalance balanceOf(const WindshieldState& state);

}  // namespace droplet
