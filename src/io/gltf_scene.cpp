// SPDX-License-Identifier: GPL-3.0-or-later
// Khronos Group, "glTF 2.0 Specification" (2021), sections 3.5 to 3.7 and 3.11.
#include "io/gltf_scene.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "axes.h"
#include "droplet/units.h"
#include "file_bytes.h"
#include "io/gltf_file.h"
#include "io/vertex_normals.h"

namespace droplet {
namespace {

constexpr std::size_t kMaxTriangles = std::size_t{1} << 26;  // a small file can repeat one mesh many times

template <typename T>
const T& entry(const std::vector<T>& list, int index, const char* name)
{
    if (index < 0 || static_cast<std::size_t>(index) >= list.size()) {
        throw Damage(std::string(name) + "[" + std::to_string(index) + "] does not exist");
    }
    return list[static_cast<std::size_t>(index)];
}

/// Numbers in a buffer. The constructor checks the bounds.
class Column {
public:
    /// @param type  tinygltf's constant
    Column(const tinygltf::Model& model, int accessor_index, int type)
    {
        const std::string name = "accessors[" + std::to_string(accessor_index) + "]";
        const tinygltf::Accessor& accessor = entry(model.accessors, accessor_index, "accessors");
        if (accessor.sparse.isSparse) {
            throw Damage(name + " is sparse, which is not supported");
        }
        if (accessor.type != type) {
            throw Damage(name + " should hold " +
                         (type == TINYGLTF_TYPE_SCALAR ? "SCALAR"
                          : type == TINYGLTF_TYPE_VEC2 ? "VEC2"
                          : type == TINYGLTF_TYPE_VEC3 ? "VEC3"
                                                       : "VEC4"));
        }
        if (accessor.bufferView < 0) {
            throw Damage(name + " has no data or compressed data");
        }
        kind_ = accessor.componentType;
        count_ = accessor.count;
        normalised_ = accessor.normalized;
        if (kind_ == TINYGLTF_COMPONENT_TYPE_INT || kind_ == TINYGLTF_COMPONENT_TYPE_DOUBLE) {
            throw Damage(name + " has components of unknown type");
        }
        component_bytes_ =
            static_cast<std::size_t>(tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(kind_)));
        const std::size_t element =
            component_bytes_ *
            static_cast<std::size_t>(tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(type)));

        const tinygltf::BufferView& view = entry(model.bufferViews, accessor.bufferView, "bufferViews");
        const std::span<const unsigned char> buffer = entry(model.buffers, view.buffer, "buffers").data;
        stride_ = view.byteStride == 0 ? element : view.byteStride;
        const std::size_t begin = view.byteOffset;
        const std::size_t length = view.byteLength;
        const std::size_t offset = accessor.byteOffset;
        const bool inside = begin <= buffer.size() && length <= buffer.size() - begin && offset <= length;
        if (!inside || stride_ < element ||
            (count_ > 0 && (length - offset < element || count_ - 1 > (length - offset - element) / stride_))) {
            throw Damage(name + " reaches beyond its buffer");
        }
        bytes_ = buffer.subspan(begin + offset, length - offset);
    }

    [[nodiscard]] std::size_t size() const { return count_; }
    /// Whether the numbers are unsigned integers that are not normalised.
    [[nodiscard]] bool counts() const
    {
        return !normalised_ &&
               (kind_ == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE || kind_ == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
                kind_ == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT);
    }

    /// Value of a component; normalised integers as in section 3.11 of the specification.
    [[nodiscard]] double number(std::size_t i, std::size_t k = 0) const
    {
        const unsigned char* const at = bytes_.data() + i * stride_ + k * component_bytes_;
        const auto scaled = [this](double value, double largest) {
            return normalised_ ? std::max(value / largest, -1.0) : value;
        };
        switch (kind_) {
            case TINYGLTF_COMPONENT_TYPE_FLOAT:
                return static_cast<double>(load<float>(at));
            case TINYGLTF_COMPONENT_TYPE_BYTE:
                return scaled(load<std::int8_t>(at), 127.0);
            case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
                return scaled(load<std::uint8_t>(at), 255.0);
            case TINYGLTF_COMPONENT_TYPE_SHORT:
                return scaled(load<std::int16_t>(at), 32767.0);
            case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
                return scaled(load<std::uint16_t>(at), 65535.0);
            default:
                return load<std::uint32_t>(at);
        }
    }

