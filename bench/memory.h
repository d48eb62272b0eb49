// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>

namespace droplet::bench {

/// Rise of the process's peak memory since construction.
class PeakMemory {
public:
    /// Returns free memory to the system, so that it counts when it is used again, and resets the peak.
    PeakMemory();

    /// Peak of resident memory since construction minus the resident memory then [bytes]; nothing if Linux does not
    /// report it.
    [[nodiscard]] std::optional<std::uint64_t> rise() const;

private:
    std::optional<std::uint64_t> before_;
};

}  // namespace droplet::bench
