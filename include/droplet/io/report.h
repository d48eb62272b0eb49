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

#include "droplet/colours/colour_regions.h"
#include "droplet/io/output.h"
#include "droplet/mask/mask.h"
#include "droplet/progress.h"
#include "droplet/shape/figures.h"
#include "droplet/shape/refill.h"
#include "droplet/shape/solve.h"
#include "droplet/surface/surface.h"

namespace droplet {

/// Number of stages.
inline constexpr std::size_t kStageCount = static_cast<std::size_t>(Stage::Write) + 1;

/// Text or glyph of the input, and its font.
struct TypeReport {
    std::string family;                                ///< from the font
    std::string style;                                 ///< from the font
    std::size_t face_index = 0;                        ///< within a font collection
    std::vector<std::pair<std::string, double>> axes;  ///< tags and values, as given
    std::optional<std::string> text;                   ///< empty for a glyph
    std::optional<std::uint32_t> glyph;                ///< index in the font; empty for a text
    std::string glyph_name;                            ///< from the font; empty for a text
    std::optional<char32_t> character;                 ///< that the glyph represents
    std::vector<char32_t> missing;                     ///< characters of the text that the font lacks
    double em = 0.0;                                   ///< type size [m]
};

/// Input: a picture and how it was read, or a font with its text.
struct InputReport {
    std::string path;                 ///< as given
    std::optional<TypeReport> type;   ///< for a font; of the members below, only specks_dropped then has a meaning, and
                                      ///< for droplets by colour the palette and the number and size of pixels
    int width_px = 0;                 ///< as in Mask [px]
    int height_px = 0;                ///< as in Mask [px]
    bool drawn = false;               ///< SVG image; it was drawn with the pixels above
    bool own_size = false;            ///< the size is the one that the SVG image states
    double pixel_size = 0.0;          ///< [m]
    Channel channel = Channel::Luma;  ///< as in Mask
    bool inverted = false;            ///< dark or transparent pixels are liquid
    double threshold = 0.5;           ///< as in Mask
    double level_dry = 0.0;           ///< as in Mask
    double level_liquid = 1.0;        ///< as in Mask
    bool anti_aliased = false;        ///< as in Outline
    std::size_t specks_dropped = 0;   ///< footprints and dry spots that were too small
    double largest_speck_px = 0.0;    ///< area of the largest speck dropped [px²]
    Segmentation segment = Segmentation::Threshold;  ///< as in Mask
    double segment_confidence = 1.0;                 ///< as in Mask
    std::vector<PaletteColour> palette = {};         ///< as in ColourRegions; empty unless droplets are made by colour
    std::optional<CssColour> background = {};        ///< as in ColourRegions
};

/// Level of detail beside the whole surface.
struct LevelReport {
    std::optional<std::string> path = {};  ///< of its file; empty if it is in that of the surface
    std::size_t triangles = 0;             ///< of the surface
    std::size_t vertices = 0;              ///< as the format counts them
    double error = 0.0;                    ///< as in SimplifiedSurface [m]
};

/// Output file.
struct OutputReport {
    std::string path;             ///< as given
    Format format = Format::Glb;  ///< of the file
    std::uint64_t bytes = 0;      ///< size of the file
    std::size_t vertices = 0;     ///< as the format counts them; glTF has copies where normals differ
    std::size_t triangles = 0;    ///< of the surface
    std::size_t quads = 0;        ///< quadrilaterals of the file, each of two of these triangles
    Topology topology;            ///< of the surface
    TextureMap texture_map = TextureMap::Projection;         ///< of the surface
    Compression compression = Compression::None;             ///< of the file
    std::optional<CompressionError> compression_error = {};  ///< empty without compression
    std::vector<LevelReport> levels = {};                    ///< but the first, which is the surface
    std::optional<double> base = {};                         ///< thickness of the plate below all droplets [m]
    std::optional<double> map_thickness = {};                ///< that is white in PNGs of maps [m]
    std::vector<std::string> maps = {};                      ///< paths
};

/// Kind of ground.
enum class GroundKind { Flat, Sphere, Cylinder, HeightMap };

/// Ground; members that its kind does not have are empty.
struct GroundReport {
    GroundKind kind = GroundKind::Flat;  ///< decides which members are set
    std::optional<std::string> path;     ///< height map: its file, as given
    std::optional<double> depth;         ///< height map: height of white above black [m]
    std::optional<double> radius;        ///< sphere or cylinder; negative: bowl or gutter [m]
    std::optional<double> axis;          ///< cylinder: counter-clockwise from the picture's right [rad]
};

/// Object under the droplets, with counts from OntoReport.
struct ObjectReport {
    std::string path;                    ///< as given
    std::size_t droplets_laid = 0;       ///< droplets placed on the object
    std::size_t droplets_left_out = 0;   ///< droplets that cannot be placed there
    std::size_t flipped_charts = 0;      ///< as in OntoReport
    std::size_t overlapping_charts = 0;  ///< as in OntoReport
    double min_scale = 0.0;              ///< minimum of length on the object over length in the picture
    double max_scale = 0.0;              ///< maximum of the same
};

/// Triangles of the liquid's surface, of all droplets together.
struct MeshReport {
    std::size_t vertices = 0;   ///< of height fields and sheets
    std::size_t triangles = 0;  ///< likewise
    double min_angle = 0.0;     ///< smallest angle of a triangle, of height fields seen from above [rad]
    std::size_t holes = 0;      ///< dry spots
};

/// Figures of one droplet.
struct DropletReport {
    ShapeFigures figures;                  ///< of this droplet
    std::size_t holes = 0;                 ///< dry spots
    double pressure = 0.0;                 ///< [Pa]
    std::optional<Retention> retention;    ///< empty if Report::hysteresis is empty
    std::optional<CssColour> colour = {};  ///< of its region; empty unless droplets are made by colour
    FillLimit limit = FillLimit::None;     ///< what makes its amount smaller than the wanted one
};

/// Options, results and warnings of a run, in SI units and radians.
struct Report {
    InputReport input;                       ///< picture or text
    OutputReport output;                     ///< file written
    SolveOptions physics;                    ///< liquid, gravity, fill and model
    std::optional<FillRange> fill_range;     ///< empty if the surface cannot be refilled
    std::optional<Hysteresis> hysteresis;    ///< empty if unknown
    GroundReport ground;                     ///< below the liquid
    std::optional<ObjectReport> onto;        ///< empty without an object
    SolveReport solve;                       ///< of the solver
    std::size_t sheets = 0;                  ///< number of droplets that hang over their rims
    MeshReport mesh;                         ///< of the liquid's surface
    ShapeFigures total;                      ///< of all droplets together
    std::optional<double> pressure;          ///< [Pa]; empty if every droplet has its own pressure
    std::optional<Retention> retention;      ///< forces of all droplets together
    std::vector<DropletReport> droplets;     ///< in the order of the meshes
    std::vector<std::string> warnings;       ///< one line each; grave ones first
    std::size_t severe_warnings = 0;         ///< number of warnings that --quiet does not silence
    std::array<double, kStageCount> time{};  ///< indexed by Stage [s]
    double time_total = 0.0;                 ///< [s]
    std::uint64_t peak_memory = 0;           ///< [bytes]
};

/// What limits the amounts of droplets: Existence if any of them, else Puddle if any.
FillLimit limitOf(const std::vector<DropletReport>& droplets);

/// Writes a report as JSON, schema `droplet-shape.report/1`: every key is always present, in a fixed order; numbers
/// have all their digits; angles are in degrees, the rest in SI units. Bytes of a path that are not UTF-8 become
/// U+FFFD.
///
/// The stream is left failed if it did not take everything.
/// @throws Error NoSuchDroplet if a number is not finite, naming its key; nothing is written then
void writeReport(std::ostream& out, const Report& report);

}  // namespace droplet
