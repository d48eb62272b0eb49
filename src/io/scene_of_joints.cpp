// SPDX-License-Identifier: GPL-3.0-or-later
// Khronos Group, "glTF 2.0 Specification" (2021), sections 3.7.3, skins, and 3.11, animations.
#include "io/scene_of_joints.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <optional>
#include <ostream>
#include <string>
#include <utility>

#include "droplet/error.h"
#include "io/axes.h"
#include "io/gltf_model.h"

namespace droplet {
namespace {

/// Number of droplets in a mesh, each with its own joint: few draw calls, and indices of joints fit into a byte.
constexpr std::size_t kDropletsOfMesh = 62;
constexpr std::size_t kAnchors = 2;  // corners of the scene in each mesh
/// Shorter rests are part of the run around them: another joint would cost more keys [frames].
constexpr std::uint32_t kShortRest = 15;
/// Time in which a slot shows a droplet.
struct Span {
    const DropletHistory* history = nullptr;
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
};

/// Rests, runs and falls of all droplets.
struct Spans {
    std::vector<Span> rests;
    std::vector<Span> runs;
    std::vector<Span> falls;
};

Vec3 vectorOf(const std::array<float, 3>& v)
{
    return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
}

/// Whether a droplet runs from one sample to the next. Small shifts are not runs: rain on a droplet at rest shifts its
/// centre.
bool runs(const DropletPose& from, const DropletPose& to)
{
    return from.moves || to.moves || length(vectorOf(to.place) - vectorOf(from.place)) > static_cast<double>(to.across);
}

/// Splits the time of a droplet on the ground.
/// @param first  index of the first sample there
/// @param last   index behind the last one
/// @param end    first frame without it
void splitOnGround(const DropletHistory& history, std::size_t first, std::size_t last, std::uint32_t end, Spans& spans)
{
    std::uint32_t done = history.samples[first].frame;
    std::optional<std::uint32_t> running;  // first frame of the run
    std::uint32_t moved = 0;               // last frame with a motion
    const auto end_run = [&](std::uint32_t next) {
        if (running && next - moved >= kShortRest) {
            spans.runs.push_back({&history, *running, moved});
            done = moved;
            running.reset();
        }
    };
    for (std::size_t i = first + 1; i < last; ++i) {
        const DropletPose& from = history.samples[i - 1].pose;
        const DropletPose& to = history.samples[i].pose;
        if (from.place == to.place || !runs(from, to)) {
            continue;
        }
        const std::uint32_t frame = history.samples[i].frame;
        end_run(frame - 1);
        if (!running) {
            running = frame - 1 - done >= kShortRest ? frame - 1 : done;
            if (*running > done) {
                spans.rests.push_back({&history, done, *running});
            }
        }
        moved = frame;
    }
    end_run(end);
    if (running) {
        spans.runs.push_back({&history, *running, end});
    } else {
        spans.rests.push_back({&history, done, end});
    }
}

void split(const DropletHistory& history, Spans& spans)
{
    const std::vector<DropletSample>& samples = history.samples;
    for (std::size_t first = 0; first < samples.size();) {
        std::size_t last = first + 1;
        while (last < samples.size() && samples[last].pose.airborne == samples[first].pose.airborne) {
            ++last;
        }
        const std::uint32_t end = last < samples.size() ? samples[last].frame : history.end;
        if (samples[first].pose.airborne) {
            spans.falls.push_back({&history, samples[first].frame, end});
        } else {
            splitOnGround(history, first, last, end, spans);
        }
        first = last;
    }
}

Spans spansOf(const DropletHistories& histories)
{
    Spans spans;
    for (const DropletHistory* history : histories.all()) {
        split(*history, spans);
    }
    for (std::vector<Span>* all : {&spans.rests, &spans.runs, &spans.falls}) {
        std::stable_sort(all->begin(), all->end(), [](const Span& a, const Span& b) { return a.begin < b.begin; });
    }
    return spans;
}

/// Place of a droplet at the beginning of a frame.
struct Point {
    std::uint32_t frame = 0;
    Vec3 place;
};

/// Path of a run; straight and with constant speed between two points.
std::vector<Point> pathOf(const Span& run)
{
    std::vector<Point> path;
    const auto add = [&](std::uint32_t frame) { path.push_back({frame, vectorOf(run.history->at(frame).place)}); };
    add(run.begin);
    for (const DropletSample& sample : run.history->samples) {
        if (sample.frame > run.begin && sample.frame < run.end) {
            if (sample.frame - 1 > path.back().frame) {
                add(sample.frame - 1);  // it rested until then
            }
            add(sample.frame);
        }
    }
    if (path.back().frame < run.end) {
        // The path ends at the next rest, or where the droplet was last.
        path.push_back(
            {run.end, run.end < run.history->end ? vectorOf(run.history->at(run.end).place) : path.back().place});
    }
    return path;
}

/// Points that suffice within the tolerances. D. H. Douglas and T. K. Peucker, "Algorithms for the reduction of the
/// number of points required to represent a digitized line", Cartographica 10 (1973) 112, over time.
/// @param tolerance    across the path [m]
/// @param time_frames  additional tolerance along the path [frames]
std::vector<Point> reduced(const std::vector<Point>& path, double tolerance, double time_frames)
{
    std::vector<bool> kept(path.size(), false);
    kept.front() = true;
    kept.back() = true;
    std::vector<std::pair<std::size_t, std::size_t>> open{{0, path.size() - 1}};
    while (!open.empty()) {
        const auto [first, last] = open.back();
        open.pop_back();
        const double frames = path[last].frame - path[first].frame;
        const Vec3 chord = path[last].place - path[first].place;
        const double size = length(chord);
        const Vec3 along = size > 0.0 ? (1.0 / size) * chord : Vec3{};
        const double longer = tolerance + time_frames * size / std::max(frames, 1.0);
        double worst = 1.0;
        std::size_t split = 0;
        for (std::size_t i = first + 1; i < last; ++i) {
            const double share = (path[i].frame - path[first].frame) / frames;
            const Vec3 off = path[i].place - path[first].place - share * chord;
            const double ahead = dot(off, along);
            const double excess = std::max(length(off - ahead * along) / tolerance, std::abs(ahead) / longer);
            if (excess > worst) {
                worst = excess;
                split = i;
            }
        }
        if (split > 0) {
            kept[split] = true;
            open.emplace_back(first, split);
            open.emplace_back(split, last);
        }
    }
    std::vector<Point> points;
    for (std::size_t i = 0; i < path.size(); ++i) {
        if (kept[i]) {
            points.push_back(path[i]);
        }
    }
    return points;
}

/// Calls take(frame, pose) for the begin of a span and for each change since the last call: of the size, of the place
/// of a droplet at rest, or of the shape of a running one.
/// @param tolerance  of the place over the contact radius, for a droplet at rest
template <typename Take>
void forChanges(const Span& span, std::optional<double> tolerance, const Take& take)
{
    DropletPose last = span.history->at(span.begin);
    take(span.begin, last);
    for (const DropletSample& sample : span.history->samples) {
        if (sample.frame <= span.begin || sample.frame >= span.end) {
            continue;
        }
        const DropletPose& pose = sample.pose;
        const double shift = length(vectorOf(pose.place) - vectorOf(last.place));
        if (!last.looksLike(pose) || (tolerance && shift > *tolerance * static_cast<double>(pose.restRadius()))) {
            last = sample.pose;
            take(sample.frame, last);
        }
    }
}

/// Numbers of an animation, and their accessors.
class Tracks {
public:
    /// @param view  index of the buffer view for the numbers
    Tracks(tinygltf::Model& model, int view) : model_(model), view_(view) {}

