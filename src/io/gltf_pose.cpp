// SPDX-License-Identifier: GPL-3.0-or-later
// Khronos Group, "glTF 2.0 Specification" (2021), sections 3.5.3, 3.7.2.2, 3.7.3 and 3.11, appendix C.
#include "io/gltf_pose.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "io/gltf_column.h"

namespace droplet {
namespace {

/// Transform of a node: scale, then rotation, then translation.
struct Transform {
    std::array<double, 3> translation = {0.0, 0.0, 0.0};
    std::array<double, 4> rotation = {0.0, 0.0, 0.0, 1.0};
    std::array<double, 3> scale = {1.0, 1.0, 1.0};

    explicit Transform(const tinygltf::Node& node)
    {
        std::copy(node.translation.begin(), node.translation.end(), translation.begin());
        std::copy(node.rotation.begin(), node.rotation.end(), rotation.begin());
        std::copy(node.scale.begin(), node.scale.end(), scale.begin());
    }

    [[nodiscard]] Placement placement() const
    {
        const auto& [a, b, c, d] = rotation;
        const double size = std::sqrt(a * a + b * b + c * c + d * d);
        if (!(size > 0.0)) {
            throw Damage("a node's rotation is not a quaternion");
        }
        const double x = a / size;
        const double y = b / size;
        const double z = c / size;
        const double w = d / size;
        return {scale[0] * Vec3{1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)},
                scale[1] * Vec3{2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)},
                scale[2] * Vec3{2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)},
                {translation[0], translation[1], translation[2]}};
    }
};

/// Matrix by columns; the last row is not read.
template <typename Number>
Placement placementOf(const Number& number)
{
    const auto column = [&](std::size_t k) { return Vec3{number(4 * k), number(4 * k + 1), number(4 * k + 2)}; };
    return {column(0), column(1), column(2), column(3)};
}

Placement placementOf(const tinygltf::Node& node)
{
    return node.matrix.empty() ? Transform(node).placement()
                               : placementOf([&](std::size_t k) { return node.matrix[k]; });
}

std::size_t targetsOf(const tinygltf::Model& model, const tinygltf::Node& node)
{
    std::size_t targets = 0;
    for (const tinygltf::Primitive& primitive : entry(model.meshes, node.mesh, "meshes").primitives) {
        targets = std::max(targets, primitive.targets.size());
    }
    return targets;
}

/// Times and interpolation of a channel.
KeyTrack emptyTrackOf(const tinygltf::Model& model, const GltfChannel& channel)
{
    const Column times(model, channel.times, TINYGLTF_TYPE_SCALAR);
    KeyTrack track;
    track.turns = channel.path == "rotation";
    track.interpolation = channel.interpolation == "STEP"          ? KeyTrack::Interpolation::Step
                          : channel.interpolation == "CUBICSPLINE" ? KeyTrack::Interpolation::CubicSpline
                                                                   : KeyTrack::Interpolation::Linear;
    for (std::size_t i = 0; i < times.size(); ++i) {
        track.times.push_back(times.number(i));
        if (!std::isfinite(track.times[i]) || (i > 0 && !(track.times[i] > track.times[i - 1]))) {
            throw Damage("the times of an animation do not ascend");
        }
    }
    return track;
}

/// Number of values that belong to each time.
std::size_t valuesPerKey(const KeyTrack& track)
{
    return track.interpolation == KeyTrack::Interpolation::CubicSpline ? 3 : 1;
}

void checkCount(const KeyTrack& track, std::size_t values, std::size_t targets)
{
    if (track.times.empty() || values != targets * valuesPerKey(track) * track.times.size()) {
        throw Damage("an animation has " + std::to_string(track.times.size()) + " times and " + std::to_string(values) +
                     " values");
    }
}

void addValue(KeyTrack& track, const KeyTrack::Value& value)
{
    if (!std::isfinite(value[0] + value[1] + value[2] + value[3])) {
        throw Damage("an animation holds numbers that are not finite");
    }
    track.values.push_back(value);
}

