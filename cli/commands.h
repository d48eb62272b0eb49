// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace cli {

/// Runs the command that the first argument names or, if it names none, makes a droplet from a picture.
/// @param argv            the program's name and its arguments
/// @return                exit code
/// @throws droplet::Error on any failure, with the code that stands for the exit code
int runCommand(int argc, const char* const* argv);

}  // namespace cli
