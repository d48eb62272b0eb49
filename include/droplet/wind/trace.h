// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "droplet/wind/forces.h"

namespace droplet {

/// A wind up the slope: mean + amplitude sin(2π t / period).
struct Gust {
    double mean = 0.0;       ///< [m/s]
    double amplitude = 0.0;  ///< [m/s], ≥ 0; 0: a steady wind
    double period = 1.0;     ///< [s], > 0; at most kMaxGusts of them in a series

    [[nodiscard]] double at(double time) const;
};

struct MotionOptions {
    double duration = 1.0;                  ///< [s], > 0
    double interval = 0.01;                 ///< between points of the series [s], > 0; at most kMaxMotionPoints of them
    double velocity = 0.0;                  ///< at the start, up the slope [m/s]
    double tolerance = 1e-9;                ///< of the velocity in one step, as a share of the fastest yet, > 0
    std::optional<double> fixed_step = {};  ///< [s]: steps of this length, whatever their error

    /// @throws Error InvalidArgument
    void validate() const;
};

inline constexpr std::size_t kMaxMotionPoints = 10'000'000;
/// Gusts in one series: each takes some fifty steps.
inline constexpr double kMaxGusts = 1e5;

/// A droplet at a time.
struct MotionPoint {
    double time = 0.0;          ///< [s]
    double wind = 0.0;          ///< V [m/s]
    double position = 0.0;      ///< up the slope from where it began [m]
    double velocity = 0.0;      ///< [m/s]; exactly 0: held
    double acceleration = 0.0;  ///< [m/s²]
};

/// A droplet begins to move, or is caught by friction.
struct MotionEvent {
    double time = 0.0;  ///< [s]
    bool moves = false;
};

struct Motion {
    std::vector<MotionPoint> points;  ///< at every multiple of the interval up to the duration, the first at 0
    std::vector<MotionEvent> events;  ///< after time 0, in order
    std::size_t steps = 0;            ///< accepted
    std::size_t rejected = 0;
};

/// The motion of one droplet.
///
/// Between events the driving force is interpolated by a parabola over each step and the linear equation of motion then
/// solved exactly: exact in a steady wind, of fourth order in a gust, and stable at any step however viscous the
/// droplet. In gusts, halved steps control the error. Where friction catches a droplet, and where it lets go, is found
/// as a root.
/// @param forces   of a droplet, as of forcesOn
/// @param slope    α [rad]
/// @throws Error   InvalidArgument
Motion traceMotion(const DropletForces& forces, double slope, const Gust& wind, const MotionOptions& options = {});

}  // namespace droplet
