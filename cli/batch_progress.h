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
    void drawBar(std::size_t ended);

    /// The last words.
    void summarise(const std::vector<ManifestRow>& rows);

    [[nodiscard]] double elapsed() const { return secondsSince(start_); }

private:
    void eraseBar();

    const BatchOptions& options_;
    std::size_t items_;
    bool bar_;
    std::size_t told_ = 0;
    bool drawn_ = false;
    Clock::time_point start_ = Clock::now();
    Clock::time_point drawn_at_ = start_;
};

}  // namespace cli