/// Tracks of the weights of all morph targets. A key has the tangents before it of all targets, then their values, then
/// the tangents after it; without a spline only the values.
std::vector<KeyTrack> weightTracksOf(const tinygltf::Model& model, const GltfChannel& channel)
{
    const tinygltf::Node& node = model.nodes[*channel.node];
    const std::size_t targets = targetsOf(model, node);
    const KeyTrack empty = emptyTrackOf(model, channel);
    const Column values(model, channel.values, TINYGLTF_TYPE_SCALAR);
    checkCount(empty, values.size(), targets);
    std::vector<KeyTrack> tracks(targets, empty);
    for (std::size_t i = 0; i < values.size(); ++i) {
        addValue(tracks[i % targets], {values.number(i), 0.0, 0.0, 0.0});
    }
    return tracks;
}

}  // namespace

GltfPose restPose(const tinygltf::Model& model, const GltfVisits& visits)
{
    GltfPose pose;
    pose.nodes.resize(model.nodes.size());
    for (const auto& [node, parent] : visits) {
        pose.nodes[node] = (parent ? pose.nodes[*parent] : Placement{}).of(placementOf(model.nodes[node]));
    }
    return pose;
}

KeyTrack trackOf(const tinygltf::Model& model, const GltfChannel& channel)
{
    KeyTrack track = emptyTrackOf(model, channel);
    const Column values(model, channel.values, track.turns ? TINYGLTF_TYPE_VEC4 : TINYGLTF_TYPE_VEC3);
    checkCount(track, values.size(), 1);
    for (std::size_t i = 0; i < values.size(); ++i) {
        addValue(track, {values.number(i, 0), values.number(i, 1), values.number(i, 2),
                         track.turns ? values.number(i, 3) : 0.0});
    }
    return track;
}

bool isStill(const GltfFile& file, const GltfChannel& channel)
{
    const auto all_are = [](const KeyTrack& track, const KeyTrack::Value& rest) {
        const std::size_t each = valuesPerKey(track);
        for (std::size_t i = 0; i < track.values.size(); ++i) {
            const bool is_tangent = each == 3 && i % 3 != 1;
            for (std::size_t k = 0; k < rest.size(); ++k) {
                constexpr double kNear = 1e-5;  // files hold floats
                const double expected = is_tangent ? 0.0 : rest[k];
                if (std::abs(track.values[i][k] - expected) > kNear * std::max(std::abs(rest[k]), 1.0)) {
                    return false;
                }
            }
        }
        return true;
    };
    if (channel.path == "weights") {
        const std::vector<KeyTrack> tracks = weightTracksOf(file.model, channel);
        return std::all_of(tracks.begin(), tracks.end(), [&](const KeyTrack& track) { return all_are(track, {}); });
    }
    const Transform rest(file.model.nodes[*channel.node]);
    const std::array<double, 3>& three = channel.path == "scale" ? rest.scale : rest.translation;
    return all_are(trackOf(file.model, channel),
                   channel.path == "rotation" ? rest.rotation : KeyTrack::Value{three[0], three[1], three[2], 0.0});
}

GltfMotion::GltfMotion(const GltfFile& file, GltfVisits visits, const GltfAnimation& animation,
                       const std::vector<std::size_t>& skins)
    : file_(file), visits_(std::move(visits))
{
    begin_ = std::numeric_limits<double>::infinity();
    end_ = -begin_;
    for (const GltfChannel& channel : animation.channels) {
        if (channel.node && *channel.node < file.model.nodes.size()) {
            add(channel);
        }
    }
    if (!(begin_ <= end_)) {
        begin_ = 0.0;
        end_ = 0.0;
    }
    for (const std::size_t skin : skins) {
        addSkin(skin);
    }
}

