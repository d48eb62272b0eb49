// SPDX-License-Identifier: GPL-3.0-or-later
// The parts of TBB that the library uses, on one thread: WebAssembly has threads only in pages that are served with
// special headers.
#pragma once

#include <cstddef>

namespace tbb {

template <typename Value>
class blocked_range {
public:
    blocked_range(Value begin, Value end, std::size_t = 1) : begin_(begin), end_(end) {}

    [[nodiscard]] Value begin() const { return begin_; }
    [[nodiscard]] Value end() const { return end_; }

private:
    Value begin_;
    Value end_;
};

}  // namespace tbb
