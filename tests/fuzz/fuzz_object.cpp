// SPDX-License-Identifier: GPL-3.0-or-later
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>

#include "droplet/error.h"
#include "droplet/flow/flow_surface.h"
#include "droplet/flow_io/flow_object.h"
#include "fuzz/targets.h"

namespace droplet {
namespace {

/// Extension of the format that the bytes look like; STL may begin with anything.
const char* extensionOf(std::string_view text)
{
    return text.starts_with("glTF")                          ? ".glb"
           : text.starts_with('{')                           ? ".gltf"
           : text.starts_with("ply")                         ? ".ply"
           : text.starts_with("v ") || text.starts_with('#') ? ".obj"
                                                             : ".stl";
}

}  // namespace

void fuzzObject(std::span<const std::byte> bytes)
{
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const std::string name = "fuzz_object_" + std::to_string(getpid()) + extensionOf(text);
    const std::filesystem::path path = std::filesystem::temp_directory_path() / name;
    std::ofstream(path, std::ios::binary).write(text.data(), static_cast<std::streamsize>(text.size()));
    try {
        const FlowObject object = readFlowObject(path);
        const FlowSurface surface = flowSurface(object.vertices, object.triangles);
        for (const FlowSurface::Face& face : surface.faces) {
            if (!(std::abs(length(face.normal) - 1.0) < 1e-9)) {
                throw std::logic_error("a face has no normal");
            }
        }
    } catch (const Error& error) {
        const std::string said = error.what();
        if (error.code() != ErrorCode::InvalidInput || said.empty() || said.find('\n') != std::string::npos) {
            throw std::logic_error("refused as \"" + said + '"');
        }
    }
    std::filesystem::remove(path);
}

}  // namespace droplet
