// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "droplet/flow_io/droplet_surfaces.h"

namespace droplet {
namespace {

/// Part of a vector along the surface.
Vec3 alongSurface(Vec3 v, Vec3 normal)
{
    return v - dot(v, normal) * normal;
}

/// Direction of a vector along the surface, or zero if it has none but rounding errors.
Vec3 directionAlong(Vec3 v, Vec3 normal)
{
    constexpr double kLeast = 1e-9;  // of the vector
    const Vec3 along = alongSurface(v, normal);
    const double size = length(along);
    if (!(size > kLeast * length(v))) {
        return {};
    }
    const Vec3 unit = alongSurface((1.0 / size) * along, normal);  // removes the rounding error of a small difference
    return (1.0 / length(unit)) * unit;
}

}  // namespace

DropletFrame frameOf(const FlowSample& sample, Vec3 gravity)
{
    DropletFrame frame;
    frame.place = sample.place;
    frame.normal = length(sample.normal) > 0.5 ? sample.normal : Vec3{0.0, 0.0, 1.0};
    const Vec3 n = frame.normal;
    const Vec3 fixed = std::abs(n.x) < 0.9 ? Vec3{1.0, 0.0, 0.0} : Vec3{0.0, 1.0, 0.0};
    for (const Vec3 candidate : {sample.velocity, gravity, fixed}) {
        frame.ahead = directionAlong(candidate, n);
        if (frame.ahead != Vec3{}) {
            break;
        }
    }
    frame.left = cross(n, frame.ahead);
    return frame;
}

BodyConditions conditionsOf(const FlowSample& sample, Vec3 gravity)
{
    const DropletFrame frame = frameOf(sample, gravity);
    BodyConditions conditions;
    conditions.volume = sample.volume;
    conditions.contact_angle = sample.contact_angle;
    conditions.airborne = sample.contact == FlowContact::Air;
    conditions.speed = length(alongSurface(sample.velocity, frame.normal));
    conditions.gravity = {dot(gravity, frame.ahead), dot(gravity, frame.left), dot(gravity, frame.normal)};
    return conditions;
}

}  // namespace droplet
