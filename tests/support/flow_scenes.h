// SPDX-License-Identifier: GPL-3.0-or-later
// Droplets and parameters for tests of flow on a plate of 0.2 m that slopes down to −y.
#pragma once

#include <cmath>
#include <vector>

#include "droplet/flow/flow_parameters.h"
#include "droplet/units.h"

namespace droplet::testing {

/// Droplets all over the upper part of the plate.
/// @param slope  [rad]
inline std::vector<FlowStart> many(int n, double slope)
{
    std::vector<FlowStart> starts;
    for (int k = 0; k < n; ++k) {
        const double x = 0.01 + 0.18 * std::fmod(0.618034 * k, 1.0);
        const double y = 0.05 + 0.14 * std::fmod(0.754878 * k, 1.0);
        starts.push_back({{x, y, std::tan(slope) * y}, (2.0 + k % 30) * 1e-9, {}});
    }
    return starts;
}

/// All sources, films that become beads and dry.
inline FlowParameters everything()
{
    FlowParameters parameters;
    parameters.forces.wetting.hysteresis = 0.02;
    parameters.streaks.film = 5e-6;
    parameters.drying = 2.0;
    parameters.emitters = {{{0.1, 0.15, 0.2}, 2e-7, {15e-9, 0.4}}};
    FlowRain rain;
    rain.rainfall = 50.0 * kMillimetrePerHour;
    parameters.rain = rain;
    parameters.condensation = FlowCondensation{1e-7, 8e-3};
    return parameters;
}

}  // namespace droplet::testing
