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

/// Viscosity factor ηf of eq. 3.5 that the thesis chose by eye (section 3.2) [Pa·s].
inline constexpr double kArtisticViscosityFactor = 0.5;
/// Cut-off length λ of wedge theory: size of a molecule [m].
inline constexpr double kMolecularCutOff = 1e-9;
/// Viscosity of water at 20 °C (IAPWS 2008) [Pa·s].
inline constexpr double kWaterViscosity = 1.002e-3;

/// Air and its boundary layer at the glass (thesis, eqs. 3.3 and 3.4).
struct Air {
    double density = 1.204;          ///< ρ_a [kg/m³], ≥ 0; at 20 °C and 1013 hPa
    double drag_coefficient = 1.0;   ///< C_D, ≥ 0
    double boundary_layer = 6.8e-3;  ///< δ, thickness of the boundary layer [m], ≥ 0; 0: the full wind everywhere
    double profile_exponent = 0.5;   ///< n, from 0 to 2: ½ in the thesis, 1/7 in a turbulent layer

    friend bool operator==(const Air&, const Air&) = default;  ///< Compares all members.

    /// Checks all fields.
    /// @throws Error InvalidArgument if a field is out of its range
    void validate() const;
};

/// Adhesion of a liquid to a coating.
struct Wetting {
    double contact_angle = 105.0 * kDegree;  ///< θ [rad], from 1° to 179°
    double hysteresis = 0.2;                 ///< Δ = cos θ_r − cos θ_a of eq. 3.2, from 0 to 2
    /// Slope at which droplets of every volume begin to run [rad], from 0 to π/2. If given, it replaces eq. 3.2: the
    /// retention is m g sin(sliding_angle). See hysteresisOf() for an angle measured at one volume.
    std::optional<double> sliding_angle = {};
    double kinetic_fraction = 1.0;                       ///< sliding friction over retention, from 0 to 1
    double viscosity_factor = kArtisticViscosityFactor;  ///< ηf of eq. 3.5 [Pa·s], ≥ 0

    /// Checks all fields.
    /// @throws Error InvalidArgument if a field is out of its range
    void validate() const;
};

/// Constants of the forces on a droplet: all except its size, the slope and the wind.
struct ForceModel {
    Liquid liquid = {};                 ///< liquid of the droplets; its density is above 0
    Air air = {};                       ///< air and boundary layer
    Wetting wetting = {};               ///< adhesion to the ground
    double gravity = kStandardGravity;  ///< g [m/s²], ≥ 0

    /// Checks all fields.
    /// @throws Error InvalidArgument if a field is out of its range
    void validate() const;
};

/// Size of a spherical cap.
struct CapSize {
    double volume = 0.0;          ///< V_d [m³]
    double radius = 0.0;          ///< R, radius of the sphere [m]
    double contact_radius = 0.0;  ///< r, radius of the contact circle [m]
    double height = 0.0;          ///< y [m]
    double frontal_area = 0.0;    ///< S, area that faces the wind along the glass [m²]
};

/// Size of the cap with a given volume.
/// @param volume         [m³], > 0
/// @param contact_angle  θ [rad], in (0, π)
CapSize capOf(double volume, double contact_angle);

/// Volume of the cap with a given contact radius [m³].
/// @param contact_radius  r [m], ≥ 0
/// @param contact_angle   θ [rad], in (0, π)
double capVolume(double contact_radius, double contact_angle);

/// Coefficients of the forces on one droplet; independent of slope, wind and speed.
struct DropletForces {
    double mass = 0.0;              ///< m [kg]
    double weight = 0.0;            ///< m g [N]
    double drag = 0.0;              ///< wind drag over the square of the free wind V, eqs. 3.3 and 3.4 [N s²/m²]
    double retention = 0.0;         ///< F_max, largest force that a droplet at rest resists, eq. 3.2 [N]
    double sliding_friction = 0.0;  ///< friction on a moving droplet [N]
    double viscous = 0.0;           ///< viscous drag over the speed, eq. 3.5 [N s/m]
};

/// Forces on a droplet with the shape of a cap.
/// @param model  valid
/// @param cap    cap with the model's contact angle
DropletForces forcesOn(const ForceModel& model, const CapSize& cap);
/// Forces on a droplet with a given volume.
/// @param model   valid
/// @param volume  [m³], > 0
DropletForces forcesOn(const ForceModel& model, double volume);

