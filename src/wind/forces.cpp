// SPDX-License-Identifier: GPL-3.0-or-later
//
// The thesis, chapter 3: hysteresis (3.2), wind drag (3.3), boundary layer (3.4), viscous dissipation (3.5).
//
// In (3.2) the scan lost the symbol of the radius: it is the contact radius, as in Furmidge's F = k · 2r γ (cos θ_r −
// cos θ_a) with k = π/4 for circular contact lines (ElSherbini and Jacobi, J. Colloid Interface Sci. 299 (2006) 841).
// In (3.4) the printed σ and δ are the same symbol. In (3.5) R is the radius of the droplet's sphere.
#include "droplet/wind/forces.h"

#include <cmath>
#include <numbers>
#include <sstream>

#include "entry_named.h"
#include "require.h"

namespace droplet {
namespace {

constexpr double kPi = std::numbers::pi;

bool within(double value, double min, double max)
{
    return value >= min && value <= max;  // NaN is not
}

bool atLeastZero(double value)
{
    return value >= 0.0 && std::isfinite(value);
}

/// θ − sin θ cos θ, without the cancellation of a flat cap.
double segment(double theta)
{
    const double x = 2.0 * theta;
    if (x > 0.5) {
        return 0.5 * (x - std::sin(x));
    }
    // x − sin x by its series: the term of x¹⁵ is the first below a rounding error.
    const double s = x * x;
    const double series = 1.0 - s / 20.0 * (1.0 - s / 42.0 * (1.0 - s / 72.0 * (1.0 - s / 110.0 * (1.0 - s / 156.0))));
    return 0.5 * x * s / 6.0 * series;
}

/// V / R³ of a cap: π/3 (1 − cos θ)² (2 + cos θ), and 1 − cos θ = 2 sin²(θ/2).
double volumeShare(double contact_angle)
{
    const double half = std::sin(0.5 * contact_angle);
    const double rise = 2.0 * half * half;
    return kPi / 3.0 * rise * rise * (3.0 - rise);
}

}  // namespace

void Air::validate() const
{
    require(atLeastZero(density), "air.density", density, "finite and at least 0 kg/m3");
    require(atLeastZero(drag_coefficient), "air.drag_coefficient", drag_coefficient, "finite and at least 0");
    require(atLeastZero(boundary_layer), "air.boundary_layer", boundary_layer, "finite and at least 0 m");
    require(within(profile_exponent, 0.0, 2.0), "air.profile_exponent", profile_exponent, "from 0 to 2");
}

void Wetting::validate() const
{
    require(within(contact_angle, kDegree, 179.0 * kDegree), "wetting.contact_angle", contact_angle,
            "from 1 to 179 degrees, in rad");
    require(within(hysteresis, 0.0, 2.0), "wetting.hysteresis", hysteresis, "from 0 to 2");
    if (sliding_angle) {
        require(within(*sliding_angle, 0.0, 0.5 * kPi), "wetting.sliding_angle", *sliding_angle, "from 0 to pi/2");
    }
    require(within(kinetic_fraction, 0.0, 1.0), "wetting.kinetic_fraction", kinetic_fraction, "from 0 to 1");
    require(atLeastZero(viscosity_factor), "wetting.viscosity_factor", viscosity_factor, "finite and at least 0 Pa.s");
}

void ForceModel::validate() const
{
    liquid.validate();
    require(liquid.density > 0.0, "liquid.density", liquid.density, "more than 0 kg/m3");
    air.validate();
    wetting.validate();
    require(atLeastZero(gravity), "gravity", gravity, "finite and at least 0 m/s2");
}

CapSize capOf(double volume, double contact_angle)
{
    const double radius = std::cbrt(volume / volumeShare(contact_angle));
    const double half = std::sin(0.5 * contact_angle);
    return {volume, radius, radius * std::sin(contact_angle), 2.0 * radius * half * half,
            radius * radius * segment(contact_angle)};
}

double capVolume(double contact_radius, double contact_angle)
{
    const double radius = contact_radius / std::sin(contact_angle);
    return volumeShare(contact_angle) * radius * radius * radius;
}

DropletForces forcesOn(const ForceModel& model, const CapSize& cap)
{
    const Wetting& wetting = model.wetting;
    const double mass = model.liquid.density * cap.volume;
    const double weight = mass * model.gravity;
    const double slowed = windAt(model.air, 1.0, cap.height);
    const double retention = wetting.sliding_angle ? weight * std::sin(*wetting.sliding_angle)
                                                   : 0.5 * kPi * cap.contact_radius * model.liquid.surface_tension *
                                                         wetting.hysteresis;  // (3.2)
    return {mass,
            weight,
            0.5 * model.air.density * model.air.drag_coefficient * cap.frontal_area * slowed * slowed,  // (3.3)
            retention,
            wetting.kinetic_fraction * retention,
            wetting.viscosity_factor * cap.radius};  // (3.5)
}

DropletForces forcesOn(const ForceModel& model, double volume)
{
    return forcesOn(model, capOf(volume, model.wetting.contact_angle));
}

double windAt(const Air& air, double wind, double height)
{
    if (height >= air.boundary_layer) {
        return wind;
    }
    const double depth = height / air.boundary_layer;
    return wind * (air.profile_exponent == 0.5 ? std::sqrt(depth) : std::pow(depth, air.profile_exponent));  // (3.4)
}

double drivingForce(const DropletForces& forces, double slope, double wind)
{
    return forces.drag * wind * std::abs(wind) - forces.weight * std::sin(slope);
}

double acceleration(const DropletForces& forces, double driving, double velocity)
{
    if (velocity == 0.0) {
        // A droplet that begins to move has sliding friction from then on.
        return std::abs(driving) <= forces.retention
                   ? 0.0
                   : (driving - std::copysign(forces.sliding_friction, driving)) / forces.mass;
    }
    return (driving - std::copysign(forces.sliding_friction, velocity) - forces.viscous * velocity) / forces.mass;
}

Vec2 acceleration(const DropletForces& forces, Vec2 driving, Vec2 velocity)
{
    const double speed = length(velocity);
    const double strength = length(driving);
    if (speed == 0.0) {
        return strength <= forces.retention
                   ? Vec2{}
                   : ((strength - forces.sliding_friction) / (strength * forces.mass)) * driving;
    }
    return (1.0 / forces.mass) * (driving - (forces.sliding_friction / speed + forces.viscous) * velocity);
}

std::optional<double> terminalVelocity(const DropletForces& forces, double driving)
{
    if (std::abs(driving) <= forces.retention) {
        return 0.0;
    }
    const double velocity = (driving - std::copysign(forces.sliding_friction, driving)) / forces.viscous;
    return std::isfinite(velocity) ? std::optional(velocity) : std::nullopt;
}

double hysteresisOf(const ForceModel& model, double sliding_angle, double volume)
{
    const CapSize cap = capOf(volume, model.wetting.contact_angle);
    return model.liquid.density * volume * model.gravity * std::sin(sliding_angle) /
           (0.5 * kPi * cap.contact_radius * model.liquid.surface_tension);
}

double wedgeViscosityFactor(double viscosity, double contact_angle, double radius)
{
    const double sine = std::sin(contact_angle);
    return viscosity * 2.0 * kPi * std::log(radius / kMolecularCutOff) * sine * sine / segment(contact_angle);
}

namespace {

/// Squares of the winds of the measured band: U±² = U₀² (1 ± F/W), with retention F and weight W along the plane.
constexpr double kLowerSquare = kMeasuredStillBand.from * kMeasuredStillBand.from;
constexpr double kUpperSquare = kMeasuredStillBand.to * kMeasuredStillBand.to;
constexpr double kNeutralSquare = 0.5 * (kLowerSquare + kUpperSquare);

/// Boundary layer in which a wind of √kNeutralSquare carries the weight of a droplet lower than the layer. With n = ½
/// it carries every such droplet, as S y is proportional to V_d.
double fittedBoundaryLayer(const ForcePreset& preset)
{
    const ForceModel& model = preset.model;
    const CapSize cap = capOf(preset.reference_volume, model.wetting.contact_angle);
    const double full_drag = 0.5 * model.air.density * model.air.drag_coefficient * cap.frontal_area * kNeutralSquare;
    return cap.height * full_drag / (model.liquid.density * cap.volume * model.gravity * std::sin(preset.slope));
}

ForcePreset thesis()
{
    ForcePreset preset{"thesis", {}, 35.0 * kDegree, 30e-9, {}, {}};
    preset.volumes = {5e-9, 10e-9, 20e-9, 30e-9, 50e-9, 100e-9};
    ForceModel& model = preset.model;
    model.wetting.contact_angle = 90.0 * kDegree;
    constexpr double kRetainedShare = (kUpperSquare - kLowerSquare) / (kUpperSquare + kLowerSquare);
    model.wetting.hysteresis =
        hysteresisOf(model, std::asin(kRetainedShare * std::sin(preset.slope)), preset.reference_volume);
    model.air.boundary_layer = fittedBoundaryLayer(preset);
    return preset;
}

ForcePreset hashimoto()
{
    ForcePreset preset{"hashimoto", {}, 35.0 * kDegree, 30e-9, 10.0 * kDegree, {}};
    preset.volumes = {15e-9, 20e-9, 25e-9, 30e-9};
    ForceModel& model = preset.model;
    constexpr double kContactAngle = 105.0 * kDegree;
    model.wetting.contact_angle = kContactAngle;
    model.wetting.hysteresis = hysteresisOf(model, *preset.sliding_angle, preset.reference_volume);
    model.wetting.viscosity_factor =
        wedgeViscosityFactor(kWaterViscosity, kContactAngle, capOf(preset.reference_volume, kContactAngle).radius);
    model.air.boundary_layer = fittedBoundaryLayer(preset);
    return preset;
}

}  // namespace

const std::vector<ForcePreset>& forcePresets()
{
    static const std::vector<ForcePreset> known{thesis(), hashimoto()};
    return known;
}

const ForcePreset& forcePresetNamed(std::string_view name)
{
    return entryNamed(forcePresets(), name, "preset");
}

}  // namespace droplet
