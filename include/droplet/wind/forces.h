// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "droplet/liquid.h"
#include "droplet/units.h"
#include "droplet/vector.h"

namespace droplet {

/// Viscosity factors ηf of eq. 3.5: the one that the thesis chose for its looks (section 3.2) [Pa·s].
inline constexpr double kArtisticViscosityFactor = 0.5;
/// Where a wedge of liquid ends in molecules: the cut-off λ of wedge theory [m].
inline constexpr double kMolecularCutOff = 1e-9;
/// Water at 20 °C (IAPWS 2008) [Pa·s].
inline constexpr double kWaterViscosity = 1.002e-3;

/// The air, and how it is slowed down near the glass (thesis, eqs. 3.3 and 3.4).
struct Air {
    double density = 1.204;         ///< ρ_a [kg/m³], ≥ 0; at 20 °C and 1013 hPa
    double drag_coefficient = 1.0;  ///< C_D, ≥ 0
    double boundary_layer =
        6.8e-3;  ///< δ, thickness of what the glass slows down [m], ≥ 0; 0: the full wind everywhere
    double profile_exponent = 0.5;  ///< n, from 0 to 2: ½ in the thesis, 1/7 of a turbulent layer

    /// @throws Error InvalidArgument
    void validate() const;
};

/// How a liquid and a coating hold on to one another.
struct Wetting {
    double contact_angle = 105.0 * kDegree;  ///< θ [rad], from 1° to 179°
    double hysteresis = 0.2;                 ///< Δ = cos θ_r − cos θ_a of eq. 3.2, from 0 to 2
    /// Slope at which droplets of every volume begin to run [rad], from 0 to π/2. If given, it stands in for eq. 3.2:
    /// the limit of retention is m g sin of it. See hysteresisOf() for an angle measured at one volume.
    std::optional<double> falling_angle = {};
    double kinetic_fraction = 1.0;                       ///< of the limit that still holds while moving, from 0 to 1
    double viscosity_factor = kArtisticViscosityFactor;  ///< ηf of eq. 3.5 [Pa·s], ≥ 0

    /// @throws Error InvalidArgument
    void validate() const;
};

/// Everything the forces on droplets depend on but their size, the slope and the wind.
struct ForceModel {
    Liquid liquid = {};
    Air air = {};
    Wetting wetting = {};
    double gravity = kStandardGravity;  ///< g [m/s²], ≥ 0

