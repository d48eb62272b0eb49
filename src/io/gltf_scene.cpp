// SPDX-License-Identifier: GPL-3.0-or-later
// Khronos Group, "glTF 2.0 Specification" (2021), sections 3.5 to 3.7 and 3.11.
#include "io/gltf_scene.h"

#include <tbb/parallel_for.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "axes.h"
#include "droplet/units.h"
#include "file_bytes.h"
#include "io/gltf_column.h"
#include "io/gltf_file.h"
#include "io/gltf_pose.h"
#include "io/vertex_normals.h"

namespace droplet {
namespace {

constexpr std::size_t kMaxTriangles = std::size_t{1} << 26;  // a small file can repeat one mesh many times

/// Times of keys that represent the tracks; curves become pieces.
std::vector<double> keyTimes(const std::optional<KeyTrack>& a, const std::optional<KeyTrack>& b)
{
    constexpr std::size_t kPieces = 16;
    std::vector<double> times;
    for (const std::optional<KeyTrack>& track : {a, b}) {
        for (std::size_t i = 0; track && i < track->times.size(); ++i) {
            times.push_back(track->times[i]);
            const bool is_curve = track->interpolation == KeyTrack::Interpolation::CubicSpline;
            for (std::size_t k = 1; is_curve && i + 1 < track->times.size() && k < kPieces; ++k) {
                times.push_back(track->times[i] + static_cast<double>(k) / static_cast<double>(kPieces) *
                                                      (track->times[i + 1] - track->times[i]));
            }
        }
    }
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
    return times;
}

/// Motion of what an animated node carries, away from its rest pose.
/// @param parent  keeps angles if there is a rotation
FileMotion motionOf(const tinygltf::Node& node, const Placement& parent, const std::optional<KeyTrack>& translation,
                    const std::optional<KeyTrack>& rotation)
{
    const std::vector<double>& t = node.translation;
    const std::vector<double>& q = node.rotation;
    const Vec3 place_at_rest = t.empty() ? Vec3{} : Vec3{t[0], t[1], t[2]};
    const Rotation turn_at_rest = q.empty() ? Rotation{} : KeyTrack::turnOf({q[0], q[1], q[2], q[3]});
    const double size = length(parent.x);
    FileMotion motion;
    const Vec3 pivot = parent.place(place_at_rest);
    motion.pivot = zUp(pivot);
    for (const double time : keyTimes(translation, rotation)) {
        for (const bool after : {false, true}) {
            FileMotion::Key key;
            key.time = time;
            Rotation turn;
            if (rotation) {
                turn = KeyTrack::turnOf(rotation->at(time, after)) * turn_at_rest.inverse();
                // A mirror image turns the other way.
                turn.axis = ((parent.mirrors() ? -1.0 : 1.0) / size) * parent.direction(turn.axis);
            }
            Vec3 place = pivot;
            if (translation) {
                const KeyTrack::Value value = translation->at(time, after);
                place = parent.place({value[0], value[1], value[2]});
            }
            key.turn = {zUp(turn.axis), turn.real};
            key.place = zUp(place - turn.of(pivot));
            if (!std::isfinite(length(key.place))) {
                throw Damage("an animation holds numbers that are not finite");
            }
            if (!after || !(motion.keys.back().turn == key.turn && motion.keys.back().place == key.place)) {
                motion.keys.push_back(key);
            }
        }
    }
    return motion;
}

std::vector<int> rootsOf(const tinygltf::Model& model)
{
    if (!model.scenes.empty()) {
        return entry(model.scenes, std::max(model.defaultScene, 0), "scenes").nodes;
    }
    std::vector<bool> child(model.nodes.size(), false);
    for (const tinygltf::Node& node : model.nodes) {
        for (const int c : node.children) {
            entry(model.nodes, c, "nodes");
            child[static_cast<std::size_t>(c)] = true;
        }
    }
    std::vector<int> roots;
    for (std::size_t i = 0; i < child.size(); ++i) {
        if (!child[i]) {
            roots.push_back(static_cast<int>(i));
        }
    }
    return roots;
}

/// Triangles of a primitive by its mode (section 3.7.2.1): triangles, strips and fans; none for points and lines.
std::vector<Triangle> trianglesOf(int mode, const std::vector<std::uint32_t>& index)
{
    std::vector<Triangle> triangles;
    const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
        const Triangle t = {index[a], index[b], index[c]};
        if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) {
            triangles.push_back(t);
        }
    };
    for (std::size_t i = 0; mode == TINYGLTF_MODE_TRIANGLES && i + 2 < index.size(); i += 3) {
        add(i, i + 1, i + 2);
    }
    for (std::size_t i = 0; mode == TINYGLTF_MODE_TRIANGLE_STRIP && i + 2 < index.size(); ++i) {
        add(i, i + 1 + i % 2, i + 2 - i % 2);
    }
    for (std::size_t i = 1; mode == TINYGLTF_MODE_TRIANGLE_FAN && i + 1 < index.size(); ++i) {
        add(i, i + 1, 0);
    }
    return triangles;
}

