// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace droplet {

struct WindshieldState;

/// A sum of many small terms that forgets none (A. Neumaier, "Rundungsfehleranalyse einiger Verfahren zur Summation
/// endlicher Summen", ZAMM 54 (1974) 39).
struct CarriedSum {
    double sum = 0.0;
    double carry = 0.0;

    void add(double term);
    [[nodiscard]] double value() const { return sum + carry; }

    friend bool operator==(const CarriedSum&, const CarriedSum&) = default;
};

/// Where the water went since the start [m³].
struct WaterBalance {
    double rained = 0.0;
    double on_glass_still = 0.0;
    double on_glass_running = 0.0;
    double left = 0.0;    ///< over the edges
    double wiped = 0.0;   ///< by wipers
    double merged = 0.0;  ///< a flow on the glass: taken up by running droplets, from still ones, rain, and each other
    double swept = 0.0;   ///< of that, from still droplets along tracks: the Lotus effect
    double shed = 0.0;    ///< a flow on the glass: left behind as streaks

    /// rained − (on glass + left + wiped), relative to rained; 0 before any rain.
    [[nodiscard]] double residual() const;
};

/// Where the water is, summed up anew.
WaterBalance balanceOf(const WindshieldState& state);

}  // namespace droplet