void GltfMotion::add(const GltfChannel& channel)
{
    const tinygltf::Node& node = file_.model.nodes[*channel.node];
    Tracks& tracks = tracks_[*channel.node];
    const auto include = [this](const KeyTrack& track) {
        begin_ = std::min(begin_, track.times.front());
        end_ = std::max(end_, track.times.back());
    };
    std::optional<KeyTrack>* const to = channel.path == "translation" ? &tracks.translation
                                        : channel.path == "rotation"  ? &tracks.rotation
                                        : channel.path == "scale"     ? &tracks.scale
                                                                      : nullptr;
    if (to != nullptr && !*to) {
        *to = trackOf(file_.model, channel);
        include(**to);
    } else if (channel.path == "weights" && node.mesh >= 0 && tracks.weights.empty() &&
               targetsOf(file_.model, node) > 0) {
        tracks.weights = weightTracksOf(file_.model, channel);
        include(tracks.weights.front());
    }
}

void GltfMotion::addSkin(std::size_t number)
{
    const std::string name = "skins[" + std::to_string(number) + "]";
    const GltfSkin& from = file_.skins[number];
    Skin& skin = skins_[number];
    std::vector<bool> is_visited(file_.model.nodes.size(), false);
    for (const GltfVisit& visit : visits_) {
        is_visited[visit.node] = true;
    }
    for (const std::size_t joint : from.joints) {
        if (joint >= is_visited.size() || !is_visited[joint]) {
            throw Damage(name + " has a joint that is not in the scene");
        }
        skin.nodes.push_back(joint);
    }
    skin.binds.resize(skin.nodes.size());
    if (from.matrices < 0) {
        return;
    }
    const Column matrices(file_.model, from.matrices, TINYGLTF_TYPE_MAT4);
    if (matrices.size() < skin.nodes.size()) {
        throw Damage(name + " has fewer matrices than joints");
    }
    for (std::size_t j = 0; j < skin.nodes.size(); ++j) {
        skin.binds[j] = placementOf([&](std::size_t k) { return matrices.number(j, k); });
    }
}

Placement GltfMotion::placementAt(std::size_t node, double time) const
{
    const tinygltf::Node& from = file_.model.nodes[node];
    const auto found = tracks_.find(node);
    if (found == tracks_.end() || !from.matrix.empty()) {  // a node with a matrix cannot be animated
        return placementOf(from);
    }
    Transform transform(from);
    const auto take = [&](const std::optional<KeyTrack>& track, auto& numbers) {
        if (track) {
            const KeyTrack::Value value = track->at(time, true);
            std::copy_n(value.begin(), numbers.size(), numbers.begin());
        }
    };
    take(found->second.translation, transform.translation);
    take(found->second.rotation, transform.rotation);
    take(found->second.scale, transform.scale);
    return transform.placement();
}

std::vector<double> GltfMotion::weightsAt(std::size_t node, double time) const
{
    const tinygltf::Node& from = file_.model.nodes[node];
    if (from.mesh < 0) {
        return {};
    }
    const auto found = tracks_.find(node);
    if (found != tracks_.end() && !found->second.weights.empty()) {
        std::vector<double> weights;
        for (const KeyTrack& track : found->second.weights) {
            weights.push_back(track.at(time, true)[0]);
        }
        return weights;
    }
    const std::vector<double>& own = entry(file_.model.meshes, from.mesh, "meshes").weights;
    return from.weights.empty() ? own : from.weights;
}

GltfPose GltfMotion::at(double time) const
{
    GltfPose pose;
    pose.nodes.resize(file_.model.nodes.size());
    pose.weights.resize(pose.nodes.size());
    for (const auto& [node, parent] : visits_) {
        pose.nodes[node] = (parent ? pose.nodes[*parent] : Placement{}).of(placementAt(node, time));
        pose.weights[node] = weightsAt(node, time);
    }
    pose.joints.resize(file_.skins.size());
    for (const auto& [number, skin] : skins_) {
        for (std::size_t j = 0; j < skin.nodes.size(); ++j) {
            pose.joints[number].push_back(pose.nodes[skin.nodes[j]].of(skin.binds[j]));
        }
    }
    return pose;
}

}  // namespace droplet
