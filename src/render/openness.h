// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "droplet/surface/textured_mesh.h"

namespace droplet {

/// Share of even light from all around that reaches each vertex of an object past the object itself.
///
/// Guarantees: the same bytes with any number of threads.
/// @param object   valid
/// @param is_clear  whether light passes a triangle, for each triangle; empty: it passes none
/// @return         from 0 to 1, for each vertex
std::vector<float> opennessOf(const TexturedMesh& object, const std::vector<bool>& is_clear = {});

}  // namespace droplet
