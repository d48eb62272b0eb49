// SPDX-License-Identifier: GPL-3.0-or-later
#include "interruption.h"

#include <atomic>
#include <csignal>

#include "droplet/io/output.h"

namespace cli {
namespace {

/// Ends the process by a signal, without what it has half written.
void endBy(int signal)
{
    droplet::removeUnfinished();
    std::signal(signal, SIG_DFL);
    std::raise(signal);  // takes effect when the handler returns
}

/// Sets a handler, but where the signal is ignored, as nohup wants it.
void handle(int signal, void (*handler)(int), struct sigaction* before = nullptr)
{
    struct sigaction action = {};
    struct sigaction found = {};
    action.sa_handler = handler;
    action.sa_flags = SA_RESTART;
    sigaction(signal, nullptr, &found);
    if (before != nullptr) {
        *before = found;
    }
    if (found.sa_handler != SIG_IGN) {
        sigaction(signal, &action, nullptr);
    }
}

/// Handlers of signals reach nothing but globals.
std::atomic<int> asked_to_end{0};
static_assert(std::atomic<int>::is_always_lock_free);

}  // namespace

void cleanUpOnSignals()
{
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGXCPU}) {
        handle(signal, endBy);
    }
}

Interruption::Interruption()
{
    asked_to_end = 0;
    for (Handled& handled : handled_) {
        handle(
            handled.signal,
            [](int signal) {
                if (asked_to_end.exchange(signal) != 0) {
                    endBy(signal);
                }
            },
            &handled.before);
    }
}

Interruption::~Interruption()
{
    for (const Handled& handled : handled_) {
        sigaction(handled.signal, &handled.before, nullptr);
    }
}

int Interruption::asked()
{
    return asked_to_end;
}

}  // namespace cli
