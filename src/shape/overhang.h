// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "droplet/shape/capillary_surface.h"

namespace droplet {

/// How far a surface leans out over its rim, seen from above [m].
double overhangOf(const CapillarySurface& sheet);

}  // namespace droplet
