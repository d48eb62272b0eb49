// SPDX-License-Identifier: GPL-3.0-or-later
#include "program.h"

#include <fcntl.h>
#include <malloc.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <iostream>

#include "interruption.h"
#include "shortage.h"

namespace cli {
namespace {

/// Opens /dev/null for closed standard streams, so that no other file gets their numbers and their output. Streams for
/// writing are opened for reading, and the reverse, so that using them still fails.
void occupyStandardStreams()
{
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        if (fcntl(stream, F_GETFD) == -1) {
            open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
        }
    }
}

/// Lets malloc keep freed memory. Returning long arrays to the system and clearing their pages again takes a tenth of a
/// run of a million triangles.
void keepFreedMemory()
{
    constexpr int kNever = 1 << 30;
    constexpr int kAtOnce = 1 << 24;
    mallopt(M_MMAP_THRESHOLD, kNever);
    mallopt(M_TRIM_THRESHOLD, kNever);
    mallopt(M_TOP_PAD, kAtOnce);
}

}  // namespace

void runProgram(int argc, char** argv, std::span<const Command> commands)
{
    // Writing to a closed pipe then fails like any other write, and is reported where it happens.
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);  // likewise for the limit of file sizes
    cleanUpOnSignals();
    reportShortages();
    occupyStandardStreams();
    keepFreedMemory();
    const int code = runGuarded(argc, argv, commands);
    // A return would wait for threads of libraries. Those of OpenBLAS, which OpenCV may load as its LAPACK, never end
    // if memory is limited.
    std::cout.flush();
    std::_Exit(code);
}

}  // namespace cli
