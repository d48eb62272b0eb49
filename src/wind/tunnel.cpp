// SPDX-License-Identifier: GPL-3.0-or-later
//
// The thesis, section 3.1.4: balance of forces on droplets over the wind (figure 3.5), compared with measurements by
// Hashimoto et al., J. Surf. Finish. Soc. Jpn 59 (2008) 907 (figure 3.3).
//
// A droplet runs down if W − D > F and climbs if D − W > F, with the weight W along the slope, the drag D and the
// retention F. Each is a power of the volume:
//
//   W ∝ V_d,  F ∝ V_d^(1/3),  D ∝ V_d^((2 + 2n)/3) below the boundary layer's edge, ∝ V_d^(2/3) above it.
//
// With a sliding angle for every volume, F ∝ V_d. So a balance divided by V_d^(1/3) is a + b V_d^p + c V_d^q on either
// side of the edge. It turns at one volume at most, which has a closed form. Between these volumes its sign changes at
// most once, and bisection finds the root.
#include "droplet/wind/tunnel.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <string>

#include "blocks.h"
#include "droplet/error.h"
#include "require.h"
#include "wind/root.h"

namespace droplet {
namespace {

template <typename Holds>
void requireAll(const std::string& field, const std::vector<double>& values, const char* constraint, const Holds& holds)
{
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (!holds(values[i])) {
            refuseValue(field + "[" + std::to_string(i) + "]", values[i], constraint);
        }
    }
}

constexpr double kFastestWind = 1e6;

/// Wind whose drag equals a force [m/s]; empty if there is none.
std::optional<double> windBalancing(const DropletForces& forces, double force)
{
    const auto balance = [&](double wind) { return forces.drag * wind * wind - force; };
    if (!(balance(0.0) <= 0.0)) {
        return std::nullopt;
    }
    double fast = 1.0;
    while (balance(fast) < 0.0 && fast < kFastestWind) {
        fast *= 2.0;
    }
    return balance(fast) < 0.0 ? std::nullopt : std::optional(rootBetween(0.0, fast, balance));
}

}  // namespace

const char* nameOf(Regime regime)
{
    return regime == Regime::RunsDown ? "runs down" : regime == Regime::Still ? "still" : "climbs";
}

Regime regimeOf(const DropletForces& forces, double driving)
{
    return driving < -forces.retention ? Regime::RunsDown : driving > forces.retention ? Regime::Climbs : Regime::Still;
}

Thresholds thresholdsOf(const DropletForces& forces, double slope)
{
    const double weight = forces.weight * std::sin(slope);
    Thresholds found;
    found.upper = windBalancing(forces, weight + forces.retention);
    if (weight > forces.retention) {
        found.lower = windBalancing(forces, weight - forces.retention);
    }
    return found;
}

namespace {

/// Splits a range of volumes so that no balance of forces turns within a part; includes both ends.
std::vector<double> turningVolumes(const ForceModel& model, const TunnelSetting& setting, const VolumeRange& range)
{
    // The forces at 1 m³ are the factors of the powers.
    const DropletForces one = forcesOn(model, 1.0);
    const CapSize cap = capOf(1.0, model.wetting.contact_angle);
    const double weight = one.weight * std::sin(setting.slope);
    const double edge = std::pow(model.air.boundary_layer / cap.height, 3.0);
    std::vector<double> volumes{range.min, range.max};
    const auto add = [&](double volume) {
        if (volume > range.min && volume < range.max) {
            volumes.push_back(volume);
        }
    };
    add(edge);
    Air free_air = model.air;
    free_air.boundary_layer = 0.0;
    ForceModel free_model = model;
    free_model.air = free_air;
    const double full_drag = forcesOn(free_model, 1.0).drag * setting.wind * std::abs(setting.wind);
    const double n = model.air.profile_exponent;
    const double slowed_drag =
        model.air.boundary_layer > 0.0 ? full_drag * std::pow(cap.height / model.air.boundary_layer, 2.0 * n) : 0.0;
    // Terms proportional to the volume: the weight, and the retention if it is, with either sign.
    const double retention = model.wetting.sliding_angle ? one.retention : 0.0;
    for (const double held : {weight - retention, weight, weight + retention}) {
        // d/dV (D − W) V^(−1/3) = 0, with D = d V^e: V^(e − 1) = (2/3) w / ((e − 1/3) d).
        const auto add_turn = [&](double drag, double exponent) {
            if (exponent != 1.0) {
                add(std::pow(2.0 / 3.0 * held / ((exponent - 1.0 / 3.0) * drag), 1.0 / (exponent - 1.0)));
            }
        };
        add_turn(slowed_drag, (2.0 + 2.0 * n) / 3.0);
        add_turn(full_drag, 2.0 / 3.0);
    }
    std::sort(volumes.begin(), volumes.end());
    return volumes;
}

}  // namespace

