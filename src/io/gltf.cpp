// SPDX-License-Identifier: GPL-3.0-or-later
// Khronos Group, "glTF 2.0 Specification" (2021), and its extensions KHR_materials_transmission, KHR_materials_ior and
// KHR_materials_volume.
#include "droplet/io/gltf.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "droplet/error.h"
#include "droplet/version.h"
#include "io/axes.h"
#include "io/little_endian.h"

namespace droplet {
namespace {

// The writer keeps offsets in int; viewers' limits are of the same order.
constexpr std::uint64_t kFileLimit = std::uint64_t{1} << 31;

// Above the JSON's length beside an embedded buffer: fewer than 60 numbers and names, each shorter than 60 characters.
constexpr std::uint64_t kJsonBound = 4096;

// 65535 restarts primitives; with fewer vertices it can be no index.
constexpr std::size_t kVerticesBeyond16Bit = 65535;

constexpr std::uint64_t kVertexBytes = 8 * sizeof(float);  // position 3, normal 3, uv 2

struct Look {
    Material material;
    const char* name;
    std::array<double, 3> colour;  // of metal and opaque matter; of liquid: of white light through the mean height
    double metallic;
    double roughness;
    double transmission;
    double ior;
    bool tinted;  // colour deepens with the way through the liquid
};

// Water's ior at 589 nm, 20 °C; ink is water with dye. Honey: Wedmore's table at 18 % water. Mercury: reflectance
// in visible light of about 0.78. The other colours are chosen by eye.
constexpr std::array<Look, 5> kLooks = {{
    {Material::Water, "water", {1.0, 1.0, 1.0}, 0.0, 0.0, 1.0, 1.333, false},
    {Material::Ink, "ink", {0.03, 0.06, 0.35}, 0.0, 0.0, 1.0, 1.333, true},
    {Material::Mercury, "mercury", {0.78, 0.78, 0.78}, 1.0, 0.02, 0.0, 1.5, false},
    {Material::Honey, "honey", {0.9, 0.5, 0.1}, 0.0, 0.0, 1.0, 1.489, true},
    {Material::Plain, "plain", {0.8, 0.8, 0.8}, 0.0, 0.5, 0.0, 1.5, false},
}};

const Look& lookOf(Material material)
{
    for (const Look& look : kLooks) {
        if (look.material == material) {
            return look;
        }
    }
    throw Error(ErrorCode::InvalidArgument, "options.material = " + std::to_string(static_cast<int>(material)) +
                                                " must be one of the " + std::to_string(kLooks.size()) + " materials");
}

bool wideIndices(const Surface& surface)
{
    return surface.positions.size() >= kVerticesBeyond16Bit;
}

void checkFileSize(const Surface& surface, bool binary)
{
    const std::uint64_t index_bytes = wideIndices(surface) ? 4 : 2;
    const std::uint64_t buffer = kVertexBytes * surface.positions.size() + 3 * index_bytes * surface.triangles.size();
    const std::uint64_t file = kJsonBound + (binary ? buffer : (buffer + 2) / 3 * 4);
    if (file >= kFileLimit) {
        throw Error(ErrorCode::InvalidArgument, "surface with " + std::to_string(surface.triangles.size()) +
                                                    " triangles would make a glTF file of " + std::to_string(file) +
                                                    " bytes; it must stay below 2 GiB");
    }
}

tinygltf::Value::Array colourValue(const std::array<double, 3>& colour)
{
    return {tinygltf::Value(colour[0]), tinygltf::Value(colour[1]), tinygltf::Value(colour[2])};
}

tinygltf::Material makeMaterial(const Look& look, const Surface& surface, bool closed)
{
    tinygltf::Material material;
    material.name = look.name;
    material.pbrMetallicRoughness.metallicFactor = look.metallic;
    material.pbrMetallicRoughness.roughnessFactor = look.roughness;
    // A thickness of 0 means thin-walled, and the distance of attenuation must be positive.
    const bool has_volume = look.transmission > 0.0 && closed && surface.mean_height > 0.0;
    if (!has_volume || !look.tinted) {
        material.pbrMetallicRoughness.baseColorFactor = {look.colour[0], look.colour[1], look.colour[2], 1.0};
    }
    if (look.transmission > 0.0) {
        material.extensions["KHR_materials_transmission"] =
            tinygltf::Value(tinygltf::Value::Object{{"transmissionFactor", tinygltf::Value(look.transmission)}});
        material.extensions["KHR_materials_ior"] =
            tinygltf::Value(tinygltf::Value::Object{{"ior", tinygltf::Value(look.ior)}});
    }
    if (has_volume) {
        tinygltf::Value::Object volume{{"thicknessFactor", tinygltf::Value(surface.mean_height)}};
        if (look.tinted) {
            volume["attenuationColor"] = tinygltf::Value(colourValue(look.colour));
            volume["attenuationDistance"] = tinygltf::Value(surface.mean_height);
        }
        material.extensions["KHR_materials_volume"] = tinygltf::Value(std::move(volume));
    }
    return material;
}

// Appends one array to the buffer, with the view and the accessor on it; returns the accessor.
class BufferBuilder {
public:
    BufferBuilder(tinygltf::Model& model, std::size_t bytes) : model_(model)
    {
        model_.buffers.emplace_back();
        data().reserve(bytes);
    }

    std::vector<unsigned char>& data() { return model_.buffers.front().data; }

