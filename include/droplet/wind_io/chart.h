// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "droplet/drawing/drawing.h"
#include "droplet/wind/forces.h"
#include "droplet/wind/tunnel.h"

namespace droplet {

/// Options of charts.
struct ChartOptions {
    std::string title = "Droplets in the wind tunnel";  ///< printable ASCII and the other characters of Drawing
    std::optional<WindBand> measured = {};              ///< measured still band, drawn for comparison
    double min = 0.0;                                   ///< acceleration that the axis includes at least [m/s²]
    double max = 0.0;                                   ///< acceleration that the axis includes at least [m/s²]
};

/// Limit of the panels of a chart. There is one for each pair of slope and hysteresis; if there are several of both,
/// each slope is a row.
inline constexpr std::size_t kMaxPanels = 12;

/// Chart of the acceleration from rest over the wind, one curve for each volume, in the manner of the thesis's figure
/// 3.5. Winds in which droplets stay at rest are shaded; darker if more droplets do. Curves are computed from the
/// forces, between the slowest and the fastest wind of the sweep.
/// @param swept    input of the sweep
/// @param tunnel   its result
/// @param options  title and axis
/// @throws Error   InvalidArgument if there are more than kMaxPanels panels
Drawing accelerationChart(const TunnelSweep& swept, const Tunnel& tunnel, const ChartOptions& options = {});

/// Map of the regimes over wind and volume. The roots U₋ and U₊ of many volumes separate droplets that run down, stay
/// still and climb. Beyond the dashed line the wind tears droplets off (tearOffWind).
/// @param swept    input of the sweep
/// @param tunnel   its result
/// @param options  title and measured band
/// @throws Error   InvalidArgument if there are more than kMaxPanels panels
Drawing regimeMap(const TunnelSweep& swept, const Tunnel& tunnel, const ChartOptions& options = {});

}  // namespace droplet
