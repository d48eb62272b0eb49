// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "droplet/flow/object_motion.h"

namespace droplet {

/// Reads keys of an object's motion from CSV text: a header with `time_s`, with `x_m,y_m,z_m` (place of the object's
/// origin), with `rotation_x,rotation_y,rotation_z,rotation_w` (quaternion), or with both, in any order, then a row for
/// every key. Other columns and empty lines at the end are ignored. The world has +Y up and is turned to z up.
/// Quaternions are normalised.
/// @param text   UTF-8, with or without a byte order mark
/// @param name   name of the file for error messages
/// @throws Error InvalidInput, naming file, row and column: a heading or number is missing, a number is not finite,
///               times do not ascend, or a quaternion is 0
ObjectMotion parseObjectMotion(std::string_view text, const std::string& name);

/// Reads keys of an object's motion from a CSV file.
/// @throws Error InvalidInput as parseObjectMotion(), or if the file cannot be read
ObjectMotion readObjectMotion(const std::filesystem::path& path);

}  // namespace droplet