    int finish(int target, int component_type, int type, std::size_t count)
    {
        tinygltf::BufferView view;
        view.buffer = 0;
        view.byteOffset = begin_;
        view.byteLength = data().size() - begin_;
        view.target = target;
        begin_ = data().size();
        tinygltf::Accessor accessor;
        accessor.bufferView = static_cast<int>(model_.bufferViews.size());
        accessor.componentType = component_type;
        accessor.type = type;
        accessor.count = count;
        model_.bufferViews.push_back(std::move(view));
        model_.accessors.push_back(std::move(accessor));
        return static_cast<int>(model_.accessors.size()) - 1;
    }

private:
    tinygltf::Model& model_;
    std::size_t begin_ = 0;
};

// Positions within half an ulp of float: of a 20 mm droplet 0.5 nm, a ten-thousandth of an edge of the finest mesh
// that fits a file. What little closer vertices would merge to stays closed, as faces go by index and welded copies
// round alike; normals are stored, so no flat triangle asks for one.
int addPositions(BufferBuilder& buffer, tinygltf::Model& model, const Surface& surface)
{
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    std::vector<double> low(3, kInfinity);
    std::vector<double> high(3, -kInfinity);
    for (const Vec3& position : surface.positions) {
        const Vec3 up = yUp(position);
        const std::array<double, 3> coordinates = {up.x, up.y, up.z};
        for (std::size_t k = 0; k < 3; ++k) {
            appendFloat(buffer.data(), coordinates[k]);
            // The bounds must be those of the floats, exactly.
            const double rounded = static_cast<double>(toFloat(coordinates[k]));
            low[k] = std::min(low[k], rounded);
            high[k] = std::max(high[k], rounded);
        }
    }
    const int accessor = buffer.finish(TINYGLTF_TARGET_ARRAY_BUFFER, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3,
                                       surface.positions.size());
    model.accessors.back().minValues = std::move(low);
    model.accessors.back().maxValues = std::move(high);
    return accessor;
}

int addNormals(BufferBuilder& buffer, const Surface& surface)
{
    for (const Vec3& normal : surface.normals) {
        const Vec3 up = yUp(normal);
        appendFloat(buffer.data(), up.x);
        appendFloat(buffer.data(), up.y);
        appendFloat(buffer.data(), up.z);
    }
    return buffer.finish(TINYGLTF_TARGET_ARRAY_BUFFER, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3,
                         surface.normals.size());
}

// glTF's texture origin is the upper left, as the mask's.
int addUvs(BufferBuilder& buffer, const Surface& surface)
{
    for (const Vec2& uv : surface.uvs) {
        appendFloat(buffer.data(), uv.x);
        appendFloat(buffer.data(), uv.y);
    }
    return buffer.finish(TINYGLTF_TARGET_ARRAY_BUFFER, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC2,
                         surface.uvs.size());
}

int addIndices(BufferBuilder& buffer, const Surface& surface)
{
    const bool wide = wideIndices(surface);
    for (const Triangle& triangle : surface.triangles) {
        for (const std::uint32_t vertex : triangle) {
            appendBytes(buffer.data(), vertex, wide ? 4 : 2);
        }
    }
    return buffer.finish(TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER,
                         wide ? TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT : TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT,
                         TINYGLTF_TYPE_SCALAR, 3 * surface.triangles.size());
}

tinygltf::Model makeModel(const Surface& surface, const GltfOptions& options)
{
    tinygltf::Model model;
    model.asset.version = "2.0";
    model.asset.generator = std::string("droplet-shape ") + kVersion;

    model.materials.push_back(makeMaterial(lookOf(options.material), surface, options.closed));
    for (const auto& [extension, value] : model.materials.front().extensions) {
        model.extensionsUsed.push_back(extension);
    }

    BufferBuilder buffer(model, kVertexBytes * surface.positions.size() + 12 * surface.triangles.size());
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.material = 0;
    primitive.attributes["POSITION"] = addPositions(buffer, model, surface);
    primitive.attributes["NORMAL"] = addNormals(buffer, surface);
    primitive.attributes["TEXCOORD_0"] = addUvs(buffer, surface);
    primitive.indices = addIndices(buffer, surface);

    tinygltf::Mesh mesh;
    mesh.name = "droplet";
    mesh.primitives.push_back(std::move(primitive));
    model.meshes.push_back(std::move(mesh));
    tinygltf::Node node;
    node.name = "droplet";
    node.mesh = 0;
    model.nodes.push_back(std::move(node));
    tinygltf::Scene scene;
    scene.nodes.push_back(0);
    model.scenes.push_back(std::move(scene));
    model.defaultScene = 0;
    return model;
}

}  // namespace

Material materialNamed(std::string_view name)
{
    std::string known;
    for (const Look& look : kLooks) {
        if (name == look.name) {
            return look.material;
        }
        known += std::string(" ") + look.name;
    }
    throw Error(ErrorCode::InvalidArgument, "material \"" + std::string(name) + "\" is unknown; known are" + known);
}

void writeGltf(const Surface& surface, std::ostream& out, const GltfOptions& options)
{
    checkFileSize(surface, options.binary);
    surface.validate();
    const tinygltf::Model model = makeModel(surface, options);
    constexpr bool kPretty = true;
    tinygltf::TinyGLTF().WriteGltfSceneToStream(&model, out, kPretty, options.binary);
    out.flush();  // its result is always true; only the stream knows, and only once its buffer is gone
}

}  // namespace droplet
