// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.h"

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "animate_command.h"
#include "batch_command.h"
#include "compare_command.h"
#include "flow_command.h"
#include "glyphs_command.h"
#include "liquid2d_command.h"
#include "morph_command.h"
#include "option_values.h"
#include "shape_command.h"
#include "studio_command.h"
#include "wind_tunnel_command.h"
#include "windshield_command.h"

namespace cli {
namespace {

/// Command, selected by the first argument.
struct Command {
    std::string_view name;
    int (*run)(int argc, const char* const* argv);
};

constexpr std::array kCommands{Command{"animate", runAnimate},
                               Command{"batch", runBatch},
                               Command{"compare", runCompare},
                               Command{"flow", runFlow},
                               Command{"glyphs", runGlyphs},
                               Command{"liquid2d", runLiquid2d},
                               Command{"morph", runMorph},
                               Command{"studio", runStudio},
                               Command{"wind-tunnel", runWindTunnel},
                               Command{"windshield", runWindshield}};

/// Refuses a word that is almost a command's name, and not an existing file.
void refuseMisspelt(const std::string& word)
{
    std::vector<std::string> names;
    for (const Command& command : kCommands) {
        names.emplace_back(command.name);
    }
    std::error_code ignored;
    const std::string name = std::filesystem::exists(word, ignored) ? "" : nearestName(word, names);
    if (!name.empty()) {
        refuse("unknown command '" + word + "', did you mean " + name + "?");
    }
}

}  // namespace

int runCommand(int argc, const char* const* argv)
{
    for (const Command& command : kCommands) {
        if (argc > 1 && argv[1] == command.name) {
            return command.run(argc - 1, argv + 1);
        }
    }
    refuseMisspelt(argc > 1 ? argv[1] : "");
    return runShape(argc, argv);
}

}  // namespace cli