    [[nodiscard]] Vec2 vec2(std::size_t i) const { return {number(i, 0), number(i, 1)}; }
    [[nodiscard]] Vec3 vec3(std::size_t i) const { return {number(i, 0), number(i, 1), number(i, 2)}; }

private:
    template <typename T>
    static T load(const unsigned char* from)
    {
        T value{};
        std::memcpy(&value, from, sizeof value);
        return value;
    }

    std::span<const unsigned char> bytes_;
    std::size_t stride_ = 0;
    std::size_t count_ = 0;
    std::size_t component_bytes_ = 0;
    int kind_ = 0;
    bool normalised_ = false;
};

/// Affine map: images of the unit vectors and of the origin.
struct Placement {
    Vec3 x{1.0, 0.0, 0.0};
    Vec3 y{0.0, 1.0, 0.0};
    Vec3 z{0.0, 0.0, 1.0};
    Vec3 origin;

    [[nodiscard]] Vec3 direction(Vec3 a) const { return a.x * x + a.y * y + a.z * z; }
    [[nodiscard]] Vec3 place(Vec3 a) const { return origin + direction(a); }
    [[nodiscard]] Placement of(const Placement& inner) const
    {
        return {direction(inner.x), direction(inner.y), direction(inner.z), place(inner.origin)};
    }
    /// Whether it is a similarity.
    [[nodiscard]] bool keepsAngles() const
    {
        const double size = dot(x, x);
        constexpr double kNear = 1e-5;  // files hold floats
        const auto is_near = [&](double a, double b) { return std::abs(a - b) <= kNear * size; };
        return size > 0.0 && is_near(dot(y, y), size) && is_near(dot(z, z), size) && is_near(dot(x, y), 0.0) &&
               is_near(dot(y, z), 0.0) && is_near(dot(z, x), 0.0);
    }
    [[nodiscard]] bool mirrors() const { return dot(cross(x, y), z) < 0.0; }
    /// Normals transform by the cofactor matrix.
    [[nodiscard]] Vec3 normal(Vec3 a) const
    {
        return (mirrors() ? -1.0 : 1.0) * (a.x * cross(y, z) + a.y * cross(z, x) + a.z * cross(x, y));
    }
};

/// Transform of a node (section 3.5.3): a matrix by columns; or scale, then rotation, then translation.
Placement placementOf(const tinygltf::Node& node)
{
    if (const std::vector<double>& m = node.matrix; !m.empty()) {
        const auto column = [&m](std::size_t k) { return Vec3{m[4 * k], m[4 * k + 1], m[4 * k + 2]}; };
        return {column(0), column(1), column(2), column(3)};
    }
    const auto or_else = [](const std::vector<double>& given, const std::vector<double>& otherwise) {
        return given.empty() ? otherwise : given;
    };
    const std::vector<double> t = or_else(node.translation, {0.0, 0.0, 0.0});
    const std::vector<double> s = or_else(node.scale, {1.0, 1.0, 1.0});
    const std::vector<double> q = or_else(node.rotation, {0.0, 0.0, 0.0, 1.0});
    const double size = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (!(size > 0.0)) {
        throw Damage("a node's rotation is not a quaternion");
    }
    const auto [x, y, z, w] = std::array{q[0] / size, q[1] / size, q[2] / size, q[3] / size};
    return {s[0] * Vec3{1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)},
            s[1] * Vec3{2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)},
            s[2] * Vec3{2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)},
            {t[0], t[1], t[2]}};
}

