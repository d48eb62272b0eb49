// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>

#include "droplet/progress.h"
#include "droplet_options.h"
#include "seconds.h"

namespace cli {

/// Shows on standard error how far a run has come. While one lives, nobody else may write there.
class ProgressDisplay {
public:
    explicit ProgressDisplay(ProgressMode mode);
    /// Erases the bar.
    ~ProgressDisplay();

    ProgressDisplay(const ProgressDisplay&) = delete;
    ProgressDisplay& operator=(const ProgressDisplay&) = delete;

    void begin(droplet::Stage stage);

    /// What follows is told anew: the same stages of another item.
    void restart();

    /// The run is over and went well.
    void finish();

private:
    [[nodiscard]] double elapsed() const { return secondsSince(start_); }
    void writeLine(droplet::Stage stage, bool done) const;
    void drawUntilStopped();
    void stop();

    ProgressMode mode_;
    Clock::time_point start_ = Clock::now();
    std::mutex mutex_;
    std::condition_variable stopping_;
    std::optional<droplet::Stage> stage_;
    bool stopped_ = false;
    std::thread drawer_;  ///< a long stage must not keep the bar from moving
};

}  // namespace cli
