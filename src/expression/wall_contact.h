// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "droplet/liquid2d/particle_frame.h"
#include "droplet/outline/outline.h"

namespace droplet {

/// Lets outlines of liquid that lies at walls lie on them: particles at rest stop within a spacing of a wall.
void meetWalls(std::vector<Loop>& loops, const ParticleFrame& frame);

}  // namespace droplet