    /// Guarantees: returns only when every field is in its documented range.
    /// @throws Error InvalidArgument
    void validate() const;
};

/// A spherical cap.
struct CapSize {
    double volume = 0.0;          ///< V_d [m³]
    double radius = 0.0;          ///< R, of its sphere [m]
    double contact_radius = 0.0;  ///< r, of its contact circle [m]
    double height = 0.0;          ///< y [m]
    double frontal_area = 0.0;    ///< S, as the wind along the glass sees it [m²]
};

/// The cap of a volume.
/// @param volume         [m³], > 0
/// @param contact_angle  θ [rad], in (0, π)
CapSize capOf(double volume, double contact_angle);

/// Volume of the cap that has a contact radius [m³].
/// @param contact_radius  r [m], ≥ 0
double capVolume(double contact_radius, double contact_angle);

/// What acts on one droplet, as far as it is its own: neither slope nor wind nor speed is in it.
struct DropletForces {
    double mass = 0.0;              ///< m [kg]
    double weight = 0.0;            ///< m g [N]
    double drag = 0.0;              ///< wind drag per square of the free wind's speed V, eqs. 3.3 and 3.4 [N s²/m²]
    double retention = 0.0;         ///< F_max, what holds a droplet at rest, eq. 3.2 [N]
    double sliding_friction = 0.0;  ///< what is left of it while moving [N]
    double viscous = 0.0;           ///< drag per speed, eq. 3.5 [N s/m]
};

/// @param model  valid
DropletForces forcesOn(const ForceModel& model, const CapSize& cap);
DropletForces forcesOn(const ForceModel& model, double volume);

/// The wind at a height over the glass, Ṽ of eq. 3.4 [m/s].
/// @param wind    V, of either sign [m/s]
/// @param height  y [m], ≥ 0
double windAt(const Air& air, double wind, double height);

/// What drives a droplet on a plane, up the slope positive: the drag of a wind that blows up along the plane, less
/// gravity's part along it [N].
///
/// The thesis calls the wind horizontal. In the boundary layer that eq. 3.4 describes air can only flow along the
/// glass, so all of the wind counts, whatever the slope. The droplet's own speed, small against the wind's, is not
/// taken from it, as in the thesis: so that the terminal speed is (|driving force| − friction) / viscous.
/// @param slope  α, from the horizontal [rad]
/// @param wind   V, up the slope [m/s]
double drivingForce(const DropletForces& forces, double slope, double wind);

/// Acceleration of a droplet under a driving force [m/s²].
///
/// Retention acts as Coulomb's friction: at rest it cancels up to `retention`, and the droplet stays at rest; in motion
/// `sliding_friction` opposes the velocity, as does viscous drag.
/// @param driving   sum of all other forces along the plane [N]
/// @param velocity  [m/s]; exactly 0: at rest
double acceleration(const DropletForces& forces, double driving, double velocity);
/// The same of a droplet that moves anywhere on the plane.
Vec2 acceleration(const DropletForces& forces, Vec2 driving, Vec2 velocity);

/// The speed, of the driving force's sign, that a droplet tends to [m/s]; 0 if friction holds it; empty if nothing
/// limits it.
std::optional<double> terminalVelocity(const DropletForces& forces, double driving);

/// Which hysteresis Δ droplets have of which those of one volume begin to run at a falling angle: eq. 3.2 solved for Δ.
/// Smaller droplets then run at steeper slopes, larger ones at shallower.
/// @param falling_angle  [rad], from 0 to π/2
/// @param volume         [m³], > 0
/// @return               Δ; over 2, and refused by Wetting, where no pair of contact angles holds so much
double hysteresisOf(const ForceModel& model, double falling_angle, double volume);

/// The factor ηf of eq. 3.5 from wedge theory: f ≈ 2π ln(R/λ) sin²θ / (θ − sin θ cos θ) [Pa·s].
/// @param viscosity  η [Pa·s]
/// @param radius     R [m], over λ = kMolecularCutOff
double wedgeViscosityFactor(double viscosity, double contact_angle, double radius);

/// A wind [m/s] between two others.
struct WindBand {
    double from = 0.0;
    double to = 0.0;
};

/// Between which winds droplets stay on the plane of Hashimoto et al., whatever their size (thesis, figure 3.3 and
/// section 3.1.4).
inline constexpr WindBand kMeasuredStillBand{7.0, 11.0};

/// Forces by a name, and the plane they were meant for.
struct ForcePreset {
    std::string name;
    ForceModel model;
    double slope = 35.0 * kDegree;        ///< α [rad]
    double reference_volume = 30e-9;      ///< droplets that the model was fitted to [m³]
    std::optional<double> falling_angle;  ///< of the reference volume, where it was given [rad]
    std::vector<double> volumes;          ///< worth a look [m³]
};

/// The presets known by name:
/// - `thesis`: hemispheres under eqs. 3.2 to 3.5 with n = ½ and ηf = 0.5. The thesis does not tell Δ and δ/C_D of its
///   figure 3.5; here they are those with which a droplet of 30 µL stays still between 7 and 11 m/s, as measured.
/// - `hashimoto`: the measured plane: contact angle 105°, slope 35°, falling angle 10°, which we take to be that of 30
///   µL, and ηf of wedge theory. Only δ/C_D is fitted, so that the wind that neither lets droplets down nor drives them
///   up is the measured band's middle, √((7² + 11²)/2) = 9.2 m/s; the band's width is the model's own.
const std::vector<ForcePreset>& forcePresets();

/// @throws Error InvalidArgument, listing the names known
const ForcePreset& forcePresetNamed(std::string_view name);

}  // namespace droplet
