// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "droplet/io/output.h"
#include "droplet/io/report.h"
#include "droplet/sequence/sequence.h"

namespace droplet {

/// What of a frame is worth telling once it is made.
struct FrameReport {
    std::string input;                    ///< its picture as given, or which of the video's frames
    std::optional<std::string> output;    ///< its file, where every frame has its own
    bool continues = false;               ///< as in Frame
    std::optional<double> vertices_kept;  ///< as in Frame
    double volume_gained = 0.0;           ///< as in Frame [m³]
    double volume_lost = 0.0;             ///< as in Frame [m³]
    ShapeFigures total;
    std::optional<double> pressure;  ///< [Pa]; empty when droplets have pressures of their own
    std::size_t vertices = 0;        ///< of the surface
    std::size_t triangles = 0;       ///< of the surface
    bool closed = false;
    std::vector<Ancestry> ancestry;       ///< one per droplet
    std::vector<DropletReport> droplets;  ///< one per droplet
};

/// Measures what a frame's report tells.
FrameReport reportOf(const Frame& frame, const SequenceOptions& options);

/// What a sequence was made of and what came of it.
struct SequenceReport {
    std::vector<std::string> inputs;  ///< as given
    std::string output;               ///< as given
    Format format = Format::Glb;
    std::uint64_t bytes = 0;  ///< of all files
    int width_px = 0;
    int height_px = 0;
    double pixel_size = 0.0;  ///< [m]
    double frames_per_second = 24.0;
    VolumeMode volume_mode = VolumeMode::Total;
    SolveOptions physics;
    GroundReport ground;
    std::vector<FrameReport> frames;
    std::vector<std::string> warnings;
    std::size_t grave_warnings = 0;  ///< so many of the first are told even where only errors are
    double time_total = 0.0;         ///< [s]
    std::uint64_t peak_memory = 0;   ///< [bytes]

    /// Mean of the frames' vertices_kept; empty if no frame has it.
    [[nodiscard]] std::optional<double> meanKept() const;
    /// How many frames have no liquid.
    [[nodiscard]] std::size_t dry() const;
    /// How many frames continue the one before.
    [[nodiscard]] std::size_t kept() const;
};

/// Writes a report as JSON, schema `droplet-shape.sequence/1`, by the rules of writeReport.
/// @throws Error NoSuchDroplet if a number is not finite, naming its key; nothing is written then
void writeSequenceReport(std::ostream& out, const SequenceReport& report);

}  // namespace droplet
