// SPDX-License-Identifier: GPL-3.0-or-later
// Khronos Group, "glTF 2.0 Specification" (2021), and its extensions KHR_materials_transmission, KHR_materials_ior,
// KHR_materials_volume, KHR_materials_emissive_strength, KHR_mesh_quantization, EXT_meshopt_compression and MSFT_lod.
#include "scene/write_gltf.h"

#include <meshoptimizer.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <ostream>
#include <streambuf>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "byte_stream.h"
#include "droplet/error.h"
#include "droplet/version.h"
#include "scene/gltf_buffer.h"
#include "scene/quantized.h"

namespace droplet {
namespace {

using tinygltf::Value;

/// Copies of a crowd in a mesh.
constexpr std::size_t kCopiesOfMesh = 62;
using CopyShapes = std::array<std::size_t, kCopiesOfMesh>;

std::vector<Vec3> vectorsOf(const std::vector<Float3>& floats)
{
    std::vector<Vec3> vectors(floats.size());
    std::transform(floats.begin(), floats.end(), vectors.begin(), vectorOf);
    return vectors;
}

double largestOf(const Float3& v)
{
    return static_cast<double>(std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])}));
}

/// States the exact bounds of an array of vectors.
template <class Number, std::size_t Lanes>
void bound(GltfArray& array, const std::vector<std::array<Number, Lanes>>& vectors)
{
    array.low.assign(3, std::numeric_limits<double>::infinity());
    array.high.assign(3, -std::numeric_limits<double>::infinity());
    for (const std::array<Number, Lanes>& vector : vectors) {
        for (std::size_t k = 0; k < 3; ++k) {
            array.low[k] = std::min(array.low[k], static_cast<double>(vector[k]));
            array.high[k] = std::max(array.high[k], static_cast<double>(vector[k]));
        }
    }
}

template <class Vector, class Quantize>
auto quantizedAll(const std::vector<Float3>& vectors, const Quantize& quantize)
{
    std::vector<Vector> result(vectors.size());
    std::transform(vectors.begin(), vectors.end(), result.begin(),
                   [&](const Float3& v) { return quantize(vectorOf(v)); });
    return result;
}

/// Positive length with the seven digits that readers keep, as they read floats: the last bits of sums differ from
/// processor to processor.
double rounded(double length)
{
    const double power = std::pow(10.0, 6.0 - std::floor(std::log10(length)));
    return std::round(length * power) / power;
}

tinygltf::Material materialOf(const SceneMaterial& from, double side)
{
    Look look = from.look;
    tinygltf::Material material;
    material.name = look.name;
    material.doubleSided = from.both_sides;
    material.alphaMode = from.opacity < 1.0 || from.blends ? "BLEND" : from.cutoff ? "MASK" : "OPAQUE";
    if (from.cutoff) {
        material.alphaCutoff = *from.cutoff;
    }
    material.pbrMetallicRoughness.metallicFactor = look.metallic;
    material.pbrMetallicRoughness.roughnessFactor = look.roughness;
    // A thickness of 0 means thin-walled; attenuationDistance must be positive.
    const bool has_volume = look.transmission > 0.0 && from.thickness;
    // In cloudy liquid what is scattered has a colour, too: it and the absorption each have a half of the tint.
    const bool is_cloudy = has_volume && look.tinted && look.transmission < 1.0 && !from.absorption;
    if (is_cloudy) {
        look.colour = {std::sqrt(look.colour.x), std::sqrt(look.colour.y), std::sqrt(look.colour.z)};
    }
    if (!has_volume || !look.tinted || is_cloudy) {
        material.pbrMetallicRoughness.baseColorFactor = {look.colour.x, look.colour.y, look.colour.z, from.opacity};
    }
    // The factor ends at 1; a strength is beyond it.
    const double strength = std::max({from.glow.x, from.glow.y, from.glow.z, 1.0});
    material.emissiveFactor = {from.glow.x / strength, from.glow.y / strength, from.glow.z / strength};
    if (strength > 1.0) {
        material.extensions["KHR_materials_emissive_strength"] =
            Value(Value::Object{{"emissiveStrength", Value(strength)}});
    }
    if (look.transmission > 0.0) {
        material.extensions["KHR_materials_transmission"] =
            Value(Value::Object{{"transmissionFactor", Value(look.transmission)}});
        material.extensions["KHR_materials_ior"] = Value(Value::Object{{"ior", Value(look.ior)}});
    }
    if (look.film) {
        constexpr double kNanometres = 1e9;
        const double thickness = kNanometres * look.film->thickness;
        material.extensions["KHR_materials_iridescence"] =
            Value(Value::Object{{"iridescenceFactor", Value(1.0)},
                                {"iridescenceIor", Value(look.film->ior)},
                                {"iridescenceThicknessMinimum", Value(thickness)},
                                {"iridescenceThicknessMaximum", Value(thickness)}});
    }
    if (has_volume) {
        // The thickness is in the mesh's unit; the distance of attenuation is not.
        const double thickness = rounded(*from.thickness);
        Value::Object volume{{"thicknessFactor", Value(thickness / side)}};
        if (look.tinted || from.absorption) {
            const auto [colour, distance] = from.absorption ? *from.absorption : attenuationOf(look, thickness);
            volume["attenuationColor"] = Value(Value::Array{Value(colour.x), Value(colour.y), Value(colour.z)});
            volume["attenuationDistance"] = Value(distance);
        }
        material.extensions["KHR_materials_volume"] = Value(std::move(volume));
    }
    return material;
}

