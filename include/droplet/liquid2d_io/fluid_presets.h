// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "droplet/liquid2d/fluid_scene.h"

namespace droplet {

/// Named scene of a 2D liquid.
struct FluidPreset {
    std::string name;       ///< such as "splash"
    std::string what;       ///< one line: what happens
    FluidScene scene;       ///< valid
    double duration = 3.0;  ///< time to show [s]
    std::string style;      ///< of the surface that suits it: realistic, cartoon, wave or paper
};

/// All presets: `splash`, `wave`, `dam`, `pour`.
const std::vector<FluidPreset>& fluidPresets();

/// Preset with a given name.
/// @throws Error InvalidArgument if there is none; the message lists all names
const FluidPreset& fluidPresetNamed(std::string_view name);

}  // namespace droplet