/// Key track of one property (appendix C of the specification).
struct KeyTrack {
    using Value = std::array<double, 4>;
    enum class Interpolation { Linear, Step, CubicSpline };

    Interpolation interpolation = Interpolation::Linear;
    bool turns = false;         ///< values are quaternions
    std::vector<double> times;  ///< ascending
    std::vector<Value> values;  ///< with CubicSpline, three for each time: tangent before, value, tangent after

    /// Value at a time; at a jump, the one before or after it.
    [[nodiscard]] Value at(double time, bool after) const
    {
        const auto next = after ? std::upper_bound(times.begin(), times.end(), time)
                                : std::lower_bound(times.begin(), times.end(), time);
        const bool is_cubic = interpolation == Interpolation::CubicSpline;
        const auto key = [&](std::size_t i) { return is_cubic ? values[3 * i + 1] : values[i]; };
        if (next == times.begin() || next == times.end()) {
            return key(next == times.begin() ? 0 : times.size() - 1);
        }
        const auto i = static_cast<std::size_t>(next - times.begin()) - 1;
        const double span = times[i + 1] - times[i];
        const double t = (time - times[i]) / span;
        if (interpolation == Interpolation::Step) {
            return key(i);
        }
        if (!is_cubic && turns) {
            const Rotation from = turnOf(key(i));
            const Rotation turn = rotationBy(t * vectorOf(turnOf(key(i + 1)) * from.inverse())) * from;
            return {turn.axis.x, turn.axis.y, turn.axis.z, turn.real};
        }
        Value value{};
        for (std::size_t k = 0; k < value.size(); ++k) {
            const double a = key(i)[k];
            const double b = key(i + 1)[k];
            value[k] = a + t * (b - a);
            if (is_cubic) {
                value[k] = (1 + 2 * t) * (1 - t) * (1 - t) * a + t * (1 - t) * (1 - t) * span * values[3 * i + 2][k] +
                           t * t * (3 - 2 * t) * b - t * t * (1 - t) * span * values[3 * i + 3][k];
            }
        }
        return value;
    }

    static Rotation turnOf(const Value& value)
    {
        const Vec3 axis{value[0], value[1], value[2]};
        const double size = std::hypot(length(axis), value[3]);
        if (!(size > 0.0) || !std::isfinite(size)) {
            throw Damage("the rotation of an animation is not a quaternion");
        }
        return {(1.0 / size) * axis, value[3] / size};
    }
};

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

class SceneReader {
public:
    SceneReader(const GltfFile& file, const SceneOptions& options)
        : file_(file), model_(file.model), options_(options), is_animated_(model_.nodes.size(), false)
    {
        for (const std::vector<GltfChannel>& channels : file.animations) {
            for (const GltfChannel& channel : channels) {
                if (isMotion(channel) && channel.node < model_.nodes.size()) {
                    is_animated_[*channel.node] = true;
                }
            }
        }
        std::vector<Visit> open;
        const auto visit_later = [&open](std::vector<int> nodes, const Placement& parent,
                                         const std::optional<Mover>& mover) {
            std::reverse(nodes.begin(), nodes.end());  // this is a stack: the first node is visited first
            for (const int node : nodes) {
                open.push_back({node, parent, mover});
            }
        };
        visit_later(rootsOf(model_), {}, {});
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
            const Placement placement = visit.parent.of(placementOf(node));
            const std::optional<Mover> mover =
                visit.mover || !is_animated_[index] ? visit.mover : std::optional(Mover{index, visit.parent});
            mesh_.deforms = mesh_.deforms || node.skin >= 0;
            if (node.mesh >= 0) {
                const std::size_t before = mesh_.triangles.size();
                addMesh(node.mesh, placement);
                if (mesh_.triangles.size() > before) {
                    movers_.push_back(mover);
                }
            }
            visit_later(node.children, placement, mover);
        }
        if (mesh_.triangles.empty()) {
            throw Damage("its scene has no triangles");
        }
        dropEmptyColumns();
        mesh_.weld = firstAtPlace(mesh_.vertices);
        completeNormals(mesh_, options_.creases);
        for (std::size_t v = 0; v < mesh_.vertices.size(); ++v) {
            mesh_.vertices[v] = zUp(mesh_.vertices[v]);
            mesh_.normals[v] = zUp(mesh_.normals[v]);
        }
        readMotion();
    }

    [[nodiscard]] FileMesh take() { return std::move(mesh_); }

