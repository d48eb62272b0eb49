// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <iterator>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "animate_command.h"
#include "batch_command.h"
#include "compare_command.h"
#include "glyphs_command.h"
#include "option_values.h"
#include "shape_command.h"
#include "shape_options.h"
#include "studio_command.h"

namespace cli {
namespace {

constexpr std::array kCommands{Command{"animate", runAnimate}, Command{"batch", runBatch},
                               Command{"compare", runCompare}, Command{"glyphs", runGlyphs},
                               Command{"studio", runStudio}};

/// Becomes the program of what moves.
/// @throws droplet::Error InvalidArgument: it is missing
[[noreturn]] void becomeMotion(const char* const* argv)
{
    std::error_code unknown;
    const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", unknown);
    const std::string program = (self.parent_path() / DROPLET_MOTION).lexically_normal().string();
    execv(program.c_str(), const_cast<char* const*>(argv));
    refuse(std::string(argv[1]) + " needs the program " + program +
           ", which is missing; the target droplet_motion builds it");
}

/// Refuses a word that is almost a command's name, and not an existing file.
void refuseMisspelt(const std::string& word)
{
    std::vector<std::string> names;
    std::transform(programCommands().begin(), programCommands().end(), std::back_inserter(names),
                   [](const auto& command) { return command.first; });
    std::error_code ignored;
    const std::string name = std::filesystem::exists(word, ignored) ? "" : nearestName(word, names);
    if (!name.empty()) {
        refuse("unknown command '" + word + "', did you mean " + name + "?");
    }
}

}  // namespace

std::span<const Command> dropletCommands()
{
    return kCommands;
}

int runCommand(int argc, const char* const* argv, std::span<const Command> commands)
{
    const std::string_view word = argc > 1 ? argv[1] : "";
    for (const Command& command : commands) {
        if (word == command.name) {
            return command.run(argc - 1, argv + 1);
        }
    }
    const auto& known = programCommands();
    if (std::any_of(known.begin(), known.end(), [&](const auto& command) { return command.first == word; })) {
        becomeMotion(argv);
    }
    refuseMisspelt(std::string(word));
    return runShape(argc, argv);
}

}  // namespace cli
