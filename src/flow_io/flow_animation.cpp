// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/flow_io/flow_animation.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "droplet/error.h"
#include "droplet/flow_io/droplet_surfaces.h"
#include "flow_io/unit_bodies.h"
#include "io/axes.h"
#include "io/gltf_model.h"
#include "io/scene_of_joints.h"
#include "require.h"

namespace droplet {
namespace {

std::array<float, 3> floatsOf(Vec3 v)
{
    return {toFloat(v.x), toFloat(v.y), toFloat(v.z)};
}

/// Object and streaks in the model.
class ObjectMeshes {
public:
    ObjectMeshes(const FlowObject& object, const std::optional<Surface>& streaks)
        : names_(object.material_names), object_{object.positions, object.normals, {}, object.uvs}
    {
        // Triangles of a material are neighbours, in the order of the materials.
        std::vector<std::size_t> order(object.triangles.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        const auto material = [&](std::size_t i) {
            return object.materials.empty() ? 0 : static_cast<std::size_t>(object.materials[i]);
        };
        std::stable_sort(order.begin(), order.end(),
                         [&](std::size_t a, std::size_t b) { return material(a) < material(b); });
        counts_.resize(std::max<std::size_t>(names_.size(), 1));
        names_.resize(counts_.size(), "object");
        for (const std::size_t i : order) {
            object_.triangles.push_back(object.triangles[i]);
            ++counts_.at(material(i));
        }
        if (streaks && !streaks->triangles.empty()) {
            streaks_ = {streaks->positions, streaks->normals, streaks->triangles, streaks->uvs};
        }
    }

    int add(tinygltf::Model& model) const
    {
        const int mesh = addMesh(model, object_, "object", 0);
        addParts(model, model.meshes[static_cast<std::size_t>(mesh)]);
        const int node = addNode(model, "object", mesh);
        if (!streaks_.triangles.empty()) {
            tinygltf::Material wet = materialNamed("streaks");
            wet.alphaMode = "BLEND";
            wet.pbrMetallicRoughness.baseColorFactor = {0.85, 0.92, 1.0, 0.25};
            wet.pbrMetallicRoughness.roughnessFactor = 0.05;
            model.materials.push_back(std::move(wet));
            const int number = static_cast<int>(model.materials.size()) - 1;
            const int child = addNode(model, "streaks", addMesh(model, streaks_, "streaks", number));
            model.nodes[static_cast<std::size_t>(node)].children.push_back(child);
        }
        return node;
    }

    void write(ByteStream& bytes) const
    {
        writeMesh(object_, bytes);
        if (!streaks_.triangles.empty()) {
            writeMesh(streaks_, bytes);
        }
    }

private:
    static tinygltf::Material materialNamed(const std::string& name)
    {
        tinygltf::Material material;
        material.name = name;
        material.doubleSided = true;
        material.pbrMetallicRoughness.metallicFactor = 0.0;
        return material;
    }

    static int addNode(tinygltf::Model& model, const char* name, int mesh)
    {
        tinygltf::Node node;
        node.name = name;
        node.mesh = mesh;
        model.nodes.push_back(std::move(node));
        return static_cast<int>(model.nodes.size()) - 1;
    }

    /// Splits the only primitive by material; all parts have the same vertices.
    void addParts(tinygltf::Model& model, tinygltf::Mesh& mesh) const
    {
        const tinygltf::Primitive whole = mesh.primitives.front();
        const tinygltf::Accessor indices = model.accessors.back();
        const auto bytes = static_cast<std::size_t>(
            tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(indices.componentType)));
        mesh.primitives.clear();
        model.accessors.pop_back();
        std::size_t first = 0;
        for (std::size_t i = 0; i < counts_.size(); ++i) {
            if (counts_[i] == 0) {
                continue;
            }
            tinygltf::Primitive part = whole;
            part.indices = static_cast<int>(model.accessors.size());
            part.material = static_cast<int>(model.materials.size());
            tinygltf::Accessor accessor = indices;
            accessor.byteOffset = 3 * bytes * first;
            accessor.count = 3 * counts_[i];
            first += counts_[i];
            model.accessors.push_back(std::move(accessor));
            tinygltf::Material material = materialNamed(names_[i]);
            material.pbrMetallicRoughness.baseColorFactor = {0.6, 0.6, 0.6, 1.0};
            material.pbrMetallicRoughness.roughnessFactor = 0.6;
            model.materials.push_back(std::move(material));
            mesh.primitives.push_back(std::move(part));
        }
    }

