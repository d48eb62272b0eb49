// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "droplet/vector.h"
#include "droplet/windshield/mist.h"
#include "windshield/cells.h"
#include "windshield/sweep.h"

namespace droplet {

/// Width of the mist's cells [m]: a finger's edge and the trail of a droplet can be told.
inline constexpr double kMistCell = 2e-3;

/// Adds mist that condenses, up to kDenseMist everywhere; lays out the cells if there are none.
/// @param size    of the unrolled glass [m]
/// @param growth  of the thickness [m], > 0
/// @return        volume that was added [m³]
double growMist(Mist& mist, Vec2 size, double growth);

/// Stroke over the glass that takes mist: all within half its width of a line.
struct MistStroke {
    Vec2 from;
    Vec2 to;
    double reach = 0.0;  ///< half the width [m]
};

/// Takes the mist in a stroke; cells at its edge keep the part outside it.
/// @return  its volume [m³]
double takeMist(Mist& mist, const MistStroke& stroke);

/// Takes the mist that a blade passes over.
/// @return  its volume [m³]
double takeMist(Mist& mist, const Sweep& blade);

}  // namespace droplet
