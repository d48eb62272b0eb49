// SPDX-License-Identifier: GPL-3.0-or-later
#include "interruption.h"

#include <unistd.h>

#include <array>
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

void endBySignal(int signal)
{
    std::signal(signal, SIG_DFL);
    std::raise(signal);
    ::_exit(1);  // the signal is blocked
}

struct Interruption::Before {
    struct Handled {
        int signal;
        struct sigaction action = {};
    };
    std::array<Handled, 3> handled{{{SIGINT}, {SIGTERM}, {SIGHUP}}};
};

Interruption::Interruption() : before_(new Before)
{
    received_signal = 0;
    for (Before::Handled& handled : before_->handled) {
        handle(
            handled.signal,
            [](int signal) {
                if (received_signal.exchange(signal) != 0) {
                    endBy(signal);
                }
            },
            &handled.action);
    }
}

Interruption::~Interruption()
{
    for (const Before::Handled& handled : before_->handled) {
        sigaction(handled.signal, &handled.action, nullptr);
    }
}

int Interruption::receivedSignal()
{
    return received_signal;
}

}  // namespace cli
