// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.h"

#include <algorithm>
#include <array>
#include <exception>
#include <filesystem>
#include <iterator>
#include <new>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "animate_command.h"
#include "batch_command.h"
#include "compare_command.h"
#include "droplet/error.h"
#include "exit_code.h"
#include "glyphs_command.h"
#include "motion_program.h"
#include "option_values.h"
#include "shape_command.h"
#include "shape_options.h"
#include "shortage.h"
#include "studio_command.h"
#include "terminal.h"

namespace cli {
namespace {

constexpr std::array kCommands{Command{"animate", runAnimate}, Command{"batch", runBatch},
                               Command{"compare", runCompare}, Command{"glyphs", runGlyphs},
                               Command{"studio", runStudio}};

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

int fail(std::string_view message, ExitCode code)
{
    printError(message);
    return static_cast<int>(code);
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
        return runMotion(argc, argv);
    }
    refuseMisspelt(std::string(word));
    return runShape(argc, argv);
}

int runGuarded(int argc, const char* const* argv, std::span<const Command> commands)
{
    try {
        return runCommand(argc, argv, commands);
    } catch (const droplet::Error& error) {
        return fail(error.what(), exitCodeOf(error.code()));
    } catch (const std::bad_alloc&) {
        return fail("out of memory; use fewer triangles or droplets, or smaller pictures", ExitCode::InternalError);
    } catch (const std::exception& error) {
        if (isThreadShortage(error)) {
            return fail("out of threads or memory: no further thread can be started; use fewer threads (--threads)",
                        ExitCode::InternalError);
        }
        return fail(std::string("internal error: ") + error.what(), ExitCode::InternalError);
    }
}

}  // namespace cli
