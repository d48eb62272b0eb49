// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "commands.h"

namespace cli {

/// Runs a program: a command, and a failure as one line on standard error. Does not return.
/// @param commands  of the program
[[noreturn]] void runProgram(int argc, char** argv, std::span<const Command> commands);

}  // namespace cli
