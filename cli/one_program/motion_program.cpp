// SPDX-License-Identifier: GPL-3.0-or-later
// One program has all commands.
#include "motion_program.h"

#include "commands.h"

namespace cli {

int runMotion(int argc, const char* const* argv)
{
    return runCommand(argc, argv, motionCommands());
}

}  // namespace cli
