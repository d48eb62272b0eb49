// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace cli {

/// Runs `droplet-shape studio`: opens the page of Studio, or writes it to a file.
/// @return                exit code
/// @throws droplet::Error on any failure
int runStudio(int argc, const char* const* argv);

}  // namespace cli
