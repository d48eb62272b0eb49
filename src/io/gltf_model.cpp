// SPDX-License-Identifier: GPL-3.0-or-later
// Khronos Group, "glTF 2.0 Specification" (2021), and its extensions KHR_materials_transmission, KHR_materials_ior and
// KHR_materials_volume.
#include "io/gltf_model.h"

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <utility>

#include "droplet/surface/material.h"
#include "droplet/version.h"
#include "io/axes.h"

namespace droplet {
namespace {

tinygltf::Value::Array colourValue(Vec3 colour)
{
    return {tinygltf::Value(colour.x), tinygltf::Value(colour.y), tinygltf::Value(colour.z)};
}

constexpr std::size_t padding(std::size_t bytes)
{
    return (4 - bytes % 4) % 4;
}

}  // namespace

tinygltf::Material makeMaterial(const Look& look, double thickness, bool closed)
{
    tinygltf::Material material;
    material.name = look.name;
    material.pbrMetallicRoughness.metallicFactor = look.metallic;
    material.pbrMetallicRoughness.roughnessFactor = look.roughness;
    // A thickness of 0 means thin-walled; attenuationDistance must be positive.
    const bool has_volume = look.transmission > 0.0 && closed && thickness > 0.0;
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
        tinygltf::Value::Object volume{{"thicknessFactor", tinygltf::Value(thickness)}};
        if (look.tinted) {
            const Attenuation attenuation = attenuationOf(look, thickness);
            volume["attenuationColor"] = tinygltf::Value(colourValue(attenuation.colour));
            volume["attenuationDistance"] = tinygltf::Value(attenuation.distance);
        }
        material.extensions["KHR_materials_volume"] = tinygltf::Value(std::move(volume));
    }
    return material;
}

int addMaterial(tinygltf::Model& model, const Look& look, double thickness, bool closed)
{
    model.materials.push_back(makeMaterial(look, thickness, closed));
    for (const auto& [extension, value] : model.materials.back().extensions) {
        std::vector<std::string>& used = model.extensionsUsed;
        if (std::find(used.begin(), used.end(), extension) == used.end()) {
            used.push_back(extension);
        }
    }
    return static_cast<int>(model.materials.size()) - 1;
}

tinygltf::Model makeEmptyModel()
{
    tinygltf::Model model;
    model.asset.version = "2.0";
    model.asset.generator = std::string("droplet-shape ") + kVersion;
    return model;
}

tinygltf::Model makeBareModel(Material material, double thickness, bool closed)
{
    tinygltf::Model model = makeEmptyModel();
    addMaterial(model, lookOf(material), thickness, closed);
    return model;
}

std::size_t bufferBytes(const tinygltf::Model& model)
{
    return model.bufferViews.empty() ? 0 : model.bufferViews.back().byteOffset + model.bufferViews.back().byteLength;
}

int addArray(tinygltf::Model& model, int target, int component_type, int type, std::size_t count)
{
    const int element_bytes = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(type)) *
                              tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(component_type));
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = bufferBytes(model) + padding(bufferBytes(model));
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

int addTexture(tinygltf::Model& model, const char* name, std::size_t bytes, const TextureFilters& filters)
{
    addArray(model, 0, TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE, TINYGLTF_TYPE_SCALAR, bytes);
    model.accessors.pop_back();  // pictures have a view, but no accessor
    tinygltf::Image image;
    image.name = name;
    image.mimeType = "image/png";
    image.bufferView = static_cast<int>(model.bufferViews.size()) - 1;
    tinygltf::Sampler sampler;
    sampler.minFilter = filters.min;
    sampler.magFilter = filters.mag;
    sampler.wrapS = TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
    sampler.wrapT = TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
    tinygltf::Texture texture;
    texture.sampler = static_cast<int>(model.samplers.size());
    texture.source = static_cast<int>(model.images.size());
    model.images.push_back(std::move(image));
    model.samplers.push_back(std::move(sampler));
    model.textures.push_back(std::move(texture));
    return static_cast<int>(model.textures.size()) - 1;
}

