// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "droplet/body/droplet_body.h"
#include "droplet/flow/flow.h"
#include "droplet/flow/flow_parameters.h"
#include "droplet/flow/flow_surface.h"
#include "droplet/vector.h"

namespace droplet {

/// Where the liquid is at one time.
struct FlowBalanceRow {
    double time = 0.0;           ///< [s]
    FlowBalance balance;         ///< liquid since the start
    std::uint64_t running = 0;   ///< number of droplets that move over the surface
    std::uint64_t still = 0;     ///< number of droplets at rest
    std::uint64_t airborne = 0;  ///< number of droplets in the air
};

/// Balance and numbers of droplets of a state.
FlowBalanceRow flowBalanceRow(const FlowState& state);

/// What is white in maps that are PNG.
struct FlowMapScale {
    double thickness = 0.0;  ///< [m]
    double age = 0.0;        ///< [s]
};

/// Inputs and results of a run.
struct FlowReport {
    std::string input;                       ///< path of the object
    FlowSurfaceReport surface;               ///< defects of its mesh
    Vec3 size;                               ///< edges of the box around it, z up [m]
    std::string output;                      ///< path
    std::optional<std::string> preset;       ///< name of the preset
    std::optional<std::string> start;        ///< path of the table of droplets at the start
    FlowParameters parameters;               ///< parameters of the simulation
    BodyShape shape = BodyShape::Capillary;  ///< model of the droplets' shape
    double deformation = 0.0;                ///< SmallDeformation::amplitude
    double frames_per_second = 30.0;         ///< > 0
    double time = 0.0;                       ///< simulated time [s]
    std::size_t frames = 0;                  ///< number of frames
    std::optional<FlowMapScale> map_scale;   ///< empty: there are no such maps
    std::vector<FlowBalanceRow> balance;     ///< balance over time
    FlowCounts counts;                       ///< event counters since the start
    std::vector<std::string> warnings;       ///< all warnings of the run
    double time_total = 0.0;                 ///< run time [s]
    std::uint64_t peak_memory = 0;           ///< [byte]
};

/// Writes the report as one JSON object, schema droplet-shape.flow/1: SI units, vectors with +Y up; every key is always
/// present. The stream is in a failed state if a write failed.
/// @throws Error NoSuchDroplet if a number is not finite
void writeFlowReport(std::ostream& out, const FlowReport& report);

}  // namespace droplet
