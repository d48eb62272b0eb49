// SPDX-License-Identifier: GPL-3.0-or-later
//
// A droplet is a point that slides over the ground. In a round bowl the ground at this point is normal to g − a, where
// a is its acceleration, as the surface of liquid that swings to and fro as a whole.
#include "flow/ponds.h"

#include <cmath>

#include "flow/flow_terrain_content.h"

namespace droplet {

Standing standingOf(const PondField& at, const FlowDroplet& droplet)
{
    return {droplet.leg.placeAt(at.time), contactRadius(at.parameters, droplet.face, droplet.volume)};
}

RestingLiquid restingLiquid(const PondField& at, const FlowDroplet& droplet, const Standing& standing)
{
    const FlowParameters& p = at.parameters;
    const Liquid& liquid = p.forces.liquid;
    const double angle = p.contactAngleOn(droplet.face);
    const double puddle =
        2.0 * std::sqrt(liquid.surface_tension / (liquid.density * length(at.field.gravity))) * std::sin(0.5 * angle);
    return {droplet.face, standing.place, droplet.volume, standing.radius, angle, puddle};
}

std::optional<FilledHollow> pondOf(const PondField& at, const FlowDroplet& droplet, const Standing& standing)
{
    if (droplet.contact == FlowContact::Air || !(droplet.volume > 0.0) || !(length(at.field.gravity) > 0.0)) {
        return std::nullopt;
    }
    const RestingLiquid liquid = restingLiquid(at, droplet, standing);
    const Vec3 velocity = droplet.leg.velocityAt(at.time);
    Vec3 felt = at.field.gravity;
    if (!at.parameters.motion.rests()) {
        felt = felt + at.parameters.motion.apparentAcceleration(at.time, liquid.place, velocity);
    }
    if (!at.terrain.motion.rests()) {
        felt = felt + at.terrain.feltOn(droplet, at.time);
    }
    const auto across = [&](Vec3 g) -> std::optional<FilledHollow> {
        const double size = length(g);
        return size > 0.0 ? pondAround(at.terrain.surface, (-1.0 / size) * g, liquid) : std::nullopt;
    };
    if (droplet.contact != FlowContact::Still) {
        if (auto sloshing = across(felt - (droplet.leg.push - droplet.leg.decay * velocity))) {
            return sloshing;
        }
    }
    return across(felt);
}

}  // namespace droplet