/// Triangles of a primitive in a node, and what their vertices are computed from.
struct Part {
    /// Change of all vertices by a morph target.
    struct Target {
        std::optional<Column> vertices;
        std::optional<Column> normals;
    };
    /// Joints of each vertex, and what they weigh; four each.
    struct Binding {
        Column joints;
        Column weights;
    };

    std::string name;
    std::size_t node = 0;
    std::size_t first_vertex = 0;
    std::size_t first_triangle = 0;
    Column vertices;
    std::optional<Column> normals;
    std::vector<Target> targets = {};
    std::optional<std::size_t> skin = {};
    std::vector<Binding> bindings = {};

    /// Where a vertex is put in a pose: by its joints, or by its node.
    [[nodiscard]] Placement placementOf(const GltfPose& pose, std::size_t v) const
    {
        if (!skin || pose.joints.empty()) {
            return pose.nodes[node];
        }
        const std::vector<Placement>& joints = pose.joints[*skin];
        Placement sum{{}, {}, {}, {}};
        double total = 0.0;
        for (const Binding& binding : bindings) {
            for (std::size_t k = 0; k < 4; ++k) {
                const double weight = binding.weights.number(v, k);
                if (weight == 0.0) {
                    continue;
                }
                const double number = binding.joints.number(v, k);
                if (!(number < static_cast<double>(joints.size()))) {
                    throw Damage(name + " names a joint that does not exist");
                }
                const Placement& joint = joints[static_cast<std::size_t>(number)];
                total += weight;
                sum.x = sum.x + weight * joint.x;
                sum.y = sum.y + weight * joint.y;
                sum.z = sum.z + weight * joint.z;
                sum.origin = sum.origin + weight * joint.origin;
            }
        }
        if (!(total > 0.0)) {
            return pose.nodes[node];
        }
        const double share = 1.0 / total;
        return {share * sum.x, share * sum.y, share * sum.z, share * sum.origin};
    }
};

class SceneReader {
public:
    SceneReader(const GltfFile& file, const SceneOptions& options)
        : file_(file), model_(file.model), options_(options), is_animated_(model_.nodes.size(), false)
    {
        for (const GltfAnimation& animation : file.animations) {
            for (const GltfChannel& channel : animation.channels) {
                if (isMotion(channel) && channel.node < model_.nodes.size()) {
                    is_animated_[*channel.node] = true;
                }
            }
        }
        visitNodes();
        if (mesh_.triangles.empty()) {
            throw Damage("its scene has no triangles");
        }
        dropEmptyColumns();
        readAnimation();
        placeVertices();
        mesh_.weld = firstAtPlace(mesh_.vertices);
        completeNormals(mesh_, options_.creases);
        for (std::size_t v = 0; v < mesh_.vertices.size(); ++v) {
            mesh_.vertices[v] = zUp(mesh_.vertices[v]);
            mesh_.normals[v] = zUp(mesh_.normals[v]);
        }
        for (std::vector<Vec3>& shape : mesh_.shapes) {
            std::transform(shape.begin(), shape.end(), shape.begin(), zUp);
        }
    }

    [[nodiscard]] FileMesh take() { return std::move(mesh_); }

private:
    /// Animated node that carries all triangles.
    struct Mover {
        std::size_t node = 0;
        Placement parent;
    };
    struct Visit {
        int node = 0;
        std::optional<std::size_t> parent;
        std::optional<std::size_t> mover;
    };

    static bool isMotion(const GltfChannel& channel)
    {
        return channel.node && (channel.path == "translation" || channel.path == "rotation");
    }

