// SPDX-License-Identifier: GPL-3.0-or-later
// Windows runs the handler in a thread of its own. Unfinished files vanish with the process; see
// src/io/windows/draft.cpp.
#include "interruption.h"

#include <windows.h>

#include <atomic>
#include <csignal>

namespace cli {
namespace {

constexpr UINT kEnded = 0xC000013A;  // STATUS_CONTROL_C_EXIT, with which Windows itself ends a program by ^C

// The handler can access only globals.
std::atomic<bool> is_recording{false};
std::atomic<int> received_signal{0};

BOOL WINAPI onEvent(DWORD event)
{
    const int signal = event == CTRL_C_EVENT ? SIGINT : SIGTERM;
    if (!is_recording || received_signal.exchange(signal) != 0) {
        ::ExitProcess(kEnded);
    }
    // Windows ends the process when the handler of a closing console returns, or some seconds later.
    if (event != CTRL_C_EVENT && event != CTRL_BREAK_EVENT) {
        ::Sleep(INFINITE);
    }
    return TRUE;
}

}  // namespace

void cleanUpOnSignals()
{
    ::SetConsoleCtrlHandler(onEvent, TRUE);
}

void endBySignal(int /*signal*/)
{
    ::ExitProcess(kEnded);
}

struct Interruption::Before {};

Interruption::Interruption()
{
    received_signal = 0;
    is_recording = true;
}

Interruption::~Interruption()
{
    is_recording = false;
}

int Interruption::receivedSignal()
{
    return received_signal;
}

}  // namespace cli
