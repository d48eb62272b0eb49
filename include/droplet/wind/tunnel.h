// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "droplet/wind/forces.h"

namespace droplet {

/// Behaviour of a droplet that was at rest.
enum class Regime {
    RunsDown,  ///< gravity wins
    Still,     ///< retention holds the droplet
    Climbs,    ///< the wind wins
};

/// Name of a regime: "runs down", "still" or "climbs".
const char* nameOf(Regime regime);

/// Regime of a droplet under a driving force.
/// @param forces   forces of forcesOn()
/// @param driving  positive up the slope, as from drivingForce() [N]
Regime regimeOf(const DropletForces& forces, double driving);

/// Winds between which a droplet stays at rest.
struct Thresholds {
    std::optional<double> lower;  ///< U₋ [m/s]: below it the droplet runs down; empty if it never does
    std::optional<double> upper;  ///< U₊ [m/s]: above it the droplet climbs; empty if it never does
};

/// Thresholds of a droplet: roots of its balance of forces, to the last digits by Chandrupatla's method. The search
/// covers winds up the slope from 0 to 10⁶ m/s.
/// @param forces  forces of forcesOn()
/// @param slope   α [rad], from 0 to π/2
Thresholds thresholdsOf(const DropletForces& forces, double slope);

/// Slope of the ground and wind up the slope.
struct TunnelSetting {
    double slope = 0.0;  ///< α [rad], from 0 to π/2
    double wind = 0.0;   ///< V [m/s]
};

/// Range of volumes, 0 < min < max.
struct VolumeRange {
    double min = 1e-15;  ///< [m³]
    double max = 1e-3;   ///< [m³]
};

/// Volume at which the regime changes.
struct RegimeChange {
    double volume = 0.0;           ///< [m³]
    Regime below = Regime::Still;  ///< regime of smaller droplets
    Regime above = Regime::Still;  ///< regime of larger droplets
};

/// All regime changes in a range of volumes, in ascending order. Finds every one: between two volumes where a balance
/// of forces may turn, the balance has at most one root.
/// @param model    valid
/// @param setting  slope and wind
/// @param range    volumes to search
std::vector<RegimeChange> regimeChanges(const ForceModel& model, const TunnelSetting& setting,
                                        const VolumeRange& range = {});

/// Smallest volume that runs down a slope without wind [m³]; empty if no volume does, or every volume.
/// @param model  valid
/// @param slope  α [rad], from 0 to π/2
std::optional<double> criticalVolume(const ForceModel& model, double slope);

/// Critical Weber number ρ_a U² y / γ, ± 0.5, above which the wind U tears off a droplet of height y: Zhang et al.,
/// Phys. Rev. Fluids 9 (2024) 034004.
inline constexpr double kTearOffWeber = 7.5;

/// Wind that tears off a droplet, from its height alone [m/s]; empty if the density of air is 0.
std::optional<double> tearOffWind(const ForceModel& model, const CapSize& cap);

/// Height of the lowest droplet that a wind along the glass tears off: the Weber number with the wind at the droplet's
/// height, as windAt() has it in the boundary layer [m]; infinity if there is none.
///
/// Where the layer is thinner than the droplet, as where the number was measured, the wind is that of tearOffWind().
/// @param model  valid
/// @param wind   outside of the boundary layer, relative to the droplet [m/s], ≥ 0
/// @param weber  critical Weber number, > 0
double tearOffHeight(const ForceModel& model, double wind, double weber = kTearOffWeber);

/// Input of sweep(): lists of values, of which all combinations are computed.
struct TunnelSweep {
    ForceModel model = {};           ///< model of all combinations
    std::vector<double> volumes;     ///< V_d [m³], each > 0
    std::vector<double> winds;       ///< V up the slope [m/s]
    std::vector<double> slopes;      ///< α [rad], from 0 to π/2
    std::vector<double> hystereses;  ///< Δ, from 0 to 2; empty: the model's value

    /// Checks the model and the lists: all values in range, no list empty except hystereses, and at most kMaxTunnelRows
    /// rows.
    /// @throws Error InvalidArgument if a check fails
    void validate() const;
};

/// Limit of rows of one sweep.
inline constexpr std::size_t kMaxTunnelRows = 10'000'000;

/// Droplet on a slope, with its figures that do not depend on the wind.
struct TunnelCase {
    double hysteresis = 0.0;                ///< Δ; with a sliding angle for every volume: the Δ of equal retention
    double slope = 0.0;                     ///< α [rad]
    CapSize cap;                            ///< size of the droplet
    DropletForces forces;                   ///< forces on it
    Thresholds thresholds;                  ///< winds between which it stays at rest
    std::optional<double> critical_volume;  ///< volume of criticalVolume() [m³]
    std::optional<double> shedding_wind;    ///< wind of tearOffWind() [m/s]
};

/// Result of one case in one wind.
struct TunnelRow {
    double drag = 0.0;                        ///< up the slope [N]
    double driving = 0.0;                     ///< drag minus the component of the weight along the slope [N]
    double acceleration = 0.0;                ///< acceleration from rest, up the slope [m/s²]
    std::optional<double> terminal_velocity;  ///< up the slope [m/s]; empty: nothing limits it
    Regime regime = Regime::Still;            ///< behaviour of the droplet
};

/// Result of a sweep.
/// Invariant: rows.size() == cases.size() * winds.size(). Rows of one case are adjacent, in the order of the winds.
/// Cases loop over volumes first, then slopes, then hystereses.
struct Tunnel {
    std::vector<double> winds;      ///< [m/s]
    std::vector<TunnelCase> cases;  ///< all combinations without the wind
    std::vector<TunnelRow> rows;    ///< all combinations
};

/// Computes all combinations. The same sweep gives the same bytes with any number of threads.
/// @throws Error InvalidArgument if validate() fails
Tunnel sweep(const TunnelSweep& what);

/// Relative error of a still band against a measured one: 0.1 means a tenth too fast.
struct BandDistance {
    double lower = 0.0;  ///< error of the lower wind
    double upper = 0.0;  ///< error of the upper wind
};

/// Distance of thresholds from a measured band; empty if a threshold is.
std::optional<BandDistance> distanceFrom(const WindBand& measured, const Thresholds& thresholds);

}  // namespace droplet
