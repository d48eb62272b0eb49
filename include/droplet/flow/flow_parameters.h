// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "droplet/flow/object_motion.h"
#include "droplet/units.h"
#include "droplet/vector.h"
#include "droplet/wind/forces.h"
#include "droplet/wind/rain.h"
#include "droplet/wind/streaks.h"

namespace droplet {

/// What holds droplets on a surface.
enum class FlowModel {
    Capillary,  ///< hysteresis of the contact angle, as on the windshield: droplets stick and slip
    Paper,      ///< roughness alone (Fournier, Habibi and Poulin 1998)
};

/// Volumes of droplets: their logarithms have a normal distribution.
struct VolumeDistribution {
    double median = 20e-9;  ///< [m³], > 0
    double spread = 0.0;    ///< standard deviation of the logarithm, from 0 to 3; 0: all are equal

    /// Volume for two random numbers [m³].
    /// @param u, v  uniform in [0, 1)
    [[nodiscard]] double at(double u, double v) const;
    /// Checks both fields.
    /// @throws Error InvalidArgument if a field is out of its range
    void validate() const;
};

/// A droplet before it begins to move.
struct FlowStart {
    Vec3 place;           ///< its point on the surface; farther from it than its radius, it begins in the air [m]
    double volume = 0.0;  ///< [m³], > 0
    Vec3 velocity;        ///< [m/s]
};

/// Source that releases one droplet after another at a place.
struct FlowEmitter {
    Vec3 place;                  ///< in the frame of the object [m]
    double rate = 0.0;           ///< [m³/s], ≥ 0
    VolumeDistribution volumes;  ///< of its droplets
};

/// Rain on the whole object.
struct FlowRain {
    double rainfall = 0.0;           ///< on a plane across the rain [m/s], ≥ 0
    Vec3 from = {0.0, 0.0, 1.0};     ///< direction that the raindrops come from; not 0
    RaindropRange raindrops;         ///< diameters that are simulated
    double small_diameter = 0.5e-3;  ///< smaller raindrops are left out, with their share of the rainfall [m]
};

/// Dew on a cold object.
struct FlowCondensation {
    double rate = 0.0;      ///< growth of the mean thickness of the water [m/s], ≥ 0
    double spacing = 3e-3;  ///< mean distance of new droplets on a dry surface [m], > 0
};

/// Properties of every face. An empty array stands for the default everywhere.
struct FaceProperties {
    std::vector<Vec2> roughness;        ///< height of bumps along the face's first edge and across it [m], ≥ 0
    std::vector<double> friction;       ///< factor on viscous friction, ≥ 0; default 1
    std::vector<double> hysteresis;     ///< factor on the retention by hysteresis, ≥ 0; default 1
    std::vector<double> contact_angle;  ///< [rad], from 1° to 179°; default: that of the force model
};

/// Hysteresis of the contact angle that varies over the surface, as dirt and roughness do: droplets stick, slip and
/// wander. Only the model capillary has it.
struct FlowPinning {
    double spread = 0.5;   ///< standard deviation of its logarithm, from 0 to 1.5; 0: it is the same everywhere
    double length = 3e-3;  ///< over which it varies [m], > 0

    /// Checks both fields.
    /// @throws Error InvalidArgument if a field is out of its range
    void validate() const;
};

/// Parameters of droplets that run over a surface.
struct FlowParameters {
    FlowModel model = FlowModel::Capillary;        ///< what holds droplets
    ForceModel forces;                             ///< liquid, air, wetting; its gravity is not used
    Vec3 gravity = {0.0, 0.0, -kStandardGravity};  ///< in the world [m/s²]
    Vec3 wind;                                     ///< in the world; pushes droplets along the surface [m/s]
    ObjectMotion motion;                           ///< of the object in the world; by default it rests
    std::optional<double> friction;                ///< |k_f| [kg/s], ≥ 0; empty: viscous drag of the force model
    std::optional<double> adhesion;     ///< D [Pa], ≥ 0; empty: what surface tension holds, 2 σ sin θ / r
    double roughness = 0.0;             ///< height of the bumps where `ground` has none [m], ≥ 0
    FaceProperties ground;              ///< of single faces
    FlowPinning pinning;                ///< how hysteresis varies over the surface; its field is in the object's frame
    bool merges = true;                 ///< droplets that touch become one
    Streaks streaks;                    ///< film behind droplets, which breaks up into beads
    bool wets = true;                   ///< streaks smooth the surface: droplets run more easily where others ran
    std::optional<double> drying;       ///< time after which a streak and its beads are dry [s], > 0; empty: never
    std::vector<FlowEmitter> emitters;  ///< sources at places
    std::optional<FlowRain> rain;       ///< rain on the whole object
    std::optional<FlowCondensation> condensation;  ///< dew
    double small_volume = 1e-13;                   ///< droplets from drying and beads of less vanish [m³], > 0
    double step = 1.0 / 120.0;  ///< droplets merge, arrive and dry at multiples of this time [s], > 0
    std::uint64_t seed = 1;     ///< of all random numbers

    /// Contact angle on a face [rad].
    /// @param face  number in FlowSurface::faces
    [[nodiscard]] double contactAngleOn(std::uint32_t face) const
    {
        return ground.contact_angle.empty() ? forces.wetting.contact_angle : ground.contact_angle[face];
    }

    /// Checks all fields.
    /// @param faces   of the surface
    /// @throws Error InvalidArgument, naming field, value and what is allowed
    void validate(std::size_t faces) const;
};

}  // namespace droplet
