// SPDX-License-Identifier: GPL-3.0-or-later
// Droplets as a texture.
#pragma once

#include <cstddef>

#include "droplet/wind_io/windshield_animation.h"
#include "io/droplet_histories.h"
#include "scene/scene.h"

namespace droplet {

/// Scene of droplets as a texture; see AnimationMethod::Texture.
/// @throws Error InvalidArgument as checkTexture()
Scene sceneOfTexture(const DropletHistories& histories, const Glass& glass, const WindshieldAnimationOptions& options);

/// Rejects textures that are too large for viewers.
/// @param slots  number of droplets at once, or more
/// @throws Error InvalidArgument if the texture has too many rows
void checkTexture(std::size_t slots, std::size_t frames);

}  // namespace droplet