std::vector<RegimeChange> regimeChanges(const ForceModel& model, const TunnelSetting& setting, const VolumeRange& range)
{
    // Divided by V^(1/3), so that droplets of all sizes have similar values.
    const auto beyond = [&](double direction) {
        return [&, direction](double log_volume) {
            const DropletForces forces = forcesOn(model, std::exp(log_volume));
            return (direction * drivingForce(forces, setting.slope, setting.wind) - forces.retention) *
                   std::exp(-log_volume / 3.0);
        };
    };
    const auto climbs = beyond(1.0);
    const auto runs_down = beyond(-1.0);
    const std::vector<double> volumes = turningVolumes(model, setting, range);
    std::vector<RegimeChange> changes;
    const auto addChange = [&](const auto& balance, Regime regime, double from, double to) {
        const double a = std::log(from);
        const double b = std::log(to);
        const bool before = balance(a) > 0.0;
        if (before != (balance(b) > 0.0)) {
            const double volume = std::exp(rootBetween(a, b, balance));
            changes.push_back({volume, before ? regime : Regime::Still, before ? Regime::Still : regime});
        }
    };
    for (std::size_t i = 0; i + 1 < volumes.size(); ++i) {
        addChange(climbs, Regime::Climbs, volumes[i], volumes[i + 1]);
        addChange(runs_down, Regime::RunsDown, volumes[i], volumes[i + 1]);
    }
    std::sort(changes.begin(), changes.end(),
              [](const RegimeChange& a, const RegimeChange& b) { return a.volume < b.volume; });
    return changes;
}

std::optional<double> criticalVolume(const ForceModel& model, double slope)
{
    // Far beyond the size of droplets at both ends.
    constexpr VolumeRange kAll{1e-30, 1e9};
    const std::vector<RegimeChange> changes = regimeChanges(model, {slope, 0.0}, kAll);
    return changes.empty() ? std::nullopt : std::optional(changes.front().volume);
}

std::optional<double> tearOffWind(const ForceModel& model, const CapSize& cap)
{
    const double wind = std::sqrt(kTearOffWeber * model.liquid.surface_tension / (model.air.density * cap.height));
    return std::isfinite(wind) ? std::optional(wind) : std::nullopt;
}

double tearOffHeight(const ForceModel& model, double wind, double weber)
{
    const Air& air = model.air;
    const double pressure = air.density * wind * wind;
    const double outside =
        pressure > 0.0 ? weber * model.liquid.surface_tension / pressure : std::numeric_limits<double>::infinity();
    // Within the layer ρ_a U² (y/δ)^(2n) y / γ is the number.
    return outside >= air.boundary_layer
               ? outside
               : air.boundary_layer * std::pow(outside / air.boundary_layer, 1.0 / (1.0 + 2.0 * air.profile_exponent));
}

