// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/io/three_mf.h"

#include <string>

#include "io/surface_scene.h"
#include "scene/write_3mf.h"

namespace droplet {

std::uint64_t writeThreeMf(const Surface& surface, std::ostream& out, const ThreeMfOptions& options)
{
    const std::string no_texture;
    return write3mf(sceneOf(surface, {options.material, true, options.nodes, options.droplets, no_texture}), out);
}

}  // namespace droplet
