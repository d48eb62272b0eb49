// SPDX-License-Identifier: GPL-3.0-or-later
#include "interruption.h"

#include <atomic>
#include <csignal>

#include "droplet/io/output.h"

namespace cli {
namespace {

/// Removes unfinished files and ends the process by a signal.
void endBy(int signal)
{
    droplet::removeUnfinished();
    std::signal(signal, SIG_DFL);
    std::raise(signal);  // takes effect when the handler returns
}

/// Sets a handler, unless the signal is ignored, as under nohup.
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

// Signal handlers can access only globals.
std::atomic<int> received_signal{0};
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
    received_signal = 0;
    for (Handled& handled : handled_) {
        handle(
            handled.signal,
            [](int signal) {
                if (received_signal.exchange(signal) != 0) {
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

int Interruption::receivedSignal()
{
    return received_signal;
}

}  // namespace cli
