// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/render/write_on_object.h"

#include <cstddef>
#include <string>

#include "droplet/error.h"
#include "io/dry_surface.h"
#include "io/surface_scene.h"
#include "render/scene_object.h"
#include "scene/scene.h"
#include "scene/write_scene.h"

namespace droplet {

std::uint64_t writeOnObject(const Surface& droplets, const ObjectStand& object, std::ostream& out, Format format,
                            const WriteOptions& options)
{
    if (!isAnimated(format)) {
        throw Error(ErrorCode::InvalidArgument, std::string("format = ") + name(format) +
                                                    " holds no object below droplets; glb, gltf, usda and usdz do");
    }
    const bool is_gltf = format == Format::Glb || format == Format::Gltf;
    const bool closed = options.closed ? *options.closed : isDry(droplets) || isClosed(droplets);
    const std::string none;
    Scene scene;
    const std::size_t node = addObject(
        SceneObject{object.mesh.vertices, object.mesh.normals, object.mesh.uvs, object.colours, object.mesh.triangles,
                    object.materials, object.material_names, object.looks, object.images},
        scene);
    SurfaceSceneOptions look{options.material, closed, options.nodes, options.droplets,
                             format == Format::Usda ? none : options.texture};
    if (is_gltf) {
        look.levels = options.levels;
    } else {
        look.closed = true;  // as USD's materials have no inside
    }
    addSurface(scene, node, droplets, look);
    return writeScene(scene, out, {format, format == Format::Glb ? options.compression : Compression::None});
}

}  // namespace droplet
