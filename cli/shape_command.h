// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "droplet/colours/colour_drawing.h"
#include "droplet/io/report.h"
#include "droplet/outline/outline.h"
#include "droplet/progress.h"
#include "run_files.h"
#include "shape_options.h"
#include "surroundings.h"

namespace cli {

/// Path of the picture on the ground below the droplets, if it is given.
std::optional<std::string> groundPicture(const ShapeOptions& options);
/// Path of the panorama that lights the scene, if it is given.
std::optional<std::string> environmentPicture(const ShapeOptions& options);

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
/// @throws droplet::Error InvalidArgument, OutputFailed
void checkShape(const ShapeOptions& options, const std::string& input_name);

/// Adds the files that the options of every command that makes droplets read.
void addSettings(RunFiles& files, const DropletSettings& settings, const RunOptions& run);

/// Writes a warning to standard error.
void printWarning(const std::string& warning, ProgressMode progress);

/// Makes one droplet with the given number of threads, and shows progress, summary and warnings.
/// @param make  makes the droplet, and calls its argument at every stage
void makeAndReport(const RunOptions& run, const std::function<droplet::Report(const droplet::Progress&)>& make);

/// Runs `droplet-shape` without a command: a picture in, a droplet out.
/// @return                exit code
/// @throws droplet::Error on any failure
int runShape(int argc, const char* const* argv);

}  // namespace cli