Value valueOf(const std::vector<double>& numbers)
{
    Value::Array values;
    for (const double number : numbers) {
        values.emplace_back(number);
    }
    return Value(std::move(values));
}

Value::Object objectOf(const std::vector<SceneProperty>& properties)
{
    Value::Object object;
    for (const auto& [name, value] : properties) {
        if (const auto* numbers = std::get_if<std::vector<double>>(&value)) {
            object[name] = valueOf(*numbers);
        } else if (const auto* count = std::get_if<int>(&value)) {
            object[name] = Value(*count);
        } else {
            object[name] = Value(std::get<double>(value));
        }
    }
    return object;
}

void setExtras(Value& extras, Value::Object object)
{
    if (!object.empty()) {
        extras = Value(std::move(object));
    }
}

const char* nameOf(SceneChange change)
{
    switch (change) {
        case SceneChange::Translation:
            return "translation";
        case SceneChange::Rotation:
            return "rotation";
        case SceneChange::Scale:
            return "scale";
        case SceneChange::Weights:
            return "weights";
    }
    return "";
}

/// Copies of a mesh, each bound to a joint of its own. The last two vertices belong to the corners of the scene.
struct Copies {
    SceneGeometry geometry;
    std::vector<std::array<std::uint8_t, 4>> joints;  ///< of each vertex; the first counts
};

/// @param shapes  of the copies: SceneCrowd::shape_of
Copies copiesOf(const SceneGeometry& one, const SceneCrowd& crowd, const CopyShapes& shapes)
{
    Copies copies;
    SceneGeometry& all = copies.geometry;
    all.parts.push_back({one.parts.front().material, {}});
    const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
    for (std::size_t k = 0; k < kCopiesOfMesh; ++k) {
        const auto first = static_cast<std::uint32_t>(all.vertices.size());
        const SceneShape* const shape = shapes[k] > 0 ? &crowd.shapes[shapes[k] - 1] : nullptr;
        append(all.vertices, shape ? shape->vertices : one.vertices);
        append(all.normals, shape ? shape->normals : one.normals);
        append(all.uvs, one.uvs);
        copies.joints.resize(all.vertices.size(), {static_cast<std::uint8_t>(k), 0, 0, 0});
        for (const auto& [a, b, c] : one.parts.front().triangles) {
            all.parts.front().triangles.push_back({first + a, first + b, first + c});
        }
    }
    for (std::size_t k = 0; k < 2; ++k) {
        all.vertices.push_back({0.0F, 0.0F, 0.0F});
        all.normals.push_back({0.0F, 1.0F, 0.0F});
        copies.joints.push_back({static_cast<std::uint8_t>(kCopiesOfMesh + k), 0, 0, 0});
        if (!one.uvs.empty()) {
            all.uvs.push_back({0.0F, 0.0F});
        }
    }
    return copies;
}

template <class Element>
void reorder(std::vector<Element>& elements, const std::vector<unsigned>& order)
{
    if (!elements.empty()) {
        std::vector<Element> ordered(elements.size());
        meshopt_remapVertexBuffer(ordered.data(), elements.data(), elements.size(), sizeof(Element), order.data());
        elements = std::move(ordered);
    }
}

/// Orders triangles and vertices as the codecs need them.
void optimize(Copies& copies)
{
    SceneGeometry& geometry = copies.geometry;
    const std::size_t vertices = geometry.vertices.size();
    std::vector<unsigned> all;
    for (ScenePart& part : geometry.parts) {
        static_assert(sizeof(Triangle) == 3 * sizeof(unsigned));
        auto* const list = part.triangles.empty() ? nullptr : part.triangles.front().data();
        meshopt_optimizeVertexCache(list, list, 3 * part.triangles.size(), vertices);
        all.insert(all.end(), list, list + 3 * part.triangles.size());
    }
    std::vector<unsigned> order(vertices);
    std::size_t used = meshopt_optimizeVertexFetchRemap(order.data(), all.data(), all.size(), vertices);
    for (unsigned& number : order) {
        number = number == ~0U ? static_cast<unsigned>(used++) : number;  // a vertex without a triangle
    }
    for (ScenePart& part : geometry.parts) {
        for (Triangle& t : part.triangles) {
            t = {order[t[0]], order[t[1]], order[t[2]]};
        }
    }
    reorder(geometry.vertices, order);
    reorder(geometry.normals, order);
    reorder(geometry.uvs, order);
    reorder(geometry.colours, order);
    reorder(geometry.angles, order);
    reorder(copies.joints, order);
    for (SceneTarget& target : geometry.targets) {
        reorder(target.vertices, order);
        reorder(target.normals, order);
    }
}