    void visitNodes()
    {
        std::vector<Visit> open;
        const auto visit_later = [&open](std::vector<int> nodes, std::optional<std::size_t> parent,
                                         std::optional<std::size_t> mover) {
            std::reverse(nodes.begin(), nodes.end());  // this is a stack: the first node is visited first
            for (const int node : nodes) {
                open.push_back({node, parent, mover});
            }
        };
        visit_later(rootsOf(model_), {}, {});
        parents_.resize(model_.nodes.size());
        std::vector<bool> seen(model_.nodes.size(), false);
        while (!open.empty()) {
            const Visit visit = open.back();
            open.pop_back();
            const tinygltf::Node& node = entry(model_.nodes, visit.node, "nodes");
            const auto index = static_cast<std::size_t>(visit.node);
            if (seen[index]) {
                throw Damage("nodes[" + std::to_string(visit.node) + "] has two parents");
            }
            seen[index] = true;
            visits_.push_back({index, visit.parent});
            parents_[index] = visit.parent;
            const auto mover = visit.mover || !is_animated_[index] ? visit.mover : std::optional(index);
            mesh_.deforms = mesh_.deforms || node.skin >= 0;
            if (node.mesh >= 0) {
                const std::size_t before = mesh_.triangles.size();
                addMesh(index);
                if (mesh_.triangles.size() > before) {
                    movers_.push_back(mover);
                }
            }
            visit_later(node.children, index, mover);
        }
    }

    /// Reads what moves the mesh: an animation that deforms it, if that is asked for, otherwise a motion of the whole.
    void readAnimation()
    {
        rest_ = restPose(model_, visits_);
        if (options_.sampling) {
            const std::set<std::size_t> moving = movingNodes();
            const GltfAnimation* const animation = chosenAnimation(moving);
            if (animation != nullptr && deforms(*animation, moving)) {
                std::set<std::size_t> skins;
                for (const Part& part : parts_) {
                    if (part.skin) {
                        skins.insert(*part.skin);
                    }
                }
                motion_.emplace(file_, visits_, *animation, std::vector<std::size_t>(skins.begin(), skins.end()));
                mesh_.deformation_end = motion_->end();
                mesh_.deforms = false;
                mesh_.animation_names = namesOf(file_.animations);
                return;
            }
        }
        readMotion();
    }

    static std::vector<std::string> namesOf(const std::vector<GltfAnimation>& animations)
    {
        std::vector<std::string> names(animations.size());
        std::transform(animations.begin(), animations.end(), names.begin(),
                       [](const GltfAnimation& animation) { return animation.name; });
        return names;
    }

    /// Nodes whose places decide where triangles are.
    [[nodiscard]] std::set<std::size_t> movingNodes() const
    {
        std::set<std::size_t> moving;
        const auto include = [&](std::optional<std::size_t> node) {
            while (node && moving.insert(*node).second) {
                node = parents_[*node];
            }
        };
        for (const Part& part : parts_) {
            if (!part.skin) {
                include(part.node);
                continue;
            }
            for (const std::size_t joint : file_.skins[*part.skin].joints) {
                include(joint < parents_.size() ? std::optional(joint) : std::nullopt);
            }
        }
        return moving;
    }

    [[nodiscard]] bool moves(const GltfChannel& channel, const std::set<std::size_t>& moving) const
    {
        if (channel.path == "weights") {
            return std::any_of(parts_.begin(), parts_.end(),
                               [&](const Part& part) { return channel.node == part.node && !part.targets.empty(); });
        }
        return channel.node && moving.contains(*channel.node) &&
               (channel.path == "translation" || channel.path == "rotation" || channel.path == "scale");
    }

    /// The animation of the name that is asked for, or the first that moves triangles; null: there is none.
    [[nodiscard]] const GltfAnimation* chosenAnimation(const std::set<std::size_t>& moving) const
    {
        const std::optional<std::string>& name = options_.sampling->animation;
        const auto found =
            std::find_if(file_.animations.begin(), file_.animations.end(), [&](const GltfAnimation& animation) {
                return name ? animation.name == *name
                            : std::any_of(animation.channels.begin(), animation.channels.end(),
                                          [&](const GltfChannel& channel) { return moves(channel, moving); });
            });
        if (found != file_.animations.end()) {
            return &*found;
        }
        if (name) {
            std::string names;
            for (const GltfAnimation& animation : file_.animations) {
                names += (names.empty() ? "" : ", ") + animation.name;
            }
            throw Damage("it has no animation " + *name + (names.empty() ? "" : "; it has " + names));
        }
        return nullptr;
    }

