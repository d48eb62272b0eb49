// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/io/object.h"

#include <cstdint>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <system_error>
#include <utility>

#include "io/object_mesh.h"

namespace droplet {

TexturedMesh readObject(const std::filesystem::path& path, const ObjectOptions& options)
{
    FileMesh mesh = readObjectMesh(path, options, {.uvs = true, .needs_uv = true}).mesh;
    return {std::move(mesh.vertices), std::move(mesh.normals), std::move(mesh.uvs), std::move(mesh.triangles)};
}

std::vector<std::filesystem::path> buffersBeside(const std::filesystem::path& path)
{
    using Json = nlohmann::json;
    // A longer text has its buffers in it.
    constexpr std::uintmax_t kMaxBytes = std::uintmax_t{1} << 24U;
    std::error_code ignored;
    if (path.extension() != ".gltf" || !std::filesystem::is_regular_file(path, ignored) ||
        std::filesystem::file_size(path, ignored) > kMaxBytes) {
        return {};
    }
    std::ifstream file(path);
    const Json root = Json::parse(file, nullptr, false);
    std::vector<std::filesystem::path> buffers;
    if (!root.is_object() || !root.contains("buffers") || !root["buffers"].is_array()) {
        return buffers;
    }
    for (const Json& buffer : root["buffers"]) {
        if (buffer.is_object() && buffer.contains("uri") && buffer["uri"].is_string()) {
            const auto uri = buffer["uri"].get<std::string>();
            if (!uri.starts_with("data:")) {
                buffers.push_back(path.parent_path() / uri);
            }
        }
    }
    return buffers;
}

}  // namespace droplet
