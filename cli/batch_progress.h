// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "batch_manifest.h"
#include "batch_options.h"
#include "seconds.h"

namespace cli {

/// Says on standard error how far a batch has come, one item after another.
class BatchProgress {
public:
    BatchProgress(std::size_t items, const BatchOptions& options);

    void tell(const BatchItem& item, const ManifestRow& row);

    /// Draws the bar anew, if there is one and it is not fresh.
    void drawBar(std::size_t ended) { drawBar("", ended, items_); }

    /// Ends the time that making takes.
    void endMaking() { made_after_ = elapsed(); }

    /// Says how many of the contact sheet's droplets are drawn.
    void tellDrawn(std::size_t drawn, std::size_t count);

    /// The last words.
    void summarise(const std::vector<ManifestRow>& rows);

    [[nodiscard]] double elapsed() const { return secondsSince(start_); }

private:
    void drawBar(const char* what, std::size_t ended, std::size_t count);
    void eraseBar();

    const BatchOptions& options_;
    std::size_t items_;
    bool bar_;
    std::size_t told_ = 0;
    std::size_t drawn_tiles_ = 0;
    double made_after_ = 0.0;  ///< how long it took to make all [s]
    bool drawn_ = false;
    Clock::time_point start_ = Clock::now();
    Clock::time_point drawn_at_ = start_;
};

}  // namespace cli
