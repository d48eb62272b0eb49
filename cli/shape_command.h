// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "droplet/io/report.h"
#include "droplet/progress.h"
#include "shape_options.h"
#include "surroundings.h"

namespace cli {

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

/// Runs the main job: the picture of a footprint in, a droplet out.
/// @return                exit code
/// @throws droplet::Error for whatever goes wrong
int runShape(int argc, const char* const* argv);

}  // namespace cli
