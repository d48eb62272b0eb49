// SPDX-License-Identifier: GPL-3.0-or-later
// Writer of droplet scenes as a texture.
#pragma once

#include <cstddef>
#include <cstdint>
#include <iosfwd>

#include "droplet/wind_io/droplet_scene.h"
#include "io/droplet_histories.h"

namespace droplet {

/// Writes droplets as a texture; see SceneAnimation::Texture.
/// @throws Error InvalidArgument as checkTexture()
std::uint64_t writeSceneOfTexture(const DropletHistories& histories, const Glass& glass,
                                  const DropletSceneOptions& options, std::ostream& out);

/// Rejects textures that are too large for viewers.
/// @param slots  number of droplets at once, or more
/// @throws Error InvalidArgument if the texture has too many rows
void checkTexture(std::size_t slots, std::size_t frames);

}  // namespace droplet
