// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <signal.h>

#include <array>

namespace cli {

/// From here on signals that end the process (SIGINT, SIGTERM, SIGHUP, SIGXCPU) remove its temporary files first.
void cleanUpOnSignals();

/// While one lives, the first signal that asks for an end (SIGINT, SIGTERM, SIGHUP) is noted; a second one ends the
/// process.
class Interruption {
public:
    Interruption();
    ~Interruption();

    Interruption(const Interruption&) = delete;
    Interruption& operator=(const Interruption&) = delete;

    /// The signal that asked for an end, or 0.
    [[nodiscard]] static int asked();

private:
    struct Handled {
        int signal;
        struct sigaction before = {};
    };
    std::array<Handled, 3> handled_{{{SIGINT}, {SIGTERM}, {SIGHUP}}};
};

}  // namespace cli