    int addTimes(const std::vector<float>& times)
    {
        const int accessor = addFloats(TINYGLTF_TYPE_SCALAR, times);
        // The shortest decimal that is exact for a float.
        const auto shortest = [](float time) { return std::stod(fmt::format("{:.9g}", time)); };
        model_.accessors.back().minValues = {shortest(times.front())};
        model_.accessors.back().maxValues = {shortest(times.back())};
        return accessor;
    }

    int addFloats(int type, const std::vector<float>& numbers)
    {
        const int accessor = add(TINYGLTF_COMPONENT_TYPE_FLOAT, type, numbers.size());
        for (const float number : numbers) {
            words_.push_back(std::bit_cast<std::uint32_t>(number));
        }
        return accessor;
    }

    /// Adds quaternions, rounded to 2^-15.
    int addTurns(const std::vector<std::array<float, 4>>& turns)
    {
        const int accessor = add(TINYGLTF_COMPONENT_TYPE_SHORT, TINYGLTF_TYPE_VEC4, 4 * turns.size());
        model_.accessors.back().normalized = true;
        for (const auto& [x, y, z, w] : turns) {
            for (const auto& [low, high] : {std::pair(x, y), std::pair(z, w)}) {
                const auto bits = [](float number) {
                    return static_cast<std::uint32_t>(std::lround(32767.0F * number)) & 0xFFFFU;
                };
                words_.push_back(bits(low) | bits(high) << 16U);
            }
        }
        return accessor;
    }

