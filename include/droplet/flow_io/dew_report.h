// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "droplet/flow/dew.h"
#include "droplet/flow/flow_surface.h"
#include "droplet/flow_io/dew_model.h"
#include "droplet/vector.h"

namespace droplet {

/// Inputs and results of covering an object with droplets at rest.
struct DewReport {
    std::string input;                     ///< path of the object
    FlowSurfaceReport surface;             ///< defects of its mesh
    Vec3 size;                             ///< edges of the box around it, z up [m]
    std::string output;                    ///< path
    std::optional<Instancing> instancing;  ///< how the file has the droplets, never Auto; empty: it is no scene
    std::string preset;                    ///< name of the preset
    DewOptions options;                    ///< what was asked for
    double area = 0.0;                     ///< of the surface where droplets may be [m²]
    double covered = 0.0;                  ///< of it, below droplets [m²]
    double volume = 0.0;                   ///< of all droplets [m³]
    double smallest = 0.0;                 ///< dewRadius() of the smallest droplet [m]
    double largest = 0.0;                  ///< of the largest droplet [m]
    std::size_t droplets = 0;              ///< that the file has
    std::size_t joined = 0;                ///< that found no room and became part of others
    std::size_t run_off = 0;               ///< that no slope holds
    std::size_t between_edges = 0;         ///< that find no place clear of the object's edges
    std::size_t left_out = 0;              ///< below which the object bends too much
    std::vector<std::string> warnings;     ///< all warnings of the run
    double time_total = 0.0;               ///< run time [s]
    std::uint64_t peak_memory = 0;         ///< [byte]
};

/// Writes the report as one JSON object, schema droplet-shape.dew/1: SI units, vectors with +Y up; every key is always
/// present. The stream is in a failed state if a write failed.
/// @throws Error NoSuchDroplet if a number is not finite
void writeDewReport(std::ostream& out, const DewReport& report);

}  // namespace droplet
