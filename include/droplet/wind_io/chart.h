// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "droplet/picture/drawing.h"
#include "droplet/wind/forces.h"
#include "droplet/wind/tunnel.h"

namespace droplet {

struct ChartOptions {
    std::string title = "Droplets in the wind tunnel";  ///< printable ASCII and the few more that drawings know
    std::optional<WindBand> measured = {};              ///< a still band to stand beside
    double min = 0.0;  ///< an acceleration down to which the axis goes at least, for charts that stand side by side
    double max = 0.0;  ///< and up to which [m/s²]
};

/// The most slopes and hystereses that charts show, a panel for each of both; of several of both a row for each slope.
inline constexpr std::size_t kMaxPanels = 12;

/// Acceleration at rest over wind speed, a curve for each volume, in the manner of the thesis' figure 3.5: where each
/// droplet stays still is shaded, the more the more of them do. Curves are drawn from the forces between the slowest
/// and the fastest wind of the sweep, however few winds that has.
/// @param model   that was swept
/// @throws Error  InvalidArgument: over kMaxPanels panels
Drawing accelerationChart(const TunnelSweep& swept, const Tunnel& tunnel, const ChartOptions& options = {});

/// What droplets do over wind and volume: where they run down, stay still and climb, parted by the roots U₋ and U₊ of
/// many volumes, up to the wind that tears droplets off, by their height alone (sheddingWind): beyond that dashed line
/// they are torn off.
/// @throws Error  InvalidArgument: over kMaxPanels panels
Drawing regimeMap(const TunnelSweep& swept, const Tunnel& tunnel, const ChartOptions& options = {});

}  // namespace droplet