    /// Whether an animation does more than to move all triangles as one body.
    [[nodiscard]] bool deforms(const GltfAnimation& animation, const std::set<std::size_t>& moving) const
    {
        const std::optional<std::size_t> mover = commonMover();
        const bool is_rigid = mover && model_.nodes[*mover].matrix.empty() && parentOf(*mover).keepsAngles();
        return std::any_of(animation.channels.begin(), animation.channels.end(), [&](const GltfChannel& channel) {
            return moves(channel, moving) && !(is_rigid && isMotion(channel) && *channel.node == *mover) &&
                   !isStill(file_, channel);
        });
    }

    /// The node that carries all triangles, if one is animated.
    [[nodiscard]] std::optional<std::size_t> commonMover() const
    {
        const bool is_same = std::all_of(movers_.begin(), movers_.end(),
                                         [&](const auto& other) { return other && other == movers_.front(); });
        return is_same ? movers_.front() : std::nullopt;
    }

    [[nodiscard]] Placement parentOf(std::size_t node) const
    {
        return parents_[node] ? rest_.nodes[*parents_[node]] : Placement{};
    }

    /// Time that a frame shows. A cycle, which ends as it begins, is repeated; otherwise the end stays.
    [[nodiscard]] std::vector<double> timesOfFrames() const
    {
        const FileSampling& sampling = *options_.sampling;
        const double begin = motion_->begin();
        const double end = motion_->end();
        const std::size_t whole = sampling.framesUntil(end);
        const std::size_t frames = sampling.frames.value_or(whole);
        const bool repeats = frames > whole && end > begin && isCycle();
        std::vector<double> times(frames);
        for (std::size_t k = 0; k < frames; ++k) {
            times[k] = static_cast<double>(k) / sampling.frames_per_second;
            if (repeats && times[k] > end) {
                times[k] = begin + std::fmod(times[k] - begin, end - begin);
            }
        }
        return times;
    }

    [[nodiscard]] bool isCycle() const
    {
        const std::vector<Vec3> first = placesIn(motion_->at(motion_->begin()));
        const std::vector<Vec3> last = placesIn(motion_->at(motion_->end()));
        Vec3 low = first.front();
        Vec3 high = low;
        double farthest = 0.0;
        for (std::size_t v = 0; v < first.size(); ++v) {
            low = {std::min(low.x, first[v].x), std::min(low.y, first[v].y), std::min(low.z, first[v].z)};
            high = {std::max(high.x, first[v].x), std::max(high.y, first[v].y), std::max(high.z, first[v].z)};
            farthest = std::max(farthest, length(last[v] - first[v]));
        }
        constexpr double kClosed = 1e-3;  // over the size: an exporter's rounding, no step
        return farthest <= kClosed * length(high - low);
    }

    /// Places of all vertices in a pose.
    [[nodiscard]] std::vector<Vec3> placesIn(const GltfPose& pose) const
    {
        std::vector<Vec3> places(vertex_count_);
        for (const Part& part : parts_) {
            const std::vector<double>& weights = pose.weights.empty() ? std::vector<double>{} : pose.weights[part.node];
            for (std::size_t v = 0; v < part.vertices.size(); ++v) {
                Vec3 place = part.vertices.vec3(v);
                for (std::size_t k = 0; k < std::min(weights.size(), part.targets.size()); ++k) {
                    if (weights[k] != 0.0 && part.targets[k].vertices) {
                        place = place + weights[k] * part.targets[k].vertices->vec3(v);
                    }
                }
                place = part.placementOf(pose, v).place(place);
                if (!std::isfinite(place.x + place.y + place.z)) {
                    throw Damage(part.name + " holds numbers that are not finite");
                }
                places[part.first_vertex + v] = place;
            }
        }
        return places;
    }

    /// Normals of all vertices in a pose, of any length; 0 where the file has none.
    [[nodiscard]] std::vector<Vec3> normalsIn(const GltfPose& pose) const
    {
        std::vector<Vec3> normals(vertex_count_);
        for (const Part& part : parts_) {
            const std::vector<double>& weights = pose.weights.empty() ? std::vector<double>{} : pose.weights[part.node];
            for (std::size_t v = 0; part.normals && v < part.vertices.size(); ++v) {
                Vec3 normal = part.normals->vec3(v);
                for (std::size_t k = 0; k < std::min(weights.size(), part.targets.size()); ++k) {
                    if (weights[k] != 0.0 && part.targets[k].normals) {
                        normal = normal + weights[k] * part.targets[k].normals->vec3(v);
                    }
                }
                normal = part.placementOf(pose, v).normal(normal);
                if (!std::isfinite(normal.x + normal.y + normal.z)) {
                    throw Damage(part.name + " holds numbers that are not finite");
                }
                normals[part.first_vertex + v] = normal;
            }
        }
        return normals;
    }

