// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/flow/object_motion.h"

namespace droplet {

Vec3 ObjectPose::toWorld(Vec3 direction) const
{
    const Vec3 twice = 2.0 * cross(axis, direction);
    return direction + real * twice + cross(axis, twice);
}

Vec3 ObjectPose::toObject(Vec3 direction) const
{
    return ObjectPose{{}, -1.0 * axis, real}.toWorld(direction);
}

bool ObjectMotion::rests() const
{
    return keys.empty() && spin == Vec3{};
}

ObjectPose ObjectMotion::at(double /*time*/) const
{
    return {};
}

Vec3 ObjectMotion::apparentAcceleration(double /*time*/, Vec3 /*place*/, Vec3 /*velocity*/) const
{
    return {};
}

void ObjectMotion::validate() const {}

}  // namespace droplet
