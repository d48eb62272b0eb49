// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace cli {

/// Runs `droplet-shape morph`: footprints in, liquid that flows from one to the next out.
/// @return                exit code
/// @throws droplet::Error with the code that stands for the exit code in the manual page
int runMorph(int argc, const char* const* argv);

}  // namespace cli
