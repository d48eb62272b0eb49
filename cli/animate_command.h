// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "animate_options.h"
#include "droplet/mask/mask.h"
#include "droplet/sequence/sequence.h"
#include "droplet/sequence/sequence_report.h"
#include "film.h"
#include "frames.h"
#include "progress_display.h"
#include "run_files.h"
#include "surroundings.h"

namespace cli {

/// Options of a sequence, completed by its first mask, which also opens the report.
/// @param around  result of readSurroundings
droplet::SequenceOptions beginSequence(const droplet::Mask& mask, const AnimateOptions& options,
                                       const Surroundings& around, droplet::SequenceReport& report);

/// Runs `droplet-shape animate`: frames or a video in, an animated droplet out.
/// @return                exit code
/// @throws droplet::Error with the code that stands for the exit code in the manual page
int runAnimate(int argc, const char* const* argv);

/// Hash of the options and the files that decide what the frames show.
/// @param files  that the frames are made from
std::string fingerprintOf(const AnimateOptions& options, const std::vector<std::string>& files);

/// Files that an animation reads and writes, without its frames.
/// @param numbers  of the frames
RunFiles filesOf(const AnimateOptions& options, const FrameNumbers& numbers);

/// Makes droplets of frames and writes them. The files have been checked.
/// @throws droplet::Error as runAnimate()
RunEnd makeAnimation(const AnimateOptions& options, Frames& frames, ProgressDisplay& progress);

}  // namespace cli
