// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tbb/blocked_range.h>

namespace tbb {

template <typename Index, typename Work>
void parallel_for(Index begin, Index end, const Work& work)
{
    for (Index i = begin; i < end; ++i) {
        work(i);
    }
}

template <typename Value, typename Work>
void parallel_for(const blocked_range<Value>& range, const Work& work)
{
    if (range.begin() < range.end()) {
        work(range);
    }
}

}  // namespace tbb
