// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "droplet/wind/forces.h"

namespace droplet {

/// What a droplet at rest does.
enum class Regime {
    RunsDown,
    Still,
    Climbs,
};

/// "runs down", "still" or "climbs".
const char* nameOf(Regime regime);

/// @param driving  up the slope, as of drivingForce [N]
Regime regimeOf(const DropletForces& forces, double driving);

/// Between which winds a droplet stays.
struct Thresholds {
    std::optional<double> lower;  ///< U₋ [m/s]: below it the droplet runs down; empty where it never does
    std::optional<double> upper;  ///< U₊ [m/s]: above it the droplet climbs; empty where no wind drives it up
};

/// The thresholds of a droplet, each the root of its balance of forces, by Chandrupatla's method to the last digits.
/// Winds up the slope and up to 10⁶ m/s are looked at.
/// @param slope  α [rad], from 0 to π/2
Thresholds thresholdsOf(const DropletForces& forces, double slope);

/// A slope and a wind up it.
struct TunnelSetting {
    double slope = 0.0;  ///< α [rad], from 0 to π/2
    double wind = 0.0;   ///< V [m/s]
};

/// Volumes [m³], 0 < from < to.
struct VolumeRange {
    double from = 1e-15;
    double to = 1e-3;
};

/// Where in a range of volumes droplets begin to do something else.
struct RegimeChange {
    double volume = 0.0;  ///< [m³]
    Regime below = Regime::Still;
    Regime above = Regime::Still;
};

/// All changes in a range of volumes, in their order. None is overlooked: between the volumes where a balance of forces
/// may turn, it has one root at most.
/// @param model  valid
std::vector<RegimeChange> regimeChanges(const ForceModel& model, const TunnelSetting& setting,
                                        const VolumeRange& range = {});

/// The smallest volume that runs down a slope without wind [m³]; empty where none does, or every one.
/// @param model  valid
std::optional<double> criticalVolume(const ForceModel& model, double slope);

/// The Weber number ρ_a U² y / γ at which wind tears a droplet of height y off its place, ± 0.5: Zhang et al., Phys.
/// Rev. Fluids 9 (2024) 034004.
inline constexpr double kTearOffWeber = 7.5;

/// The wind that tears a droplet off its place, from its height alone [m/s]; empty where the air weighs nothing.
std::optional<double> sheddingWind(const ForceModel& model, const CapSize& cap);

/// What is swept: every value of one list with every one of the others.
struct TunnelSweep {
    ForceModel model = {};
    std::vector<double> volumes;     ///< V_d [m³], each > 0
    std::vector<double> winds;       ///< V up the slope [m/s]
    std::vector<double> slopes;      ///< α [rad], from 0 to π/2
    std::vector<double> hystereses;  ///< Δ, from 0 to 2; empty: as the model has it

    /// Guarantees: returns only when model and lists are in their documented ranges, lists not empty, and rows at most
    /// kMaxTunnelRows.
    /// @throws Error InvalidArgument
    void validate() const;
};

inline constexpr std::size_t kMaxTunnelRows = 10'000'000;

/// A droplet on a slope, at no wind in particular.
struct TunnelCase {
    double hysteresis = 0.0;  ///< Δ; with a falling angle for every volume: the Δ that holds as much
    double slope = 0.0;       ///< α [rad]
    CapSize cap;
    DropletForces forces;
    Thresholds thresholds;
    std::optional<double> critical_volume;  ///< as of criticalVolume [m³]
    std::optional<double> shedding_wind;    ///< [m/s]
};

/// A case at a wind.
struct TunnelRow {
    double drag = 0.0;                        ///< up the slope [N]
    double driving = 0.0;                     ///< drag less the weight's part along the slope [N]
    double acceleration = 0.0;                ///< at rest, up the slope [m/s²]
    std::optional<double> terminal_velocity;  ///< up the slope [m/s]; empty: nothing limits it
    Regime regime = Regime::Still;
};

/// What a sweep found.
/// Invariant: rows.size() == cases.size() * winds.size(); rows of one case stand together, in the order of the winds;
/// cases go through volumes first, then slopes, then hystereses.
struct Tunnel {
    std::vector<double> winds;  ///< [m/s]
    std::vector<TunnelCase> cases;
    std::vector<TunnelRow> rows;
};

/// Sweeps. The same sweep gives the same bytes at any number of threads.
/// @throws Error InvalidArgument
Tunnel sweep(const TunnelSweep& what);

/// By how much a still band is off a measured one, as a share of the measured winds: 0.1 is a tenth too fast.
struct BandDistance {
    double lower = 0.0;
    double upper = 0.0;
};

/// Empty where one of the thresholds is.
std::optional<BandDistance> distanceFrom(const WindBand& measured, const Thresholds& thresholds);

}  // namespace droplet
