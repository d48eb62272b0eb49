// SPDX-License-Identifier: GPL-3.0-or-later
// Khronos Group, "glTF 2.0 Specification" (2021), section 3.6, and "EXT_meshopt_compression".
#include "scene/gltf_buffer.h"

#include <meshoptimizer.h>

#include <cstring>
#include <sstream>
#include <utility>

namespace droplet {
namespace {

constexpr const char* kMeshopt = "EXT_meshopt_compression";

// Index 65535 restarts primitives; with fewer vertices it does not occur.
constexpr std::size_t kVerticesBeyond16Bit = 65535;

constexpr std::size_t aligned(std::size_t bytes)
{
    return (bytes + 3) / 4 * 4;
}

std::string bytesOf(const std::vector<GltfArray>& arrays)
{
    std::ostringstream text;
    ByteStream bytes(text);
    for (const GltfArray& array : arrays) {
        array.write(bytes);
    }
    bytes.finish();
    return std::move(text).str();
}

/// Encodes bytes by the codec of their kind.
std::string encoded(const std::string& bytes, std::size_t stride, bool are_indices)
{
    // The extension needs the second version of the indices' codec; the library would take the first.
    [[maybe_unused]] static const bool is_set = [] {
        meshopt_encodeIndexVersion(1);
        return true;
    }();
    const std::size_t count = bytes.size() / stride;
    std::string code;
    const auto at = [&] { return reinterpret_cast<unsigned char*>(code.data()); };
    if (are_indices) {
        std::vector<unsigned> indices(count);
        for (std::size_t i = 0; i < count; ++i) {
            std::memcpy(&indices[i], bytes.data() + i * stride, stride);  // little-endian, as the file
        }
        code.resize(meshopt_encodeIndexBufferBound(count, count));
        code.resize(meshopt_encodeIndexBuffer(at(), code.size(), indices.data(), count));
    } else {
        code.resize(meshopt_encodeVertexBufferBound(count, stride));
        code.resize(meshopt_encodeVertexBuffer(at(), code.size(), bytes.data(), count, stride));
    }
    return code;
}

std::size_t elementBytes(const GltfArray& array)
{
    const int components = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(array.type));
    const int bytes = tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(array.component_type));
    return static_cast<std::size_t>(components) * static_cast<std::size_t>(bytes);
}

}  // namespace

GltfArray arrayOf(const std::vector<float>& numbers, std::size_t components)
{
    return {.type = gltfType(components),
            .count = numbers.size() / components,
            .stride = components * sizeof(float),
            .write = [&numbers](ByteStream& bytes) {
                for (const float number : numbers) {
                    bytes.f32(number);
                }
            }};
}

GltfArray arrayOf(const std::vector<Triangle>& triangles, std::size_t vertices)
{
    const bool is_wide = vertices >= kVerticesBeyond16Bit;
    return {.component_type = is_wide ? TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT : TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT,
            .count = 3 * triangles.size(),
            .stride = is_wide ? 4U : 2U,
            .write = [&triangles, is_wide](ByteStream& bytes) {
                for (const auto& [a, b, c] : triangles) {
                    if (is_wide) {
                        bytes.u32(a, b, c);
                    } else {
                        bytes.u16(a, b, c);
                    }
                }
            }};
}

int GltfBuffer::add(const GltfArray& array, GltfContent content)
{
    return add(std::vector{array}, content);
}

int GltfBuffer::add(const std::vector<GltfArray>& arrays, GltfContent content)
{
    tinygltf::BufferView view;
    view.buffer = 0;
    view.target = content == GltfContent::Indices ? TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER
                  : content == GltfContent::Other ? 0
                                                  : TINYGLTF_TARGET_ARRAY_BUFFER;
    if (arrays.front().stride != elementBytes(arrays.front())) {
        view.byteStride = arrays.front().stride;
    }
    const auto first = static_cast<int>(model_.accessors.size());
    for (const GltfArray& array : arrays) {
        tinygltf::Accessor accessor;
        accessor.bufferView = static_cast<int>(model_.bufferViews.size());
        accessor.byteOffset = view.byteLength;
        accessor.componentType = array.component_type;
        accessor.type = array.type;
        accessor.normalized = array.normalised;
        accessor.count = array.count;
        accessor.minValues = array.low;
        accessor.maxValues = array.high;
        model_.accessors.push_back(std::move(accessor));
        view.byteLength += array.bytes();
    }
    if (is_encoded_) {
        encode(arrays, content, view);
    } else {
        append(view.byteLength, [arrays](ByteStream& bytes) {
            for (const GltfArray& array : arrays) {
                array.write(bytes);
            }
        });
        view.byteOffset = pieces_.back().begin;
    }
    model_.bufferViews.push_back(std::move(view));
    return first;
}

int GltfBuffer::addPicture(const std::string& bytes)
{
    append(bytes.size(), [&bytes](ByteStream& stream) { stream.text(bytes); });
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = pieces_.back().begin;
    view.byteLength = bytes.size();
    model_.bufferViews.push_back(std::move(view));
    return static_cast<int>(model_.bufferViews.size()) - 1;
}

void GltfBuffer::append(std::size_t bytes, std::function<void(ByteStream&)> write)
{
    pieces_.push_back({aligned(end_), bytes, std::move(write), {}});
    end_ = pieces_.back().begin + bytes;
}

void GltfBuffer::encode(const std::vector<GltfArray>& arrays, GltfContent content, tinygltf::BufferView& view)
{
    const bool are_indices = content == GltfContent::Indices;
    const std::size_t stride = arrays.front().stride;
    std::string code = encoded(bytesOf(arrays), stride, are_indices);
    const std::size_t bytes = code.size();
    append(bytes, [own = std::move(code)](ByteStream& stream) { stream.text(own); });
    view.buffer = 1;
    view.byteOffset = aligned(decoded_end_);
    decoded_end_ = view.byteOffset + view.byteLength;
    nlohmann::json& codec = pieces_.back().codec;
    codec = {{"buffer", 0},
             {"byteOffset", pieces_.back().begin},
             {"byteLength", bytes},
             {"byteStride", stride},
             {"count", view.byteLength / stride},
             {"mode", are_indices ? "TRIANGLES" : "ATTRIBUTES"}};
    if (content == GltfContent::OctahedralNormals) {
        codec["filter"] = "OCTAHEDRAL";
    }
}

void GltfBuffer::write(ByteStream& bytes) const
{
    std::size_t at = 0;
    for (const Piece& piece : pieces_) {
        for (; at < piece.begin; ++at) {
            bytes.u8(0);
        }
        piece.write(bytes);
        at += piece.bytes;
    }
}

// tinygltf (2.7) writes the length of a buffer that it holds, which would be in memory three times, and leaves out the
// extensions of views. Both are added to what it prints.
nlohmann::json GltfBuffer::json() const
{
    constexpr bool kPretty = false;
    constexpr bool kBinary = false;
    std::stringstream text;
    tinygltf::TinyGLTF().WriteGltfSceneToStream(&model_, text, kPretty, kBinary);
    nlohmann::json json = nlohmann::json::parse(text);
    if (end_ > 0) {
        json["buffers"] = {{{"byteLength", end_}}};
    }
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
        if (!pieces_[i].codec.is_null()) {
            json["bufferViews"][i]["extensions"][kMeshopt] = pieces_[i].codec;
        }
    }
    if (decoded_end_ > 0) {
        json["buffers"].push_back({{"byteLength", decoded_end_}, {"extensions", {{kMeshopt, {{"fallback", true}}}}}});
    }
    return json;
}

}  // namespace droplet
