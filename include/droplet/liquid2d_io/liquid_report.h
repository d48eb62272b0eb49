// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "droplet/expression/expression.h"
#include "droplet/vector.h"

namespace droplet {

/// Figures of one frame.
struct LiquidFrameRow {
    double time = 0.0;            ///< [s]
    std::uint64_t particles = 0;  ///< number of particles
    std::uint64_t steps = 0;      ///< of the simulation since the start
    double particle_area = 0.0;   ///< of all particles [m²]
    double area = 0.0;            ///< that the outlines enclose [m²]
    std::uint64_t outlines = 0;   ///< number of the liquid's outlines and holes
    std::uint64_t foam = 0;       ///< number of holes that are foam
    std::uint64_t droplets = 0;   ///< number of outlines of detached droplets
};

/// Inputs and results of a run.
struct LiquidReport {
    std::optional<std::string> scene;      ///< name or path of the scene
    std::optional<std::string> particles;  ///< path of the particle files
    std::optional<std::string> output;     ///< path of the drawings
    std::optional<std::string> masks;      ///< path of the masks
    std::string style;                     ///< of the surface
    ExpressionOptions options;             ///< controls of the surface
    Vec2 size;                             ///< of the window [m]
    double spacing = 0.0;                  ///< of particles at rest [m]
    double frames_per_second = 24.0;       ///< > 0
    std::vector<LiquidFrameRow> frames;    ///< of all frames
    std::uint64_t removed = 0;             ///< particles that left the window and its margin
    std::vector<std::string> warnings;     ///< all warnings of the run
    double time_total = 0.0;               ///< run time [s]
    std::uint64_t peak_memory = 0;         ///< [byte]
};

/// Writes the report as one JSON object, schema droplet-shape.liquid2d/1: SI units; every key is always present. The
/// stream is in a failed state if a write failed.
/// @throws Error NoSuchDroplet if a number is not finite
void writeLiquidReport(std::ostream& out, const LiquidReport& report);

}  // namespace droplet
