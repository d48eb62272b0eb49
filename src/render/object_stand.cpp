// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/render/object_stand.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "file_bytes.h"
#include "io/object_mesh.h"
#include "render/openness.h"
#include "render/take_looks.h"
#include "surface/open_edges.h"

namespace droplet {
namespace {

double areaOf(const TexturedMesh& mesh, const Triangle& triangle)
{
    const Vec3 a = mesh.vertices[triangle[0]];
    return 0.5 * length(cross(mesh.vertices[triangle[1]] - a, mesh.vertices[triangle[2]] - a));
}

/// Whether light passes each triangle; or nothing if the object is plain.
std::vector<bool> clearTriangles(const ObjectStand& object)
{
    std::vector<bool> clear;
    if (object.is_plain) {
        return clear;
    }
    for (const std::uint32_t material : object.materials) {
        clear.push_back(object.looks[material].clearness() > 0.5);
    }
    return clear;
}

/// Leaves out the pictures of a file that have no alpha that cuts.
void keepAlpha(FileMesh& scene)
{
    for (FileMaterial& material : scene.looks) {
        material.normals = {};
        material.finish = {};
        material.glows = {};
        if (!material.blends && !material.cutoff) {
            material.colours = {};
        }
    }
}

bool hasHoles(const std::vector<StandLook>& looks)
{
    return std::any_of(looks.begin(), looks.end(), [](const StandLook& look) { return look.coverage.has_value(); });
}

}  // namespace

bool ObjectStand::isSeenThrough() const
{
    const std::vector<bool> is_clear = clearTriangles(*this);
    double clear = 0.0;
    double all = 0.0;
    for (std::size_t t = 0; t < is_clear.size(); ++t) {
        const double area = areaOf(mesh, mesh.triangles[t]);
        clear += is_clear[t] ? area : 0.0;
        all += area;
    }
    return clear > 0.5 * all;
}

StandOpenness ObjectStand::openness() const
{
    return opennessOf(mesh, {clearTriangles(*this), is_open});
}

void ObjectStand::showIn(RenderOptions& options) const
{
    options.stand = mesh;
    options.shows_whole_stand = true;
    options.stand_openness = openness();
    if (!looks.empty() && !is_plain) {
        options.stand_looks = looks;
        options.stand_materials = materials;
        options.stand_colours = colours;
        options.shows_room = isSeenThrough();
    }
}

ObjectStand readObjectStand(const std::filesystem::path& path, const ObjectOptions& options, StandParts parts)
{
    ObjectStand object;
    FileMesh scene = readObjectMesh(path, options, {.uvs = true, .needs_uv = true, .looks = true}).mesh;
    if (parts == StandParts::Holes) {
        keepAlpha(scene);
    }
    TakenLooks taken = takeLooks(scene, shown(path), object.warnings);
    if (parts == StandParts::Holes) {
        object.is_plain = true;
        object.warnings.clear();
        taken.looks = hasHoles(taken.looks) ? std::move(taken.looks) : std::vector<StandLook>{};
    }
    object.material_names = std::move(scene.material_names);
    object.is_open = !openEdges(weldedTriangles(scene.triangles, scene.weld)).empty();
    object.mesh = {std::move(scene.vertices), std::move(scene.normals), std::move(scene.uvs),
                   std::move(scene.triangles)};
    if (!taken.looks.empty() && !scene.materials.empty()) {
        object.looks = std::move(taken.looks);
        object.images = std::move(taken.images);
        object.materials = std::move(scene.materials);
        object.colours = std::move(scene.colours);
    }
    return object;
}

}  // namespace droplet
