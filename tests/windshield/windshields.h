// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <random>
#include <utility>

#include "droplet/windshield/windshield.h"
#include "windshield/still_droplets.h"

namespace droplet::testing {

/// Uniform number, the same on every platform: the standard fixes engines, but not distributions.
inline double uniform(std::mt19937_64& bits, double low, double high)
{
    return low + (high - low) * static_cast<double>(bits() >> 11U) * 0x1p-53;
}

/// Small flat glass without rain, wind, fluctuation or wipers, for which there are closed forms.
inline WindshieldParameters quietGlass()
{
    WindshieldParameters p;
    p.glass = Glass({.width = 0.2, .height = 0.2, .radius = std::numeric_limits<double>::infinity()});
    p.forces = forcePresetNamed("thesis").model;
    p.vehicle = constantSpeed(0.0);
    p.rainfall = 0.0;
    p.fluctuation.acceleration = 0.0;
    return p;
}

/// Heavy rain on a small glass, on which droplets move and merge.
inline WindshieldParameters busyGlass()
{
    WindshieldParameters p = quietGlass();
    p.glass = Glass({.width = 0.2, .height = 0.15});
    p.forces.wetting.hysteresis = 0.05;
    p.forces.wetting.viscosity_factor = 0.05;
    p.vehicle = constantSpeed(18.0);
    p.rainfall = 50.0 * kMillimetrePerHour;
    p.fluctuation = {};
    return p;
}

inline void addRunning(WindshieldState& state, Vec2 position, double volume, Vec2 velocity = {})
{
    state.droplets.push_back({state.next_id++, position, velocity, volume, 0.0, 0});
    state.rained.add(volume);
}

inline void addStill(WindshieldState& state, Vec2 position, double volume)
{
    StillCells& still = StillCells::of(state.still);
    const auto column = static_cast<std::size_t>(position.x / still.cell);
    const auto row = static_cast<std::size_t>(position.y / still.cell);
    const std::size_t cell = row * still.columns + column;
    still.put(cell, {position, volume});
    state.rained.add(volume);
}

inline WindshieldState after(WindshieldState state, const WindshieldParameters& parameters, double dt, int steps)
{
    for (int k = 0; k < steps; ++k) {
        state = step(std::move(state), parameters, dt);
    }
    return state;
}

}  // namespace droplet::testing
