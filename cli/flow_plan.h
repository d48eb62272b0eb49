// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "droplet/flow/flow.h"
#include "droplet/flow/flow_shapes.h"
#include "droplet/flow_io/flow_object.h"
#include "flow_options.h"

namespace cli {

/// What a run simulates: the options with the content of their files.
struct FlowPlan {
    droplet::FlowObject object;
    droplet::FlowShapes shapes;  ///< of the object's surface: one, or one for every frame
    droplet::FlowParameters parameters;
    std::vector<droplet::FlowStart> starts;
    std::size_t frames = 1;
    std::vector<std::string> warnings;
    std::size_t floor_begins = 0;  ///< number of the object's own triangles
    droplet::Vec3 size;            ///< edges of the box around the object without a floor [m]

    /// The object's surface at the begin.
    [[nodiscard]] const droplet::FlowTerrain& terrain() const { return shapes.first(); }
};

/// Path of the object, or name of the preset that has it.
std::string nameOfObject(const FlowOptions& options);

/// Files of the object: none of a preset, one, or one for every frame.
/// @throws droplet::Error InvalidInput if a number is missing
std::vector<std::string> objectFiles(const FlowOptions& options);

/// Number of frames, at least one.
std::size_t frameCount(const FlowOptions& options);

/// Reads the options' files and makes the plan.
/// @throws droplet::Error InvalidArgument, InvalidInput
FlowPlan planOf(const FlowOptions& options);

}  // namespace cli
