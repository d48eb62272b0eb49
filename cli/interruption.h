// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

namespace cli {

/// Lets the process remove temporary files before SIGINT, SIGTERM, SIGHUP or SIGXCPU ends it. Windows has ^C and the
/// closing of the console instead.
void cleanUpOnSignals();

/// Ends the process by a signal, as if nothing had caught it.
[[noreturn]] void endBySignal(int signal);

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
    struct Before;
    std::unique_ptr<Before> before_;  ///< what happened on signals before the scope
};

}  // namespace cli