    std::vector<std::string> names_;   ///< of the materials
    std::vector<std::size_t> counts_;  ///< number of triangles of every material
    DropletMesh object_;
    DropletMesh streaks_;
};

}  // namespace

void FlowAnimationOptions::validate() const
{
    require(frames_per_second > 0.0 && std::isfinite(frames_per_second), "frames_per_second", frames_per_second,
            "finite and more than 0");
    require(std::isfinite(length(gravity)), "gravity", length(gravity), "finite");
    motion.validate();
}

struct FlowAnimation::Content {
    FlowObject object;
    const DropletBodies& bodies;
    FlowAnimationOptions options;
    double unit_volume;  ///< of all meshes of a droplet
    DropletHistories histories = {};
    std::vector<SceneGround::Pose> poses = {};  ///< of the object, if it moves
    std::array<Vec3, 2> corners = {};           ///< of the object and all droplets, in the object's frame
    std::array<Vec3, 2> moved_corners = {};     ///< the same in the world
    double logarithms = 0.0;                    ///< sum of the logarithms of volumes
    std::uint64_t volumes = 0;                  ///< their number
    std::optional<Surface> streaks = {};

    [[nodiscard]] DropletPose poseOf(const FlowSample& sample, Vec3 gravity) const
    {
        const DropletPose* const last = histories.last(sample.id);
        const DropletFrame frame = frameOf(sample, gravity);
        DropletPose pose;
        pose.place = floatsOf(yUp(sample.place));
        pose.airborne = sample.contact == FlowContact::Air;
        pose.along = toFloat(std::cbrt(sample.volume / unit_volume));
        pose.across = pose.along;
        pose.up = pose.along;
        if (pose.airborne) {
            return pose;
        }
        pose.moves = sample.velocity != Vec3{};
        const Vec3 x = yUp(frame.ahead);
        const Vec3 y = yUp(frame.normal);
        pose.turn = turnTo(x, y, cross(x, y));
        if (pose.moves) {
            const Vec2 half = halfSizes(bodies, conditionsOf(sample, gravity));
            pose.along = toFloat(half.x);
            pose.across = toFloat(half.y);
            pose.up = toFloat(sample.volume / (unit_volume * half.x * half.y));
        } else if (last != nullptr && !last->airborne && last->place == pose.place) {
            pose.turn = last->turn;  // it is round
        }
        return pose;
    }

