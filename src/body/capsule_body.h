// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "body/body_grid.h"
#include "droplet/body/running_shape.h"

namespace droplet {

/// Vertices on a capsule, evenly spaced along its rim; the apex is in the middle.
BodyGrid capsuleGrid(const RunningShape& shape);

}  // namespace droplet
