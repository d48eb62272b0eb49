// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>

#include "droplet/flow_io/flow_object.h"
#include "scene/scene.h"

namespace droplet {

/// Material without transmission, seen from both sides.
SceneMaterial opaqueMaterial(const std::string& name, double roughness);

/// Adds an object, with a material for each name in its file, and its node; returns the node.
std::size_t addObject(const FlowObject& object, Scene& scene);

}  // namespace droplet
