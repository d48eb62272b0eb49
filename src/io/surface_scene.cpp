// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/surface_scene.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

#include "byte_stream.h"
#include "droplet/error.h"
#include "droplet/units.h"
#include "io/dry_surface.h"
#include "number_text.h"

namespace droplet {
namespace {

/// Droplets of a surface that become one piece of a file.
struct PartGroup {
    Look look;
    std::optional<FileDroplet> droplet = {};  ///< with Nodes::Each
    std::vector<std::size_t> parts = {};      ///< indices of Surface::parts; empty: the whole surface
};

/// Indices of the surface's parts by the number of their droplet.
std::vector<std::size_t> partsInOrder(const Surface& surface, std::size_t droplets)
{
    std::vector<std::size_t> order(surface.parts.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return surface.parts[a].droplet < surface.parts[b].droplet; });
    if (order.empty() || surface.parts[order.back()].droplet >= droplets) {
        throw Error(ErrorCode::InvalidArgument, "options.droplets has " + std::to_string(droplets) +
                                                    " entries; the surface must have parts, for these droplets alone");
    }
    return order;
}

/// Groups the parts of a surface: one group for each look, or with Nodes::Each for each droplet.
std::vector<PartGroup> groupParts(const Surface& surface, const SurfaceSceneOptions& options)
{
    const bool is_each = options.nodes == Nodes::Each;
    if (is_each && options.droplets.empty()) {
        throw Error(ErrorCode::InvalidArgument, "options.droplets is empty; Nodes::Each needs one for every droplet");
    }
    if (isDry(surface)) {
        return {};
    }
    if (options.droplets.empty()) {
        return {{lookOf(options.material)}};
    }
    std::vector<PartGroup> groups;
    for (const std::size_t k : partsInOrder(surface, options.droplets.size())) {
        const FileDroplet& droplet = options.droplets[surface.parts[k].droplet];
        const auto same = is_each ? groups.end()
                                  : std::find_if(groups.begin(), groups.end(),
                                                 [&](const PartGroup& group) { return group.look == droplet.look; });
        if (same != groups.end()) {
            same->parts.push_back(k);
        } else {
            groups.push_back({droplet.look, is_each ? std::optional(droplet) : std::nullopt, {k}});
        }
    }
    return groups;
}

void describeRefill(const Refill& refill, SceneMesh& mesh)
{
    const std::vector<double> range{refill.min, refill.max};
    if (refill.states.size() == 1 && refill.states.front().fill == 2.0) {
        mesh.targets = {"volume"};
        mesh.properties = {{"fill_range", range}};
        return;
    }
    std::vector<double> fills;
    for (const RefillState& state : refill.states) {
        mesh.targets.push_back("volume_" + numberText(state.fill, 3));
        fills.push_back(state.fill);
    }
    mesh.properties = {{"fill_range", range}, {"fills", fills}};
}

std::vector<SceneProperty> figuresOf(const FileDroplet& droplet)
{
    return {{"contact_angle_deg", droplet.contact_angle / kDegree},
            {"height_max_m", droplet.height_max},
            {"pressure_pa", droplet.pressure},
            {"volume_m3", droplet.volume}};
}

/// Adds a mesh, and its node.
/// @param droplet  name and figures of the node; empty: of all droplets
void addNode(Scene& scene, std::vector<SceneGeometry> geometries, const Surface& surface,
             const std::optional<FileDroplet>& droplet)
{
    SceneMesh mesh{droplet ? droplet->name : "droplet", std::move(geometries)};
    if (surface.refill) {
        describeRefill(*surface.refill, mesh);
    }
    SceneNode node{mesh.name, scene.addMesh(std::move(mesh))};
    if (droplet) {
        node.properties = figuresOf(*droplet);
    }
    scene.addNode(std::move(node));
}

}  // namespace

std::vector<Look> looksOf(const std::vector<FileDroplet>& droplets)
{
    std::vector<Look> looks;
    looks.reserve(droplets.size());
    for (const FileDroplet& droplet : droplets) {
        looks.push_back(droplet.look);
    }
    return looks;
}

// Positions are rounded to half an ulp of float: for a 20 mm droplet 0.5 nm, a ten-thousandth of an edge of the finest
// mesh that fits into a file. If rounding merges vertices the mesh stays closed, since faces use indices and welded
// copies round alike. Normals are stored, so degenerate triangles need none.
SceneGeometry geometryOf(const Surface& surface, std::size_t material)
{
    SceneGeometry geometry{sceneVectors(surface.vertices), sceneVectors(surface.normals),
                           sceneCoordinates(surface.uvs)};
    geometry.angles.resize(surface.contact_angle.size());
    std::transform(surface.contact_angle.begin(), surface.contact_angle.end(), geometry.angles.begin(),
                   [](float angle) { return toFloat(static_cast<double>(angle) / kDegree); });
    geometry.weld = surface.weld;
    if (surface.refill) {
        for (const RefillState& state : surface.refill->states) {
            geometry.targets.push_back({sceneVectors(state.vertices), sceneVectors(state.normals)});
        }
    }
    geometry.parts.push_back({material, surface.triangles, quadrilaterals(surface)});
    return geometry;
}

Scene sceneOf(const Surface& surface, const SurfaceSceneOptions& options)
{
    validateUnlessDry(surface);
    const std::vector<PartGroup> groups = groupParts(surface, options);
    Scene scene;
    std::vector<SceneGeometry> geometries;
    for (const PartGroup& group : groups) {
        const std::optional<Surface> own =
            groups.size() == 1 ? std::nullopt : std::optional(extract(surface, group.parts));
        const Surface& part = own ? *own : surface;
        const double thickness = options.closed ? part.mean_height : 0.0;
        geometries.push_back(geometryOf(part, scene.addMaterial(liquidMaterial(group.look, thickness))));
        if (group.droplet) {
            addNode(scene, std::exchange(geometries, {}), part, group.droplet);
        }
    }
    if (!geometries.empty()) {
        addNode(scene, std::move(geometries), surface, {});
    }
    if (!groups.empty() && !options.texture.empty()) {
        scene.picture = ScenePicture{"picture", options.texture};
    }
    return scene;
}

}  // namespace droplet
