// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/flow/object_motion.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "require.h"
#include "rotation.h"

namespace droplet {
namespace {

Rotation turnOf(const ObjectPose& pose)
{
    return {pose.axis, pose.real};
}

/// Constant velocities: of the pivot, and angular, in the world.
struct Piece {
    double begin = 0.0;  ///< [s]
    Rotation turn;       ///< at begin
    Vec3 place;          ///< of the pivot at begin
    Vec3 velocity;       ///< of the pivot [m/s]
    Vec3 spin;           ///< [rad/s]
};

Piece pieceAt(const ObjectMotion& motion, double time)
{
    if (motion.keys.empty()) {
        return {0.0, {}, motion.pivot, {}, motion.spin};
    }
    const auto after = std::upper_bound(motion.keys.begin(), motion.keys.end(), time,
                                        [](double t, const ObjectMotion::Key& key) { return t < key.time; });
    const ObjectMotion::Key& from = after == motion.keys.begin() ? *after : *(after - 1);
    const auto pivot_of = [&](const ObjectPose& pose) { return pose.place + pose.toWorld(motion.pivot); };
    Piece piece{from.time, turnOf(from.pose), pivot_of(from.pose), {}, {}};
    if (after != motion.keys.begin() && after != motion.keys.end()) {
        const double rate = 1.0 / (after->time - from.time);
        piece.velocity = rate * (pivot_of(after->pose) - piece.place);
        piece.spin = rate * vectorOf(turnOf(after->pose) * piece.turn.inverse());
    }
    return piece;
}

}  // namespace

Vec3 ObjectPose::toWorld(Vec3 direction) const
{
    return turnOf(*this).of(direction);
}

Vec3 ObjectPose::toObject(Vec3 direction) const
{
    return turnOf(*this).inverse().of(direction);
}

bool ObjectMotion::rests() const
{
    if (keys.empty()) {
        return spin == Vec3{};
    }
    return std::all_of(keys.begin(), keys.end(), [](const Key& key) { return key.pose == ObjectPose{}; });
}

ObjectPose ObjectMotion::at(double time) const
{
    const Piece piece = pieceAt(*this, time);
    const double passed = time - piece.begin;
    Rotation turn = piece.turn;
    if (piece.spin != Vec3{}) {
        turn = rotationBy(passed * piece.spin) * turn;
    }
    const Vec3 pivot_at = piece.place + passed * piece.velocity;
    return {pivot_at - turn.of(pivot), turn.axis, turn.real};
}

Vec3 ObjectMotion::apparentAcceleration(double time, Vec3 place, Vec3 velocity) const
{
    const Piece piece = pieceAt(*this, time);
    if (piece.spin == Vec3{}) {
        return {};
    }
    // The angular velocity does not change by the turn that it causes itself.
    const Vec3 spin_here = piece.turn.inverse().of(piece.spin);
    return -1.0 * (cross(spin_here, cross(spin_here, place - pivot)) + 2.0 * cross(spin_here, velocity));
}

void ObjectMotion::validate() const
{
    const auto is_finite = [](Vec3 a) { return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z); };
    require(is_finite(spin), "motion.spin", length(spin), "finite");
    require(is_finite(pivot), "motion.pivot", length(pivot), "finite");
    for (std::size_t i = 0; i < keys.size(); ++i) {
        const auto& [time, pose] = keys[i];
        const std::string name = "motion.keys[" + std::to_string(i) + "].";
        const double size = std::hypot(length(pose.axis), pose.real);
        constexpr double kUnit = 1e-6;
        if (!std::isfinite(time) || (i > 0 && time < keys[i - 1].time)) {
            refuseValue(name + "time", time, "finite, and not before the key before it");
        }
        if (!is_finite(pose.place)) {
            refuseValue(name + "place", length(pose.place), "finite");
        }
        if (!(std::abs(size - 1.0) <= kUnit)) {
            refuseValue(name + "quaternion's length", size, "1");
        }
    }
}

}  // namespace droplet
