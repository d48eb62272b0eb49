// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "droplet/flow_io/flow_object.h"
#include "flow_io/shape_basis.h"
#include "scene/scene.h"

namespace droplet {

/// Adds an object, with a material for each name in its file, and its node; returns the node.
/// @param changes  morph targets; may be empty
std::size_t addObject(const FlowObject& object, Scene& scene, const std::vector<MeshShape>& changes = {});

}  // namespace droplet
