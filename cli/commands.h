// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string_view>

namespace cli {

/// Command, selected by the first argument.
struct Command {
    std::string_view name;
    int (*run)(int argc, const char* const* argv);
};

/// Commands of droplet-shape that make droplets.
std::span<const Command> dropletCommands();

/// Commands of what moves: rain, droplets on objects, liquids in the plane. They are a program of their own, which
/// droplet-shape starts, so that nobody waits for it to be built who wants a droplet.
std::span<const Command> motionCommands();

/// Runs the command that the first argument names: one of those, or one of another program's; if it names none, makes a
/// droplet from a picture.
/// @param argv            the program's name and its arguments
/// @return                exit code
/// @throws droplet::Error on any failure, with the code that stands for the exit code
int runCommand(int argc, const char* const* argv, std::span<const Command> commands);

/// Runs a command and returns its exit code. A failure is one line on standard error.
/// @param commands  of the program
int runGuarded(int argc, const char* const* argv, std::span<const Command> commands);

}  // namespace cli
