// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "droplet/flow/flow.h"
#include "droplet/flow/flow_terrain.h"
#include "droplet/flow_io/droplet_surfaces.h"
#include "droplet/surface/surface.h"

namespace droplet {

/// Seats droplets on the object below them, and extends their rims a little into it, so that no light leaks in between.
/// @param samples   droplets
/// @param droplets  dropletSurfaces() of them
/// @param is_shown  for each; others are left out
SettledDroplets settled(const FlowTerrain& terrain, std::span<const FlowSample> samples, const Surface& droplets,
                        const std::vector<bool>& is_shown);

}  // namespace droplet