void TunnelSweep::validate() const
{
    model.validate();
    const auto require_some = [](const char* field, const std::vector<double>& values) {
        if (values.empty()) {
            throw Error(ErrorCode::InvalidArgument, std::string(field) + " must hold at least one value");
        }
    };
    require_some("volumes", volumes);
    require_some("winds", winds);
    require_some("slopes", slopes);
    requireAll("volumes", volumes, "finite and more than 0 m3", [](double v) { return v > 0.0 && std::isfinite(v); });
    requireAll("winds", winds, "finite, in m/s", [](double v) { return std::isfinite(v); });
    requireAll("slopes", slopes, "from 0 to pi/2", [](double v) { return v >= 0.0 && v <= 0.5 * std::numbers::pi; });
    requireAll("hystereses", hystereses, "from 0 to 2", [](double v) { return v >= 0.0 && v <= 2.0; });
    if (!hystereses.empty() && model.wetting.sliding_angle) {
        throw Error(ErrorCode::InvalidArgument,
                    "hystereses and model.wetting.sliding_angle exclude each other: both set the retention");
    }
    double rows = static_cast<double>(std::max<std::size_t>(1, hystereses.size()));
    for (const auto* values : {&volumes, &winds, &slopes}) {
        rows *= static_cast<double>(values->size());
    }
    if (rows > static_cast<double>(kMaxTunnelRows)) {
        throw Error(ErrorCode::InvalidArgument, "a sweep has " + std::to_string(static_cast<long long>(rows)) +
                                                    " rows; at most " + std::to_string(kMaxTunnelRows) +
                                                    " are allowed");
    }
}

namespace {

/// Slope and hysteresis, common to all volumes.
struct Incline {
    ForceModel model;
    double slope = 0.0;
    std::optional<double> critical_volume;
};

std::vector<Incline> inclinesOf(const TunnelSweep& what)
{
    std::vector<Incline> inclines;
    const std::vector<double> hystereses =
        what.hystereses.empty() ? std::vector<double>{what.model.wetting.hysteresis} : what.hystereses;
    for (const double hysteresis : hystereses) {
        for (const double slope : what.slopes) {
            Incline incline{what.model, slope, {}};
            incline.model.wetting.hysteresis = hysteresis;
            inclines.push_back(incline);
        }
    }
    forBlocks(inclines.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            inclines[i].critical_volume = criticalVolume(inclines[i].model, inclines[i].slope);
        }
    });
    return inclines;
}

TunnelCase caseOf(const Incline& incline, double volume)
{
    const ForceModel& model = incline.model;
    const std::optional<double> sliding_angle = model.wetting.sliding_angle;
    TunnelCase found;
    found.hysteresis = sliding_angle ? hysteresisOf(model, *sliding_angle, volume) : model.wetting.hysteresis;
    found.slope = incline.slope;
    found.cap = capOf(volume, model.wetting.contact_angle);
    found.forces = forcesOn(model, found.cap);
    found.thresholds = thresholdsOf(found.forces, incline.slope);
    found.critical_volume = incline.critical_volume;
    found.shedding_wind = tearOffWind(model, found.cap);
    return found;
}

TunnelRow rowOf(const TunnelCase& tunnel_case, double wind)
{
    const double driving = drivingForce(tunnel_case.forces, tunnel_case.slope, wind);
    return {tunnel_case.forces.drag * wind * std::abs(wind), driving, acceleration(tunnel_case.forces, driving, 0.0),
            terminalVelocity(tunnel_case.forces, driving), regimeOf(tunnel_case.forces, driving)};
}

}  // namespace

Tunnel sweep(const TunnelSweep& what)
{
    what.validate();
    const std::vector<Incline> inclines = inclinesOf(what);
    Tunnel tunnel;
    tunnel.winds = what.winds;
    tunnel.cases.resize(inclines.size() * what.volumes.size());
    forBlocks(tunnel.cases.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            tunnel.cases[i] = caseOf(inclines[i / what.volumes.size()], what.volumes[i % what.volumes.size()]);
        }
    });
    tunnel.rows.resize(tunnel.cases.size() * what.winds.size());
    forBlocks(tunnel.rows.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            tunnel.rows[i] = rowOf(tunnel.cases[i / what.winds.size()], what.winds[i % what.winds.size()]);
        }
    });
    return tunnel;
}

std::optional<BandDistance> distanceFrom(const WindBand& measured, const Thresholds& thresholds)
{
    if (!thresholds.lower || !thresholds.upper) {
        return std::nullopt;
    }
    return BandDistance{*thresholds.lower / measured.from - 1.0, *thresholds.upper / measured.to - 1.0};
}

}  // namespace droplet
