// SPDX-License-Identifier: GPL-3.0-or-later
// Fournier, Habibi and Poulin 1998, section 2.3; hysteresis, wind and viscous drag of wind/forces.h.
#include "flow/flow_forces.h"

#include <cmath>
#include <numbers>
#include <optional>

#include "droplet/wind/forces.h"

namespace droplet {

FlowField fieldAt(const FlowParameters& parameters, double time)
{
    if (parameters.motion.rests()) {
        return {parameters.gravity, parameters.wind};
    }
    const ObjectPose pose = parameters.motion.at(time);
    return {pose.toObject(parameters.gravity), pose.toObject(parameters.wind)};
}

double contactRadius(const FlowParameters& parameters, std::uint32_t face, double volume)
{
    return capOf(volume, parameters.contactAngleOn(face)).contact_radius;
}

WalkForces forcesOn(const FlowParameters& parameters, const FlowField& field, const FlowDroplet& droplet,
                    std::optional<double> moves)
{
    const ForceModel& model = parameters.forces;
    const double angle = parameters.contactAngleOn(droplet.face);
    const CapSize cap = capOf(droplet.volume, angle);
    const DropletForces forces = forcesOn(model, cap);
    const double mass = model.liquid.density * droplet.volume;
    WalkForces result;
    result.acceleration = field.gravity;
    if (moves) {
        const Vec3 place = droplet.leg.placeAt(*moves);
        const Vec3 velocity = droplet.leg.velocityAt(*moves);
        result.acceleration = result.acceleration + parameters.motion.apparentAcceleration(*moves, place, velocity);
    }
    const double wind = length(field.wind);
    result.wind = (forces.drag * wind / mass) * field.wind;  // drag along V, over V²
    result.fall = result.acceleration;
    result.decay = parameters.friction.value_or(forces.viscous) / mass;
    result.height = cap.height;
    if (parameters.model == FlowModel::Capillary) {
        result.retention = forces.retention / mass;
        result.sliding = forces.sliding_friction / mass;
        // At a sharp edge the angle in front may be up to 180° (J. W. Gibbs), in place of the advancing angle:
        // 2 r σ π/4 (cos θ_r + 1), with cos θ_r = cos θ + Δ/2.
        const Wetting& wetting = model.wetting;
        const double behind = std::min(std::cos(angle) + 0.5 * wetting.hysteresis, 1.0);
        result.edge =
            0.5 * std::numbers::pi * cap.contact_radius * model.liquid.surface_tension * (1.0 + behind) / mass;
    }
    // a_N > D π r²/m. What surface tension holds around the contact line is 2 π r σ sin θ, so D is 2 σ sin θ / r.
    const double r = cap.contact_radius;
    const double pressure = parameters.adhesion.value_or(2.0 * model.liquid.surface_tension * std::sin(angle) / r);
    result.adhesion = pressure * std::numbers::pi * r * r / mass;
    result.contact_width = 2.0 * r;
    return result;
}

}  // namespace droplet
