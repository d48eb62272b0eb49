// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <iosfwd>

#include "scene/scene.h"

namespace droplet {

/// Writes a scene's meshes as 3MF: an object for every geometry of a mesh, welded, in the colour of its look, and one
/// object of all of them, which lies on the plate as it is. Nodes without motion alone; normals, pictures and tracks
/// are left out.
///
/// Guarantees: the same scene gives the same bytes, in any locale; nothing is written if it throws.
/// @return       bytes handed to the stream, which is left failed if it did not take everything
/// @throws Error InvalidArgument if the file would reach 4 GiB
std::uint64_t write3mf(const Scene& scene, std::ostream& out);

}  // namespace droplet
