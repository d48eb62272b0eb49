// SPDX-License-Identifier: GPL-3.0-or-later
// Khronos Group, "KHR_mesh_quantization" and "EXT_meshopt_compression", both with "glTF 2.0 Specification" (2021).
#include "io/compressed_gltf.h"

#include <meshoptimizer.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <map>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "io/gltf_model.h"
#include "io/quantized.h"

namespace droplet {
namespace {

using Json = nlohmann::json;

constexpr const char* kMeshopt = "EXT_meshopt_compression";

template <typename Number>
std::string bytesOf(const std::vector<Number>& numbers)
{
    return {reinterpret_cast<const char*>(numbers.data()), sizeof(Number) * numbers.size()};
}

std::vector<Vec3> vectorsOf(const std::vector<float>& numbers)
{
    std::vector<Vec3> vectors;
    for (std::size_t i = 0; i + 2 < numbers.size(); i += 3) {
        vectors.push_back({static_cast<double>(numbers[i]), static_cast<double>(numbers[i + 1]),
                           static_cast<double>(numbers[i + 2])});
    }
    return vectors;
}

/// Array with a view of its own.
struct Column {
    std::string bytes;
    std::size_t stride = 0;
    std::size_t count = 0;
    bool indices = false;
    bool octahedral = false;  ///< with Meshopt
};

/// Encodes an array by the codec of its kind.
std::string encoded(const Column& column)
{
    // The extension needs the second version of the indices' codec; the library would take the first.
    [[maybe_unused]] static const bool is_set = (meshopt_encodeIndexVersion(1), true);
    std::string bytes;
    const auto at = [&] { return reinterpret_cast<unsigned char*>(bytes.data()); };
    if (column.indices) {
        std::vector<unsigned> indices(column.count);
        for (std::size_t i = 0; i < column.count; ++i) {
            std::memcpy(&indices[i], column.bytes.data() + i * column.stride, column.stride);
        }
        bytes.resize(meshopt_encodeIndexBufferBound(column.count, column.count));
        bytes.resize(meshopt_encodeIndexBuffer(at(), bytes.size(), indices.data(), column.count));
    } else {
        bytes.resize(meshopt_encodeVertexBufferBound(column.count, column.stride));
        bytes.resize(meshopt_encodeVertexBuffer(at(), bytes.size(), column.bytes.data(), column.count, column.stride));
    }
    return bytes;
}

class Compressor {
public:
    Compressor(Json json, std::string_view buffer, Compression compression)
        : json_(std::move(json)), buffer_(buffer), meshopt_(compression == Compression::Meshopt)
    {
        accessors_ = std::exchange(json_["accessors"], Json::array());
        views_ = std::exchange(json_["bufferViews"], Json::array());
    }

    void compress()
    {
        std::map<std::size_t, std::vector<Json*>> groups;  // primitives with the same positions share all attributes
        std::vector<Vec3> positions;
        for (Json& mesh : json_["meshes"]) {
            for (Json& primitive : mesh["primitives"]) {
                std::vector<Json*>& group = groups[primitive["attributes"]["POSITION"]];
                group.push_back(&primitive);
                if (group.size() == 1) {
                    const std::vector<Vec3> own = vectorsOf(numbersOf(primitive["attributes"]["POSITION"]));
                    positions.insert(positions.end(), own.begin(), own.end());
                }
            }
        }
        cube_ = cubeAround(positions);
        for (const auto& [position, primitives] : groups) {
            compressGroup(primitives);
        }
        scaleNodes();
        copyPictures();
        addExtension("KHR_mesh_quantization");
        json_["buffers"] = {{{"byteLength", out_.size()}}};
        if (meshopt_) {
            addExtension(kMeshopt);
            json_["buffers"].push_back(
                {{"byteLength", decoded_bytes_}, {"extensions", {{kMeshopt, {{"fallback", true}}}}}});
        }
    }

    [[nodiscard]] const Json& json() const { return json_; }
    [[nodiscard]] const std::string& bytes() const { return out_; }

private:
    void addExtension(const char* extension)
    {
        json_["extensionsUsed"].push_back(extension);
        json_["extensionsRequired"].push_back(extension);
    }

    [[nodiscard]] const char* dataOf(const Json& accessor) const
    {
        return buffer_.data() + views_[accessor["bufferView"].get<std::size_t>()].value("byteOffset", std::size_t{0});
    }

    [[nodiscard]] std::vector<float> numbersOf(std::size_t index) const
    {
        const Json& accessor = accessors_[index];
        const std::string type = accessor["type"];
        const std::size_t components = type == "SCALAR" ? 1 : type == "VEC2" ? 2 : 3;
        std::vector<float> numbers(components * accessor["count"].get<std::size_t>());
        std::memcpy(numbers.data(), dataOf(accessor), sizeof(float) * numbers.size());
        return numbers;
    }

