// SPDX-License-Identifier: GPL-3.0-or-later
// The command on the system that node_system.js offers.
#include <emscripten/emscripten.h>

#include <cstddef>
#include <iostream>
#include <vector>

#include "commands.h"

extern "C" {

/// Runs the command.
/// @param arguments  the program's name and its arguments, each ended by a zero byte
/// @return exit code
EMSCRIPTEN_KEEPALIVE int droplet_command(const char* arguments, std::size_t argument_bytes)
{
    std::vector<const char*> words;
    for (const char* at = arguments; at < arguments + argument_bytes; ++at) {
        if (at == arguments || at[-1] == '\0') {
            words.push_back(at);
        }
    }
    const int code = cli::runGuarded(static_cast<int>(words.size()), words.data(), cli::dropletCommands());
    std::cout.flush();
    return code;
}

}  // extern "C"
