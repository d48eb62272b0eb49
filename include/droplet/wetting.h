// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string_view>

namespace droplet {

/// What a liquid lies on.
enum class Solid {
    Glass,  ///< ordinary, not freshly cleaned
    Ptfe,   ///< polytetrafluoroethylene
    Wax,    ///< paraffin
    Lotus,  ///< a leaf of the lotus
};

/// Contact angle that a droplet takes by itself [rad], 0 … π, with its source in src/wetting.cpp.
/// @param liquid  name, as in liquids()
/// @param solid   below it
/// @return        empty if it is not known; 0 if the liquid spreads
std::optional<double> naturalContactAngle(std::string_view liquid, Solid solid);

/// Name of a solid in messages: glass, ptfe, wax or lotus.
const char* name(Solid solid);

}  // namespace droplet
