// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace cli {

/// Runs a command of what moves: unless one program has all commands, by becoming the program that has them.
/// @param argv            the program's name, a command of what moves, and its arguments
/// @return                exit code
/// @throws droplet::Error on any failure; InvalidArgument: the program is missing
int runMotion(int argc, const char* const* argv);

}  // namespace cli
