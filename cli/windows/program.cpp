// SPDX-License-Identifier: GPL-3.0-or-later
// The program's manifest makes UTF-8 the code page of arguments, paths and the C library; see src/cmake/windows.
#include "program.h"

#include <fcntl.h>
#include <io.h>
#include <windows.h>

#include <cstdio>
#include <cstdlib>
#include <iostream>

#include "interruption.h"
#include "shortage.h"

// MinGW's C library: patterns such as *.png stay as they are given.
// NOLINTNEXTLINE(readability-identifier-naming,misc-definitions-in-headers): its name
int _CRT_glob = 0;

namespace cli {

void runProgram(int argc, char** argv, std::span<const Command> commands)
{
    // Lines end as they are written.
    for (std::FILE* const stream : {stdin, stdout, stderr}) {
        ::_setmode(::_fileno(stream), _O_BINARY);
    }
    const UINT code_page = ::GetConsoleOutputCP();
    ::SetConsoleOutputCP(CP_UTF8);
    cleanUpOnSignals();
    reportShortages();
    const int code = runGuarded(argc, argv, commands);
    std::cout.flush();
    ::SetConsoleOutputCP(code_page);
    std::_Exit(code);
}

}  // namespace cli
