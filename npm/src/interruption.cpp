// SPDX-License-Identifier: GPL-3.0-or-later
// Signals come from the thread that has started the command.
#include "interruption.h"

#include <csignal>
#include <cstdlib>

#include "host.h"

namespace cli {

void endBySignal(int signal)
{
    std::signal(signal, SIG_DFL);
    std::raise(signal);
    std::abort();
}

struct Interruption::Before {};

Interruption::Interruption()
{
    droplet_host_await_signals(true);
}

Interruption::~Interruption()
{
    droplet_host_await_signals(false);
}

int Interruption::receivedSignal()
{
    return droplet_host_received_signal();
}

}  // namespace cli
