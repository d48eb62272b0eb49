// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/io/read_surface.h"

#include <algorithm>
#include <utility>

#include "io/file_mesh.h"

namespace droplet {

ReadSurface readSurface(const std::filesystem::path& path)
{
    FileMesh mesh = readFileMesh(path);
    ReadSurface result;
    if (mesh.ignores_animation || mesh.deforms) {
        result.warnings.push_back(
            path.string() + " has animations, skins or morph targets; they are ignored, and the rest pose is read");
    }
    Surface& surface = result.surface;
    surface.positions = std::move(mesh.positions);
    surface.triangles = std::move(mesh.triangles);
    surface.normals = std::move(mesh.normals);
    surface.weld = std::move(mesh.weld);
    surface.uvs = std::move(mesh.uvs);
    surface.uvs.resize(surface.positions.size());
    if (std::any_of(mesh.contact_angles.begin(), mesh.contact_angles.end(), [](float a) { return a != 0.0F; })) {
        surface.contact_angle = std::move(mesh.contact_angles);
    }
    return result;
}

}  // namespace droplet
