// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace cli {

/// Runs `droplet-shape batch`: many pictures in, one file for each out.
/// @return                exit code
/// @throws droplet::Error if an error can be found before any work is done
int runBatch(int argc, const char* const* argv);

}  // namespace cli
