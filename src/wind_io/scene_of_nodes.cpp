// SPDX-License-Identifier: GPL-3.0-or-later
// Khronos Group, "glTF 2.0 Specification" (2021), sections 3.7.3, skins, and 3.11, animations.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <optional>
#include <ostream>
#include <string>
#include <utility>

#include "io/axes.h"
#include "io/gltf_model.h"
#include "wind_io/droplet_nets.h"
#include "wind_io/scene_files.h"

namespace droplet {
namespace {

/// Droplets in a mesh, each with a joint of its own: few draw calls, and indices of joints fit into a byte.
constexpr std::size_t kDropletsOfMesh = 62;
constexpr std::size_t kAnchors = 2;
/// Shorter rests stay with the run around them: another joint would cost more keys [frames].
constexpr std::uint32_t kShortRest = 15;
/// Runs are right to this share of a droplet's width across their way,
constexpr double kPlaceTolerance = 0.25;
/// and along it to this time more [s].
constexpr double kTimeTolerance = 5e-3;

/// When a slot shows a droplet.
struct Span {
    const DropletLife* life = nullptr;
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
};

/// Rests and runs of all droplets.
struct Spans {
    std::vector<Span> rests;
    std::vector<Span> runs;
};

Vec3 vectorOf(const std::array<float, 3>& v)
{
    return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
}

/// Whether a droplet is on its way from one sample to the next. What falls on one at rest may shift its middle.
bool runs(const DropletPose& from, const DropletPose& to)
{
    return from.moves || to.moves || length(vectorOf(to.place) - vectorOf(from.place)) > static_cast<double>(to.across);
}

void split(const DropletLife& life, Spans& spans)
{
    std::uint32_t done = life.begin();
    std::optional<std::uint32_t> running;  // since when
    std::uint32_t moved = 0;               // up to when
    const auto end_run = [&](std::uint32_t next) {
        if (running && next - moved >= kShortRest) {
            spans.runs.push_back({&life, *running, moved});
            done = moved;
            running.reset();
        }
    };
    for (std::size_t i = 1; i < life.samples.size(); ++i) {
        const DropletPose& from = life.samples[i - 1].pose;
        const DropletPose& to = life.samples[i].pose;
        if (from.place == to.place || !runs(from, to)) {
            continue;
        }
        const std::uint32_t frame = life.samples[i].frame;
        end_run(frame - 1);
        if (!running) {
            running = frame - 1 - done >= kShortRest ? frame - 1 : done;
            if (*running > done) {
                spans.rests.push_back({&life, done, *running});
            }
        }
        moved = frame;
    }
    end_run(life.end);
    if (running) {
        spans.runs.push_back({&life, *running, life.end});
    } else {
        spans.rests.push_back({&life, done, life.end});
    }
}

Spans spansOf(const DropletLives& lives)
{
    Spans spans;
    for (const DropletLife* life : lives.all()) {
        split(*life, spans);
    }
    for (std::vector<Span>* all : {&spans.rests, &spans.runs}) {
        std::stable_sort(all->begin(), all->end(), [](const Span& a, const Span& b) { return a.begin < b.begin; });
    }
    return spans;
}

/// Where a droplet is at the beginning of a frame.
struct Point {
    std::uint32_t frame = 0;
    Vec3 place;
};

/// The way of a run; straight and even between two points.
std::vector<Point> wayOf(const Span& run)
{
    std::vector<Point> way;
    const auto go = [&](std::uint32_t frame) { way.push_back({frame, vectorOf(run.life->at(frame).place)}); };
    go(run.begin);
    for (const DropletSample& sample : run.life->samples) {
        if (sample.frame > run.begin && sample.frame < run.end) {
            if (sample.frame - 1 > way.back().frame) {
                go(sample.frame - 1);  // until then it rested
            }
            go(sample.frame);
        }
    }
    if (way.back().frame < run.end) {
        // It goes on where it will rest, or ends where it was.
        way.push_back({run.end, run.end < run.life->end ? vectorOf(run.life->at(run.end).place) : way.back().place});
    }
    return way;
}

/// The points that suffice. D. H. Douglas and T. K. Peucker, "Algorithms for the reduction of the number of points
/// required to represent a digitized line", Cartographica 10 (1973) 112, over time.
std::vector<Point> reduced(const std::vector<Point>& way, double tolerance, double frames_per_second)
{
    std::vector<bool> kept(way.size(), false);
    kept.front() = true;
    kept.back() = true;
    std::vector<std::pair<std::size_t, std::size_t>> open{{0, way.size() - 1}};
    while (!open.empty()) {
        const auto [first, last] = open.back();
        open.pop_back();
        const double frames = way[last].frame - way[first].frame;
        const Vec3 chord = way[last].place - way[first].place;
        const double size = length(chord);
        const Vec3 along = size > 0.0 ? (1.0 / size) * chord : Vec3{};
        const double longer = tolerance + kTimeTolerance * size * frames_per_second / std::max(frames, 1.0);
        double worst = 1.0;
        std::size_t split = 0;
        for (std::size_t i = first + 1; i < last; ++i) {
            const double share = (way[i].frame - way[first].frame) / frames;
            const Vec3 off = way[i].place - way[first].place - share * chord;
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
    for (std::size_t i = 0; i < way.size(); ++i) {
        if (kept[i]) {
            points.push_back(way[i]);
        }
    }
    return points;
}

/// Calls take(frame, pose) for the begin of a span and where a droplet's size, a resting one's place or a running one's
/// shape has changed since it was last called.
template <typename Take>
void forChanges(const Span& span, bool running, const Take& take)
{
    DropletPose last = span.life->at(span.begin);
    take(span.begin, last);
    for (const DropletSample& sample : span.life->samples) {
        if (sample.frame <= span.begin || sample.frame >= span.end) {
            continue;
        }
        const DropletPose& pose = sample.pose;
        const double shift = length(vectorOf(pose.place) - vectorOf(last.place));
        if (!last.looksLike(pose) || (!running && shift > kPlaceTolerance * static_cast<double>(pose.restRadius()))) {
            last = sample.pose;
            take(sample.frame, last);
        }
    }
}

/// Numbers of an animation, and the accessors on them.
class Tracks {
public:
    /// @param view  the buffer's view that will hold them
    Tracks(tinygltf::Model& model, int view) : model_(model), view_(view) {}

    int addTimes(const std::vector<float>& times)
    {
        const int accessor = addFloats(TINYGLTF_TYPE_SCALAR, times);
        // As short as tells the float.
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

    /// Quaternions, to 2^-15.
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

/// As they stand in JSON, to so many decimals.
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

/// A mesh of many droplets, each bound to the joint of its number; the last vertices are the anchors'.
struct Herd {
    Net net;
    std::vector<std::size_t> joints;  ///< by vertex
};

Herd herdOf(const Net& droplet)
{
    Herd herd;
    for (std::size_t k = 0; k < kDropletsOfMesh; ++k) {
        const auto first = static_cast<std::uint32_t>(herd.net.positions.size());
        herd.net.positions.insert(herd.net.positions.end(), droplet.positions.begin(), droplet.positions.end());
        herd.net.normals.insert(herd.net.normals.end(), droplet.normals.begin(), droplet.normals.end());
        herd.joints.insert(herd.joints.end(), droplet.positions.size(), k);
        for (const auto& [a, b, c] : droplet.triangles) {
            herd.net.triangles.push_back({first + a, first + b, first + c});
        }
    }
    // Viewers measure a mesh once, where its joints are then; of the glass's two corners no triangle is made.
    for (std::size_t k = 0; k < kAnchors; ++k) {
        herd.net.positions.emplace_back();
        herd.net.normals.push_back({0.0, 0.0, 1.0});
        herd.joints.push_back(kDropletsOfMesh + k);
    }
    return herd;
}

class SceneOfNodes {
public:
    SceneOfNodes(const DropletLives& lives, const Glass& glass, const DropletSceneOptions& options)
        : frames_(lives.frames()), options_(options), pane_(glassNet(glass))
    {
        const Spans spans = spansOf(lives);
        model_ = makeBareModel(options.material, meanRadius(spans), true);
        scene_.nodes.push_back(addGlass(model_, pane_));
        tinygltf::Node all;
        all.name = "droplets";
        root_ = addNode(std::move(all), std::nullopt);
        const Vec3 none{};
        for (const bool low : {true, false}) {
            Vec3 corner = none;
            for (const Vec3& position : pane_.positions) {
                const auto farther = [&](double a, double b) { return low ? std::min(a, b) : std::max(a, b); };
                corner = &position == &pane_.positions.front()
                             ? position
                             : Vec3{farther(corner.x, position.x), farther(corner.y, position.y),
                                    farther(corner.z, position.z)};
            }
            tinygltf::Node anchor;
            anchor.name = "corner of the glass";
            const Vec3 up = yUp(corner);
            anchor.translation = rounded(std::array{up.x, up.y, up.z}, 5);
            anchors_.push_back(addNode(std::move(anchor), root_));
        }
        resting_ = herdOf(capNet(options.shape.contact_angle, {.around = 12, .rings = 3}));
        running_ = herdOf(capNet(options.shape.contact_angle, {.around = 16, .rings = 5}));
        // Views come first: the tracks' is the last one in the buffer.
        const int resting = spans.rests.empty() ? -1 : addHerd(resting_, "droplets at rest");
        const int running = spans.runs.empty() ? -1 : addHerd(running_, "droplets on their way");
        if (!written_.empty()) {
            // They change nothing, but some readers cannot do without.
            bind_ = addArray(model_, 0, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_MAT4, kDropletsOfMesh + kAnchors);
        }
        model_.animations.emplace_back().name = "rain";
        tracks_.emplace(model_, static_cast<int>(model_.bufferViews.size()));
        addRests(spans.rests, resting);
        addRuns(spans.runs, running);
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
            writeNet(pane_, bytes);
            for (const Herd* herd : written_) {
                writeHerd(*herd, bytes);
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
    [[nodiscard]] float timeOf(std::uint32_t frame) const { return toFloat(frame / options_.frames_per_second); }

    /// How thick liquid is, to viewers: they do not scale it with joints.
    static double meanRadius(const Spans& spans)
    {
        double sum = 0.0;
        for (const std::vector<Span>* all : {&spans.rests, &spans.runs}) {
            for (const Span& span : *all) {
                sum += static_cast<double>(span.life->at(span.begin).restRadius());
            }
        }
        const std::size_t count = spans.rests.size() + spans.runs.size();
        return count > 0 ? sum / static_cast<double>(count) : 0.0;
    }

    int addNode(tinygltf::Node node, std::optional<int> parent)
    {
        const auto number = static_cast<int>(model_.nodes.size());
        model_.nodes.push_back(std::move(node));
        (parent ? model_.nodes[static_cast<std::size_t>(*parent)].children : scene_.nodes).push_back(number);
        return number;
    }

    int addHerd(const Herd& herd, const char* name)
    {
        const int mesh = addNet(model_, herd.net, name, 0);
        const auto add_bytes = [&](bool normalised) {
            const int accessor = addArray(model_, TINYGLTF_TARGET_ARRAY_BUFFER, TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE,
                                          TINYGLTF_TYPE_VEC4, herd.joints.size());
            model_.accessors.back().normalized = normalised;
            return accessor;
        };
        auto& attributes = model_.meshes.back().primitives.front().attributes;
        attributes["JOINTS_0"] = add_bytes(false);
        attributes["WEIGHTS_0"] = add_bytes(true);
        written_.push_back(&herd);
        return mesh;
    }

    static void writeHerd(const Herd& herd, ByteStream& bytes)
    {
        writeNet(herd.net, bytes);
        for (const std::size_t joint : herd.joints) {
            bytes.u8(joint, 0, 0, 0);
        }
        for (std::size_t i = 0; i < herd.joints.size(); ++i) {
            bytes.u8(255, 0, 0, 0);
        }
    }

    /// Shows joints, so many to a mesh.
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

    /// A joint as it is in the first frame.
    int addJoint(const Span& span, int parent, Vec3 place, bool turns)
    {
        tinygltf::Node joint;
        if (span.begin > 0) {
            joint.scale = {0.0, 0.0, 0.0};
        } else {
            const DropletPose& pose = span.life->at(0);
            joint.translation = rounded(std::array{place.x, place.y, place.z}, 5);
            if (turns) {
                joint.rotation = rounded(pose.turn, 4);
                joint.scale = rounded(std::array{pose.along, pose.across, pose.across}, 6);
            } else {
                joint.scale = rounded(std::array{pose.restRadius(), pose.restRadius(), pose.restRadius()}, 6);
            }
        }
        return addNode(std::move(joint), parent);
    }

    /// Droplets that face one way, to kFacing.
    struct Facing {
        std::array<float, 4> turn{};
        Vec3 normal;
        std::vector<Span> spans;
    };

    void addRests(const std::vector<Span>& rests, int mesh)
    {
        std::vector<Facing> facings;
        for (const Span& rest : rests) {
            const DropletPose& pose = rest.life->at(rest.begin);
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
            for (const std::vector<std::size_t>& slot : pooled(facing.spans, 0)) {
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
                    forChanges(span, false, [&](std::uint32_t frame, const DropletPose& pose) {
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
                    addJoint(first, parent, turnedBy(back, vectorOf(first.life->at(first.begin).place)), false);
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

    void addRuns(const std::vector<Span>& runs, int mesh)
    {
        std::vector<int> joints;
        for (const std::vector<std::size_t>& slot : pooled(runs, 1)) {
            std::vector<float> times;
            std::vector<float> places;
            std::vector<float> changes;  // times of turns and sizes
            std::vector<std::array<float, 4>> turns;
            std::vector<float> sizes;
            const auto change = [&](std::uint32_t frame, const DropletPose& pose) {
                changes.push_back(timeOf(frame));
                turns.push_back(pose.turn);
                sizes.insert(sizes.end(), {pose.along, pose.across, pose.across});
            };
            const auto hide = [&](std::uint32_t frame, DropletPose pose) {
                pose.along = 0.0F;
                pose.across = 0.0F;
                change(frame, pose);
            };
            const Span& first = runs[slot.front()];
            if (first.begin > 0) {
                hide(0, first.life->at(first.begin));
            }
            for (const std::size_t number : slot) {
                const Span& run = runs[number];
                const auto tolerance = kPlaceTolerance * static_cast<double>(run.life->at(run.begin).across);
                for (const Point& point : reduced(wayOf(run), tolerance, options_.frames_per_second)) {
                    times.push_back(timeOf(point.frame));
                    append(places, point.place);
                }
                forChanges(run, true, change);
                if (run.end < frames_) {
                    hide(run.end, run.life->at(run.end - 1));
                }
            }
            const int joint = addJoint(first, root_, vectorOf(first.life->at(first.begin).place), true);
            joints.push_back(joint);
            tracks_->animate(joint, "translation", tracks_->addTimes(times),
                             tracks_->addFloats(TINYGLTF_TYPE_VEC3, places), "LINEAR");
            const int input = tracks_->addTimes(changes);
            tracks_->animate(joint, "rotation", input, tracks_->addTurns(turns), "STEP");
            tracks_->animate(joint, "scale", input, tracks_->addFloats(TINYGLTF_TYPE_VEC3, sizes), "STEP");
        }
        show(std::move(joints), mesh, root_);
    }

    std::uint32_t frames_;
    DropletSceneOptions options_;
    Net pane_;
    Herd resting_;
    Herd running_;
    std::vector<const Herd*> written_;
    tinygltf::Model model_;
    tinygltf::Scene scene_;
    int root_ = 0;
    int bind_ = -1;  ///< accessor of inverse bind matrices
    std::vector<int> anchors_;
    std::optional<Tracks> tracks_;
};

}  // namespace

std::uint64_t writeSceneOfNodes(const DropletLives& lives, const Glass& glass, const DropletSceneOptions& options,
                                std::ostream& out)
{
    return SceneOfNodes(lives, glass, options).write(out);
}

}  // namespace droplet
