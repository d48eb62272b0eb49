// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/flow_io/flow_animation.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "axes.h"
#include "box_corners.h"
#include "byte_stream.h"
#include "droplet/error.h"
#include "droplet/flow_io/droplet_surfaces.h"
#include "flow/following.h"
#include "flow_io/object_faces.h"
#include "flow_io/object_scene.h"
#include "flow_io/pond_surface.h"
#include "flow_io/shape_basis.h"
#include "flow_io/unit_bodies.h"
#include "io/droplet_crowd.h"
#include "require.h"
#include "scene/write_scene.h"

namespace droplet {
namespace {

/// Vertices of some triangles.
DropletMesh partOf(const Surface& surface, const std::vector<Triangle>& triangles)
{
    DropletMesh part;
    std::map<std::uint32_t, std::uint32_t> numbers;
    for (const Triangle& t : triangles) {
        Triangle own{};
        for (std::size_t k = 0; k < 3; ++k) {
            const auto [number, is_new] = numbers.try_emplace(t[k], static_cast<std::uint32_t>(part.vertices.size()));
            if (is_new) {
                part.vertices.push_back(surface.vertices[t[k]]);
                part.normals.push_back(surface.normals[t[k]]);
                part.uvs.push_back(surface.uvs[t[k]]);
            }
            own[k] = number->second;
        }
        part.triangles.push_back(own);
    }
    return part;
}

/// Frames in which something is shown.
struct Shown {
    std::uint32_t begin = 0;
    std::uint32_t end = 0;  ///< first frame without it
    friend bool operator<(const Shown& a, const Shown& b)
    {
        return std::pair(a.begin, a.end) < std::pair(b.begin, b.end);
    }
};

/// Adds a mesh that appears in one frame and vanishes in another; returns its node.
/// @param frames  of the animation
std::size_t addForFrames(Scene& scene, std::size_t parent, SceneMesh mesh, const Shown& shown, std::uint32_t frames)
{
    SceneNode node{mesh.name};
    node.mesh = scene.addMesh(std::move(mesh));
    std::vector<float> times;
    std::vector<float> scales;
    const auto key = [&](std::uint32_t frame, float scale) {
        times.push_back(toFloat(frame / scene.frames_per_second));
        scales.insert(scales.end(), 3, scale);
    };
    if (shown.begin > 0) {
        node.scale = {0.0, 0.0, 0.0};
        key(0, 0.0F);
    }
    key(shown.begin, 1.0F);
    if (shown.end < frames) {
        key(shown.end, 0.0F);
    }
    const std::size_t added = scene.addNode(std::move(node), parent);
    if (times.size() > 1) {
        const std::size_t keys = scene.addTimes(std::move(times));
        scene.tracks.push_back({added, SceneChange::Scale, true, keys, std::move(scales)});
    }
    return added;
}

/// How an object deforms.
struct Deforming {
    const FlowObject& object;
    const FlowTerrain& terrain;             ///< the first shape
    ShapeBasis basis;                       ///< of the object
    const std::vector<std::size_t>& shown;  ///< shapes of all frames

    /// Weights of the changes in frames, for a node with their targets.
    void addTrack(Scene& scene, std::size_t node, const Shown& frames) const
    {
        std::vector<float> times;
        std::vector<float> weights;
        for (std::uint32_t frame = frames.begin; frame < frames.end; ++frame) {
            times.push_back(toFloat(frame / scene.frames_per_second));
            for (const double weight : basis.weights[shown[frame]]) {
                weights.push_back(toFloat(weight));
            }
        }
        const std::size_t keys = scene.addTimes(std::move(times));
        scene.tracks.push_back({node, SceneChange::Weights, false, keys, std::move(weights)});
    }

