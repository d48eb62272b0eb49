// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion_program.h"

#include <unistd.h>

#include <string>

#include "option_values.h"
#include "this_process.h"

namespace cli {

int runMotion(int /*argc*/, const char* const* argv)
{
    const std::string program = (programFile().parent_path() / DROPLET_MOTION).lexically_normal().string();
    execv(program.c_str(), const_cast<char* const*>(argv));
    refuse(std::string(argv[1]) + " needs the program " + program +
           ", which is missing; the target droplet_motion builds it");
}

}  // namespace cli
