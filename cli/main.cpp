// SPDX-License-Identifier: GPL-3.0-or-later
#include <fcntl.h>
#include <malloc.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iostream>
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
#include "interruption.h"
#include "option_values.h"
#include "shape_command.h"
#include "terminal.h"
#include "wind_tunnel_command.h"
#include "windshield_command.h"

namespace {

using cli::ExitCode;
using cli::exitCodeOf;

int fail(std::string_view message, ExitCode code)
{
    std::cerr << cli::paint("droplet-shape: ", cli::Colour::Red) << cli::oneLine(message) << std::endl;
    return static_cast<int>(code);
}

/// Takes the numbers of closed standard streams, so that no file of ours gets them and the words meant for them: for
/// reading where one writes and for writing where one reads, so that using them still fails.
void occupyStandardStreams()
{
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        if (fcntl(stream, F_GETFD) == -1) {
            open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
        }
    }
}

/// Keeps memory that was freed for what comes next: to give every long array back to the system and have its pages
/// cleared again takes a tenth of a run of a million triangles.
void keepMemory()
{
    constexpr int kNever = 1 << 30;
    constexpr int kAtOnce = 1 << 24;
    mallopt(M_MMAP_THRESHOLD, kNever);
    mallopt(M_TRIM_THRESHOLD, kNever);
    mallopt(M_TOP_PAD, kAtOnce);
}

/// What is run when the first argument is its name.
struct Command {
    std::string_view name;
    int (*run)(int argc, const char* const* argv);
};

const std::vector<Command>& commands()
{
    static const std::vector<Command> all{{"animate", cli::runAnimate},        {"batch", cli::runBatch},
                                          {"compare", cli::runCompare},        {"glyphs", cli::runGlyphs},
                                          {"wind-tunnel", cli::runWindTunnel}, {"windshield", cli::runWindshield}};
    return all;
}

/// A word that is nearly a command's name, and no file, was meant for it.
void refuseMisspelt(const std::string& word)
{
    std::vector<std::string> names;
    for (const Command& command : commands()) {
        names.emplace_back(command.name);
    }
    std::error_code ignored;
    const std::string name = std::filesystem::exists(word, ignored) ? "" : cli::nearestName(word, names);
    if (!name.empty()) {
        cli::refuse("unknown command '" + word + "', did you mean " + name + "?");
    }
}

int run(int argc, const char* const* argv)
{
    for (const Command& command : commands()) {
        if (argc > 1 && argv[1] == command.name) {
            return command.run(argc - 1, argv + 1);
        }
    }
    refuseMisspelt(argc > 1 ? argv[1] : "");
    return cli::runShape(argc, argv);
}

int guardedRun(int argc, const char* const* argv)
{
    try {
        return run(argc, argv);
    } catch (const droplet::Error& error) {
        return fail(error.what(), exitCodeOf(error.code()));
    } catch (const std::bad_alloc&) {
        return fail("out of memory; fewer --triangles or a smaller picture need less", ExitCode::InternalError);
    } catch (const std::exception& error) {
        return fail(std::string("internal error: ") + error.what(), ExitCode::InternalError);
    }
}

}  // namespace

int main(int argc, char** argv)
{
    // A reader that went away is then a failed write like any other, found and named where it happens.
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);  // so is a file beyond the limit of its size
    cli::cleanUpOnSignals();
    occupyStandardStreams();
    keepMemory();
    const int code = guardedRun(argc, argv);
    // Not by a return, which waits for threads of libraries: those of OpenBLAS, which may stand for the LAPACK that
    // OpenCV loads, wait without end where memory is limited.
    std::cout.flush();
    std::_Exit(code);
}
