// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace cli {

/// Runs `droplet-shape flow`.
/// @param argv            begins with the command's name
/// @return                exit code
/// @throws droplet::Error on any failure
int runFlow(int argc, const char* const* argv);

}  // namespace cli
