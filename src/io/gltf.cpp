// SPDX-License-Identifier: GPL-3.0-or-later
// Khronos Group, "glTF 2.0 Specification" (2021), and its extensions KHR_materials_transmission, KHR_materials_ior and
// KHR_materials_volume.
#include "droplet/io/gltf.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <ostream>
#include <sstream>
#include <streambuf>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "droplet/error.h"
#include "droplet/units.h"
#include "droplet/version.h"
#include "io/axes.h"
#include "io/byte_stream.h"

namespace droplet {
namespace {

// The writer keeps offsets in int; viewers' limits are of the same order.
constexpr std::uint64_t kFileLimit = std::uint64_t{1} << 31;

// Above the JSON's length beside an embedded buffer: fewer than 60 numbers and names, each shorter than 60 characters.
constexpr std::uint64_t kJsonBound = 4096;

// 65535 restarts primitives; with fewer vertices it can be no index.
constexpr std::size_t kVerticesBeyond16Bit = 65535;

// Position 3, normal 3, uv 2, contact angle 1, changes of position and normal 6.
std::uint64_t vertexBytes(const Surface& surface)
{
    return ((surface.contact_angle.empty() ? 8U : 9U) + (surface.refill ? 6U : 0U)) * sizeof(float);
}

bool wideIndices(const Surface& surface)
{
    return surface.positions.size() >= kVerticesBeyond16Bit;
}

void checkFileSize(const Surface& surface, bool binary)
{
    const std::uint64_t index_bytes = wideIndices(surface) ? 4 : 2;
    const std::uint64_t buffer =
        vertexBytes(surface) * surface.positions.size() + 3 * index_bytes * surface.triangles.size();
    const std::uint64_t file = kJsonBound + (binary ? buffer : (buffer + 2) / 3 * 4);
    if (file >= kFileLimit) {
        throw Error(ErrorCode::InvalidArgument, "surface with " + std::to_string(surface.triangles.size()) +
                                                    " triangles would make a glTF file of " + std::to_string(file) +
                                                    " bytes; it must stay below 2 GiB");
    }
}

// Before the first byte is written; of positions the bounds tell, and normals are unit.
void checkFloats(const Surface& surface)
{
    if (surface.refill) {
        for (const Vec3& normal : surface.refill->normals) {
            toFloat(normal.x);
            toFloat(normal.y);
            toFloat(normal.z);
        }
    }
    for (const Vec2& uv : surface.uvs) {
        toFloat(uv.x);
        toFloat(uv.y);
    }
}

tinygltf::Value::Array colourValue(Vec3 colour)
{
    return {tinygltf::Value(colour.x), tinygltf::Value(colour.y), tinygltf::Value(colour.z)};
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
        material.pbrMetallicRoughness.baseColorFactor = {look.colour.x, look.colour.y, look.colour.z, 1.0};
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

std::size_t bufferBytes(const tinygltf::Model& model)
{
    return model.bufferViews.empty() ? 0 : model.bufferViews.back().byteOffset + model.bufferViews.back().byteLength;
}

// Puts an array behind the last one in the buffer; returns the accessor on it.
int addArray(tinygltf::Model& model, int target, int component_type, int type, std::size_t count)
{
    const int element_bytes = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(type)) *
                              tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(component_type));
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = bufferBytes(model);
    view.byteLength = count * static_cast<std::size_t>(element_bytes);
    view.target = target;
    tinygltf::Accessor accessor;
    accessor.bufferView = static_cast<int>(model.bufferViews.size());
    accessor.componentType = component_type;
    accessor.type = type;
    accessor.count = count;
    model.bufferViews.push_back(std::move(view));
    model.accessors.push_back(std::move(accessor));
    return static_cast<int>(model.accessors.size()) - 1;
}

int addVertexArray(tinygltf::Model& model, int type, std::size_t count)
{
    return addArray(model, TINYGLTF_TARGET_ARRAY_BUFFER, TINYGLTF_COMPONENT_TYPE_FLOAT, type, count);
}

// Bounds of the floats, exactly: rounding keeps the order of numbers.
void addBounds(tinygltf::Accessor& accessor, const std::vector<Vec3>& positions)
{
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    Vec3 low{kInfinity, kInfinity, kInfinity};
    Vec3 high{-kInfinity, -kInfinity, -kInfinity};
    for (const Vec3& position : positions) {
        const Vec3 up = yUp(position);
        low = {std::min(low.x, up.x), std::min(low.y, up.y), std::min(low.z, up.z)};
        high = {std::max(high.x, up.x), std::max(high.y, up.y), std::max(high.z, up.z)};
    }
    accessor.minValues = {toFloat(low.x), toFloat(low.y), toFloat(low.z)};
    accessor.maxValues = {toFloat(high.x), toFloat(high.y), toFloat(high.z)};
}

// targetNames is a convention that viewers share (section 3.7.2.2, implementation note).
tinygltf::Value refillExtras(const Refill& refill)
{
    using tinygltf::Value;
    return Value(Value::Object{{"targetNames", Value(Value::Array{Value(std::string("volume"))})},
                               {"fill_range", Value(Value::Array{Value(refill.least), Value(refill.most)})}});
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

    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.material = 0;
    const std::size_t vertices = surface.positions.size();
    primitive.attributes["POSITION"] = addVertexArray(model, TINYGLTF_TYPE_VEC3, vertices);
    addBounds(model.accessors.back(), surface.positions);
    primitive.attributes["NORMAL"] = addVertexArray(model, TINYGLTF_TYPE_VEC3, vertices);
    primitive.attributes["TEXCOORD_0"] = addVertexArray(model, TINYGLTF_TYPE_VEC2, vertices);
    if (!surface.contact_angle.empty()) {
        primitive.attributes["_CONTACT_ANGLE"] = addVertexArray(model, TINYGLTF_TYPE_SCALAR, vertices);
    }
    if (surface.refill) {
        std::map<std::string, int>& target = primitive.targets.emplace_back();
        target["POSITION"] = addVertexArray(model, TINYGLTF_TYPE_VEC3, vertices);
        addBounds(model.accessors.back(), surface.refill->positions);
        target["NORMAL"] = addVertexArray(model, TINYGLTF_TYPE_VEC3, vertices);
    }
    primitive.indices =
        addArray(model, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER,
                 wideIndices(surface) ? TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT : TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT,
                 TINYGLTF_TYPE_SCALAR, 3 * surface.triangles.size());

    tinygltf::Mesh mesh;
    mesh.name = "droplet";
    mesh.primitives.push_back(std::move(primitive));
    if (surface.refill) {
        mesh.weights = {0.0};
        mesh.extras = refillExtras(*surface.refill);
    }
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

// tinygltf makes the JSON, but of a model without a buffer: it would hold the buffer's bytes three times before the
// first one is written. Only their number, and where the bytes themselves stand in text, is added.
nlohmann::json jsonOf(const tinygltf::Model& model)
{
    constexpr bool kPretty = false;
    constexpr bool kBinary = false;
    std::stringstream text;
    tinygltf::TinyGLTF().WriteGltfSceneToStream(&model, text, kPretty, kBinary);
    nlohmann::json json = nlohmann::json::parse(text);
    json["buffers"] = {{{"byteLength", bufferBytes(model)}}};
    return json;
}

void writeVectors(const std::vector<Vec3>& vectors, ByteStream& bytes)
{
    for (const Vec3& vector : vectors) {
        const Vec3 up = yUp(vector);
        bytes.f32(up.x, up.y, up.z);
    }
}

// Positions within half an ulp of float: of a 20 mm droplet 0.5 nm, a ten-thousandth of an edge of the finest mesh
// that fits a file. What little closer vertices would merge to stays closed, as faces go by index and welded copies
// round alike; normals are stored, so no flat triangle asks for one.
void writeBuffer(const Surface& surface, ByteStream& bytes)
{
    writeVectors(surface.positions, bytes);
    writeVectors(surface.normals, bytes);
    for (const Vec2& uv : surface.uvs) {  // glTF's texture origin is the upper left, as the mask's
        bytes.f32(uv.x, uv.y);
    }
    for (const float angle : surface.contact_angle) {
        bytes.f32(angle / kDegree);
    }
    if (surface.refill) {
        writeVectors(surface.refill->positions, bytes);
        writeVectors(surface.refill->normals, bytes);
    }
    for (const auto& [a, b, c] : surface.triangles) {
        if (wideIndices(surface)) {
            bytes.u32(a, b, c);
        } else {
            bytes.u16(a, b, c);
        }
    }
}

constexpr std::size_t padding(std::size_t bytes)
{
    return (4 - bytes % 4) % 4;
}

// GLB file format: a header of three words, then chunks of whole words, JSON filled up with spaces, the buffer with 0.
void writeBinary(const Surface& surface, const tinygltf::Model& model, ByteStream& bytes)
{
    std::string json = jsonOf(model).dump();
    json.append(padding(json.size()), ' ');
    const std::string zeros(padding(bufferBytes(model)), '\0');
    const std::size_t buffer_bytes = bufferBytes(model) + zeros.size();
    constexpr std::size_t kHeaders = 12 + 8 + 8;
    bytes.text("glTF");
    bytes.u32(2, kHeaders + json.size() + buffer_bytes, json.size());
    bytes.text("JSON");
    bytes.text(json);
    bytes.u32(buffer_bytes);
    bytes.text("BIN");
    bytes.u8(0);
    writeBuffer(surface, bytes);
    bytes.text(zeros);
}

// Encodes what it is given: S. Josefsson, RFC 4648 (2006), section 4.
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

void writeText(const Surface& surface, const tinygltf::Model& model, ByteStream& bytes)
{
    nlohmann::json json = jsonOf(model);
    const std::string uri = "data:application/octet-stream;base64,";
    json["buffers"][0]["uri"] = uri;
    const std::string text = json.dump(2);
    const std::size_t buffer_begin = text.find(uri) + uri.size();
    bytes.text(std::string_view(text).substr(0, buffer_begin));
    Base64Buffer base64(bytes);
    std::ostream encoded(&base64);
    ByteStream buffer(encoded);
    writeBuffer(surface, buffer);
    buffer.finish();
    base64.finish();
    bytes.text(std::string_view(text).substr(buffer_begin));
    bytes.text("\n");
}

}  // namespace

std::uint64_t writeGltf(const Surface& surface, std::ostream& out, const GltfOptions& options)
{
    checkFileSize(surface, options.binary);
    surface.validate();
    checkFloats(surface);
    const tinygltf::Model model = makeModel(surface, options);
    ByteStream bytes(out);
    if (options.binary) {
        writeBinary(surface, model, bytes);
    } else {
        writeText(surface, model, bytes);
    }
    return bytes.finish();
}

}  // namespace droplet