    void animate(int node, const char* path, int times, int values, const char* interpolation)
    {
        tinygltf::Animation& animation = model_.animations.front();
        tinygltf::AnimationSampler sampler;
        sampler.input = times;
        sampler.output = values;
        sampler.interpolation = interpolation;
        tinygltf::AnimationChannel channel;
        channel.sampler = static_cast<int>(animation.samplers.size());
        channel.target_node = node;
        channel.target_path = path;
        animation.samplers.push_back(std::move(sampler));
        animation.channels.push_back(std::move(channel));
    }

    [[nodiscard]] const std::vector<std::uint32_t>& words() const { return words_; }

private:
    int add(int component_type, int type, std::size_t numbers)
    {
        tinygltf::Accessor accessor;
        accessor.bufferView = view_;
        accessor.byteOffset = sizeof(std::uint32_t) * words_.size();
        accessor.componentType = component_type;
        accessor.type = type;
        accessor.count =
            numbers / static_cast<std::size_t>(tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(type)));
        model_.accessors.push_back(std::move(accessor));
        return static_cast<int>(model_.accessors.size()) - 1;
    }

    tinygltf::Model& model_;
    int view_;
    std::vector<std::uint32_t> words_;
};

void append(std::vector<float>& numbers, Vec3 v)
{
    numbers.insert(numbers.end(), {toFloat(v.x), toFloat(v.y), toFloat(v.z)});
}

/// Rounds numbers for JSON.
template <typename Numbers>
std::vector<double> rounded(const Numbers& numbers, int decimals)
{
    std::vector<double> result;
    for (const auto number : numbers) {
        const double unit = std::pow(10.0, decimals);
        result.push_back(std::round(unit * static_cast<double>(number)) / unit + 0.0);
    }
    return result;
}

/// Mesh of many droplets, each bound to its own joint; the last vertices belong to the anchors.
struct DropletGroup {
    DropletMesh mesh;
    std::vector<std::size_t> joints;  ///< joint of each vertex
};

DropletGroup groupOf(const DropletMesh& droplet)
{
    DropletGroup group;
    for (std::size_t k = 0; k < kDropletsOfMesh; ++k) {
        const auto first = static_cast<std::uint32_t>(group.mesh.positions.size());
        group.mesh.positions.insert(group.mesh.positions.end(), droplet.positions.begin(), droplet.positions.end());
        group.mesh.normals.insert(group.mesh.normals.end(), droplet.normals.begin(), droplet.normals.end());
        group.joints.insert(group.joints.end(), droplet.positions.size(), k);
        for (const auto& [a, b, c] : droplet.triangles) {
            group.mesh.triangles.push_back({first + a, first + b, first + c});
        }
    }
    // Viewers compute bounds once, from the first pose. The anchors extend them to two corners of the scene.
    for (std::size_t k = 0; k < kAnchors; ++k) {
        group.mesh.positions.emplace_back();
        group.mesh.normals.push_back({0.0, 0.0, 1.0});
        group.joints.push_back(kDropletsOfMesh + k);
    }
    return group;
}

class SceneWriter {
public:
    SceneWriter(const DropletHistories& histories, const JointScene& scene) : frames_(histories.frames()), about_(scene)
    {
        const Spans spans = spansOf(histories);
        model_ = makeBareModel(scene.material, meanRadius(spans), true);
        const int ground = scene.ground.add(model_);
        const bool moves = !scene.ground.poses.empty();
        scene_.nodes.push_back(ground);
        tinygltf::Node all;
        all.name = "droplets";
        root_ = addNode(std::move(all), moves ? std::optional(ground) : std::nullopt);
        for (const Vec3& corner : scene.ground.corners) {
            tinygltf::Node anchor;
            anchor.name = scene.ground.corner;
            const Vec3 up = yUp(corner);
            anchor.translation = rounded(std::array{up.x, up.y, up.z}, scene.decimals);
            anchors_.push_back(addNode(std::move(anchor), moves ? std::nullopt : std::optional(root_)));
        }
        resting_ = groupOf(scene.resting);
        running_ = groupOf(scene.running);
        falling_ = groupOf(scene.falling);
        // The view of the animation is the last one in the buffer.
        const int resting = spans.rests.empty() ? -1 : addGroup(resting_, "droplets at rest");
        const int running = spans.runs.empty() ? -1 : addGroup(running_, "droplets on their way");
        const int falling = spans.falls.empty() ? -1 : addGroup(falling_, "droplets in the air");
        if (!written_.empty()) {
            // Identity matrices, which some readers require.
            bind_ = addArray(model_, 0, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_MAT4, kDropletsOfMesh + kAnchors);
        }
        model_.animations.emplace_back().name = scene.animation;
        tracks_.emplace(model_, static_cast<int>(model_.bufferViews.size()));
        moveGround(ground);
        addRests(spans.rests, resting);
        addRuns(spans.runs, running, true);
        addRuns(spans.falls, falling, false);
        if (model_.animations.front().channels.empty()) {
            model_.animations.clear();
        } else {
            tinygltf::BufferView view;
            view.buffer = 0;
            view.byteOffset = bufferBytes(model_);
            view.byteLength = sizeof(std::uint32_t) * tracks_->words().size();
            model_.bufferViews.push_back(std::move(view));
        }
        model_.scenes.push_back(scene_);
        model_.defaultScene = 0;
    }

