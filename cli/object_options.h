// SPDX-License-Identifier: GPL-3.0-or-later
// Options of commands that put droplets on the mesh of an object.
#pragma once

#include <string>
#include <vector>

#include "command_line.h"
#include "droplet/flow/flow_parameters.h"
#include "droplet/flow/flow_surface.h"
#include "droplet/flow_io/flow_object.h"
#include "droplet/flow_io/flow_points.h"
#include "droplet/scene/format.h"
#include "droplet/surface/surface.h"
#include "droplet/vector.h"
#include "option_values.h"

namespace cli {

/// Declares --pinning and --pinning-length.
void declarePinning(CommandLine& line, const char* group, droplet::FlowPinning& pinning);

/// Turns a surface to the axes of the object's file, for formats that are written z up.
void turnToFile(droplet::Surface& surface, droplet::Format format, const droplet::ObjectOptions& reading);

/// The same for points of a PLY.
void turnToFile(std::vector<droplet::FlowPoint>& points, const droplet::ObjectOptions& reading);

/// Warns of what is wrong with a mesh that droplets are on.
/// @param path      of the object, for the words
/// @param warnings  get lines
void warnOfDefects(const droplet::FlowSurfaceReport& report, const std::string& path,
                   std::vector<std::string>& warnings);

}  // namespace cli