/// Makes the model and the buffer of a scene.
class GltfWriter {
public:
    GltfWriter(const Scene& scene, Compression compression)
        : scene_(scene), compression_(compression), buffer_(model_, compression == Compression::Meshopt)
    {
        model_.asset.version = "2.0";
        model_.asset.generator = std::string("droplet-shape ") + kVersion;
        model_.defaultScene = 0;
        model_.scenes.emplace_back();
        if (scene.roots.empty()) {
            model_.scenes.front().name = "nothing";
        }
        if (scene.meshes.empty()) {
            compression_ = Compression::None;
        }
        findCrowds();
        findCube();
        addMaterials();
        for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
            addMesh(i);
        }
        addNodes();
        for (const SceneCrowd& crowd : scene.crowds) {
            addCrowd(crowd);
        }
        for (const SceneInstances& instances : scene.instances) {
            addInstances(instances);
        }
        if (!scene.instances.empty() && scene.gpu_instancing) {
            require("EXT_mesh_gpu_instancing");
        }
        addTracks();
        addPicture();
        addImages();
        if (compression_ != Compression::None) {
            require("KHR_mesh_quantization");
        }
        if (compression_ == Compression::Meshopt) {
            require("EXT_meshopt_compression");
        }
    }

    [[nodiscard]] nlohmann::json json() const { return buffer_.json(); }
    [[nodiscard]] const GltfBuffer& buffer() const { return buffer_; }

