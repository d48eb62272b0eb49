// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace cli {

/// Runs `droplet-shape compare`: two surfaces in, their difference out.
/// @return                exit code: 1 if they differ by more than a tolerance
/// @throws droplet::Error on any failure
int runCompare(int argc, const char* const* argv);

}  // namespace cli