    std::uint64_t write(std::ostream& out) const
    {
        return writeBinary(out, model_, [&](ByteStream& bytes) {
            about_.ground.write(bytes);
            for (const DropletGroup* group : written_) {
                writeGroup(*group, bytes);
            }
            for (std::size_t k = 0; !written_.empty() && k < kDropletsOfMesh + kAnchors; ++k) {
                bytes.f32(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1);
            }
            for (const std::uint32_t word : tracks_->words()) {
                bytes.u32(word);
            }
        });
    }

private:
    [[nodiscard]] float timeOf(std::uint32_t frame) const { return toFloat(frame / about_.frames_per_second); }

    /// Thickness of the liquid for viewers, which do not scale it with joints.
    static double meanRadius(const Spans& spans)
    {
        double sum = 0.0;
        for (const std::vector<Span>* all : {&spans.rests, &spans.runs, &spans.falls}) {
            for (const Span& span : *all) {
                sum += static_cast<double>(span.history->at(span.begin).restRadius());
            }
        }
        const std::size_t count = spans.rests.size() + spans.runs.size() + spans.falls.size();
        return count > 0 ? sum / static_cast<double>(count) : 0.0;
    }

    int addNode(tinygltf::Node node, std::optional<int> parent)
    {
        const auto number = static_cast<int>(model_.nodes.size());
        model_.nodes.push_back(std::move(node));
        (parent ? model_.nodes[static_cast<std::size_t>(*parent)].children : scene_.nodes).push_back(number);
        return number;
    }

    int addGroup(const DropletGroup& group, const char* name)
    {
        const int mesh = addMesh(model_, group.mesh, name, 0);
        const auto add_bytes = [&](bool normalised) {
            const int accessor = addArray(model_, TINYGLTF_TARGET_ARRAY_BUFFER, TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE,
                                          TINYGLTF_TYPE_VEC4, group.joints.size());
            model_.accessors.back().normalized = normalised;
            return accessor;
        };
        auto& attributes = model_.meshes.back().primitives.front().attributes;
        attributes["JOINTS_0"] = add_bytes(false);
        attributes["WEIGHTS_0"] = add_bytes(true);
        written_.push_back(&group);
        return mesh;
    }

    static void writeGroup(const DropletGroup& group, ByteStream& bytes)
    {
        writeMesh(group.mesh, bytes);
        for (const std::size_t joint : group.joints) {
            bytes.u8(joint, 0, 0, 0);
        }
        for (std::size_t i = 0; i < group.joints.size(); ++i) {
            bytes.u8(255, 0, 0, 0);
        }
    }