    /// Puts vertices where they are at the begin, and in all frames that are asked for.
    void placeVertices()
    {
        const std::vector<double> times = motion_ ? timesOfFrames() : std::vector<double>{};
        const GltfPose pose = motion_ ? motion_->at(0.0) : rest_;
        mesh_.vertices = placesIn(pose);
        mesh_.normals = normalsIn(pose);
        for (std::size_t p = 0; p < parts_.size(); ++p) {
            const bool mirrors = parts_[p].placementOf(pose, 0).mirrors();
            const std::size_t end = p + 1 < parts_.size() ? parts_[p + 1].first_triangle : mesh_.triangles.size();
            for (std::size_t t = parts_[p].first_triangle; mirrors && t < end; ++t) {
                std::swap(mesh_.triangles[t][1], mesh_.triangles[t][2]);
            }
        }
        mesh_.shapes.resize(times.size());
        tbb::parallel_for(std::size_t{0}, times.size(),
                          [&](std::size_t k) { mesh_.shapes[k] = placesIn(motion_->at(times[k])); });
    }

    void dropEmptyColumns()
    {
        mesh_.lacks_uv = has_uv_ && lacks_uv_;
        if (!has_uv_) {
            mesh_.uvs.clear();
        }
        if (!has_weights_) {
            mesh_.weights.clear();
        }
        if (!has_colours_) {
            mesh_.colours.clear();
        }
        const std::size_t names = file_.material_names.size();
        const auto none = static_cast<std::uint32_t>(names);
        mesh_.material_names = file_.material_names;
        mesh_.looks = file_.materials;
        if (std::find(mesh_.materials.begin(), mesh_.materials.end(), none) != mesh_.materials.end()) {
            mesh_.material_names.emplace_back();
            if (!mesh_.looks.empty()) {
                mesh_.looks.push_back(plainMaterial());
            }
        }
        if (names == 0) {
            mesh_.materials.clear();
            mesh_.material_names.clear();
            mesh_.looks.clear();
        }
    }

    void readMotion()
    {
        std::size_t channels = 0;
        for (const GltfAnimation& animation : file_.animations) {
            channels += std::max<std::size_t>(animation.channels.size(), 1);
        }
        std::size_t read = 0;
        if (const auto mover = commonMover(); options_.motion && mover) {
            read = readMotionOf({*mover, parentOf(*mover)});
        }
        mesh_.ignores_animation = read < channels;
    }

    /// @return  number of channels read
    std::size_t readMotionOf(const Mover& mover)
    {
        const tinygltf::Node& node = model_.nodes[mover.node];
        const std::optional<std::string> name = options_.sampling ? options_.sampling->animation : std::nullopt;
        const auto animation =
            std::find_if(file_.animations.begin(), file_.animations.end(), [&](const GltfAnimation& one) {
                return (!name || one.name == *name) &&
                       std::any_of(one.channels.begin(), one.channels.end(), [&](const GltfChannel& channel) {
                           return isMotion(channel) && *channel.node == mover.node;
                       });
            });
        if (animation == file_.animations.end()) {
            return 0;
        }
        std::optional<KeyTrack> translation;
        std::optional<KeyTrack> rotation;
        std::size_t read = 0;
        for (const GltfChannel& channel : animation->channels) {
            if (!isMotion(channel) || *channel.node != mover.node) {
                // An animation that is sampled if it deforms has nothing else that moves triangles.
                read += options_.sampling ? 1 : 0;
                continue;
            }
            std::optional<KeyTrack>& track = channel.path == "rotation" ? rotation : translation;
            if (!track) {
                track = trackOf(model_, channel);
                ++read;
            }
        }
        if (!node.matrix.empty() || (rotation && !mover.parent.keepsAngles())) {
            return 0;  // not a rigid motion
        }
        mesh_.motion = motionOf(node, mover.parent, translation, rotation);
        return read;
    }

