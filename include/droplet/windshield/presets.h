// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "droplet/windshield/parameters.h"

namespace droplet {

/// Named parameters of one figure of the thesis.
struct WindshieldPreset {
    std::string name;                 ///< such as "figure-3.10"
    std::string description;          ///< one line: the parameters and the result in the thesis
    WindshieldParameters parameters;  ///< valid
};

/// All presets: figures 3.10 (11.3 m/s, hysteresis 0.5), 3.11 (11.3 m/s, 0.05) and 3.12 (15 m/s, 0.5).
const std::vector<WindshieldPreset>& windshieldPresets();

/// Preset with a given name.
/// @throws Error InvalidArgument if there is none; the message lists all names
const WindshieldPreset& windshieldPresetNamed(std::string_view name);

}  // namespace droplet
