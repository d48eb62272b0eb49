// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/io/read_surface.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <string_view>
#include <system_error>
#include <utility>

#include "droplet/error.h"
#include "io/file_mesh.h"

namespace droplet {

namespace {

/// Whether a file begins as a .glb; a pipe, which nobody may write to, is not opened.
bool beginsAsGlb(const std::filesystem::path& path)
{
    std::error_code none;
    if (!std::filesystem::is_regular_file(path, none)) {
        return false;
    }
    constexpr std::string_view kMagic = "glTF";
    std::array<char, kMagic.size()> begin{};
    std::ifstream file(path, std::ios::binary);
    return file.read(begin.data(), begin.size()) && std::string_view(begin.data(), begin.size()) == kMagic;
}

}  // namespace

Format readableFormat(const std::filesystem::path& path)
{
    const Format format = [&] {
        try {
            return formatNamed(path.extension().string());
        } catch (const Error&) {
            if (beginsAsGlb(path)) {
                return Format::Glb;
            }
            throw;
        }
    }();
    if (format == Format::Usda || format == Format::Usdz || format == Format::ThreeMf) {
        throw Error(ErrorCode::InvalidArgument,
                    "USD and 3MF files are only written; glb, gltf, obj, ply and stl can be read");
    }
    return format;
}

ReadSurface readSurface(const std::filesystem::path& path)
{
    FileMesh mesh = readFileMesh(path);
    ReadSurface result;
    if (mesh.ignores_animation || mesh.deforms) {
        result.warnings.push_back(
            path.string() + " has animations, skins or morph targets; they are ignored, and the rest pose is read");
    }
    Surface& surface = result.surface;
    surface.vertices = std::move(mesh.vertices);
    surface.triangles = std::move(mesh.triangles);
    surface.normals = std::move(mesh.normals);
    surface.weld = std::move(mesh.weld);
    surface.uvs = std::move(mesh.uvs);
    surface.uvs.resize(surface.vertices.size());
    if (std::any_of(mesh.contact_angles.begin(), mesh.contact_angles.end(), [](float a) { return a != 0.0F; })) {
        surface.contact_angle = std::move(mesh.contact_angles);
    }
    return result;
}

}  // namespace droplet