    void addMesh(std::size_t node)
    {
        const int mesh_index = model_.nodes[node].mesh;
        const tinygltf::Mesh& mesh = entry(model_.meshes, mesh_index, "meshes");
        for (const tinygltf::Primitive& primitive : mesh.primitives) {
            if (primitive.mode >= TINYGLTF_MODE_TRIANGLES) {
                addPrimitive(primitive, node,
                             "mesh " + (mesh.name.empty() ? std::to_string(mesh_index) : "\"" + mesh.name + "\""));
            }
        }
    }

    void addPrimitive(const tinygltf::Primitive& primitive, std::size_t node, const std::string& name)
    {
        const auto column = [&](const char* semantic, int type) -> std::optional<Column> {
            const auto found = primitive.attributes.find(semantic);
            return found == primitive.attributes.end() ? std::nullopt
                                                       : std::optional(Column(model_, found->second, type));
        };
        mesh_.deforms = mesh_.deforms || !primitive.targets.empty();
        const std::optional<Column> found = column("POSITION", TINYGLTF_TYPE_VEC3);
        if (!found) {
            throw Damage(name + " has no POSITION");
        }
        const Column& vertices = *found;
        const std::optional<Column> uvs = column("TEXCOORD_0", TINYGLTF_TYPE_VEC2);
        if (!uvs && options_.needs_uv) {
            throw Damage(name + " has no texture coordinates (uv), which place the droplets; unwrap it first");
        }
        const std::optional<Column> normals = column("NORMAL", TINYGLTF_TYPE_VEC3);
        const std::optional<Column> angles = column("_CONTACT_ANGLE", TINYGLTF_TYPE_SCALAR);
        const std::optional<Column> weights = options_.weights ? weightsOf(primitive) : std::nullopt;
        const std::optional<Column> colours = options_.looks ? coloursOf(primitive) : std::nullopt;
        const std::size_t count = vertices.size();
        const auto fits = [count](const std::optional<Column>& one) { return !one || one->size() == count; };
        if (!fits(uvs) || !fits(normals) || !fits(angles) || !fits(weights) || !fits(colours)) {
            throw Damage(name + " has attributes of different lengths");
        }
        const std::vector<Triangle> triangles = trianglesOf(primitive.mode, indicesOf(primitive, count, name));
        if (triangles.empty()) {
            return;
        }
        if (triangles.size() > kMaxTriangles - mesh_.triangles.size() || count > 3 * kMaxTriangles - vertex_count_) {
            throw Damage("it has more than " + std::to_string(kMaxTriangles) + " triangles");
        }
        const auto first = static_cast<std::uint32_t>(vertex_count_);
        for (std::size_t v = 0; v < count; ++v) {
            const Vec2 uv = uvs ? uvs->vec2(v) : Vec2{};
            const double angle = angles ? angles->number(v) : 0.0;
            if (!std::isfinite(uv.x + uv.y + angle)) {
                throw Damage(name + " holds numbers that are not finite");
            }
            mesh_.uvs.push_back(uv);
            mesh_.contact_angles.push_back(static_cast<float>(kDegree * angle));
            const double weight = weights ? weights->number(v) : 0.0;
            mesh_.weights.push_back(std::isfinite(weight) ? std::clamp(weight, 0.0, 1.0) : 0.0);
            const auto share = [&](std::size_t k) {
                const double light = colours ? colours->number(v, k) : 1.0;
                return std::isfinite(light) ? std::clamp(light, 0.0, 1.0) : 1.0;
            };
            mesh_.colours.push_back({share(0), share(1), share(2)});
        }
        vertex_count_ += count;
        Part& part = parts_.emplace_back(Part{name, node, first, mesh_.triangles.size(), vertices, normals});
        if (options_.sampling) {
            readDeformation(primitive, part);
        }
        (uvs ? has_uv_ : lacks_uv_) = true;
        has_weights_ = has_weights_ || weights;
        has_colours_ = has_colours_ || colours;
        const std::size_t materials = file_.material_names.size();
        const bool has_material = primitive.material >= 0 && static_cast<std::size_t>(primitive.material) < materials;
        mesh_.materials.insert(
            mesh_.materials.end(), triangles.size(),
            static_cast<std::uint32_t>(has_material ? static_cast<std::size_t>(primitive.material) : materials));
        for (const Triangle& t : triangles) {
            mesh_.triangles.push_back({first + t[0], first + t[1], first + t[2]});
        }
    }

