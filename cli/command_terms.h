// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace cli {

/// Options that a command's messages may name.
struct CommandTerms {
    std::vector<std::string> options;  ///< of the command, such as `--width`
    std::vector<std::string> given;    ///< those of the command line and of the configuration file
};

}  // namespace cli
