// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "droplet/wind/forces.h"

namespace droplet {

/// Wind up the slope: mean + amplitude sin(2π t / period).
struct Gust {
    double mean = 0.0;       ///< [m/s]
    double amplitude = 0.0;  ///< [m/s], ≥ 0; 0: steady wind
    double period = 1.0;     ///< [s], > 0; at most kMaxGusts periods in a series

    /// Wind at a time [m/s].
    [[nodiscard]] double at(double time) const;
};

/// Options of traceMotion().
struct MotionOptions {
    double duration = 1.0;                  ///< [s], > 0
    double interval = 0.01;                 ///< time between points [s], > 0; at most kMaxMotionPoints points
    double velocity = 0.0;                  ///< initial velocity, up the slope [m/s]
    double tolerance = 1e-9;                ///< velocity error per step over the highest speed so far, in (0, 1)
    std::optional<double> fixed_step = {};  ///< fixed time step without error control [s], > 0

    /// Checks all fields.
    /// @throws Error InvalidArgument if a field is out of its range
    void validate() const;
};

/// Limit of points in one series.
inline constexpr std::size_t kMaxMotionPoints = 10'000'000;
/// Limit of gust periods in one series; each takes about fifty steps.
inline constexpr double kMaxGusts = 1e5;

/// State of a droplet at one time.
struct MotionPoint {
    double time = 0.0;          ///< [s]
    double wind = 0.0;          ///< V [m/s]
    double position = 0.0;      ///< way up the slope since the start [m]
    double velocity = 0.0;      ///< [m/s]; exactly 0: at rest
    double acceleration = 0.0;  ///< [m/s²]
};

/// Start or stop of a droplet.
struct MotionEvent {
    double time = 0.0;   ///< [s]
    bool moves = false;  ///< true: it begins to move; false: friction stops it
};

/// Motion of one droplet as a series of points.
struct Motion {
    std::vector<MotionPoint> points;  ///< at every multiple of the interval up to the duration, from 0
    std::vector<MotionEvent> events;  ///< after time 0, in order of time
    std::size_t steps = 0;            ///< number of accepted steps
    std::size_t rejected = 0;         ///< number of rejected steps
};

/// Traces the motion of one droplet.
///
/// Over each step a parabola interpolates the driving force; the linear equation of motion is then solved exactly. This
/// is exact in a steady wind, of fourth order in a gust, and stable with any step and any viscosity. In gusts, halved
/// steps control the error. The times at which friction stops or releases the droplet are found as roots.
/// @param forces   forces of forcesOn()
/// @param slope    α [rad], finite
/// @param wind     finite, in its documented range
/// @param options  valid
/// @throws Error   InvalidArgument if an argument is out of its range
Motion traceMotion(const DropletForces& forces, double slope, const Gust& wind, const MotionOptions& options = {});

}  // namespace droplet