    [[nodiscard]] std::vector<unsigned> indicesOf(std::size_t index) const
    {
        const Json& accessor = accessors_[index];
        const std::size_t size = accessor["componentType"] == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ? 2 : 4;
        std::vector<unsigned> indices(accessor["count"].get<std::size_t>());
        for (std::size_t i = 0; i < indices.size(); ++i) {
            std::memcpy(&indices[i], dataOf(accessor) + i * size, size);  // little-endian, as the file
        }
        return indices;
    }

    void compressGroup(const std::vector<Json*>& primitives)
    {
        const std::size_t vertices = accessors_[(*primitives[0])["attributes"]["POSITION"].get<std::size_t>()]["count"];
        std::vector<std::vector<unsigned>> lists(primitives.size());
        std::transform(primitives.begin(), primitives.end(), lists.begin(),
                       [this](const Json* primitive) { return indicesOf((*primitive)["indices"]); });
        const std::vector<unsigned> order = meshopt_ ? optimize(lists, vertices) : std::vector<unsigned>();
        Json attributes = Json::object();
        for (const auto& [name, index] : (*primitives[0])["attributes"].items()) {
            attributes[name] = addAttribute(name, index, order);
        }
        for (std::size_t i = 0; i < primitives.size(); ++i) {
            (*primitives[i])["attributes"] = attributes;
            (*primitives[i])["indices"] = addIndices(lists[i], vertices);
        }
    }

    /// Orders triangles and vertices as the codecs need them.
    /// @return  new number of every vertex
    static std::vector<unsigned> optimize(std::vector<std::vector<unsigned>>& lists, std::size_t vertices)
    {
        std::vector<unsigned> all;
        for (std::vector<unsigned>& list : lists) {
            meshopt_optimizeVertexCache(list.data(), list.data(), list.size(), vertices);
            all.insert(all.end(), list.begin(), list.end());
        }
        std::vector<unsigned> order(vertices);
        std::size_t used = meshopt_optimizeVertexFetchRemap(order.data(), all.data(), all.size(), vertices);
        for (unsigned& number : order) {
            number = number == ~0U ? static_cast<unsigned>(used++) : number;  // a vertex without a triangle
        }
        for (std::vector<unsigned>& list : lists) {
            meshopt_remapIndexBuffer(list.data(), list.data(), list.size(), order.data());
        }
        return order;
    }

    std::size_t addAttribute(const std::string& name, std::size_t index, const std::vector<unsigned>& order)
    {
        const std::vector<float> numbers = numbersOf(index);
        const std::size_t count = accessors_[index]["count"];
        Json accessor = {{"count", count}, {"type", accessors_[index]["type"]}};
        Column column;
        column.count = count;
        const auto normalised = [&](int component_type) {
            accessor["componentType"] = component_type;
            accessor["normalized"] = true;
        };
        const bool is_texture =
            name.starts_with("TEXCOORD_") &&
            std::all_of(numbers.begin(), numbers.end(), [](float n) { return n >= 0.0F && n <= 1.0F; });
        if (name == "POSITION") {
            normalised(TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT);
            column.bytes = quantizedPositions(numbers, accessor);
        } else if (name == "NORMAL") {
            normalised(TINYGLTF_COMPONENT_TYPE_SHORT);
            column.bytes = bytesOf(
                quantizeNormals(vectorsOf(numbers), meshopt_ ? Compression::Meshopt : Compression::Quantize).stored);
            column.octahedral = meshopt_;
        } else if (is_texture) {
            normalised(TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT);
            std::vector<std::uint16_t> quantized(numbers.size());
            std::transform(numbers.begin(), numbers.end(), quantized.begin(),
                           [](float n) { return static_cast<std::uint16_t>(std::lround(n * 65535.0F)); });
            column.bytes = bytesOf(quantized);
        } else {
            accessor["componentType"] = TINYGLTF_COMPONENT_TYPE_FLOAT;
            column.bytes = bytesOf(numbers);
        }
        column.stride = count > 0 ? column.bytes.size() / count : 0;
        if (!order.empty()) {
            std::string ordered(column.bytes.size(), '\0');
            meshopt_remapVertexBuffer(ordered.data(), column.bytes.data(), count, column.stride, order.data());
            column.bytes = std::move(ordered);
        }
        return addAccessor(std::move(accessor), column);
    }