/// Wind at a height over the glass, Ṽ of eq. 3.4 [m/s].
/// @param air     valid
/// @param wind    V, of either sign [m/s]
/// @param height  y [m], ≥ 0
double windAt(const Air& air, double wind, double height);

/// Driving force on a droplet on a plane, positive up the slope: drag of a wind up the slope minus the component of the
/// weight along the slope [N].
///
/// The thesis calls the wind horizontal. In the boundary layer of eq. 3.4 air can only flow along the glass, so the
/// whole wind counts at every slope. As in the thesis, the droplet's own speed is not subtracted from the wind: it is
/// small. So the terminal speed is (|driving force| − friction) / viscous.
/// @param forces  forces of forcesOn()
/// @param slope   α, from the horizontal [rad]
/// @param wind    V, up the slope [m/s]
double drivingForce(const DropletForces& forces, double slope, double wind);

/// Acceleration of a droplet under a driving force [m/s²].
///
/// Retention acts as Coulomb friction: at rest it cancels a driving force up to `retention`, and the droplet stays at
/// rest. In motion `sliding_friction` and viscous drag oppose the velocity.
/// @param forces    forces of forcesOn()
/// @param driving   sum of all other forces along the plane [N]
/// @param velocity  [m/s]; exactly 0: at rest
double acceleration(const DropletForces& forces, double driving, double velocity);
/// Acceleration of a droplet that moves in two dimensions on the plane [m/s²].
Vec2 acceleration(const DropletForces& forces, Vec2 driving, Vec2 velocity);

/// Limit of a droplet's velocity, with the sign of the driving force [m/s]; 0 if friction holds the droplet; empty if
/// nothing limits it.
std::optional<double> terminalVelocity(const DropletForces& forces, double driving);

/// Hysteresis Δ from a sliding angle that was measured at one volume: eq. 3.2 solved for Δ. Smaller droplets then begin
/// to run at steeper slopes, larger ones at shallower slopes.
/// @param model          valid
/// @param sliding_angle  [rad], from 0 to π/2
/// @param volume         [m³], > 0
/// @return               Δ; above 2, which Wetting rejects, if no pair of contact angles holds such a droplet
double hysteresisOf(const ForceModel& model, double sliding_angle, double volume);

/// Factor ηf of eq. 3.5 from wedge theory: f ≈ 2π ln(R/λ) sin²θ / (θ − sin θ cos θ) [Pa·s].
/// @param viscosity      η [Pa·s]
/// @param contact_angle  θ [rad], in (0, π)
/// @param radius         R [m], above λ = kMolecularCutOff
double wedgeViscosityFactor(double viscosity, double contact_angle, double radius);

/// Range of wind speeds.
struct WindBand {
    double from = 0.0;  ///< lower end [m/s]
    double to = 0.0;    ///< upper end [m/s]
};

/// Winds in which droplets of every size stay at rest on the plane of Hashimoto et al. (thesis, figure 3.3 and section
/// 3.1.4).
inline constexpr WindBand kMeasuredStillBand{7.0, 11.0};

/// Named force model and the plane that it describes.
struct ForcePreset {
    std::string name;                     ///< unique
    ForceModel model;                     ///< valid
    double slope = 35.0 * kDegree;        ///< α [rad]
    double reference_volume = 30e-9;      ///< volume of the droplets that the model was fitted to [m³]
    std::optional<double> sliding_angle;  ///< sliding angle of the reference volume, if it was measured [rad]
    std::vector<double> volumes;          ///< default volumes of a sweep [m³]
};

/// All presets:
/// - `thesis`: hemispheres under eqs. 3.2 to 3.5 with n = ½ and ηf = 0.5. The thesis does not give Δ and δ/C_D of its
///   figure 3.5; here they are chosen so that a droplet of 30 µL is still between 7 and 11 m/s, as measured.
/// - `hashimoto`: the measured plane: contact angle 105°, slope 35°, sliding angle 10° (we assume: of 30 µL), and ηf of
///   wedge theory. Only δ/C_D is fitted: the wind that cancels the weight along the slope is the middle of the measured
///   band, √((7² + 11²)/2) = 9.2 m/s. The width of the band follows from the model.
const std::vector<ForcePreset>& forcePresets();

/// Preset with a given name.
/// @throws Error InvalidArgument if there is none; the message lists all names
const ForcePreset& forcePresetNamed(std::string_view name);

}  // namespace droplet
