// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "droplet/flow/flow_parameters.h"
#include "droplet/flow_io/face_properties.h"
#include "droplet/flow_io/preset_object.h"
#include "droplet/render/render.h"

namespace droplet {

/// Named scene: an object, droplets and all that acts on them.
struct FlowPreset {
    std::string name;                                     ///< such as "tear"
    std::string description;                              ///< one line: what happens
    PresetObject object = PresetObject::Slope;            ///< at detail 1
    FlowParameters parameters;                            ///< valid; without ground
    std::map<std::string, MaterialProperties> materials;  ///< ground of the object's materials
    std::vector<FlowStart> starts;                        ///< droplets at the begin
    double duration = 5.0;                                ///< time to show [s]
    CameraPlace camera;                                   ///< place of the camera for pictures
};

/// All presets. The sequences of Fournier, Habibi and Poulin 1998, section 5, with FlowModel::Paper: `masses`,
/// `viscosities`, `adhesions`, `roughnesses`, `tear`, `forces`; and `bottle`, `leaf` and `car`.
const std::vector<FlowPreset>& flowPresets();

/// Preset with a given name.
/// @throws Error InvalidArgument if there is none; the message lists all names
const FlowPreset& flowPresetNamed(std::string_view name);

}  // namespace droplet