    /// Lets a mesh that lies on the first shape follow the object: a place in a triangle moves by the mean of what its
    /// corners do, and so do all changes of shape.
    void carry(SceneMesh& mesh, const std::vector<Vec3>& vertices) const
    {
        std::vector<Triangle> triangles;
        std::vector<std::array<double, 3>> weights;
        for (const Vec3 p : vertices) {
            const FlowTerrain::Point point = terrain.nearest(p);
            triangles.push_back(object.triangles[terrain.surface().faces[point.face].source]);
            weights.push_back(weightsAt(object, triangles.back(), point.place));
        }
        for (const MeshShape& change : basis.changes) {
            SceneTarget target;
            for (std::size_t v = 0; v < vertices.size(); ++v) {
                target.vertices.push_back(sceneVector(mixed(change.vertices, triangles[v], weights[v])));
                target.normals.push_back(sceneVector(mixed(change.normals, triangles[v], weights[v])));
            }
            mesh.geometries.front().targets.push_back(std::move(target));
            mesh.targets.push_back("motion " + std::to_string(mesh.targets.size() + 1));
        }
    }
};

/// Adds streaks on the object: a node for what appears in one frame and vanishes in another.
/// @param deforming  null: the object keeps its shape
void addStreaks(const StreakMesh& streaks, std::size_t object, std::uint32_t frames, const Deforming* deforming,
                Scene& scene)
{
    SceneMaterial wet = opaqueMaterial("streaks", 0.05);
    wet.look.colour = {0.85, 0.92, 1.0};
    wet.opacity = 0.25;
    const std::size_t material = scene.addMaterial(std::move(wet));
    const std::size_t all = scene.addNode({"streaks"}, object);
    std::map<Shown, std::vector<Triangle>> by_frames;
    const double rate = scene.frames_per_second;
    const auto frame_of = [&](double time) {
        constexpr double kRounding = 1e-6;
        return static_cast<std::uint32_t>(
            std::clamp(std::ceil(time * rate - kRounding), 0.0, static_cast<double>(frames)));
    };
    for (std::size_t i = 0; i < streaks.wetted.size(); ++i) {
        const Shown when{frame_of(streaks.wetted[i]), frame_of(streaks.gone[i])};
        if (when.begin < when.end) {
            by_frames[when].push_back(streaks.surface.triangles[i]);
        }
    }
    for (const auto& [when, triangles] : by_frames) {
        const std::string name =
            "streaks of frames " + std::to_string(when.begin) + " to " + std::to_string(when.end - 1);
        const DropletMesh part = partOf(streaks.surface, triangles);
        SceneMesh mesh = sceneMesh(part, name, material);
        const bool deforms = deforming != nullptr && !deforming->basis.changes.empty();
        if (deforms) {
            deforming->carry(mesh, part.vertices);
        }
        const std::size_t node = addForFrames(scene, all, std::move(mesh), when, frames);
        if (deforms) {
            deforming->addTrack(scene, node, {when.begin, std::min(when.end + 1, frames)});
        }
    }
}

/// A pond with one form, while it is shown.
struct ShownPond {
    Shown frames;
    Pond pond;
    std::size_t shape = 0;  ///< of the object
    DropletMesh mesh;

    /// Whether it may stand for another one, as DropletPose::looksLike() says of droplets.
    [[nodiscard]] bool looksLike(const Pond& other, std::size_t at) const
    {
        constexpr double kNear = 0.01;  // of the radius
        const double near = kNear * std::sqrt(pond.area / std::numbers::pi);
        const double way = pond.front ? pond.front->way : 0.0;
        const double other_way = other.front ? other.front->way : 0.0;
        return shape == at && pond.front.has_value() == other.front.has_value() && std::abs(other_way - way) <= near &&
               std::abs(other.level - pond.level) <= near && std::abs(other.dome - pond.dome) <= near * pond.area &&
               dot(other.up, pond.up) >= std::cos(kFacing);
    }
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
    const FlowTerrain& terrain;
    const DropletBodies& bodies;
    FlowAnimationOptions options;
    double unit_volume;                   ///< of all meshes of a droplet
    const FlowShapes* deforms = nullptr;  ///< null: it keeps its shape
    std::vector<std::size_t> shown = {};  ///< shapes of all frames, if it deforms
    DropletHistories histories = {};
    std::vector<CrowdPose> poses = {};                 ///< of the object, if it moves
    std::array<Vec3, 2> corners = {};                  ///< of the object and all droplets, in the object's frame
    std::array<Vec3, 2> moved_corners = {};            ///< the same in the world
    double logarithms = 0.0;                           ///< sum of the logarithms of volumes
    std::uint64_t volumes = 0;                         ///< their number
    std::map<std::uint64_t, DropletPose> shaped = {};  ///< with which droplets got their last shape, by id
    std::size_t shapes = 0;                            ///< about the number that the file will have
    std::optional<StreakMesh> streaks = {};
    std::vector<ShownPond> ponds = {};
    std::map<std::uint64_t, std::size_t> pond_of = {};  ///< index of each droplet's pond in the last frame

