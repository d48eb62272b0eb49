// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/flow_io/flow_points.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <numbers>
#include <ostream>
#include <string>
#include <utility>

#include "byte_stream.h"
#include "droplet/error.h"
#include "droplet/flow_io/droplet_surfaces.h"
#include "droplet/version.h"
#include "flow/following.h"
#include "flow_io/unit_bodies.h"
#include "require.h"
#include "scene/write_scene.h"

namespace droplet {
namespace {

/// Prototypes of a point instancer, in their order.
constexpr std::uint32_t kResting = 0;
constexpr std::uint32_t kRunning = 1;
constexpr std::uint32_t kFalling = 2;

std::uint32_t prototypeOf(const FlowPoint& point)
{
    return !point.face ? kFalling : point.velocity != Vec3{} ? kRunning : kResting;
}

/// Mean volume of points, of their logarithms.
double usualVolume(std::span<const std::vector<FlowPoint>> frames)
{
    constexpr double kUsual = 20e-9;
    double logarithms = 0.0;
    std::size_t count = 0;
    for (const std::vector<FlowPoint>& points : frames) {
        for (const FlowPoint& point : points) {
            logarithms += std::log(point.volume);
            ++count;
        }
    }
    return count > 0 ? std::exp(logarithms / static_cast<double>(count)) : kUsual;
}

/// Scales of a prototype, +Y off the ground.
Vec3 scalesOf(const FlowPoint& point, double unit)
{
    if (prototypeOf(point) == kFalling) {
        const double size = std::cbrt(point.volume / unit);
        return {size, size, size};
    }
    const double along = point.elongation * point.radius;
    return {along, point.volume / (unit * along * point.radius), point.radius};
}

/// Sets the angular velocity of a point by its rotation in the next frame, and gives its own quaternion the nearer
/// sign.
void leadTo(const Float4& next, double frames_per_second, ScenePointFrame& frame, std::size_t i)
{
    const auto quaternion = [](const Float4& turn) { return Eigen::Quaternionf(turn.data()).cast<double>(); };
    Float4& turn = frame.rotations[i];
    if (quaternion(turn).dot(quaternion(next)) < 0.0) {
        std::transform(turn.begin(), turn.end(), turn.begin(), [](float part) { return 0.0F - part; });
    }
    const Eigen::AngleAxisd change(quaternion(next) * quaternion(turn).conjugate());
    constexpr double kParts = 1e3;
    const Eigen::Vector3d velocity = (change.angle() / kDegree * frames_per_second) * change.axis();
    for (Eigen::Index k = 0; k < 3; ++k) {
        frame.angular_velocities[i][static_cast<std::size_t>(k)] =
            toFloat(std::round(kParts * velocity[k]) / kParts + 0.0);
    }
}

ScenePointFrame sceneFrame(const std::vector<FlowPoint>& points, double unit)
{
    ScenePointFrame frame;
    frame.values.resize(4);
    for (const FlowPoint& point : points) {
        frame.ids.push_back(static_cast<std::int64_t>(point.id));
        frame.meshes.push_back(prototypeOf(point));
        frame.translations.push_back(sceneVector(point.place));
        frame.velocities.push_back(sceneVector(point.velocity));
        frame.rotations.push_back(turnOf(DropletFrame{point.place, point.axes[0], point.axes[1], point.axes[2]}));
        frame.angular_velocities.push_back({});
        const Vec3 scales = scalesOf(point, unit);
        frame.scales.push_back({toFloat(scales.x), toFloat(scales.y), toFloat(scales.z)});
        const std::array values{point.age, point.elongation, point.radius, point.volume};
        for (std::size_t k = 0; k < values.size(); ++k) {
            frame.values[k].push_back(toFloat(values[k]));
        }
    }
    return frame;
}

}  // namespace

void UsdPointsOptions::validate() const
{
    require(frames_per_second > 0.0 && std::isfinite(frames_per_second), "frames_per_second", frames_per_second,
            "finite and more than 0");
    require(gravity >= 0.0 && std::isfinite(gravity), "gravity", gravity, "finite and at least 0");
}

std::vector<FlowPoint> flowPoints(std::span<const FlowSample> samples, const FlowTerrain& terrain,
                                  const DropletBodies& bodies, Vec3 gravity)
{
    std::vector<FlowPoint> points;
    points.reserve(samples.size());
    for (const FlowSample& sample : samples) {
        const DropletFrame frame = frameOf(sample, gravity);
        FlowPoint point{sample.id,
                        sample.place,
                        sample.velocity,
                        sample.volume,
                        0.0,
                        1.0,
                        {frame.ahead, frame.left, frame.normal},
                        sample.age,
                        {}};
        if (sample.contact == FlowContact::Air) {
            point.radius = std::cbrt(0.75 * sample.volume / std::numbers::pi);
        } else {
            if (sample.pond) {
                point.radius = std::sqrt(sample.pond->area / std::numbers::pi);
            } else {
                const Vec2 half = halfSizes(bodies, conditionsOf(sample, gravity));
                point.radius = half.y;
                point.elongation = half.x / half.y;
            }
            const FlowSurface::Face& face = terrain.surface().faces[*sample.face];
            point.face = face.source;
            if (const GroundMotion& ground = terrain.motion(); !ground.rests()) {
                point.velocity =
                    point.velocity + mixed(ground.velocity[*sample.face], weightsOn(face.corners, sample.place));
            }
        }
        points.push_back(point);
    }
    return points;
}

std::array<double, 4> rotationOf(const FlowPoint& point)
{
    Eigen::Matrix3d turned;
    for (int k = 0; k < 3; ++k) {
        const Vec3& axis = point.axes[static_cast<std::size_t>(k)];
        turned.col(k) = Eigen::Vector3d(axis.x, axis.y, axis.z);
    }
    const Eigen::Quaterniond turn(turned);
    const double sign = turn.w() < 0.0 ? -1.0 : 1.0;
    return {sign * turn.x() + 0.0, sign * turn.y() + 0.0, sign * turn.z() + 0.0, sign * turn.w()};
}

std::uint64_t writePointsAsPly(std::span<const FlowPoint> points, std::ostream& out)
{
    ByteStream bytes(out);
    std::string head = std::string("ply\nformat binary_little_endian 1.0\ncomment droplet-shape ") + kVersion +
                       "\nelement vertex " + std::to_string(points.size()) + "\n";
    for (const char* const name :
         {"x", "y", "z", "nx", "ny", "nz", "velocity_x", "velocity_y", "velocity_z", "rotation_x", "rotation_y",
          "rotation_z", "rotation_w", "radius", "elongation", "volume", "age"}) {
        head += std::string("property float ") + name + "\n";
    }
    bytes.text(head + "property uint id\nproperty int face\nend_header\n");
    for (const FlowPoint& point : points) {
        for (const Vec3& v : {point.place, point.axes[2], point.velocity}) {
            bytes.f32(v.x, v.y, v.z);
        }
        const auto [x, y, z, w] = rotationOf(point);
        bytes.f32(x, y, z, w, point.radius, point.elongation, point.volume, point.age);
        constexpr auto kNone = std::numeric_limits<std::uint32_t>::max();  // −1
        bytes.u32(static_cast<std::uint32_t>(point.id), point.face.value_or(kNone));
    }
    return bytes.finish();
}

std::uint64_t writePointsAsUsd(std::span<const std::vector<FlowPoint>> frames, const DropletBodies& bodies,
                               const UsdPointsOptions& options, std::ostream& out, Format format)
{
    options.validate();
    if (frames.empty()) {
        throw Error(ErrorCode::InvalidArgument, "frames is empty; points over time must have at least one frame");
    }
    constexpr std::uint32_t kAround = 32;
    const double unit = unitVolume(bodies);
    const UnitDroplets droplets = unitDroplets(bodies, usualVolume(frames), options.gravity, kAround);
    Scene scene;
    scene.frames_per_second = options.frames_per_second;
    const std::size_t material = scene.addMaterial(liquidMaterial(lookOf(options.material), 0.0));
    ScenePoints points{"droplets", {}, {"age", "elongation", "radius", "volume"}, {}};
    // As kResting, kRunning and kFalling.
    points.meshes = {scene.addMesh(sceneMesh(droplets.resting, "resting", material)),
                     scene.addMesh(sceneMesh(droplets.running, "running", material)),
                     scene.addMesh(sceneMesh(droplets.falling, "falling", material))};
    std::map<std::uint64_t, std::size_t> later;  // indices of the next frame's points by id
    points.frames.resize(frames.size());
    for (std::size_t k = frames.size(); k-- > 0;) {
        ScenePointFrame& frame = points.frames[k];
        frame = sceneFrame(frames[k], unit);
        std::map<std::uint64_t, std::size_t> indices;
        for (std::size_t i = 0; i < frames[k].size(); ++i) {
            const FlowPoint& point = frames[k][i];
            indices.emplace(point.id, i);
            const auto next = later.find(point.id);
            if (next != later.end() && point.face && frames[k + 1][next->second].face) {
                leadTo(points.frames[k + 1].rotations[next->second], options.frames_per_second, frame, i);
            }
        }
        later = std::move(indices);
    }
    scene.points = std::move(points);
    return writeScene(scene, out, {format});
}

}  // namespace droplet
