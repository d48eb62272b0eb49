// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace cli {

/// Runs `droplet-shape dew`.
/// @param argv            begins with the command's name
/// @return                exit code
/// @throws droplet::Error on any failure
int runDew(int argc, const char* const* argv);

}  // namespace cli