    [[nodiscard]] DropletPose poseOf(const FlowSample& sample, Vec3 gravity, std::size_t shape) const
    {
        const DropletPose* const last = histories.last(sample.id);
        const DropletFrame frame = frameOf(sample, gravity);
        DropletPose pose;
        pose.place = sceneVector(sample.place);
        pose.airborne = sample.contact == FlowContact::Air;
        pose.along = toFloat(std::cbrt(sample.volume / unit_volume));
        pose.across = pose.along;
        pose.up = pose.along;
        if (pose.airborne) {
            return pose;
        }
        pose.moves = sample.velocity != Vec3{};
        if (deforms != nullptr) {
            pose.face = *sample.face;
            pose.shape = static_cast<std::uint32_t>(shape);
        }
        pose.turn = turnOf(frame);
        if (pose.moves || sample.contact_angle) {
            const Vec2 half = halfSizes(bodies, conditionsOf(sample, gravity));
            pose.along = toFloat(half.x);
            pose.across = toFloat(half.y);
            pose.up = toFloat(sample.volume / (unit_volume * half.x * half.y));
        }
        if (!pose.moves && last != nullptr && !last->airborne && last->place == pose.place) {
            pose.turn = last->turn;  // it is round
        }
        return pose;
    }

    /// Adds a pond to the frame.
    void addPond(const FlowSample& sample, std::size_t shape, std::map<std::uint64_t, std::size_t>& now)
    {
        const std::uint32_t frame = histories.frames();
        if (const auto last = pond_of.find(sample.id); last != pond_of.end()) {
            ShownPond& before = ponds[last->second];
            if (before.looksLike(*sample.pond, shape)) {
                before.frames.end = frame + 1;
                now.insert(*last);
                return;
            }
        }
        std::vector<FlowSurface::Face> ground;
        for (const std::uint32_t face : sample.pond->faces) {
            ground.push_back(deforms != nullptr ? deforms->faceAt(shape, face) : terrain.surface().faces[face]);
        }
        PondSurface surface = pondSurface(ground, *sample.pond);
        ShownPond pond{{frame, frame + 1}, *sample.pond, shape, {}};
        const std::vector<Vec3>& places = surface.vertices;
        if (!places.empty()) {
            const auto [low, high] = cornersOf(places);
            corners = cornersOf({corners[0], corners[1], low, high});
        }
        pond.mesh.vertices = std::move(surface.vertices);
        pond.mesh.normals = std::move(surface.normals);
        pond.mesh.triangles = std::move(surface.triangles);
        now.emplace(sample.id, ponds.size());
        constexpr std::size_t kVerticesOfShape = 64;  // of a droplet on the way
        shapes += 1 + pond.mesh.vertices.size() / kVerticesOfShape;
        ponds.push_back(std::move(pond));
    }

