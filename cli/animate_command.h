// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace cli {

/// `droplet-shape animate`.
/// @return                exit code
/// @throws droplet::Error as the manual page says of exit codes
int runAnimate(int argc, const char* const* argv);

}  // namespace cli
