// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <optional>
#include <string>
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
    /// @param item  how the bar calls it, such as "frame 3 of 12"
    void restart(std::string item);

    /// So many of the pictures of all items are drawn.
    void tellDrawn(std::size_t drawn, std::size_t count);

    /// The run is over and went well.
    void finish();

private:
    [[nodiscard]] double elapsed() const { return secondsSince(start_); }
    [[nodiscard]] std::string bar() const;
    void writeLine(droplet::Stage stage, bool done) const;
    void drawUntilStopped();
    void stop();

    ProgressMode mode_;
    Clock::time_point start_ = Clock::now();
    std::mutex mutex_;
    std::condition_variable stopping_;
    std::optional<droplet::Stage> stage_;
    std::string item_;
    std::size_t drawn_ = 0;
    std::size_t to_draw_ = 0;  ///< 0 before the first is drawn
    bool stopped_ = false;
    std::thread drawer_;  ///< a long stage must not keep the bar from moving
};

}  // namespace cli
