// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

namespace tbb {

/// Limits that have no effect: there is one thread.
class global_control {
public:
    enum parameter { max_allowed_parallelism, thread_stack_size };

    global_control(parameter, std::size_t) {}
    global_control(const global_control&) = delete;
    global_control& operator=(const global_control&) = delete;

    static std::size_t active_value(parameter) { return 1; }
};

}  // namespace tbb