    [[nodiscard]] std::string quantizedPositions(const std::vector<float>& numbers, Json& accessor) const
    {
        std::vector<std::uint16_t> quantized;
        std::array<std::uint16_t, 3> low{65535, 65535, 65535};
        std::array<std::uint16_t, 3> high{};
        for (const Vec3& position : vectorsOf(numbers)) {
            const auto lanes = cube_.quantized(position);
            quantized.insert(quantized.end(), lanes.begin(), lanes.end());
            for (std::size_t k = 0; k < low.size(); ++k) {
                low[k] = std::min(low[k], lanes[k]);
                high[k] = std::max(high[k], lanes[k]);
            }
        }
        accessor["min"] = low;
        accessor["max"] = high;
        return bytesOf(quantized);
    }

    std::size_t addIndices(const std::vector<unsigned>& indices, std::size_t vertices)
    {
        const bool wide = vertices >= kVerticesBeyond16Bit;
        Column column;
        column.indices = true;
        column.count = indices.size();
        column.stride = wide ? 4 : 2;
        column.bytes = wide ? bytesOf(indices) : bytesOf(std::vector<std::uint16_t>(indices.begin(), indices.end()));
        return addAccessor(
            {{"componentType", wide ? TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT : TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT},
             {"count", column.count},
             {"type", "SCALAR"}},
            column);
    }

    /// Adds an accessor with a view of its own.
    std::size_t addAccessor(Json accessor, const Column& column)
    {
        Json view = {{"buffer", 0},
                     {"byteLength", column.bytes.size()},
                     {"target", column.indices ? TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER : TINYGLTF_TARGET_ARRAY_BUFFER}};
        if (!column.indices) {
            view["byteStride"] = column.stride;
        }
        out_.resize(aligned(out_.size()));
        if (meshopt_) {
            const std::string code = encoded(column);
            view["buffer"] = 1;
            view["byteOffset"] = aligned(decoded_bytes_);
            decoded_bytes_ = aligned(decoded_bytes_) + column.bytes.size();
            Json& extension = view["extensions"][kMeshopt];
            extension = {{"buffer", 0},
                         {"byteOffset", out_.size()},
                         {"byteLength", code.size()},
                         {"byteStride", column.stride},
                         {"count", column.count},
                         {"mode", column.indices ? "TRIANGLES" : "ATTRIBUTES"}};
            if (column.octahedral) {
                extension["filter"] = "OCTAHEDRAL";
            }
            out_ += code;
        } else {
            view["byteOffset"] = out_.size();
            out_ += column.bytes;
        }
        accessor["bufferView"] = json_["bufferViews"].size();
        json_["bufferViews"].push_back(std::move(view));
        json_["accessors"].push_back(std::move(accessor));
        return json_["accessors"].size() - 1;
    }

    static std::size_t aligned(std::size_t bytes) { return (bytes + 3) / 4 * 4; }

    /// Places meshes where they were. The volume's thickness is in the mesh's unit; the distance of attenuation is not.
    void scaleNodes()
    {
        for (Json& node : json_["nodes"]) {
            if (node.contains("mesh")) {
                const auto old = node.value("translation", std::array{0.0, 0.0, 0.0});
                node["translation"] = {old[0] + cube_.low.x, old[1] + cube_.low.y, old[2] + cube_.low.z};
                node["scale"] = {cube_.side, cube_.side, cube_.side};
            }
        }
        for (Json& material : json_["materials"]) {
            if (const Json::json_pointer path("/extensions/KHR_materials_volume/thicknessFactor");
                material.contains(path)) {
                material[path] = material[path].get<double>() / cube_.side;
            }
        }
    }

    void copyPictures()
    {
        if (!json_.contains("images")) {
            return;
        }
        for (Json& image : json_["images"]) {
            Json view = views_[image["bufferView"].get<std::size_t>()];
            out_.resize(aligned(out_.size()));
            const std::size_t begin = std::exchange(view["byteOffset"], out_.size()).get<std::size_t>();
            out_ += buffer_.substr(begin, view["byteLength"]);
            image["bufferView"] = json_["bufferViews"].size();
            json_["bufferViews"].push_back(std::move(view));
        }
    }

    Json json_;
    std::string_view buffer_;
    bool meshopt_ = false;
    Json accessors_;  ///< before compression
    Json views_;      ///< before compression
    QuantizationCube cube_;
    std::string out_;
    std::size_t decoded_bytes_ = 0;
};

}  // namespace

std::uint64_t writeCompressed(std::ostream& out, Json json, std::string_view buffer, Compression compression)
{
    Compressor compressor(std::move(json), buffer, compression);
    compressor.compress();
    return writeBinary(out, compressor.json(), compressor.bytes().size(),
                       [&](ByteStream& bytes) { bytes.text(compressor.bytes()); });
}

}  // namespace droplet