private:
    void require(const char* extension)
    {
        model_.extensionsUsed.emplace_back(extension);
        model_.extensionsRequired.emplace_back(extension);
    }

    void use(const std::string& extension)
    {
        std::vector<std::string>& used = model_.extensionsUsed;
        if (std::find(used.begin(), used.end(), extension) == used.end()) {
            used.push_back(extension);
        }
    }

    void findCrowds()
    {
        crowd_of_.assign(scene_.meshes.size(), nullptr);
        for (const SceneCrowd& crowd : scene_.crowds) {
            crowd_of_[crowd.mesh] = &crowd;
        }
        is_instanced_.assign(scene_.meshes.size(), false);
        for (const SceneInstances& instances : scene_.instances) {
            is_instanced_[instances.mesh] = true;
        }
    }

    /// Whether a mesh is one of copies, which are scaled, so that it is not in the cube of all meshes.
    [[nodiscard]] bool isCopied(std::size_t mesh) const { return crowd_of_[mesh] || is_instanced_[mesh]; }

    void findCube()
    {
        if (compression_ == Compression::None) {
            return;
        }
        std::vector<Vec3> vertices;
        double longest = 0.0;
        for (std::size_t i = 0; i < scene_.meshes.size(); ++i) {
            for (const SceneGeometry& geometry : scene_.meshes[i].geometries) {
                if (isCopied(i)) {
                    continue;
                }
                const std::vector<Vec3> own = vectorsOf(geometry.vertices);
                vertices.insert(vertices.end(), own.begin(), own.end());
                for (const SceneTarget& target : geometry.targets) {
                    for (const Float3& change : target.vertices) {
                        longest = std::max(longest, largestOf(change));
                    }
                }
            }
        }
        cube_ = vertices.empty() ? QuantizationCube{} : cubeAround(vertices, longest);
    }

    void addMaterials()
    {
        std::vector<bool> is_small(scene_.materials.size(), false);  // whether its unit is the cube's side
        for (std::size_t i = 0; cube_ && i < scene_.meshes.size(); ++i) {
            for (const SceneGeometry& geometry : scene_.meshes[i].geometries) {
                for (const ScenePart& part : geometry.parts) {
                    is_small[part.material] = !isCopied(i);
                }
            }
        }
        for (std::size_t i = 0; i < scene_.materials.size(); ++i) {
            model_.materials.push_back(materialOf(scene_.materials[i], is_small[i] ? cube_->side : 1.0));
            for (const auto& [extension, value] : model_.materials.back().extensions) {
                use(extension);
            }
        }
    }

    void addMesh(std::size_t index)
    {
        if (crowd_of_[index]) {
            addCopies(*crowd_of_[index], 0);
            return;
        }
        const SceneMesh& from = scene_.meshes[index];
        tinygltf::Mesh mesh;
        mesh.name = from.name;
        mesh.weights.assign(from.targets.size(), 0.0);
        Value::Object extras = objectOf(from.properties);
        if (!from.targets.empty()) {
            Value::Array names;
            for (const std::string& name : from.targets) {
                names.emplace_back(name);
            }
            extras["targetNames"] = Value(std::move(names));  // a convention of viewers (section 3.7.2.2)
        }
        setExtras(mesh.extras, std::move(extras));
        for (const SceneGeometry& geometry : from.geometries) {
            const SceneGeometry* shown = &geometry;
            if (compression_ == Compression::Meshopt) {
                Copies& copies = copies_.emplace_back(Copies{geometry, {}});
                optimize(copies);
                shown = &copies.geometry;
            }
            addPrimitives(*shown, nullptr, is_instanced_[index] ? std::nullopt : cube_, mesh);
        }
        model_.meshes.push_back(std::move(mesh));
    }

    /// Adds the mesh of some of a crowd's copies.
    /// @param first  of the copies
    void addCopies(const SceneCrowd& crowd, std::size_t first)
    {
        const SceneMesh& from = scene_.meshes[crowd.mesh];
        tinygltf::Mesh mesh;
        mesh.name = from.name;
        Copies& copies = copies_.emplace_back(copiesOf(from.geometries.front(), crowd, shapesFrom(crowd, first)));
        if (cube_ && first == 0) {
            std::vector<Vec3> vertices = vectorsOf(from.geometries.front().vertices);
            vertices.emplace_back();  // of the corners
            for (const SceneShape& shape : crowd.shapes) {
                const std::vector<Vec3> own = vectorsOf(shape.vertices);
                vertices.insert(vertices.end(), own.begin(), own.end());
            }
            crowd_cubes_[crowd.mesh] = cubeAround(vertices, 0.0);
        }
        if (compression_ == Compression::Meshopt) {
            optimize(copies);
        }
        const auto cube = cube_ ? std::optional(crowd_cubes_.at(crowd.mesh)) : std::nullopt;
        if (first == 0) {
            addPrimitives(copies.geometry, &copies.joints, cube, mesh);
        } else {
            // All but vertices and normals is the same in the first mesh of the crowd.
            tinygltf::Primitive& primitive = mesh.primitives.emplace_back(model_.meshes[crowd.mesh].primitives.front());
            primitive.attributes["POSITION"] = addPositions(copies.geometry.vertices, cube);
            primitive.attributes["NORMAL"] = addNormals(copies.geometry.normals, cube.has_value());
        }
        model_.meshes.push_back(std::move(mesh));
    }

    /// Shapes of the copies in a mesh.
    static CopyShapes shapesFrom(const SceneCrowd& crowd, std::size_t first)
    {
        CopyShapes shapes{};
        for (std::size_t k = 0; k < shapes.size() && first + k < crowd.nodes.size(); ++k) {
            shapes[k] = crowd.shapeOf(first + k);
        }
        return shapes;
    }

    using Joints = std::vector<std::array<std::uint8_t, 4>>;

    void addPrimitives(const SceneGeometry& geometry, const Joints* joints, const std::optional<QuantizationCube>& cube,
                       tinygltf::Mesh& mesh)
    {
        tinygltf::Primitive primitive;
        primitive.mode = TINYGLTF_MODE_TRIANGLES;
        std::map<std::string, int>& attributes = primitive.attributes;
        attributes["POSITION"] = addPositions(geometry.vertices, cube);
        attributes["NORMAL"] = addNormals(geometry.normals, cube.has_value());
        if (!geometry.uvs.empty()) {
            attributes["TEXCOORD_0"] = addCoordinates(geometry.uvs, cube.has_value());
        }
        if (!geometry.colours.empty()) {
            attributes["COLOR_0"] = buffer_.add(arrayOf(geometry.colours), GltfContent::Vertices);
        }
        if (!geometry.angles.empty()) {
            attributes["_CONTACT_ANGLE"] = buffer_.add(arrayOf(geometry.angles), GltfContent::Vertices);
        }
        if (joints && !joints->empty()) {
            GltfArray numbers = arrayOf(*joints, 4, TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE);
            numbers.normalised = false;
            attributes["JOINTS_0"] = buffer_.add(numbers, GltfContent::Vertices);
            attributes["WEIGHTS_0"] =
                buffer_.add(arrayOf(Joints(joints->size(), {255, 0, 0, 0}), 4, TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE),
                            GltfContent::Vertices);
        }
        for (const SceneTarget& target : geometry.targets) {
            primitive.targets.push_back({{"POSITION", addChanges(target.vertices, cube)},
                                         {"NORMAL", addTurns(target.normals, cube.has_value())}});
        }
        for (const ScenePart& part : geometry.parts) {
            primitive.material = static_cast<int>(part.material);
            primitive.indices = addIndices(part.triangles, geometry.vertices.size());
            mesh.primitives.push_back(primitive);
        }
    }

    /// Parts of the same triangles share an array.
    int addIndices(const std::vector<Triangle>& triangles, std::size_t vertices)
    {
        for (const auto& [same, count, accessor] : indices_) {
            if (count == vertices && *same == triangles) {
                return accessor;
            }
        }
        const int accessor = buffer_.add(arrayOf(triangles, vertices), GltfContent::Indices);
        indices_.push_back({&triangles, vertices, accessor});
        return accessor;
    }

    int addPositions(const std::vector<Float3>& vertices, const std::optional<QuantizationCube>& cube)
    {
        if (!cube) {
            return addBounded(vertices);
        }
        return addBounded(
            quantizedAll<QuantizedPosition>(vertices, [&](Vec3 position) { return cube->quantized(position); }),
            TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT);
    }

    int addChanges(const std::vector<Float3>& changes, const std::optional<QuantizationCube>& cube)
    {
        if (!cube) {
            return addBounded(changes);
        }
        return addBounded(
            quantizedAll<QuantizedVector>(changes, [&](Vec3 change) { return cube->quantizedChange(change); }),
            TINYGLTF_COMPONENT_TYPE_SHORT);
    }

    int addBounded(const std::vector<Float3>& vectors)
    {
        GltfArray array = arrayOf(vectors);
        bound(array, vectors);
        return buffer_.add(array, GltfContent::Vertices);
    }

    template <class Number>
    int addBounded(std::vector<std::array<Number, 4>> vectors, int component_type)
    {
        GltfArray bounds;
        bound(bounds, vectors);
        GltfArray array = arrayOf(std::move(vectors), 3, component_type);
        array.low = std::move(bounds.low);
        array.high = std::move(bounds.high);
        return buffer_.add(array, GltfContent::Vertices);
    }

    int addNormals(const std::vector<Float3>& normals, bool is_quantized)
    {
        if (!is_quantized) {
            return buffer_.add(arrayOf(normals), GltfContent::Vertices);
        }
        return buffer_.add(
            arrayOf(quantizeNormals(vectorsOf(normals), compression_).stored, 3, TINYGLTF_COMPONENT_TYPE_SHORT),
            compression_ == Compression::Meshopt ? GltfContent::OctahedralNormals : GltfContent::Vertices);
    }

    /// Changes of normals are quantized unless a coordinate turns by more than 1.
    int addTurns(const std::vector<Float3>& turns, bool is_quantized)
    {
        const bool is_small =
            std::all_of(turns.begin(), turns.end(), [](const Float3& turn) { return largestOf(turn) <= 1.0; });
        if (!is_quantized || !is_small) {
            return buffer_.add(arrayOf(turns), GltfContent::Vertices);
        }
        return buffer_.add(arrayOf(quantizedAll<QuantizedVector>(turns, [](Vec3 turn) { return quantized(turn); }), 3,
                                   TINYGLTF_COMPONENT_TYPE_SHORT),
                           GltfContent::Vertices);
    }

    int addCoordinates(const std::vector<Float2>& uvs, bool is_quantized)
    {
        const auto is_inside = [](float number) { return number >= 0.0F && number <= 1.0F; };
        if (!is_quantized || !std::all_of(uvs.begin(), uvs.end(),
                                          [&](const Float2& uv) { return is_inside(uv[0]) && is_inside(uv[1]); })) {
            return buffer_.add(arrayOf(uvs), GltfContent::Vertices);
        }
        std::vector<std::array<std::uint16_t, 2>> steps(uvs.size());
        std::transform(uvs.begin(), uvs.end(), steps.begin(), [](const Float2& uv) {
            const auto step = [](float number) { return static_cast<std::uint16_t>(std::lround(number * 65535.0F)); };
            return std::array{step(uv[0]), step(uv[1])};
        });
        return buffer_.add(arrayOf(std::move(steps), 2, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT), GltfContent::Vertices);
    }

    void addNodes()
    {
        std::vector<bool> is_moved(scene_.nodes.size(), false);
        for (const SceneTrack& track : scene_.tracks) {
            is_moved[track.node] = is_moved[track.node] || track.change != SceneChange::Weights;
        }
        for (const SceneNode& from : scene_.nodes) {
            tinygltf::Node node;
            node.name = from.name;
            node.mesh = from.mesh ? static_cast<int>(*from.mesh) : -1;
            node.children.assign(from.children.begin(), from.children.end());
            if (from.translation != SceneNode{}.translation) {
                node.translation.assign(from.translation.begin(), from.translation.end());
            }
            if (from.rotation != SceneNode{}.rotation) {
                node.rotation.assign(from.rotation.begin(), from.rotation.end());
            }
            if (from.scale != SceneNode{}.scale) {
                node.scale.assign(from.scale.begin(), from.scale.end());
            }
            setExtras(node.extras, objectOf(from.properties));
            if (!from.levels.empty()) {
                Value::Array levels;
                for (const std::size_t level : from.levels) {
                    levels.emplace_back(static_cast<int>(level));
                }
                node.extensions["MSFT_lod"] = Value(Value::Object{{"ids", Value(std::move(levels))}});
                use("MSFT_lod");
            }
            model_.nodes.push_back(std::move(node));
        }
        mesh_nodes_.resize(scene_.nodes.size());
        for (std::size_t i = 0; i < scene_.nodes.size(); ++i) {
            mesh_nodes_[i] = static_cast<int>(i);
            if (cube_ && scene_.nodes[i].mesh) {
                placeCube(i, is_moved[i]);
            }
        }
        model_.scenes.front().nodes.assign(scene_.roots.begin(), scene_.roots.end());
    }

    /// Places the cube of a node's mesh, in a child if the node is not free for that.
    void placeCube(std::size_t index, bool is_moved)
    {
        const auto at = [this](std::size_t i) -> tinygltf::Node& { return model_.nodes[i]; };
        std::size_t placed = index;
        if (is_moved || !at(index).children.empty() || !at(index).translation.empty() || !at(index).rotation.empty() ||
            !at(index).scale.empty()) {
            placed = model_.nodes.size();
            tinygltf::Node child;
            child.name = at(index).name;
            child.mesh = std::exchange(at(index).mesh, -1);
            at(index).children.push_back(static_cast<int>(placed));
            model_.nodes.push_back(std::move(child));
            mesh_nodes_[index] = static_cast<int>(placed);
        }
        at(placed).translation = {cube_->low.x, cube_->low.y, cube_->low.z};
        at(placed).scale.assign(3, cube_->side);
    }

    /// Matrices that take vertices of a crowd's mesh to the frame of their joints; some readers need them.
    int bindOf(std::size_t mesh)
    {
        const auto [found, is_new] = binds_.try_emplace(cube_ ? std::optional(mesh) : std::nullopt, -1);
        if (is_new) {
            const QuantizationCube cube = cube_ ? crowd_cubes_.at(mesh) : QuantizationCube{};
            const auto side = static_cast<float>(cube.side);
            const std::array<float, 16> matrix{side,
                                               0,
                                               0,
                                               0,
                                               0,
                                               side,
                                               0,
                                               0,
                                               0,
                                               0,
                                               side,
                                               0,
                                               static_cast<float>(cube.low.x),
                                               static_cast<float>(cube.low.y),
                                               static_cast<float>(cube.low.z),
                                               1};
            matrices_.emplace_back(kCopiesOfMesh + scene_.corners.size(), matrix);
            found->second = buffer_.add(arrayOf(matrices_.back()), GltfContent::Other);
        }
        return found->second;
    }

    void addCrowd(const SceneCrowd& crowd)
    {
        std::vector<int> joints(crowd.nodes.begin(), crowd.nodes.end());
        while (joints.size() % kCopiesOfMesh != 0) {
            tinygltf::Node spare;
            spare.scale = {0.0, 0.0, 0.0};
            joints.push_back(static_cast<int>(model_.nodes.size()));
            model_.nodes[crowd.parent].children.push_back(joints.back());
            model_.nodes.push_back(std::move(spare));
        }
        std::map<CopyShapes, int> meshes{{shapesFrom(crowd, 0), static_cast<int>(crowd.mesh)}};
        for (std::size_t first = 0; first < joints.size(); first += kCopiesOfMesh) {
            const auto [mesh, is_new] =
                meshes.try_emplace(shapesFrom(crowd, first), static_cast<int>(model_.meshes.size()));
            if (is_new) {
                addCopies(crowd, first);
            }
            tinygltf::Skin skin;
            skin.inverseBindMatrices = bindOf(crowd.mesh);
            const auto begin = joints.begin() + static_cast<std::ptrdiff_t>(first);
            skin.joints.assign(begin, begin + kCopiesOfMesh);
            skin.joints.insert(skin.joints.end(), scene_.corners.begin(), scene_.corners.end());
            tinygltf::Node node;
            node.name = scene_.meshes[crowd.mesh].name;
            node.mesh = mesh->second;
            node.skin = static_cast<int>(model_.skins.size());
            model_.skins.push_back(std::move(skin));
            model_.scenes.front().nodes.push_back(static_cast<int>(model_.nodes.size()));
            model_.nodes.push_back(std::move(node));
        }
    }

    void addInstances(const SceneInstances& instances)
    {
        if (!scene_.gpu_instancing) {
            for (std::size_t i = 0; i < instances.translations.size(); ++i) {
                tinygltf::Node node;
                node.mesh = static_cast<int>(instances.mesh);
                node.translation.assign(instances.translations[i].begin(), instances.translations[i].end());
                node.rotation.assign(instances.rotations[i].begin(), instances.rotations[i].end());
                node.scale.assign(instances.scales[i].begin(), instances.scales[i].end());
                model_.nodes[instances.parent].children.push_back(static_cast<int>(model_.nodes.size()));
                model_.nodes.push_back(std::move(node));
            }
            return;
        }
        tinygltf::Node node;
        node.name = scene_.meshes[instances.mesh].name;
        node.mesh = static_cast<int>(instances.mesh);
        Value::Object attributes;
        attributes["TRANSLATION"] = Value(buffer_.add(arrayOf(instances.translations), GltfContent::Other));
        attributes["ROTATION"] = Value(buffer_.add(arrayOf(instances.rotations), GltfContent::Other));
        attributes["SCALE"] = Value(buffer_.add(arrayOf(instances.scales), GltfContent::Other));
        node.extensions["EXT_mesh_gpu_instancing"] = Value(Value::Object{{"attributes", Value(std::move(attributes))}});
        model_.nodes[instances.parent].children.push_back(static_cast<int>(model_.nodes.size()));
        model_.nodes.push_back(std::move(node));
    }

    /// Numbers of an animation with one size are in one view.
    class TrackArrays {
    public:
        /// Takes an array up; add() gives it an accessor.
        /// @param accessor  takes its index; must stay valid
        void take(GltfArray array, int& accessor)
        {
            auto& [arrays, accessors] = by_stride_[array.stride];
            arrays.push_back(std::move(array));
            accessors.push_back(&accessor);
        }

        void add(GltfBuffer& buffer)
        {
            for (auto& [stride, entry] : by_stride_) {
                int accessor = buffer.add(entry.first, GltfContent::Other);
                for (int* const index : entry.second) {
                    *index = accessor++;
                }
            }
        }

    private:
        std::map<std::size_t, std::pair<std::vector<GltfArray>, std::vector<int*>>> by_stride_;
    };

    void addTracks()
    {
        if (scene_.tracks.empty()) {
            return;
        }
        TrackArrays arrays;
        std::vector<int> inputs(scene_.times.size());
        for (std::size_t i = 0; i < inputs.size(); ++i) {
            GltfArray array = arrayOf(scene_.times[i]);
            array.low = {static_cast<double>(scene_.times[i].front())};
            array.high = {static_cast<double>(scene_.times[i].back())};
            arrays.take(std::move(array), inputs[i]);
        }
        tinygltf::Animation& animation = model_.animations.emplace_back();
        animation.name = scene_.animation;
        animation.samplers.resize(scene_.tracks.size());
        for (std::size_t i = 0; i < scene_.tracks.size(); ++i) {
            arrays.take(trackArray(scene_.tracks[i]), animation.samplers[i].output);
        }
        arrays.add(buffer_);
        for (std::size_t i = 0; i < scene_.tracks.size(); ++i) {
            const SceneTrack& track = scene_.tracks[i];
            animation.samplers[i].input = inputs[track.times];
            animation.samplers[i].interpolation = track.steps ? "STEP" : "LINEAR";
            tinygltf::AnimationChannel channel;
            channel.sampler = static_cast<int>(i);
            channel.target_node =
                track.change == SceneChange::Weights ? mesh_nodes_[track.node] : static_cast<int>(track.node);
            channel.target_path = nameOf(track.change);
            animation.channels.push_back(std::move(channel));
        }
    }

    static GltfArray trackArray(const SceneTrack& track)
    {
        if (!track.is_coarse) {
            return arrayOf(track.values, track.change == SceneChange::Weights    ? 1
                                         : track.change == SceneChange::Rotation ? 4
                                                                                 : 3);
        }
        std::vector<QuantizedVector> turns(track.values.size() / 4);
        for (std::size_t i = 0; i < track.values.size(); ++i) {
            turns[i / 4][i % 4] = static_cast<std::int16_t>(std::lround(32767.0F * track.values[i]));
        }
        return arrayOf(std::move(turns), 4, TINYGLTF_COMPONENT_TYPE_SHORT);
    }

    void addPicture()
    {
        if (!scene_.picture) {
            return;
        }
        const bool is_colour = scene_.picture->is_colour;
        tinygltf::Image image;
        image.name = scene_.picture->name;
        image.mimeType = "image/png";
        image.bufferView = buffer_.addPicture(scene_.picture->png);
        tinygltf::Sampler sampler;
        sampler.minFilter = is_colour ? TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR : TINYGLTF_TEXTURE_FILTER_NEAREST;
        sampler.magFilter = is_colour ? TINYGLTF_TEXTURE_FILTER_LINEAR : TINYGLTF_TEXTURE_FILTER_NEAREST;
        sampler.wrapS = TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
        sampler.wrapT = TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
        tinygltf::Texture texture;
        texture.sampler = 0;
        texture.source = 0;
        texture.name = is_colour ? "" : scene_.picture->name;
        model_.images.push_back(std::move(image));
        model_.samplers.push_back(std::move(sampler));
        model_.textures.push_back(std::move(texture));
    }

    /// Images of single materials; those that are equal once.
    void addImages()
    {
        constexpr const char* kPlace = "KHR_texture_transform";
        bool is_moved = false;
        std::map<std::string_view, int> textures;
        const auto index_of = [&](const std::string& bytes) {
            if (bytes.empty()) {
                return -1;
            }
            const auto [found, is_new] = textures.try_emplace(bytes, static_cast<int>(model_.textures.size()));
            if (is_new) {
                tinygltf::Image image;
                image.mimeType = bytes.starts_with("\x89PNG") ? "image/png" : "image/jpeg";
                image.bufferView = buffer_.addPicture(bytes);
                tinygltf::Texture texture;
                texture.source = static_cast<int>(model_.images.size());
                model_.images.push_back(std::move(image));
                model_.textures.push_back(std::move(texture));
            }
            return found->second;
        };
        for (std::size_t m = 0; m < scene_.materials.size(); ++m) {
            const SceneMaterial& from = scene_.materials[m];
            tinygltf::Material& material = model_.materials[m];
            const bool has_picture = scene_.picture && m >= scene_.picture->first_material;
            material.pbrMetallicRoughness.baseColorTexture.index = !has_picture                ? index_of(from.image)
                                                                   : scene_.picture->is_colour ? 0
                                                                                               : -1;
            material.pbrMetallicRoughness.metallicRoughnessTexture.index = index_of(from.finish_image);
            material.normalTexture.index = index_of(from.normal_image);
            material.normalTexture.scale = from.relief;
            material.emissiveTexture.index = index_of(from.glow_image);
            if (!(from.place == TexturePlace())) {
                is_moved = true;
                const Value place(Value::Object{
                    {"offset", Value(Value::Array{Value(from.place.offset.x), Value(from.place.offset.y)})},
                    {"rotation", Value(from.place.turn)},
                    {"scale", Value(Value::Array{Value(from.place.scale.x), Value(from.place.scale.y)})}});
                material.pbrMetallicRoughness.baseColorTexture.extensions[kPlace] = place;
                material.pbrMetallicRoughness.metallicRoughnessTexture.extensions[kPlace] = place;
                material.normalTexture.extensions[kPlace] = place;
                material.emissiveTexture.extensions[kPlace] = place;
            }
        }
        if (is_moved) {
            model_.extensionsUsed.emplace_back(kPlace);
        }
    }

    const Scene& scene_;
    Compression compression_;
    tinygltf::Model model_;
    GltfBuffer buffer_;
    std::vector<const SceneCrowd*> crowd_of_;  ///< of every mesh, or null
    std::vector<bool> is_instanced_;           ///< of every mesh
    std::optional<QuantizationCube> cube_;     ///< of all meshes but those of copies
    std::map<std::size_t, QuantizationCube> crowd_cubes_;
    std::deque<Copies> copies_;  ///< what arrays refer to
    /// Arrays of indices: triangles, number of vertices, accessor.
    std::vector<std::tuple<const std::vector<Triangle>*, std::size_t, int>> indices_;
    std::deque<std::vector<std::array<float, 16>>> matrices_;
    std::map<std::optional<std::size_t>, int> binds_;  ///< accessors of matrices
    std::vector<int> mesh_nodes_;                      ///< of every node, the one that has its mesh
};

