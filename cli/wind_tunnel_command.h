// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace cli {

/// Runs `droplet-shape wind-tunnel` and returns the exit code.
int runWindTunnel(int argc, const char* const* argv);

}  // namespace cli
