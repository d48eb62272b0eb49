// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "droplet/windshield/parameters.h"

namespace droplet {

/// A setting of the thesis's figures.
struct WindshieldPreset {
    std::string name;         ///< "figure-3.10"
    std::string description;  ///< what the thesis says of it, in a line
    WindshieldParameters parameters;
};

/// Figures 3.10, 3.11 and 3.12: 11.3 m/s with hysteresis 0.5, 11.3 m/s with 0.05, 15 m/s with 0.5.
const std::vector<WindshieldPreset>& windshieldPresets();

/// @throws Error InvalidArgument, listing the names known
const WindshieldPreset& windshieldPresetNamed(std::string_view name);

}  // namespace droplet
