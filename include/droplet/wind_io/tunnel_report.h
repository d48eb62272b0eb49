// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "droplet/wind/trace.h"
#include "droplet/wind/tunnel.h"

namespace droplet {

/// Sweep with its result and the origin of its parameters.
struct TunnelRun {
    std::string preset;                    ///< name of the preset; empty: none
    TunnelSweep swept;                     ///< input of the sweep
    Tunnel tunnel;                         ///< result of the sweep
    std::optional<double> sliding_angle;   ///< sliding angle that gave the hysteresis, at sliding_volume [rad]
    std::optional<double> sliding_volume;  ///< [m³]
    std::optional<WindBand> measured;      ///< measured still band to compare with
};

/// Writes runs as one CSV table with a line for every combination: SI units, angles in degrees. Lines before the header
/// begin with `#` and hold everything that all lines of a run share: `# gravity_m_per_s2 = 9.81`. Fields without a
/// value are empty.
///
/// Guarantees: the same runs give the same bytes with any number of threads; every number reads back exactly; the
/// stream is in a failed state if a write failed.
void writeTunnelCsv(std::ostream& out, const std::vector<TunnelRun>& runs);

/// Writes runs as JSON, schema `droplet-shape.wind-tunnel/1`: SI units, angles in degrees. Every key is always present,
/// in a fixed order; a missing value is null.
void writeTunnelJson(std::ostream& out, const std::vector<TunnelRun>& runs);

/// Motion of one droplet with its parameters.
struct TraceRun {
    TunnelRun run;          ///< sweep of one case and one wind
    Gust wind;              ///< wind over time
    MotionOptions options;  ///< options of traceMotion()
    Motion motion;          ///< its result
};

/// Writes a motion as a CSV table like writeTunnelCsv(): time, wind, position, velocity, acceleration.
void writeTraceCsv(std::ostream& out, const TraceRun& run);

/// Writes a motion and its events as JSON, schema `droplet-shape.wind-trace/1`.
void writeTraceJson(std::ostream& out, const TraceRun& run);

}  // namespace droplet