    /// Reads joints and morph targets of vertices.
    void readDeformation(const tinygltf::Primitive& primitive, Part& part) const
    {
        const auto column = [&](const std::map<std::string, int>& attributes, const std::string& semantic,
                                int type) -> std::optional<Column> {
            const auto found = attributes.find(semantic);
            if (found == attributes.end()) {
                return std::nullopt;
            }
            const Column numbers(model_, found->second, type);
            if (numbers.size() != part.vertices.size()) {
                throw Damage(part.name + " has attributes of different lengths");
            }
            return numbers;
        };
        for (const std::map<std::string, int>& target : primitive.targets) {
            part.targets.push_back(
                {column(target, "POSITION", TINYGLTF_TYPE_VEC3), column(target, "NORMAL", TINYGLTF_TYPE_VEC3)});
        }
        const int skin = model_.nodes[part.node].skin;
        if (skin < 0) {
            return;
        }
        entry(file_.skins, skin, "skins");
        for (std::size_t set = 0;; ++set) {
            const std::string number = std::to_string(set);
            const auto joints = column(primitive.attributes, "JOINTS_" + number, TINYGLTF_TYPE_VEC4);
            const auto weights = column(primitive.attributes, "WEIGHTS_" + number, TINYGLTF_TYPE_VEC4);
            if (!joints || !weights) {
                break;
            }
            if (!joints->counts()) {
                throw Damage(part.name + " has joints that are not unsigned integers");
            }
            part.bindings.push_back({*joints, *weights});
            part.skin = static_cast<std::size_t>(skin);
        }
    }

    /// Column of weights: of its own, or the red of the first colours.
    [[nodiscard]] std::optional<Column> weightsOf(const tinygltf::Primitive& primitive) const
    {
        for (const char* const name : {"_WEIGHT", "COLOR_0"}) {
            if (const auto found = primitive.attributes.find(name); found != primitive.attributes.end()) {
                return Column(model_, found->second, entry(model_.accessors, found->second, "accessors").type);
            }
        }
        return std::nullopt;
    }

    /// Column of colours, unless these are read as weights.
    [[nodiscard]] std::optional<Column> coloursOf(const tinygltf::Primitive& primitive) const
    {
        const auto found = primitive.attributes.find("COLOR_0");
        if (found == primitive.attributes.end() || (options_.weights && !primitive.attributes.contains("_WEIGHT"))) {
            return std::nullopt;
        }
        const int type = entry(model_.accessors, found->second, "accessors").type;
        return Column(model_, found->second, type == TINYGLTF_TYPE_VEC3 ? type : TINYGLTF_TYPE_VEC4);
    }

    [[nodiscard]] std::vector<std::uint32_t> indicesOf(const tinygltf::Primitive& primitive, std::size_t count,
                                                       const std::string& name) const
    {
        if (primitive.indices < 0) {
            std::vector<std::uint32_t> all(count);
            std::iota(all.begin(), all.end(), 0U);
            return all;
        }
        const Column column(model_, primitive.indices, TINYGLTF_TYPE_SCALAR);
        if (!column.counts()) {
            throw Damage(name + " has indices that are not unsigned integers");
        }
        std::vector<std::uint32_t> indices(column.size());
        for (std::size_t i = 0; i < indices.size(); ++i) {
            indices[i] = static_cast<std::uint32_t>(column.number(i));
            if (indices[i] >= count) {
                throw Damage(name + " names vertex " + std::to_string(indices[i]) + " of " + std::to_string(count));
            }
        }
        return indices;
    }

    const GltfFile& file_;
    const tinygltf::Model& model_;
    const SceneOptions& options_;
    std::vector<bool> is_animated_;                   ///< of every node
    std::vector<std::optional<std::size_t>> movers_;  ///< outermost animated nodes above all that have triangles
    GltfVisits visits_;
    std::vector<std::optional<std::size_t>> parents_;  ///< of every node
    std::vector<Part> parts_;
    std::size_t vertex_count_ = 0;
    GltfPose rest_;
    std::optional<GltfMotion> motion_;  ///< if the mesh deforms
    bool has_uv_ = false;
    bool lacks_uv_ = false;
    bool has_weights_ = false;
    bool has_colours_ = false;
    FileMesh mesh_;
};

}  // namespace

FileMesh readScene(const std::filesystem::path& path, const SceneOptions& options)
{
    const GltfFile file = readGltfFile(path, options.looks);
    return SceneReader(file, options).take();
}

}  // namespace droplet