    /// Adds nodes that show the joints, kDropletsOfMesh in each.
    void show(std::vector<int> joints, int mesh, int parent)
    {
        while (joints.size() % kDropletsOfMesh != 0) {
            tinygltf::Node spare;
            spare.scale = {0.0, 0.0, 0.0};
            joints.push_back(addNode(std::move(spare), parent));
        }
        for (std::size_t k = 0; k < joints.size(); k += kDropletsOfMesh) {
            tinygltf::Skin skin;
            skin.inverseBindMatrices = bind_;
            const auto first = joints.begin() + static_cast<std::ptrdiff_t>(k);
            skin.joints.assign(first, first + static_cast<std::ptrdiff_t>(kDropletsOfMesh));
            skin.joints.insert(skin.joints.end(), anchors_.begin(), anchors_.end());
            tinygltf::Node node;
            node.name = model_.meshes[static_cast<std::size_t>(mesh)].name;
            node.mesh = mesh;
            node.skin = static_cast<int>(model_.skins.size());
            model_.skins.push_back(std::move(skin));
            addNode(std::move(node), std::nullopt);
        }
    }

    /// Adds a joint in the pose of the first frame.
    int addJoint(const Span& span, int parent, Vec3 place, bool turns)
    {
        tinygltf::Node joint;
        if (span.begin > 0) {
            joint.scale = {0.0, 0.0, 0.0};
        } else {
            const DropletPose& pose = span.history->at(0);
            joint.translation = rounded(std::array{place.x, place.y, place.z}, about_.decimals);
            if (turns) {
                joint.rotation = rounded(pose.turn, 4);
                joint.scale = rounded(std::array{pose.along, pose.up, pose.across}, about_.decimals + 1);
            } else {
                joint.scale =
                    rounded(std::array{pose.restRadius(), pose.restRadius(), pose.restRadius()}, about_.decimals + 1);
            }
        }
        return addNode(std::move(joint), parent);
    }

    void moveGround(int node)
    {
        const std::vector<SceneGround::Pose>& poses = about_.ground.poses;
        if (poses.empty()) {
            return;
        }
        std::vector<float> times;
        std::vector<float> places;
        std::vector<float> turns;
        for (std::uint32_t frame = 0; frame < poses.size(); ++frame) {
            times.push_back(timeOf(frame));
            places.insert(places.end(), poses[frame].place.begin(), poses[frame].place.end());
            turns.insert(turns.end(), poses[frame].turn.begin(), poses[frame].turn.end());
        }
        const int input = tracks_->addTimes(times);
        tracks_->animate(node, "translation", input, tracks_->addFloats(TINYGLTF_TYPE_VEC3, places), "LINEAR");
        tracks_->animate(node, "rotation", input, tracks_->addFloats(TINYGLTF_TYPE_VEC4, turns), "LINEAR");
    }

    /// Droplets at rest with the same normal, to kFacing.
    struct Facing {
        std::array<float, 4> turn{};
        Vec3 normal;
        std::vector<Span> spans;
    };

    void addRests(const std::vector<Span>& rests, int mesh)
    {
        std::vector<Facing> facings;
        for (const Span& rest : rests) {
            const DropletPose& pose = rest.history->at(rest.begin);
            const Vec3 normal = pose.normal();
            auto facing = std::find_if(facings.begin(), facings.end(),
                                       [&](const Facing& one) { return dot(one.normal, normal) > std::cos(kFacing); });
            if (facing == facings.end()) {
                facing = facings.insert(facings.end(), {pose.turn, normal, {}});
            }
            facing->spans.push_back(rest);
        }
        std::vector<int> joints;
        for (const Facing& facing : facings) {
            tinygltf::Node node;
            node.name = "at rest";
            node.rotation.assign(facing.turn.begin(), facing.turn.end());
            const int parent = addNode(std::move(node), root_);
            const auto [x, y, z, w] = facing.turn;
            const std::array<float, 4> back{-x, -y, -z, w};
            for (const std::vector<std::size_t>& slot : assignSlots(facing.spans, 0)) {
                std::vector<float> times;
                std::vector<float> places;
                std::vector<float> sizes;
                std::uint32_t free = 0;
                const auto key = [&](std::uint32_t frame, Vec3 place, float radius) {
                    times.push_back(timeOf(frame));
                    append(places, place);
                    sizes.insert(sizes.end(), 3, radius);
                };
                Vec3 place;
                for (const std::size_t number : slot) {
                    const Span& span = facing.spans[number];
                    if (span.begin > free) {
                        key(free, place, 0.0F);
                    }
                    forChanges(span, about_.place_tolerance, [&](std::uint32_t frame, const DropletPose& pose) {
                        place = turnedBy(back, vectorOf(pose.place));
                        key(frame, place, pose.restRadius());
                    });
                    free = span.end;
                }
                if (free < frames_) {
                    key(free, place, 0.0F);
                }
                const Span& first = facing.spans[slot.front()];
                const int joint =
                    addJoint(first, parent, turnedBy(back, vectorOf(first.history->at(first.begin).place)), false);
                joints.push_back(joint);
                if (times.size() > 1) {
                    const int input = tracks_->addTimes(times);
                    if (!std::equal(places.begin() + 3, places.end(), places.begin())) {
                        tracks_->animate(joint, "translation", input, tracks_->addFloats(TINYGLTF_TYPE_VEC3, places),
                                         "STEP");
                    }
                    tracks_->animate(joint, "scale", input, tracks_->addFloats(TINYGLTF_TYPE_VEC3, sizes), "STEP");
                }
            }
        }
        show(std::move(joints), mesh, root_);
    }

