// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace cli {

/// Runs `droplet-shape windshield`.
/// @return                exit code
/// @throws droplet::Error on any failure
int runWindshield(int argc, const char* const* argv);

}  // namespace cli
