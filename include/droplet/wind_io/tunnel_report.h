// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "droplet/wind/trace.h"
#include "droplet/wind/tunnel.h"

namespace droplet {

/// A sweep, what it found, and where its numbers are from.
struct TunnelRun {
    std::string preset;  ///< empty: none
    TunnelSweep swept;
    Tunnel tunnel;
    std::optional<double> falling_angle;   ///< that the hysteresis was taken from, at falling_volume [rad]
    std::optional<double> falling_volume;  ///< [m³]
    std::optional<WindBand> measured;      ///< a still band that thresholds are compared with
};

/// Writes runs as one table, comma-separated, a line for every combination, SI units, angles in degrees. Lines before
/// its head begin with `#` and hold everything that all lines of a run share: `# gravity_m_per_s2 = 9.81`. What does
/// not exist is left empty.
///
/// Guarantees: the same runs give the same bytes at any number of threads, and every number reads back as it was; the
/// stream is left failed if it did not take everything.
void writeTunnelCsv(std::ostream& out, const std::vector<TunnelRun>& runs);

/// Writes runs as JSON, schema `droplet-shape.wind-tunnel/1`: every key always present, in a fixed order, angles in
/// degrees, the rest in SI units; null is what does not exist.
void writeTunnelJson(std::ostream& out, const std::vector<TunnelRun>& runs);

/// One droplet's motion, and which droplet it was.
struct TraceRun {
    TunnelRun run;  ///< of one case and one wind
    Gust wind;
    MotionOptions options;
    Motion motion;
};

/// Writes a series as a table as above: time, wind, position, velocity, acceleration.
void writeTraceCsv(std::ostream& out, const TraceRun& run);

/// Writes a series and its events as JSON, schema `droplet-shape.wind-trace/1`.
void writeTraceJson(std::ostream& out, const TraceRun& run);

}  // namespace droplet
