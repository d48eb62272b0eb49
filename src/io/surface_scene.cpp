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
/// @param parent   of the node; empty: none
void addNode(Scene& scene, std::optional<std::size_t> parent, std::vector<SceneGeometry> geometries,
             const Surface& surface, const std::optional<FileDroplet>& droplet)
{
    SceneMesh mesh{droplet ? droplet->name : "droplet", std::move(geometries)};
    if (surface.refill) {
        describeRefill(*surface.refill, mesh);
    }
    SceneNode node{mesh.name, scene.addMesh(std::move(mesh))};
    if (droplet) {
        node.properties = figuresOf(*droplet);
    }
    scene.addNode(std::move(node), parent);
}

/// Adds the nodes and meshes of a surface with fewer triangles.
/// @param level       scene of that surface, with the same materials as the surface
/// @param first_node  of the surface
/// @param number      from 1
/// @param materials   in front of the surface's own
void addLevel(Scene& scene, std::size_t first_node, Scene level, std::size_t number, std::size_t materials)
{
    const std::string suffix = "_lod" + std::to_string(number);
    const std::size_t first = scene.meshes.size();
    for (SceneMesh& mesh : level.meshes) {
        mesh.name += suffix;
        for (SceneGeometry& geometry : mesh.geometries) {
            for (ScenePart& part : geometry.parts) {
                part.material += materials;
            }
        }
        scene.addMesh(std::move(mesh));
    }
    for (std::size_t i = 0; i < level.nodes.size(); ++i) {
        SceneNode node{level.nodes[i].name + suffix, first + *level.nodes[i].mesh};
        scene.nodes[first_node + i].levels.push_back(scene.nodes.size());
        scene.nodes.push_back(std::move(node));
    }
}

/// Adds the surfaces with fewer triangles.
/// @param first_node      of the surface
/// @param first_material  of the surface
void addLevels(Scene& scene, std::size_t first_node, std::size_t first_material, const Surface& surface,
               const SurfaceSceneOptions& options)
{
    std::vector<double> coverage;
    const std::size_t nodes = scene.nodes.size() - first_node;
    const std::size_t materials = scene.materials.size() - first_material;
    SurfaceSceneOptions alone = options;
    alone.levels = {};
    for (std::size_t k = 0; k < options.levels.size(); ++k) {
        const Surface& level = options.levels[k];
        Scene own = sceneOf(level, alone);
        if (own.nodes.size() != nodes || own.materials.size() != materials) {
            throw Error(ErrorCode::InvalidArgument,
                        "options.levels[" + std::to_string(k) + "] must have the parts of the surface");
        }
        addLevel(scene, first_node, std::move(own), k + 1, first_material);
        coverage.push_back(static_cast<double>(level.triangles.size()) / static_cast<double>(surface.triangles.size()));
    }
    coverage.push_back(0.0);  // the last one is never left out
    for (std::size_t i = 0; i < nodes; ++i) {
        scene.nodes[first_node + i].properties.emplace_back("MSFT_screencoverage", coverage);
    }
}

void addTo(Scene& scene, std::optional<std::size_t> parent, const Surface& surface, const SurfaceSceneOptions& options)
{
    validateUnlessDry(surface);
    const std::vector<PartGroup> groups = groupParts(surface, options);
    const std::size_t first_node = scene.nodes.size();
    const std::size_t first_material = scene.materials.size();
    std::vector<SceneGeometry> geometries;
    for (const PartGroup& group : groups) {
        const std::optional<Surface> own =
            groups.size() == 1 ? std::nullopt : std::optional(extract(surface, group.parts));
        const Surface& part = own ? *own : surface;
        const double thickness = options.closed ? part.mean_height : 0.0;
        geometries.push_back(geometryOf(part, scene.addMaterial(liquidMaterial(group.look, thickness))));
        if (group.droplet) {
            addNode(scene, parent, std::exchange(geometries, {}), part, group.droplet);
        }
    }
    if (!geometries.empty()) {
        addNode(scene, parent, std::move(geometries), surface, {});
    }
    if (!groups.empty() && !options.texture.empty()) {
        scene.picture = ScenePicture{"picture", options.texture, true, first_material};
    }
    if (!options.levels.empty()) {
        addLevels(scene, first_node, first_material, surface, options);
    }
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
    Scene scene;
    addTo(scene, {}, surface, options);
    return scene;
}

void addSurface(Scene& scene, std::size_t parent, const Surface& surface, const SurfaceSceneOptions& options)
{
    addTo(scene, parent, surface, options);
}

}  // namespace droplet