    void addPonds(std::size_t object_node, Scene& scene) const
    {
        double radius = 0.0;
        for (const ShownPond& pond : ponds) {
            radius = std::max(radius, std::sqrt(pond.pond.area / std::numbers::pi));
        }
        const std::size_t material = scene.addMaterial(liquidMaterial(lookOf(options.material), radius));
        const std::size_t all = scene.addNode({"ponds"}, object_node);
        for (const ShownPond& pond : ponds) {
            const std::string name =
                "pond of frames " + std::to_string(pond.frames.begin) + " to " + std::to_string(pond.frames.end - 1);
            addForFrames(scene, all, sceneMesh(pond.mesh, name, material), pond.frames, histories.frames());
        }
    }

    /// Counts the shapes that a droplet needs on its way over ground that bends.
    void countShapes(std::uint64_t id, const DropletPose& pose)
    {
        constexpr double kWay = 1.2;  // over the contact radius: experiment with Suzanne and the bunny
        const auto [last, is_new] = shaped.try_emplace(id, pose);
        const double way = length(vectorOf(pose.place) - vectorOf(last->second.place));
        if (!pose.airborne && way > kWay * static_cast<double>(pose.across) &&
            dot(pose.normal(), last->second.normal()) < std::cos(kFacing)) {
            last->second = pose;
            ++shapes;
        }
    }

    /// Pose with which a droplet sits on the first shape as it does on its own.
    [[nodiscard]] DropletPose onFirst(const DropletPose& pose) const
    {
        if (deforms == nullptr || pose.shape == 0) {
            return pose;
        }
        const FlowSurface::Face from = deforms->faceAt(pose.shape, pose.face);
        const FlowSurface::Face to = deforms->faceAt(0, pose.face);
        DropletFrame frame = frameOf(pose);
        frame.place = followed(from, to, frame.place);
        frame.ahead = turnedWith(from, to, frame.ahead);
        frame.normal = turnedWith(from, to, frame.normal);
        DropletPose first = pose;
        first.place = sceneVector(frame.place);
        first.turn = turnOf(frame);
        return first;
    }