// Base64 encoder: S. Josefsson, RFC 4648 (2006), section 4.
class Base64Buffer : public std::streambuf {
public:
    explicit Base64Buffer(ByteStream& text) : text_(text) {}

    void finish()
    {
        if (filled_ > 0) {
            const int missing = 3 - filled_;
            group_ <<= 8 * missing;
            text_.u8(sign(18), sign(12), missing == 1 ? sign(6) : '=', '=');
        }
    }

protected:
    std::streamsize xsputn(const char* bytes, std::streamsize count) override
    {
        for (std::streamsize i = 0; i < count; ++i) {
            group_ = group_ << 8 | static_cast<unsigned char>(bytes[i]);
            if (++filled_ == 3) {
                text_.u8(sign(18), sign(12), sign(6), sign(0));
                filled_ = 0;
            }
        }
        return count;
    }

private:
    [[nodiscard]] char sign(int shift) const
    {
        constexpr const char* kSigns = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        return kSigns[group_ >> shift & 63U];
    }

    ByteStream& text_;
    std::uint32_t group_ = 0;
    int filled_ = 0;
};

void checkSize(std::uint64_t bytes)
{
    if (bytes >= kGltfFileLimit) {
        throw Error(ErrorCode::InvalidArgument, "the scene would make a glTF file of " + std::to_string(bytes) +
                                                    " bytes; it must stay below 2 GiB");
    }
}

