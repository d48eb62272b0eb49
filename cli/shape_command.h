// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace cli {

/// The main job: `droplet-shape INPUT OUTPUT`.
/// @return                exit code
/// @throws droplet::Error as main() maps to exit codes
int runShape(int argc, const char* const* argv);

}  // namespace cli
