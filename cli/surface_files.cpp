// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface_files.h"

#include <fmt/core.h>

#include <filesystem>
#include <utility>

#include "droplet/printable.h"
#include "droplet/render/write_on_object.h"
#include "droplet/surface/simplify.h"
#include "droplet_report.h"
#include "option_values.h"

namespace cli {

std::optional<std::string> materialFile(const std::string& path, droplet::Format format)
{
    std::filesystem::path file(path);
    if (format != droplet::Format::Obj || (file.extension() != ".obj" && file.extension() != ".OBJ")) {
        return std::nullopt;
    }
    const std::string name = file.replace_extension(".mtl").filename().string();
    if (!droplet::isPrintable(name)) {
        refuse("'" + path + "' names '" + name + "' in a line of its text: use UTF-8 without control characters");
    }
    return file.string();
}

std::string pathBeside(const std::string& path, const std::string& word)
{
    std::filesystem::path file(path);
    const std::string extension = file.extension().string();
    file.replace_extension();
    return file.string() + '-' + word + extension;
}

std::vector<std::string> levelPaths(const std::string& path, droplet::Format format, std::size_t count)
{
    std::vector<std::string> paths;
    for (std::size_t k = 1; format != droplet::Format::Glb && format != droplet::Format::Gltf && k <= count; ++k) {
        paths.push_back(pathBeside(path, "lod" + std::to_string(k)));
    }
    return paths;
}

Levels makeLevels(const droplet::Surface& whole, const DropletSettings& settings, const std::string& output,
                  droplet::Format format)
{
    constexpr double kFew = 1.1;  // times as many as asked for need no warning
    const std::vector<std::size_t>& wanted = settings.levels;
    const std::vector<std::string> paths = levelPaths(output, format, wanted.size());
    Levels levels;
    if (whole.triangles.empty()) {
        levels.surfaces.resize(wanted.size());
        return levels;
    }
    for (std::size_t k = 0; k < wanted.size(); ++k) {
        droplet::SimplifiedSurface level = droplet::simplify(whole, wanted[k]);
        if (settings.weld) {
            level.surface = droplet::welded(level.surface);
        }
        const std::size_t triangles = level.surface.triangles.size();
        if (static_cast<double>(triangles) > kFew * static_cast<double>(wanted[k])) {
            levels.warnings.push_back(
                fmt::format("level {} has {} triangles, not {}: fewer would close holes or join what is apart", k + 1,
                            triangles, wanted[k]));
        }
        const droplet::OutputReport made = describeOutput(level.surface, output, format);
        levels.reports.push_back(
            {k < paths.size() ? std::optional(paths[k]) : std::nullopt, triangles, made.vertices, level.error});
        levels.surfaces.push_back(std::move(level.surface));
    }
    return levels;
}

droplet::Surface lowered(droplet::Surface surface, double depth)
{
    for (droplet::Vec3& position : surface.vertices) {
        position.z -= depth;
    }
    return surface;
}

std::uint64_t writeSurface(const droplet::Surface& surface, std::ostream& out, const SurfaceTarget& target)
{
    return target.object != nullptr
               ? droplet::writeOnObject(surface, *target.object, out, target.format, target.options)
               : droplet::writeSurface(surface, out, target.format, target.options);
}

std::vector<OutputFile> surfaceFiles(const droplet::Surface& surface, SurfaceTarget target, std::uint64_t& bytes)
{
    std::vector<OutputFile> files;
    const auto material_file = materialFile(target.path, target.format);
    if (material_file) {
        target.options.material_file = std::filesystem::path(*material_file).filename().string();
    }
    files.push_back(
        {target.path, [&surface, &bytes, target](std::ostream& out) { bytes = writeSurface(surface, out, target); }});
    const std::vector<std::string> paths = levelPaths(target.path, target.format, target.options.levels.size());
    for (std::size_t k = 0; k < paths.size(); ++k) {
        files.push_back(
            {paths[k], [k, target](std::ostream& out) { writeSurface(target.options.levels[k], out, target); }});
    }
    if (material_file) {
        std::vector<droplet::Look> looks = droplet::looksOf(target.options.droplets);
        if (looks.empty()) {
            looks.push_back(droplet::lookOf(target.options.material));
        }
        files.push_back({*material_file, [looks](std::ostream& out) { droplet::writeMtl(looks, out); }});
    }
    return files;
}

}  // namespace cli
