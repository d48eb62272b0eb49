// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "dew_options.h"
#include "droplet/body/droplet_body.h"
#include "droplet/flow/flow.h"
#include "droplet/flow/flow_terrain.h"
#include "droplet/flow_io/dew_model.h"
#include "droplet/flow_io/dew_report.h"
#include "droplet/flow_io/flow_object.h"
#include "droplet/io/table_format.h"
#include "droplet/progress.h"
#include "droplet/scene/format.h"
#include "droplet/surface/surface.h"
#include "run_files.h"

namespace cli {

/// Object with droplets that rest on it.
struct Dew {
    droplet::FlowObject object;
    droplet::FlowTerrain terrain;            ///< of the object
    droplet::DropletBodies bodies;           ///< shapes of the droplets
    droplet::DewModel model;                 ///< their meshes
    std::vector<droplet::FlowSample> shown;  ///< droplets that have a mesh
    droplet::DewReport report;               ///< without time and memory
};

/// Files that the command reads and writes.
RunFiles filesOf(const DewCommandOptions& options);

/// Words on the droplets that a file lacks.
std::string lostOf(const droplet::DewReport& report);

/// Covers an object with droplets; reads files, and writes none.
/// @param progress        told of the stages Read, Solve (placing) and Loft (meshes)
/// @throws droplet::Error InvalidArgument, InvalidInput
Dew placeDew(const DewCommandOptions& options, const droplet::Progress& progress = {});

/// All droplets as they are written in a format that holds one surface.
/// @param reading  of the object
droplet::Surface surfaceFor(droplet::Format format, const Dew& dew, const droplet::ObjectOptions& reading);

/// Writes the table of --droplets.
void writeTable(std::ostream& out, droplet::TableFormat format, const Dew& dew);

/// Covers an object with droplets and writes all outputs.
/// @throws droplet::Error on any failure
droplet::DewReport makeDew(const DewCommandOptions& options, const droplet::Progress& progress = {});

}  // namespace cli
