// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "droplet/io/output.h"
#include "droplet/io/report.h"
#include "droplet/sequence/sequence.h"

namespace droplet {

/// Figures of one frame for the report.
struct FrameReport {
    std::string input;                    ///< path of its picture as given, or the number of the video's frame
    std::optional<std::string> output;    ///< path of its file, if every frame has its own
    bool continues = false;               ///< as in Frame
    std::optional<double> vertices_kept;  ///< as in Frame
    bool held = false;                    ///< whether the droplets are those of the frame before, since none exists
    double volume_gained = 0.0;           ///< as in Frame [m³]
    double volume_lost = 0.0;             ///< as in Frame [m³]
    ShapeFigures total;                   ///< of all droplets together
    std::optional<double> pressure;       ///< pressure [Pa]; empty if droplets have different pressures
    std::size_t vertices = 0;             ///< of the surface
    std::size_t triangles = 0;            ///< of the surface
    bool closed = false;                  ///< whether the surface is closed
    std::vector<Ancestry> ancestry;       ///< origins, one per droplet
    std::vector<DropletReport> droplets;  ///< figures, one per droplet
    std::vector<FallingDrop> falling;     ///< as in Frame
    std::size_t drops_shed = 0;           ///< as in Frame
};

/// Measures the figures of a frame for its report; input and output stay empty.
FrameReport reportOf(const Frame& frame, const SequenceOptions& options);

/// Exact bytes of reports, so that an interrupted sequence can go on.
/// @param frames  any number
std::string bytesOf(const std::vector<FrameReport>& frames);

/// Reports from their bytes.
/// @param bytes   of bytesOf()
/// @param name    of their source, for messages
/// @throws Error  InvalidInput if they are damaged, or those of another version
std::vector<FrameReport> frameReportsFromBytes(std::string_view bytes, const std::string& name);

/// Report on a sequence: its inputs, options and results.
struct SequenceReport {
    std::vector<std::string> inputs;             ///< paths of the pictures as given
    std::string output;                          ///< path of the result as given
    Format format = Format::Glb;                 ///< format of the files
    std::uint64_t bytes = 0;                     ///< size of all files together
    int width_px = 0;                            ///< width of a picture
    int height_px = 0;                           ///< height of a picture
    double pixel_size = 0.0;                     ///< edge of a pixel [m]
    double frames_per_second = 24.0;             ///< frame rate of the animation [1/s]
    VolumeMode volume_mode = VolumeMode::Total;  ///< volume that is conserved
    SolveOptions physics;                        ///< liquid and fill
    GroundReport ground;                         ///< ground under the droplets
    std::vector<FrameReport> frames;             ///< one per frame
    std::vector<std::string> warnings;           ///< the grave ones first
    std::size_t severe_warnings = 0;  ///< number of warnings, from the first, that are shown even in quiet mode
    double time_total = 0.0;          ///< run time [s]
    std::uint64_t peak_memory = 0;    ///< [bytes]

    /// Number of frames that show the droplets of the frame before, since they have none.
    [[nodiscard]] std::size_t held() const;
    /// Mean vertices_kept of all frames that have it; empty if none has.
    [[nodiscard]] std::optional<double> meanVerticesKept() const;
    /// Number of frames without liquid.
    [[nodiscard]] std::size_t dry() const;
    /// Number of frames that continue the one before.
    [[nodiscard]] std::size_t kept() const;
};

/// Writes a report as JSON, schema `droplet-shape.sequence/1`, by the rules of writeReport.
/// @throws Error NoSuchDroplet if a number is not finite, with its key; then nothing is written
void writeSequenceReport(std::ostream& out, const SequenceReport& report);

}  // namespace droplet