    /// @param turns  whether the droplets have a direction
    void addRuns(const std::vector<Span>& runs, int mesh, bool turns)
    {
        std::vector<int> joints;
        for (const std::vector<std::size_t>& slot : assignSlots(runs, 1)) {
            std::vector<float> times;
            std::vector<float> places;
            std::vector<float> changes;  // times of rotations and sizes
            std::vector<std::array<float, 4>> rotations;
            std::vector<float> sizes;
            const auto change = [&](std::uint32_t frame, const DropletPose& pose) {
                changes.push_back(timeOf(frame));
                rotations.push_back(pose.turn);
                sizes.insert(sizes.end(), {pose.along, pose.up, pose.across});
            };
            const auto hide = [&](std::uint32_t frame, DropletPose pose) {
                pose.along = 0.0F;
                pose.across = 0.0F;
                pose.up = 0.0F;
                change(frame, pose);
            };
            const Span& first = runs[slot.front()];
            if (first.begin > 0) {
                hide(0, first.history->at(first.begin));
            }
            for (const std::size_t number : slot) {
                const Span& run = runs[number];
                const auto tolerance = about_.place_tolerance * static_cast<double>(run.history->at(run.begin).across);
                for (const Point& point :
                     reduced(pathOf(run), tolerance, about_.time_tolerance * about_.frames_per_second)) {
                    times.push_back(timeOf(point.frame));
                    append(places, point.place);
                }
                forChanges(run, std::nullopt, change);
                if (run.end < frames_) {
                    hide(run.end, run.history->at(run.end - 1));
                }
            }
            const int joint = addJoint(first, root_, vectorOf(first.history->at(first.begin).place), turns);
            joints.push_back(joint);
            tracks_->animate(joint, "translation", tracks_->addTimes(times),
                             tracks_->addFloats(TINYGLTF_TYPE_VEC3, places), "LINEAR");
            const int input = tracks_->addTimes(changes);
            if (turns) {
                tracks_->animate(joint, "rotation", input, tracks_->addTurns(rotations), "STEP");
            }
            tracks_->animate(joint, "scale", input, tracks_->addFloats(TINYGLTF_TYPE_VEC3, sizes), "STEP");
        }
        show(std::move(joints), mesh, root_);
    }

    std::uint32_t frames_;
    const JointScene& about_;
    DropletGroup resting_;
    DropletGroup running_;
    DropletGroup falling_;
    std::vector<const DropletGroup*> written_;
    tinygltf::Model model_;
    tinygltf::Scene scene_;
    int root_ = 0;
    int bind_ = -1;  ///< accessor of the inverse bind matrices
    std::vector<int> anchors_;
    std::optional<Tracks> tracks_;
};

}  // namespace

std::uint64_t writeSceneOfJoints(const DropletHistories& histories, const JointScene& scene, std::ostream& out)
{
    return SceneWriter(histories, scene).write(out);
}

void checkSceneOfJoints(const DropletHistories& histories, const char* remedy)
{
    // Bytes of a joint's JSON and of a sample's keys. In memory the JSON takes about fifteen times as much.
    constexpr std::uint64_t kJoint = 800;
    constexpr std::uint64_t kSample = 10;
    constexpr std::uint64_t kMax = std::uint64_t{1} << 27;
    const std::uint64_t bytes = kSample * histories.samples() + kJoint * histories.maxCount();
    if (bytes >= kMax) {
        throw Error(ErrorCode::InvalidArgument,
                    std::to_string(histories.frames()) + " frames of up to " + std::to_string(histories.maxCount()) +
                        " droplets would make a glTF file of about " + std::to_string(bytes) +
                        " bytes; it must be less than 128 MiB: use a shorter time, fewer frames per second or " +
                        remedy);
    }
}

}  // namespace droplet
