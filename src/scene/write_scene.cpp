// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/write_scene.h"

#include <string>

#include "droplet/error.h"
#include "scene/write_gltf.h"
#include "scene/write_usd.h"

namespace droplet {

std::uint64_t writeScene(const Scene& scene, std::ostream& out, const AnimatedFile& file)
{
    if (!isAnimated(file.format)) {
        throw Error(ErrorCode::InvalidArgument,
                    std::string("format = ") + name(file.format) + " holds no animations; glb, gltf, usda and usdz do");
    }
    const bool is_usd = file.format == Format::Usda || file.format == Format::Usdz;
    if (scene.points && !is_usd) {
        throw Error(ErrorCode::InvalidArgument,
                    std::string("format = ") + name(file.format) + " holds no points over time; usda and usdz do");
    }
    if (is_usd && !scene.instances.empty()) {
        Scene spread = scene;
        spread.spreadInstances();
        return writeUsd(spread, out, file);
    }
    return is_usd ? writeUsd(scene, out, file) : writeGltf(scene, out, file);
}

}  // namespace droplet
