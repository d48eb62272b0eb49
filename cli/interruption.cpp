// SPDX-License-Identifier: GPL-3.0-or-later
#include "interruption.h"

#include <atomic>

namespace cli {
namespace {

/// Handlers of signals reach nothing but globals.
std::atomic<int> asked_to_end{0};
static_assert(std::atomic<int>::is_always_lock_free);

}  // namespace

Interruption::Interruption()
{
    asked_to_end = 0;
    for (Handled& handled : handled_) {
        struct sigaction action = {};
        action.sa_handler = [](int signal) { asked_to_end = signal; };
        action.sa_flags = static_cast<int>(SA_RESTART | SA_RESETHAND);
        sigaction(handled.signal, nullptr, &handled.before);
        if (handled.before.sa_handler != SIG_IGN) {  // as nohup wants it
            sigaction(handled.signal, &action, nullptr);
        }
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
