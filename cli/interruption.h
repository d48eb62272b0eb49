// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <signal.h>

#include <array>

namespace cli {

/// Installs handlers that remove temporary files before SIGINT, SIGTERM, SIGHUP or SIGXCPU ends the process.
void cleanUpOnSignals();

/// Scope in which the first SIGINT, SIGTERM or SIGHUP is only recorded; a second one ends the process.
class Interruption {
public:
    Interruption();
    ~Interruption();

    Interruption(const Interruption&) = delete;
    Interruption& operator=(const Interruption&) = delete;

    /// Recorded signal, or 0.
    [[nodiscard]] static int receivedSignal();

private:
    struct Handled {
        int signal;
        struct sigaction before = {};
    };
    std::array<Handled, 3> handled_{{{SIGINT}, {SIGTERM}, {SIGHUP}}};
};

}  // namespace cli
