// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "batch_manifest.h"
#include "batch_options.h"
#include "seconds.h"

namespace cli {

/// Reports the progress of a batch on standard error.
class BatchProgress {
public:
    BatchProgress(std::size_t items, const BatchOptions& options);

    /// Prints the result of an item.
    void reportItem(const BatchItem& item, const ManifestRow& row);

    /// Redraws the bar, at most ten times a second.
    void drawBar(std::size_t ended) { drawBar("", ended, items_); }

    /// Stops the clock of the items.
    void endMaking() { made_after_ = elapsed(); }

    /// Shows how many droplets of the contact sheet are drawn.
    void reportDrawn(std::size_t drawn, std::size_t count);

    /// Prints the summary.
    void summarise(const std::vector<ManifestRow>& rows);

    [[nodiscard]] double elapsed() const { return secondsSince(start_); }

private:
    void drawBar(const char* what, std::size_t ended, std::size_t count);
    void eraseBar();

    const BatchOptions& options_;
    std::size_t items_;
    bool bar_;
    std::size_t reported_ = 0;
    std::size_t drawn_tiles_ = 0;
    double made_after_ = 0.0;  ///< time until all items were made [s]
    bool drawn_ = false;       ///< whether the bar is on the screen
    Clock::time_point start_ = Clock::now();
    Clock::time_point drawn_at_ = start_;
};

}  // namespace cli
