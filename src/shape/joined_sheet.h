// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "droplet/mesh/planar_mesh.h"
#include "droplet/shape/sheet.h"

namespace droplet {

/// Footprints as one mesh: all rims first. Its loops are those of the footprints, one after another.
PlanarMesh join(const std::vector<PlanarMesh>& footprints);

/// Sheets at one pressure as one sheet; separate() is the inverse.
ParametricSheet join(const std::vector<ParametricSheet>& sheets);

}  // namespace droplet
