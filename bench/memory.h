// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>

namespace droplet::bench {

/// How much memory the process takes beyond what it held when this was made.
class PeakMemory {
public:
    /// Gives free memory back to the system, so that it counts when it is taken again, and forgets earlier peaks.
    PeakMemory();

    /// Most that was resident since, beyond what was resident then; none where Linux does not say [bytes].
    [[nodiscard]] std::optional<std::uint64_t> risen() const;

private:
    std::optional<std::uint64_t> before_;
};

}  // namespace droplet::bench
