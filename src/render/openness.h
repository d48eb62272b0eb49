// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "droplet/render/stand_openness.h"
#include "droplet/surface/textured_mesh.h"

namespace droplet {

/// What openness depends on besides the object.
struct OpennessOptions {
    std::vector<bool> is_clear = {};  ///< whether light passes a triangle, for each triangle; empty: it passes none
    bool has_backs = false;           ///< also of the other sides of triangles
};

/// Share of even light from all around that reaches an object past the object itself, on grids as fine as shadows of
/// large triangles are seen.
///
/// Guarantees: the same bytes with any number of threads.
/// @param object  valid
StandOpenness opennessOf(const TexturedMesh& object, const OpennessOptions& options = {});

}  // namespace droplet
