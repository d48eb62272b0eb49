// SPDX-License-Identifier: GPL-3.0-or-later
// Khronos Group, "EXT_meshopt_compression".
#include "io/meshopt_views.h"

#include <meshoptimizer.h>

#include <cmath>
#include <span>
#include <string>
#include <utility>

#include "file_bytes.h"

namespace droplet {
namespace {

using Json = nlohmann::json;

constexpr const char* kExtension = "EXT_meshopt_compression";

/// Extension of an entry in a list; null if there is none.
const Json& extensionOf(const Json& root, const char* list, std::size_t index)
{
    static const Json none;
    const Json* at = &root;
    for (const char* const key : {list, "extensions", kExtension}) {
        const auto found = at->find(key);
        if (found == at->end()) {
            return none;
        }
        at = &*found;
        if (key == list) {
            if (!at->is_array() || index >= at->size() || !(*at)[index].is_object()) {
                return none;
            }
            at = &(*at)[index];
        }
        if (!at->is_object()) {
            return none;
        }
    }
    return *at;
}

[[noreturn]] void damaged(const MeshoptView& view, const std::string& what)
{
    throw Damage("bufferViews[" + std::to_string(view.view) + "]: its compressed data are damaged: " + what);
}

std::size_t numberOf(const MeshoptView& view, const char* key, bool needed = true)
{
    const auto found = view.content.find(key);
    if (found == view.content.end() && !needed) {
        return 0;
    }
    constexpr double kExact = 9007199254740992.0;  // 2⁵³: integers up to it are exact doubles
    const double number = found != view.content.end() && found->is_number() ? found->get<double>() : -1.0;
    if (!(number >= 0.0 && number <= kExact && std::floor(number) == number)) {
        damaged(view, std::string("\"") + key + "\" is not a valid index or count");
    }
    return static_cast<std::size_t>(number);
}

std::string textOf(const MeshoptView& view, const char* key, const char* otherwise)
{
    const auto found = view.content.find(key);
    return found != view.content.end() && found->is_string() ? found->get<std::string>() : otherwise;
}

void filter(const MeshoptView& view, std::span<unsigned char> data, std::size_t count, std::size_t stride)
{
    const std::string name = textOf(view, "filter", "NONE");
    if (name == "OCTAHEDRAL" && (stride == 4 || stride == 8)) {
        meshopt_decodeFilterOct(data.data(), count, stride);
    } else if (name == "QUATERNION" && stride == 8) {
        meshopt_decodeFilterQuat(data.data(), count, stride);
    } else if (name == "EXPONENTIAL" && stride % 4 == 0) {
        meshopt_decodeFilterExp(data.data(), count, stride);
    } else if (name != "NONE") {
        damaged(view, "filter " + name.substr(0, 40) + " with a stride of " + std::to_string(stride));
    }
}

std::vector<unsigned char> decoded(const MeshoptView& view, std::span<const unsigned char> code)
{
    // The codecs shrink data to no less than a 64th; more would be a small file that takes all memory.
    constexpr std::size_t kMaxRatio = 128;
    const std::size_t count = numberOf(view, "count");
    const std::size_t stride = numberOf(view, "byteStride");
    const std::string mode = textOf(view, "mode", "");
    const bool is_vertices = mode == "ATTRIBUTES" && stride > 0 && stride <= 256 && stride % 4 == 0;
    const bool is_triangles = mode == "TRIANGLES" && (stride == 2 || stride == 4) && count % 3 == 0;
    const bool is_indices = mode == "INDICES" && (stride == 2 || stride == 4);
    if (!is_vertices && !is_triangles && !is_indices) {
        damaged(view, "mode \"" + mode.substr(0, 40) + "\" with " + std::to_string(count) + " numbers of " +
                          std::to_string(stride) + " bytes");
    }
    if (count / kMaxRatio > code.size() / stride + 1) {
        damaged(view, "they are too short");
    }
    std::vector<unsigned char> data(count * stride);
    const int error = is_vertices ? meshopt_decodeVertexBuffer(data.data(), count, stride, code.data(), code.size())
                      : is_triangles
                          ? meshopt_decodeIndexBuffer(data.data(), count, stride, code.data(), code.size())
                          : meshopt_decodeIndexSequence(data.data(), count, stride, code.data(), code.size());
    if (error != 0) {
        damaged(view, "the decoder refuses them");
    }
    if (is_vertices) {
        filter(view, data, count, stride);
    }
    return data;
}

}  // namespace

std::vector<MeshoptView> findMeshoptViews(Json& root, const Json& with_extensions)
{
    std::vector<MeshoptView> views;
    for (std::size_t i = 0; root.contains("bufferViews") && i < root["bufferViews"].size(); ++i) {
        if (const Json& extension = extensionOf(with_extensions, "bufferViews", i); !extension.is_null()) {
            MeshoptView view{i, extension};
            Json& plain = root["bufferViews"][i];
            plain["buffer"] = numberOf(view, "buffer");
            plain["byteOffset"] = numberOf(view, "byteOffset", false);
            plain["byteLength"] = numberOf(view, "byteLength");
            views.push_back(std::move(view));
        }
    }
    for (std::size_t i = 0; !views.empty() && root.contains("buffers") && i < root["buffers"].size(); ++i) {
        if (const Json& extension = extensionOf(with_extensions, "buffers", i);
            !extension.is_null() && !root["buffers"][i].contains("uri")) {
            root["buffers"][i] = {{"uri", "data:application/octet-stream;base64,AAAA"}, {"byteLength", 3}};
        }
    }
    return views;
}

void decodeMeshoptViews(tinygltf::Model& model, const std::vector<MeshoptView>& views)
{
    for (const MeshoptView& view : views) {
        tinygltf::BufferView& plain = model.bufferViews.at(view.view);
        if (plain.buffer < 0 || static_cast<std::size_t>(plain.buffer) >= model.buffers.size()) {
            damaged(view, "buffers[" + std::to_string(plain.buffer) + "] does not exist");
        }
        const std::span<const unsigned char> buffer = model.buffers[static_cast<std::size_t>(plain.buffer)].data;
        if (plain.byteOffset > buffer.size() || plain.byteLength > buffer.size() - plain.byteOffset) {
            damaged(view, "they reach beyond their buffer");
        }
        tinygltf::Buffer own;
        own.data = decoded(view, buffer.subspan(plain.byteOffset, plain.byteLength));
        plain.buffer = static_cast<int>(model.buffers.size());
        plain.byteOffset = 0;
        plain.byteLength = own.data.size();
        model.buffers.push_back(std::move(own));
    }
}

}  // namespace droplet