int addVertexArray(tinygltf::Model& model, int type, std::size_t count)
{
    return addArray(model, TINYGLTF_TARGET_ARRAY_BUFFER, TINYGLTF_COMPONENT_TYPE_FLOAT, type, count);
}

// These are exact bounds of the floats, since rounding keeps the order of numbers.
void addBounds(tinygltf::Accessor& accessor, const std::vector<Vec3>& vectors)
{
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    Vec3 low{kInfinity, kInfinity, kInfinity};
    Vec3 high{-kInfinity, -kInfinity, -kInfinity};
    for (const Vec3& vector : vectors) {
        const Vec3 up = yUp(vector);
        low = {std::min(low.x, up.x), std::min(low.y, up.y), std::min(low.z, up.z)};
        high = {std::max(high.x, up.x), std::max(high.y, up.y), std::max(high.z, up.z)};
    }
    accessor.minValues = {toFloat(low.x), toFloat(low.y), toFloat(low.z)};
    accessor.maxValues = {toFloat(high.x), toFloat(high.y), toFloat(high.z)};
}

int addIndices(tinygltf::Model& model, std::size_t triangles, std::size_t vertices)
{
    const bool wide = vertices >= kVerticesBeyond16Bit;
    return addArray(model, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER,
                    wide ? TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT : TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT,
                    TINYGLTF_TYPE_SCALAR, 3 * triangles);
}

// tinygltf writes the JSON of a model without a buffer; with one it would hold the bytes three times in memory. The
// buffer's length, and its place in the text, are added here.
nlohmann::json jsonOf(const tinygltf::Model& model)
{
    constexpr bool kPretty = false;
    constexpr bool kBinary = false;
    std::stringstream text;
    tinygltf::TinyGLTF().WriteGltfSceneToStream(&model, text, kPretty, kBinary);
    nlohmann::json json = nlohmann::json::parse(text);
    if (bufferBytes(model) > 0) {
        json["buffers"] = {{{"byteLength", bufferBytes(model)}}};
    }
    return json;
}

void writeVectors(const std::vector<Vec3>& vectors, ByteStream& bytes)
{
    for (const Vec3& vector : vectors) {
        const Vec3 up = yUp(vector);
        bytes.f32(up.x, up.y, up.z);
    }
}

void writeIndices(const std::vector<Triangle>& triangles, std::size_t vertices, ByteStream& bytes)
{
    const bool wide = vertices >= kVerticesBeyond16Bit;
    for (const auto& [a, b, c] : triangles) {
        if (wide) {
            bytes.u32(a, b, c);
        } else {
            bytes.u16(a, b, c);
        }
    }
}

// GLB file format: a header of three words, then chunks padded to whole words, JSON with spaces, the buffer with 0.
std::uint64_t writeBinary(std::ostream& out, const nlohmann::json& content, std::size_t length,
                          const std::function<void(ByteStream&)>& write_buffer)
{
    std::string json = content.dump();
    json.append(padding(json.size()), ' ');
    const std::string zeros(padding(length), '\0');
    const std::size_t buffer_bytes = length + zeros.size();
    const std::size_t headers = buffer_bytes > 0 ? 12 + 8 + 8 : 12 + 8;  // an empty buffer has no chunk
    ByteStream bytes(out);
    bytes.text("glTF");
    bytes.u32(2, headers + json.size() + buffer_bytes, json.size());
    bytes.text("JSON");
    bytes.text(json);
    if (buffer_bytes > 0) {
        bytes.u32(buffer_bytes);
        bytes.text("BIN");
        bytes.u8(0);
        write_buffer(bytes);
        bytes.text(zeros);
    }
    return bytes.finish();
}

std::uint64_t writeBinary(std::ostream& out, const tinygltf::Model& model,
                          const std::function<void(ByteStream&)>& write_buffer)
{
    return writeBinary(out, jsonOf(model), bufferBytes(model), write_buffer);
}

}  // namespace droplet