    void include(const ObjectPose& pose)
    {
        const auto corner = [&](std::size_t i) {
            return Vec3{corners[i & 1U].x, corners[i >> 1U & 1U].y, corners[i >> 2U].z};
        };
        std::vector<Vec3> all(moved_corners.begin(), moved_corners.end());
        if (histories.frames() == 0) {
            all.clear();
        }
        for (std::size_t i = 0; i < 8; ++i) {
            all.push_back(pose.place + pose.toWorld(corner(i)));
        }
        moved_corners = cornersOf(all);
    }
};

FlowAnimation::FlowAnimation(FlowObject object, const DropletBodies& bodies, const FlowAnimationOptions& options)
{
    options.validate();
    content_ = std::make_unique<Content>(Content{std::move(object), bodies, options, unitVolume(bodies)});
    content_->corners = cornersOf(content_->object.positions);
}

FlowAnimation::~FlowAnimation() = default;
FlowAnimation::FlowAnimation(FlowAnimation&&) noexcept = default;
FlowAnimation& FlowAnimation::operator=(FlowAnimation&&) noexcept = default;

void FlowAnimation::add(double time, std::span<const FlowSample> samples)
{
    Content& content = *content_;
    const ObjectPose at = content.options.motion.at(time);
    const Vec3 gravity = at.toObject(content.options.gravity);
    std::vector<DropletPose> poses(samples.size());
    tbb::parallel_for(std::size_t{0}, samples.size(),
                      [&](std::size_t i) { poses[i] = content.poseOf(samples[i], gravity); });
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const Vec3 size = std::cbrt(samples[i].volume) * Vec3{1.0, 1.0, 1.0};
        content.corners =
            cornersOf({content.corners[0], content.corners[1], samples[i].place - size, samples[i].place + size});
        content.logarithms += std::log(samples[i].volume);
        ++content.volumes;
        content.histories.add(samples[i].id, poses[i]);
    }
    content.include(at);
    if (!content.options.motion.rests()) {
        const Vec3 axis = yUp(at.axis);
        SceneGround::Pose pose{floatsOf(yUp(at.place)),
                               {toFloat(axis.x), toFloat(axis.y), toFloat(axis.z), toFloat(at.real)}};
        if (!content.poses.empty()) {
            const auto& last = content.poses.back().turn;
            if (std::inner_product(last.begin(), last.end(), pose.turn.begin(), 0.0F) < 0.0F) {
                for (float& number : pose.turn) {
                    number = 0.0F - number;  // the same rotation on the shorter way
                }
            }
        }
        content.poses.push_back(pose);
    }
    content.histories.endFrame();
    checkSceneOfJoints(content.histories, "fewer droplets");
}

void FlowAnimation::setStreaks(Surface streaks)
{
    content_->streaks = std::move(streaks);
}

std::uint64_t FlowAnimation::write(std::ostream& out) const
{
    const Content& content = *content_;
    if (content.histories.frames() == 0) {
        throw Error(ErrorCode::InvalidArgument, "an animation of droplets must have at least one frame");
    }
    constexpr double kUsualVolume = 20e-9;
    constexpr double kSlope = 0.7071067811865476;
    const DropletBodies& bodies = content.bodies;
    const double unit = content.unit_volume;
    BodyConditions conditions;
    conditions.volume =
        content.volumes > 0 ? std::exp(content.logarithms / static_cast<double>(content.volumes)) : kUsualVolume;
    const double gravity = length(content.options.gravity);
    conditions.gravity = {0.0, 0.0, -gravity};
    const ObjectMeshes ground(content.object, content.streaks);
    JointScene scene;
    scene.frames_per_second = content.options.frames_per_second;
    scene.material = content.options.material;
    scene.animation = "flow";
    scene.decimals = 7;
    scene.place_tolerance = 0.1;
    scene.time_tolerance = 2e-3;
    scene.ground.add = [&](tinygltf::Model& model) { return ground.add(model); };
    scene.ground.write = [&](ByteStream& bytes) { ground.write(bytes); };
    scene.ground.corners = content.moved_corners;
    scene.ground.corner = "corner of the scene";
    scene.ground.poses = content.poses;
    scene.resting = unitBody(bodies, conditions, {.around = 12, .rings = 4}, unit);
    // A running droplet of usual length stands for all.
    constexpr double kUsualLength = 1.6;  // over the width
    constexpr double kFastest = 2.0;      // [m/s]
    conditions.gravity = kSlope * Vec3{gravity, 0.0, -gravity};
    conditions.speed = 0.05;
    for (Vec2 half; conditions.speed < kFastest && half.x <= kUsualLength * half.y; conditions.speed *= 1.25) {
        half = halfSizes(bodies, conditions);
    }
    scene.running = unitBody(bodies, conditions, {.around = 16, .rings = 5}, unit);
    scene.falling = unitBall({.around = 10, .rings = 6}, unit);
    return writeSceneOfJoints(content.histories, scene, out);
}

}  // namespace droplet