private:
    /// Outermost animated node above a mesh.
    struct Mover {
        std::size_t node = 0;
        Placement parent;
    };
    struct Visit {
        int node = 0;
        Placement parent;
        std::optional<Mover> mover;
    };

    static bool isMotion(const GltfChannel& channel)
    {
        return channel.node && (channel.path == "translation" || channel.path == "rotation");
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
        for (const std::vector<GltfChannel>& animation : file_.animations) {
            channels += std::max<std::size_t>(animation.size(), 1);
        }
        const std::optional<Mover>& mover = movers_.front();
        const auto is_same = [&](const std::optional<Mover>& other) { return other && other->node == mover->node; };
        std::size_t read = 0;
        if (options_.motion && mover && std::all_of(movers_.begin(), movers_.end(), is_same)) {
            read = readMotionOf(*mover);
        }
        mesh_.ignores_animation = read < channels;
    }

    /// @return  number of channels read
    std::size_t readMotionOf(const Mover& mover)
    {
        const tinygltf::Node& node = model_.nodes[mover.node];
        const auto animation = std::find_if(
            file_.animations.begin(), file_.animations.end(), [&](const std::vector<GltfChannel>& channels) {
                return std::any_of(channels.begin(), channels.end(), [&](const GltfChannel& channel) {
                    return isMotion(channel) && *channel.node == mover.node;
                });
            });
        std::optional<KeyTrack> translation;
        std::optional<KeyTrack> rotation;
        std::size_t read = 0;
        for (const GltfChannel& channel : *animation) {
            if (!isMotion(channel) || *channel.node != mover.node) {
                continue;
            }
            std::optional<KeyTrack>& track = channel.path == "rotation" ? rotation : translation;
            if (!track) {
                track = trackOf(channel);
                ++read;
            }
        }
        if (!node.matrix.empty() || (rotation && !mover.parent.keepsAngles())) {
            return 0;  // not a rigid motion
        }
        mesh_.motion = motionOf(node, mover.parent, translation, rotation);
        return read;
    }

    [[nodiscard]] KeyTrack trackOf(const GltfChannel& channel) const
    {
        const bool turns = channel.path == "rotation";
        const Column times(model_, channel.times, TINYGLTF_TYPE_SCALAR);
        const Column values(model_, channel.values, turns ? TINYGLTF_TYPE_VEC4 : TINYGLTF_TYPE_VEC3);
        KeyTrack track;
        track.turns = turns;
        track.interpolation = channel.interpolation == "STEP"          ? KeyTrack::Interpolation::Step
                              : channel.interpolation == "CUBICSPLINE" ? KeyTrack::Interpolation::CubicSpline
                                                                       : KeyTrack::Interpolation::Linear;
        const std::size_t each = track.interpolation == KeyTrack::Interpolation::CubicSpline ? 3 : 1;
        if (times.size() == 0 || values.size() != each * times.size()) {
            throw Damage("an animation has " + std::to_string(times.size()) + " times and " +
                         std::to_string(values.size()) + " values");
        }
        for (std::size_t i = 0; i < times.size(); ++i) {
            track.times.push_back(times.number(i));
            if (!std::isfinite(track.times[i]) || (i > 0 && !(track.times[i] > track.times[i - 1]))) {
                throw Damage("the times of an animation do not ascend");
            }
        }
        for (std::size_t i = 0; i < values.size(); ++i) {
            const KeyTrack::Value value{values.number(i, 0), values.number(i, 1), values.number(i, 2),
                                        turns ? values.number(i, 3) : 0.0};
            if (!std::isfinite(value[0] + value[1] + value[2] + value[3])) {
                throw Damage("an animation holds numbers that are not finite");
            }
            track.values.push_back(value);
        }
        return track;
    }

    void addMesh(int mesh_index, const Placement& placement)
    {
        const tinygltf::Mesh& mesh = entry(model_.meshes, mesh_index, "meshes");
        for (const tinygltf::Primitive& primitive : mesh.primitives) {
            if (primitive.mode >= TINYGLTF_MODE_TRIANGLES) {
                addPrimitive(primitive, placement,
                             "mesh " + (mesh.name.empty() ? std::to_string(mesh_index) : "\"" + mesh.name + "\""));
            }
        }
    }

    void addPrimitive(const tinygltf::Primitive& primitive, const Placement& placement, const std::string& name)
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
        const std::size_t count = vertices.size();
        const auto fits = [count](const std::optional<Column>& column) { return !column || column->size() == count; };
        if (!fits(uvs) || !fits(normals) || !fits(angles) || (weights && weights->size() != count)) {
            throw Damage(name + " has attributes of different lengths");
        }
        const std::vector<Triangle> triangles = trianglesOf(primitive.mode, indicesOf(primitive, count, name));
        if (triangles.empty()) {
            return;
        }
        if (triangles.size() > kMaxTriangles - mesh_.triangles.size() ||
            count > 3 * kMaxTriangles - mesh_.vertices.size()) {
            throw Damage("it has more than " + std::to_string(kMaxTriangles) + " triangles");
        }
        const auto first = static_cast<std::uint32_t>(mesh_.vertices.size());
        for (std::size_t v = 0; v < count; ++v) {
            const Vec3 p = placement.place(vertices.vec3(v));
            const Vec3 n = normals ? placement.normal(normals->vec3(v)) : Vec3{};
            const Vec2 uv = uvs ? uvs->vec2(v) : Vec2{};
            const double angle = angles ? angles->number(v) : 0.0;
            if (!std::isfinite(p.x + p.y + p.z + n.x + n.y + n.z + uv.x + uv.y + angle)) {
                throw Damage(name + " holds numbers that are not finite");
            }
            mesh_.vertices.push_back(p);
            mesh_.normals.push_back(n);
            mesh_.uvs.push_back(uv);
            mesh_.contact_angles.push_back(static_cast<float>(kDegree * angle));
            const double weight = weights ? weights->number(v) : 0.0;
            mesh_.weights.push_back(std::isfinite(weight) ? std::clamp(weight, 0.0, 1.0) : 0.0);
        }
        (uvs ? has_uv_ : lacks_uv_) = true;
        has_weights_ = has_weights_ || weights;
        const std::size_t materials = file_.material_names.size();
        const bool has_material = primitive.material >= 0 && static_cast<std::size_t>(primitive.material) < materials;
        mesh_.materials.insert(
            mesh_.materials.end(), triangles.size(),
            static_cast<std::uint32_t>(has_material ? static_cast<std::size_t>(primitive.material) : materials));
        for (const Triangle& t : triangles) {
            mesh_.triangles.push_back(placement.mirrors() ? Triangle{first + t[0], first + t[2], first + t[1]}
                                                          : Triangle{first + t[0], first + t[1], first + t[2]});
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
    std::vector<bool> is_animated_;             ///< of every node
    std::vector<std::optional<Mover>> movers_;  ///< of every node that has triangles
    bool has_uv_ = false;
    bool lacks_uv_ = false;
    bool has_weights_ = false;
    FileMesh mesh_;
};

}  // namespace

FileMesh readScene(const std::filesystem::path& path, const SceneOptions& options)
{
    const GltfFile file = readGltfFile(path, options.looks);
    return SceneReader(file, options).take();
}

}  // namespace droplet
