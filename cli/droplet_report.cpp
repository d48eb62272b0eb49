// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet_report.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <vector>

namespace cli {
namespace {

droplet::MeshReport describeMeshes(const droplet::Droplet& droplet)
{
    droplet::MeshReport report;
    report.min_angle = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < droplet.meshes.size(); ++k) {
        const droplet::PlanarMesh& mesh = droplet.meshes[k];
        const droplet::CapillarySurface& surface = droplet.solution.droplets[k];
        report.vertices += surface.vertices.size();
        report.triangles += surface.triangles.size();
        report.holes += mesh.loopCount() - 1;
        report.min_angle =
            std::min(report.min_angle, surface.isHeightField() ? droplet::minAngle(mesh) : droplet::minAngle(surface));
    }
    return report;
}

std::optional<droplet::Retention> retentionOf(const droplet::ShapeFigures& figures, const DropletSettings& settings)
{
    if (!settings.hysteresis) {
        return std::nullopt;
    }
    return droplet::retention(figures, settings.droplet.solve, *settings.hysteresis);
}

}  // namespace

droplet::OutputReport describeOutput(const droplet::Surface& surface, const std::string& path, droplet::Format format)
{
    droplet::OutputReport output;
    output.path = path;
    output.format = format;
    output.triangles = surface.triangles.size();
    output.quads = droplet::hasQuads(format) ? droplet::quadrilaterals(surface).size() : 0;
    output.topology = droplet::topology(surface);
    output.texture_map = surface.texture_map;
    // Only glTF repeats a vertex to give it a second normal.
    const bool repeats = format == droplet::Format::Glb || format == droplet::Format::Gltf;
    for (std::uint32_t i = 0; i < surface.weld.size(); ++i) {
        output.vertices += repeats || surface.weld[i] == i ? 1 : 0;
    }
    return output;
}

droplet::Report describe(const droplet::Droplet& droplet, const DropletSettings& settings)
{
    droplet::Report report;
    report.physics = settings.droplet.solve;
    report.physics.model = droplet.solution.report.model;
    report.sheets = static_cast<std::size_t>(
        std::count_if(droplet.solution.droplets.begin(), droplet.solution.droplets.end(),
                      [](const droplet::CapillarySurface& surface) { return !surface.isHeightField(); }));
    report.fill_range = settings.droplet.fill_range;
    report.hysteresis = settings.hysteresis;
    report.ground = settings.ground;
    report.solve = droplet.solution.report;
    report.mesh = describeMeshes(droplet);
    report.total = droplet.total;
    for (std::size_t i = 0; i < droplet.meshes.size(); ++i) {
        report.droplets.push_back({droplet.figures[i], droplet.meshes[i].loopCount() - 1,
                                   droplet.solution.droplets[i].pressure, retentionOf(droplet.figures[i], settings),
                                   std::nullopt, droplet.limits[i]});
    }
    report.retention = retentionOf(droplet.total, settings);
    const bool one_pressure =
        report.droplets.size() == 1 || settings.droplet.solve.fill.sharing == droplet::FillSharing::Total;
    if (one_pressure) {
        report.pressure = report.droplets.front().pressure;
    }
    report.warnings = droplet.warnings;
    report.severe_warnings = droplet.severe_warnings;
    const auto grave_end = report.warnings.begin() + static_cast<std::ptrdiff_t>(report.severe_warnings);
    report.warnings.insert(grave_end, settings.warnings.begin(), settings.warnings.end());
    return report;
}

}  // namespace cli
