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

#include "droplet/units.h"
#include "file_bytes.h"
#include "io/axes.h"
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
                                                       : "VEC3"));
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

class Scene {
public:
    Scene(const GltfFile& file, const SceneOptions& options) : model_(file.model), options_(options)
    {
        struct Visit {
            int node = 0;
            Placement parent;
        };
        std::vector<Visit> open;
        const auto visit_later = [&open](std::vector<int> nodes, const Placement& parent) {
            std::reverse(nodes.begin(), nodes.end());  // this is a stack: the first node is visited first
            for (const int node : nodes) {
                open.push_back({node, parent});
            }
        };
        visit_later(rootsOf(model_), {});
        mesh_.moves = file.animated;
        std::vector<bool> seen(model_.nodes.size(), false);
        while (!open.empty()) {
            const Visit visit = open.back();
            open.pop_back();
            const tinygltf::Node& node = entry(model_.nodes, visit.node, "nodes");
            if (seen[static_cast<std::size_t>(visit.node)]) {
                throw Damage("nodes[" + std::to_string(visit.node) + "] has two parents");
            }
            seen[static_cast<std::size_t>(visit.node)] = true;
            const Placement placement = visit.parent.of(placementOf(node));
            mesh_.moves = mesh_.moves || node.skin >= 0;
            if (node.mesh >= 0) {
                addMesh(node.mesh, placement);
            }
            visit_later(node.children, placement);
        }
        if (mesh_.triangles.empty()) {
            throw Damage("its scene has no triangles");
        }
        mesh_.weld = firstAtPlace(mesh_.positions);
        fillNormals(mesh_.positions, mesh_.triangles, mesh_.weld, mesh_.normals);
        for (std::size_t v = 0; v < mesh_.positions.size(); ++v) {
            mesh_.positions[v] = zUp(mesh_.positions[v]);
            mesh_.normals[v] = zUp(mesh_.normals[v]);
        }
    }

    [[nodiscard]] SceneMesh take() { return std::move(mesh_); }

private:
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
        mesh_.moves = mesh_.moves || !primitive.targets.empty();
        const std::optional<Column> found = column("POSITION", TINYGLTF_TYPE_VEC3);
        if (!found) {
            throw Damage(name + " has no POSITION");
        }
        const Column& positions = *found;
        const std::optional<Column> uvs = column("TEXCOORD_0", TINYGLTF_TYPE_VEC2);
        if (!uvs && options_.needs_uv) {
            throw Damage(name + " has no texture coordinates (uv), which place the droplets; unwrap it first");
        }
        const std::optional<Column> normals = column("NORMAL", TINYGLTF_TYPE_VEC3);
        const std::optional<Column> angles = column("_CONTACT_ANGLE", TINYGLTF_TYPE_SCALAR);
        const std::size_t count = positions.size();
        const auto fits = [count](const std::optional<Column>& column) { return !column || column->size() == count; };
        if (!fits(uvs) || !fits(normals) || !fits(angles)) {
            throw Damage(name + " has attributes of different lengths");
        }
        const std::vector<Triangle> triangles = trianglesOf(primitive.mode, indicesOf(primitive, count, name));
        if (triangles.empty()) {
            return;
        }
        if (triangles.size() > kMaxTriangles - mesh_.triangles.size() ||
            count > 3 * kMaxTriangles - mesh_.positions.size()) {
            throw Damage("it has more than " + std::to_string(kMaxTriangles) + " triangles");
        }
        const auto first = static_cast<std::uint32_t>(mesh_.positions.size());
        for (std::size_t v = 0; v < count; ++v) {
            const Vec3 p = placement.place(positions.vec3(v));
            const Vec3 n = normals ? placement.normal(normals->vec3(v)) : Vec3{};
            const Vec2 uv = uvs ? uvs->vec2(v) : Vec2{};
            const double angle = angles ? angles->number(v) : 0.0;
            if (!std::isfinite(p.x + p.y + p.z + n.x + n.y + n.z + uv.x + uv.y + angle)) {
                throw Damage(name + " holds numbers that are not finite");
            }
            mesh_.positions.push_back(p);
            mesh_.normals.push_back(n);
            mesh_.uvs.push_back(uv);
            mesh_.contact_angles.push_back(static_cast<float>(kDegree * angle));
        }
        for (const Triangle& t : triangles) {
            mesh_.triangles.push_back(placement.mirrors() ? Triangle{first + t[0], first + t[2], first + t[1]}
                                                          : Triangle{first + t[0], first + t[1], first + t[2]});
        }
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

    const tinygltf::Model& model_;
    const SceneOptions& options_;
    SceneMesh mesh_;
};

}  // namespace

SceneMesh readScene(const std::filesystem::path& path, const SceneOptions& options)
{
    const GltfFile file = readGltfFile(path);
    return Scene(file, options).take();
}

}  // namespace droplet
