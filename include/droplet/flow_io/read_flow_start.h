// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "droplet/flow/flow_parameters.h"

namespace droplet {

/// Reads droplets from CSV text: a header with `x_m,y_m,z_m,volume_m3` and maybe `velocity_x_m_per_s,
/// velocity_y_m_per_s,velocity_z_m_per_s`, in any order, then a row for every droplet. Other columns and empty lines at
/// the end are ignored. Places and velocities are in the object's frame, +Y up, and are turned to z up.
/// @param text   UTF-8, with or without a byte order mark
/// @param name   name of the file for error messages
/// @throws Error InvalidInput, naming file, row and column: a heading or number is missing, a number is not finite, or
///               a volume is not positive
std::vector<FlowStart> parseFlowStart(std::string_view text, const std::string& name);

/// Reads droplets from a CSV file.
/// @throws Error InvalidInput as parseFlowStart(), or if the file cannot be read
std::vector<FlowStart> readFlowStart(const std::filesystem::path& path);

}  // namespace droplet
