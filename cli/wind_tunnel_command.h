// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace cli {

/// `droplet-shape wind-tunnel`. @return its exit code
int runWindTunnel(int argc, const char* const* argv);

}  // namespace cli
