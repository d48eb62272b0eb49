// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "animate_options.h"
#include "frames.h"

namespace cli {

/// Runs `droplet-shape animate`: frames or a video in, an animated droplet out.
/// @return                exit code
/// @throws droplet::Error with the code that stands for the exit code in the manual page
int runAnimate(int argc, const char* const* argv);

/// Makes droplets of frames and writes them.
/// @throws droplet::Error as runAnimate()
void makeAnimation(const AnimateOptions& options, Frames& frames);

}  // namespace cli
