// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "droplet/footprint/outline.h"
#include "droplet/io/report.h"
#include "droplet/progress.h"
#include "shape_options.h"
#include "surroundings.h"

namespace cli {

/// An edge is too short for a footprint only when the footprint is known; all memory would be used up to find out.
/// @param area             of the footprint [m²]
/// @throws droplet::Error  InvalidArgument
void refuseTooShortEdge(double area, const droplet::DropletOptions& options);

/// Area of the liquid on the ground [m²].
double coveredArea(const droplet::Outline& outline);

/// The path of the picture that is to be seen below the droplets, where one is asked for.
std::optional<std::string> groundPicture(const ShapeOptions& options);
/// Path of the picture that shines, if there is one.
std::optional<std::string> environmentPicture(const ShapeOptions& options);

/// The bytes of the picture, from its file or standard input.
/// @throws droplet::Error InvalidInput
std::vector<std::byte> readPicture(const ShapeOptions& options);

/// Makes one droplet from its picture, and writes its files, all of them or none.
/// @param progress        told of every stage, from Read to Write
/// @return                what was done, with times and memory
/// @throws droplet::Error InvalidArgument, InvalidInput, OutputFailed, NoSuchDroplet
droplet::Report makeShape(const ShapeOptions& options, const droplet::Progress& progress);

/// The same, from what has been read already.
/// @param around   of readSurroundings
/// @param picture  of readPicture
droplet::Report makeShape(const ShapeOptions& options, const Surroundings& around, std::vector<std::byte> picture);

/// A footprint that comes of something else than a picture.
struct DrawnFootprint {
    droplet::Outline outline;
    droplet::InputReport input;
};

/// The same, from an outline on.
/// @param around    of readSurroundings
/// @param progress  told of every stage from Triangulate
droplet::Report makeShape(const ShapeOptions& options, const Surroundings& around, DrawnFootprint footprint,
                          const droplet::Progress& progress);

/// What is known to fail must fail before any work is done.
/// @param input_name      how messages call the input
/// @throws droplet::Error InvalidArgument, OutputFailed
void checkShape(const ShapeOptions& options, const std::string& input_name);

/// Writes a warning to standard error.
void tellWarning(const std::string& warning, ProgressMode progress);

/// Makes one droplet with as many threads as asked for, shows how far it is, and tells what came of it.
/// @param make  is given whom to tell of every stage
void makeAndTell(const RunOptions& run, const std::function<droplet::Report(const droplet::Progress&)>& make);

/// Runs the main job: the picture of a footprint in, a droplet out.
/// @return                exit code
/// @throws droplet::Error for whatever goes wrong
int runShape(int argc, const char* const* argv);

}  // namespace cli
