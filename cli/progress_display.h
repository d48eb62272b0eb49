// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "common_options.h"
#include "droplet/progress.h"
#include "seconds.h"

namespace cli {

/// Progress of a run on standard error. While it exists, nothing else may write there.
class ProgressDisplay {
public:
    /// @param terms  of the command, for warnings
    explicit ProgressDisplay(ProgressMode mode, CommandTerms terms = {});
    /// Erases the bar.
    ~ProgressDisplay();

    ProgressDisplay(const ProgressDisplay&) = delete;
    ProgressDisplay& operator=(const ProgressDisplay&) = delete;

    /// Shows a stage, unless it comes before the current one, and how far it is.
    /// @param share  as of droplet::Progress
    void begin(droplet::Stage stage, double share = 0.0);

    /// Starts again with the first stage, for another item.
    /// @param item  name in the bar, such as "frame 3 of 12"
    void restart(std::string item);

    /// Shows how many frames are finished.
    void reportFrame(std::size_t frame, std::size_t count);

    /// Shows how many pictures of all items are drawn.
    void reportDrawn(std::size_t drawn, std::size_t count);

    /// Writes a warning at once.
    void warn(const std::string& warning);

    /// Ends the display after a successful run.
    void finish();

private:
    [[nodiscard]] double elapsed() const { return secondsSince(start_); }
    [[nodiscard]] std::string bar() const;
    void report(const char* what, std::size_t done, std::size_t count);
    void writeLine(droplet::Stage stage, bool done) const;
    void draw();
    void drawIfDue();
    void drawUntilStopped();
    void stop();

    ProgressMode mode_;
    CommandTerms terms_;
    Clock::time_point start_ = Clock::now();
    std::mutex mutex_;
    std::condition_variable stopping_;
    std::optional<droplet::Stage> stage_;
    double share_ = 0.0;  ///< of the stage
    std::string item_;
    std::string counted_;    ///< what is counted instead of stages
    std::size_t done_ = 0;   ///< number of these
    std::size_t count_ = 0;  ///< of all of them; 0 before the first
    bool stopped_ = false;
    bool is_drawn_ = false;
    std::optional<Clock::time_point> next_bar_;  ///< time of the next bar, where no thread draws it
    std::thread drawer_;                         ///< keeps the bar moving during long stages
};

}  // namespace cli
