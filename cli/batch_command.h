// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace cli {

/// Runs `droplet-shape batch`: many pictures in, a file for each out.
/// @return                exit code
/// @throws droplet::Error for whatever is known to fail before any work is done
int runBatch(int argc, const char* const* argv);

}  // namespace cli