std::uint64_t writeText(nlohmann::json json, const GltfBuffer& buffer, std::ostream& out)
{
    const std::string uri = "data:application/octet-stream;base64,";
    if (buffer.bytes() > 0) {
        json["buffers"][0]["uri"] = uri;
    }
    const std::string text = json.dump(2);
    checkSize(text.size() + (buffer.bytes() + 2) / 3 * 4);
    const std::size_t begin = buffer.bytes() > 0 ? text.find(uri) + uri.size() : text.size();
    ByteStream bytes(out);
    bytes.text(std::string_view(text).substr(0, begin));
    if (buffer.bytes() > 0) {
        Base64Buffer base64(bytes);
        std::ostream encoded(&base64);
        ByteStream content(encoded);
        buffer.write(content);
        content.finish();
        base64.finish();
    }
    bytes.text(std::string_view(text).substr(begin));
    bytes.text("\n");
    return bytes.finish();
}

// GLB file format: a header of three words, then chunks padded to whole words, JSON with spaces, the buffer with 0.
std::uint64_t writeBinary(const nlohmann::json& content, const GltfBuffer& buffer, std::ostream& out)
{
    const auto padding = [](std::size_t bytes) { return (4 - bytes % 4) % 4; };
    std::string json = content.dump();
    json.append(padding(json.size()), ' ');
    const std::string zeros(padding(buffer.bytes()), '\0');
    const std::size_t buffer_bytes = buffer.bytes() + zeros.size();
    const std::size_t headers = buffer_bytes > 0 ? 12 + 8 + 8 : 12 + 8;  // an empty buffer has no chunk
    checkSize(headers + json.size() + buffer_bytes);
    ByteStream bytes(out);
    bytes.text("glTF");
    bytes.u32(2, headers + json.size() + buffer_bytes, json.size());
    bytes.text("JSON");
    bytes.text(json);
    if (buffer_bytes > 0) {
        bytes.u32(buffer_bytes);
        bytes.text("BIN");
        bytes.u8(0);
        buffer.write(bytes);
        bytes.text(zeros);
    }
    return bytes.finish();
}

}  // namespace

std::uint64_t writeGltf(const Scene& scene, std::ostream& out, const AnimatedFile& file)
{
    if (file.compression != Compression::None && file.format != Format::Glb) {
        throw Error(ErrorCode::InvalidArgument,
                    std::string("options.compression = ") + name(file.compression) + " needs a GLB");
    }
    const GltfWriter writer(scene, file.compression);
    return file.format == Format::Glb ? writeBinary(writer.json(), writer.buffer(), out)
                                      : writeText(writer.json(), writer.buffer(), out);
}

}  // namespace droplet
