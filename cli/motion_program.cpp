// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion_program.h"

#include <unistd.h>

#include <filesystem>
#include <string>
#include <system_error>

#include "option_values.h"

namespace cli {

void becomeMotion(const char* const* argv)
{
    std::error_code unknown;
    const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", unknown);
    const std::string program = (self.parent_path() / DROPLET_MOTION).lexically_normal().string();
    execv(program.c_str(), const_cast<char* const*>(argv));
    refuse(std::string(argv[1]) + " needs the program " + program +
           ", which is missing; the target droplet_motion builds it");
}

}  // namespace cli
