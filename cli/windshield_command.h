// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace cli {

/// droplet-shape windshield.
/// @return                the exit code
/// @throws droplet::Error
int runWindshield(int argc, const char* const* argv);

}  // namespace cli
