// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <signal.h>

#include <array>

namespace cli {

/// While one lives, signals that ask for an end (SIGINT, SIGTERM, SIGHUP) are noted, once each; a second one ends the
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
