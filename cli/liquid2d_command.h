// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace cli {

/// Runs `droplet-shape liquid2d`.
/// @throws droplet::Error
int runLiquid2d(int argc, const char* const* argv);

}  // namespace cli
