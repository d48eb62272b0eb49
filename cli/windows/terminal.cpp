// SPDX-License-Identifier: GPL-3.0-or-later
#include "terminal.h"

#include <windows.h>

namespace cli {

bool errorIsTerminal()
{
    // Consoles obey control sequences since Windows 10, if asked to.
    const HANDLE error = ::GetStdHandle(STD_ERROR_HANDLE);
    DWORD mode = 0;
    return ::GetConsoleMode(error, &mode) != FALSE &&
           ::SetConsoleMode(error, mode | ENABLE_VIRTUAL_TERMINAL_PROCESSING) != FALSE;
}

}  // namespace cli
