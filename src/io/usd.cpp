// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/io/usd.h"

#include "io/surface_scene.h"
#include "scene/write_usd.h"

namespace droplet {
namespace {

std::uint64_t write(const Surface& surface, std::ostream& out, const UsdOptions& options, Format format)
{
    constexpr bool kClosed = true;  // USD's materials have no inside
    Scene scene = sceneOf(surface, {options.material, kClosed, options.nodes, options.droplets, options.texture});
    if (options.nodes == Nodes::One && !scene.nodes.empty()) {
        scene.nodes.front().name = "surface";  // below the prim `droplet`
    }
    if (scene.materials.empty()) {
        scene.addMaterial({lookOf(options.material)});
    }
    if (!options.texture.empty()) {
        scene.picture = ScenePicture{"picture", options.texture};  // a package has it also without liquid
    }
    return writeUsd(scene, out, {format});
}

}  // namespace

std::uint64_t writeUsda(const Surface& surface, std::ostream& out, const UsdOptions& options)
{
    return write(surface, out, options, Format::Usda);
}

std::uint64_t writeUsdz(const Surface& surface, std::ostream& out, const UsdOptions& options)
{
    return write(surface, out, options, Format::Usdz);
}

}  // namespace droplet
