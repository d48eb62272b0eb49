// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace cli {

/// Runs `compare`: two surfaces in, how far they differ out.
/// @return                exit code: 1 where they differ by more than a tolerance
/// @throws droplet::Error for whatever goes wrong
int runCompare(int argc, const char* const* argv);

}  // namespace cli