    [[nodiscard]] Deforming deforming() const
    {
        std::vector<MeshShape> all;
        for (std::size_t k = 0; k < deforms->count(); ++k) {
            FlowObject shape = inShape(object, deforms->vertices(k));
            all.push_back({std::move(shape.vertices), std::move(shape.normals)});
        }
        constexpr double kNear = 5e-5;   // over the size: less than a pixel of a picture that shows all of it
        constexpr double kTurned = 0.1;  // of normals: 6 degrees
        return {object, terrain, shapeBasis(all, {kNear * length(sizeOf(object)), kTurned}), shown};
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

FlowAnimation::FlowAnimation(FlowObject object, const FlowTerrain& terrain, const DropletBodies& bodies,
                             const FlowAnimationOptions& options)
{
    options.validate();
    content_ = std::make_unique<Content>(Content{std::move(object), terrain, bodies, options, unitVolume(bodies)});
    content_->corners = cornersOf(content_->object.vertices);
}

FlowAnimation::FlowAnimation(FlowObject object, const FlowShapes& shapes, const DropletBodies& bodies,
                             const FlowAnimationOptions& options)
    : FlowAnimation(std::move(object), shapes.first(), bodies, options)
{
    if (shapes.count() > 1) {
        content_->deforms = &shapes;
        std::vector<Vec3> all;
        for (std::size_t k = 0; k < shapes.count(); ++k) {
            const std::array<Vec3, 2> corners = cornersOf(shapes.vertices(k));
            all.insert(all.end(), corners.begin(), corners.end());
        }
        content_->corners = cornersOf(all);
    }
}

FlowAnimation::~FlowAnimation() = default;
FlowAnimation::FlowAnimation(FlowAnimation&&) noexcept = default;
FlowAnimation& FlowAnimation::operator=(FlowAnimation&&) noexcept = default;

void FlowAnimation::add(double time, std::span<const FlowSample> samples, std::size_t shape)
{
    Content& content = *content_;
    const ObjectPose at = content.options.motion.at(time);
    const Vec3 gravity = at.toObject(content.options.gravity);
    std::vector<DropletPose> poses(samples.size());
    tbb::parallel_for(std::size_t{0}, samples.size(),
                      [&](std::size_t i) { poses[i] = content.poseOf(samples[i], gravity, shape); });
    std::map<std::uint64_t, std::size_t> ponds;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        if (samples[i].pond) {
            content.addPond(samples[i], shape, ponds);
            continue;
        }
        const Vec3 size = std::cbrt(samples[i].volume) * Vec3{1.0, 1.0, 1.0};
        content.corners =
            cornersOf({content.corners[0], content.corners[1], samples[i].place - size, samples[i].place + size});
        content.logarithms += std::log(samples[i].volume);
        ++content.volumes;
        content.histories.add(samples[i].id, poses[i]);
        content.countShapes(samples[i].id, content.onFirst(poses[i]));
    }
    content.pond_of = std::move(ponds);
    if (content.deforms != nullptr) {
        content.shown.push_back(shape);
    }
    content.include(at);
    if (!content.options.motion.rests()) {
        const Vec3 axis = yUp(at.axis);
        CrowdPose pose{sceneVector(at.place), {toFloat(axis.x), toFloat(axis.y), toFloat(axis.z), toFloat(at.real)}};
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
    checkCrowd(content.histories, content.shapes, "fewer droplets");
}

void FlowAnimation::setStreaks(StreakMesh streaks)
{
    content_->streaks = std::move(streaks);
}

std::uint64_t FlowAnimation::write(std::ostream& out, const AnimatedFile& file) const
{
    const Content& content = *content_;
    if (content.histories.frames() == 0) {
        throw Error(ErrorCode::InvalidArgument, "an animation of droplets must have at least one frame");
    }
    constexpr double kUsualVolume = 20e-9;
    const double volume =
        content.volumes > 0 ? std::exp(content.logarithms / static_cast<double>(content.volumes)) : kUsualVolume;
    Scene scene;
    scene.frames_per_second = content.options.frames_per_second;
    CrowdOptions droplets;
    droplets.deforms = content.deforms != nullptr;
    const std::uint32_t frames = content.histories.frames();
    const auto deforming = droplets.deforms ? std::optional(content.deforming()) : std::nullopt;
    droplets.ground = addObject(content.object, scene, deforming ? deforming->basis.changes : std::vector<MeshShape>());
    if (deforming && !deforming->basis.changes.empty()) {
        deforming->addTrack(scene, droplets.ground, {0, frames});
    }
    if (content.streaks && !content.streaks->surface.triangles.empty()) {
        addStreaks(*content.streaks, droplets.ground, frames, deforming ? &*deforming : nullptr, scene);
    }
    if (!content.ponds.empty()) {
        content.addPonds(droplets.ground, scene);
    }
    droplets.material = content.options.material;
    droplets.animation = "flow";
    droplets.decimals = 7;
    droplets.place_tolerance = 0.1;
    // Where the ground moves fast, a delay would be seen as a slip over it.
    droplets.time_tolerance = content.deforms != nullptr ? 0.0 : 2e-3;
    droplets.corners = content.moved_corners;
    droplets.corner = "corner of the scene";
    droplets.poses = content.poses;
    constexpr std::uint32_t kAround = 16;
    UnitDroplets unit = unitDroplets(content.bodies, volume, length(content.options.gravity), kAround);
    droplets.resting = std::move(unit.resting);
    droplets.running = std::move(unit.running);
    droplets.falling = std::move(unit.falling);
    droplets.seating = {[&](const DropletMesh& mesh, const DropletPose& pose) {
                            return seatedBody(content.terrain, mesh, kAround, content.onFirst(pose));
                        },
                        [&](const std::vector<Vec3>& vertices, const DropletPose& pose) {
                            return rimGap(content.terrain, vertices, kAround, content.onFirst(pose));
                        }};
    addDroplets(content.histories, droplets, scene);
    return writeScene(scene, out, file);
}

}  // namespace droplet
