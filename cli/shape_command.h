// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "droplet/colours/colour_drawing.h"
#include "droplet/drawing/picture.h"
#include "droplet/droplet.h"
#include "droplet/image/css_colour.h"
#include "droplet/io/report.h"
#include "droplet/mask/mask.h"
#include "droplet/outline/outline.h"
#include "droplet/progress.h"
#include "run_files.h"
#include "shape_options.h"
#include "surroundings.h"

namespace cli {

/// Droplets of one footprint, on their object if there is one, before any file is written.
struct MadeShape {
    droplet::Droplet droplet;
    DropletSettings settings;  ///< with what the picture decides
    droplet::InputReport input;
    std::vector<droplet::CssColour> colours = {};  ///< one per droplet, or none
    std::optional<droplet::Mask> mask = {};        ///< if it is to be written
    std::optional<droplet::Picture> colour_map = {};
    std::optional<droplet::ObjectReport> onto = {};
};

/// Places droplets on their object, if there is one.
MadeShape placed(MadeShape made, const Surroundings& around);

/// Makes droplets from the bytes of a picture.
/// @param around          result of readSurroundings
/// @throws droplet::Error InvalidArgument, InvalidInput, NoSuchDroplet
MadeShape makeOfPicture(const ShapeOptions& options, const Surroundings& around, std::vector<std::byte> picture);

/// What files say of droplets.
struct DescribedShape {
    droplet::Report report;  ///< without output, times and memory
    std::vector<droplet::FileDroplet> droplets;
};

/// Describes droplets.
DescribedShape describe(const MadeShape& made, const ShapeOptions& options);

/// Bytes of the PNG with the droplets' colours; none if they have one.
std::string textureOf(const MadeShape& made);

/// Reads the bytes of the input picture, from its file or standard input.
/// @throws droplet::Error InvalidInput
std::vector<std::byte> readPicture(const ShapeOptions& options);

/// Makes one droplet from its picture, and writes all its files, or none.
/// @param progress        called at every stage, from Read to Write
/// @return                report with times and memory
/// @throws droplet::Error InvalidArgument, InvalidInput, OutputFailed, NoSuchDroplet
droplet::Report makeShape(const ShapeOptions& options, const droplet::Progress& progress);

/// Makes one droplet from a picture that has been read.
/// @param around   result of readSurroundings
/// @param picture  result of readPicture
droplet::Report makeShape(const ShapeOptions& options, const Surroundings& around, std::vector<std::byte> picture);

/// Footprint that does not come from a picture.
struct DrawnFootprint {
    droplet::Outline outline;
    droplet::InputReport input;
};

/// Areas of colour that do not come from a picture.
struct DrawnColours {
    droplet::ColourDrawing drawing;
    droplet::InputReport input;
    double speck_size = 0.0;  ///< smallest area of a region [m²]
};

/// Makes one droplet for each region of one colour.
/// @param around    result of readSurroundings
/// @param progress  called at every stage, from Read to Write
droplet::Report makeShape(const ShapeOptions& options, const Surroundings& around, const DrawnColours& drawn,
                          const droplet::Progress& progress);

/// Makes one droplet from an outline.
/// @param around    result of readSurroundings
/// @param progress  called at every stage, from Triangulate to Write
droplet::Report makeShape(const ShapeOptions& options, const Surroundings& around, DrawnFootprint footprint,
                          const droplet::Progress& progress);

/// Files that one droplet's options name, and that its outputs bring with them.
/// @param input_name  name of the input in messages
RunFiles filesOf(const ShapeOptions& options, const std::string& input_name);

/// Checks one droplet's files, and that a video can be written, before any work is done.
/// @param files  all that the run reads and writes
/// @throws droplet::Error InvalidArgument, OutputFailed
void checkShape(const ShapeOptions& options, const RunFiles& files);

/// Adds the files that the options of every command that makes droplets read.
void addSettings(RunFiles& files, const DropletSettings& settings, const RunOptions& run);

/// Writes a warning to standard error.
void printWarning(const std::string& warning, ProgressMode progress);

/// Makes one droplet with the given number of threads, and shows progress, summary and warnings.
/// @param make  makes the droplet, and calls its argument at every stage
void makeAndReport(const RunOptions& run, const RunFiles& files,
                   const std::function<droplet::Report(const droplet::Progress&)>& make);

/// Runs `droplet-shape` without a command: a picture in, a droplet out.
/// @return                exit code
/// @throws droplet::Error on any failure
int runShape(int argc, const char* const* argv);

}  // namespace cli
