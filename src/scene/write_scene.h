// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <iosfwd>

#include "droplet/scene/format.h"
#include "scene/scene.h"

namespace droplet {

/// Writes a scene as writeGltf() or writeUsd() do.
/// @throws Error InvalidArgument as they do, or if the format holds no animations, or no points
std::uint64_t writeScene(const Scene& scene, std::ostream& out, const AnimatedFile& file);

}  // namespace droplet
