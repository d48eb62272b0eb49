// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "droplet/io/report.h"
#include "droplet/progress.h"
#include "seconds.h"

namespace cli {

/// Clock that adds up the time of each stage.
class StageClock {
public:
    /// @param share  as of droplet::Progress
    void begin(droplet::Stage stage, double share = 0.0)
    {
        if (share > 0.0) {
            return;
        }
        close();
        current_ = stage;
    }

    /// Time of every stage up to now [s].
    std::array<double, droplet::kStageCount> times()
    {
        close();
        return times_;
    }

    [[nodiscard]] double total() const { return secondsSince(start_); }

private:
    void close()
    {
        const auto now = Clock::now();
        if (current_) {
            times_[static_cast<std::size_t>(*current_)] += seconds(since_, now);
        }
        since_ = now;
    }

    Clock::time_point start_ = Clock::now();
    Clock::time_point since_ = start_;
    std::optional<droplet::Stage> current_;
    std::array<double, droplet::kStageCount> times_{};
};

}  // namespace cli
