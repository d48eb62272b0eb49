// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "droplet/footprint/mask.h"
#include "droplet/io/output.h"
#include "droplet/progress.h"
#include "droplet/shape/figures.h"
#include "droplet/shape/refill.h"
#include "droplet/shape/solve.h"
#include "droplet/surface/surface.h"

namespace droplet {

/// How many stages there are.
inline constexpr std::size_t kStageCount = static_cast<std::size_t>(Stage::Write) + 1;

/// What was set, and in what.
struct TypeReport {
    std::string family;  ///< as the font says
    std::string style;
    std::size_t face_index = 0;
    std::vector<std::pair<std::string, double>> axes;  ///< tags and values as given
    std::optional<std::string> text;                   ///< empty where there is a glyph
    std::optional<std::uint32_t> glyph;                ///< empty where there is a text
    std::string glyph_name;
    std::optional<char32_t> character;  ///< that the glyph stands for
    std::vector<char32_t> missing;      ///< characters of the text that the font lacks
    double em = 0.0;                    ///< [m]
};

/// The picture and how it was read, or what was set in type.
struct InputReport {
    std::string path;                ///< as given
    std::optional<TypeReport> type;  ///< if the path is a font's: then what follows says nothing but specks_dropped
    int width_px = 0;
    int height_px = 0;
    bool drawn = false;       ///< an SVG image, which has no pixels but those it was drawn with
    bool own_size = false;    ///< whether its size is what it states itself
    double pixel_size = 0.0;  ///< [m]
    Channel channel = Channel::Luma;
    bool inverted = false;
    double threshold = 0.5;
    double level_dry = 0.0;     ///< as in Mask
    double level_liquid = 1.0;  ///< as in Mask
    bool anti_aliased = false;
    std::size_t specks_dropped = 0;
    double largest_speck_px = 0.0;                   ///< [px²]
    Segmentation segment = Segmentation::Threshold;  ///< as in Mask
    double segment_confidence = 1.0;                 ///< as in Mask
};

/// The file that was written.
struct OutputReport {
    std::string path;  ///< as given
    Format format = Format::Glb;
    std::uint64_t bytes = 0;
    std::size_t vertices = 0;  ///< as the format counts them: distinct places, or more where normals need copies
    std::size_t triangles = 0;
    Topology topology;
};

/// What the liquid stands on.
enum class GroundKind { Flat, Sphere, Cylinder, HeightMap };

/// The ground; what a kind does not have is empty.
struct GroundReport {
    GroundKind kind = GroundKind::Flat;
    std::optional<std::string> path;  ///< of a height map, as given
    std::optional<double> depth;      ///< of a height map: white over black [m]
    std::optional<double> radius;     ///< negative of a bowl or gutter [m]
    std::optional<double> axis;       ///< of a cylinder, counter-clockwise from the picture's right [rad]
};

/// The object the droplets were laid on, and how.
struct ObjectReport {
    std::string path;  ///< as given
    std::size_t droplets_laid = 0;
    std::size_t droplets_left_out = 0;
    std::size_t flipped_charts = 0;
    std::size_t overlapping_charts = 0;
    double min_scale = 0.0;  ///< of object to picture, in length
    double max_scale = 0.0;
};

/// The footprint's triangulation, all droplets together.
struct MeshReport {
    std::size_t vertices = 0;
    std::size_t triangles = 0;
    double min_angle = 0.0;  ///< [rad]
    std::size_t holes = 0;
};

/// One droplet of the table.
struct DropletReport {
    ShapeFigures figures;
    std::size_t holes = 0;
    double pressure = 0.0;               ///< [Pa]
    std::optional<Retention> retention;  ///< where Report::hysteresis is known
};

/// What a run did and what came of it, in SI units and radians.
struct Report {
    InputReport input;
    OutputReport output;
    SolveOptions physics;
    std::optional<FillRange> fill_range;  ///< where the surface can be filled and drained
    std::optional<Hysteresis> hysteresis;
    GroundReport ground;
    std::optional<ObjectReport> onto;  ///< empty where there is no object
    SolveReport solve;
    MeshReport mesh;
    ShapeFigures total;
    std::optional<double> pressure;       ///< [Pa]; empty when droplets have pressures of their own
    std::optional<Retention> retention;   ///< forces of all droplets together
    std::vector<DropletReport> droplets;  ///< in the order of the meshes
    std::vector<std::string> warnings;
    std::size_t grave_warnings = 0;          ///< so many of the first of them are told even where only errors are
    std::array<double, kStageCount> time{};  ///< indexed by Stage [s]
    double time_total = 0.0;                 ///< [s]
    std::uint64_t peak_memory = 0;           ///< [bytes]
};

/// Writes a report as JSON, schema `droplet-shape.report/1`: every key always present, in a fixed order, numbers with
/// all their digits, angles in degrees, the rest in SI units. Bytes of a path that are not UTF-8 become U+FFFD.
///
/// The stream is left failed if it did not take everything.
/// @throws Error NoSuchDroplet if a number is not finite, naming its key; nothing is written then
void writeReport(std::ostream& out, const Report& report);

}  // namespace droplet
