// SPDX-License-Identifier: GPL-3.0-or-later
// The forms a scene of droplets is written in.
#pragma once

#include <cstddef>
#include <cstdint>
#include <iosfwd>

#include "droplet/wind_io/droplet_scene.h"
#include "wind_io/droplet_lives.h"

namespace droplet {

/// Writes droplets as joints of skinned meshes. See SceneAnimation::Nodes.
std::uint64_t writeSceneOfNodes(const DropletLives& lives, const Glass& glass, const DropletSceneOptions& options,
                                std::ostream& out);

/// Writes droplets as a texture. See SceneAnimation::Texture.
/// @throws Error InvalidArgument: checkTexture
std::uint64_t writeSceneOfTexture(const DropletLives& lives, const Glass& glass, const DropletSceneOptions& options,
                                  std::ostream& out);

/// Refuses what viewers have no textures for.
/// @param slots  droplets at once, or more
/// @throws Error InvalidArgument
void checkTexture(std::size_t slots, std::size_t frames);

}  // namespace droplet
